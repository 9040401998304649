// The sequence of the document as an animated picture: a job of the service, with its progress, that can be cancelled.

import * as api from "./api.js";
import { at } from "./document.js";
import { el } from "./dom.js";

const kLookMs = 500; // how often the job is asked for
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// save(blob, suffix): as a file. failed(problem), note(text).
export function createAnimation(store, { save, failed, note }) {
  let running = null; // AbortController
  const button = el("button", { type: "button", "aria-describedby": "animation-why", onclick: begin }, "Animation");
  const why = el("p", { id: "animation-why", class: "why", hidden: true }, "An animation needs a sequence: see the group Time.");
  const bar = el("progress", { max: 1, value: 0, "aria-label": "Progress of the animation" });
  const cancel = el("button", { type: "button", onclick: () => running?.abort() }, "Cancel the animation");
  const line = el("span", { class: "together", hidden: true }, bar, cancel);

  const hasSequence = () => {
    const sequence = at(store.scene, "/sequence");
    return sequence !== undefined && sequence !== "none";
  };
  async function begin() {
    if (running) return;
    if (!hasSequence()) {
      note(why.textContent);
      return;
    }
    running = new AbortController();
    const { signal } = running;
    let place = null;
    line.hidden = false;
    bar.value = 0;
    try {
      place = await api.beginJob(`{"kind": "sequence", "format": "webp", "scene": ${api.withoutLayers(store.text)}}`, { signal });
      for (;;) {
        const job = await api.job(place, { signal });
        bar.value = job.progress;
        if (!["queued", "running"].includes(job.state)) break;
        await pause(kLookMs);
        if (signal.aborted) throw new DOMException("cancelled", "AbortError");
      }
      save(await api.jobResult(place, { signal }), ".webp");
    } catch (error) {
      if (signal.aborted && place) {
        api.dropJob(place).catch(() => {});
        note("The animation is cancelled.");
      }
      failed(error);
    } finally {
      running = null;
      line.hidden = true;
    }
  }
  return {
    elements: [button, line],
    why,
    refresh() {
      // Not `disabled`: it stays reachable, so that its explanation can be read.
      button.setAttribute("aria-disabled", String(!hasSequence()));
    },
  };
}
