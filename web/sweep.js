// What accuracy costs this scene, measured by the service on request: a job with its progress, that can be cancelled, in
// a dialog. What it found stays known for as long as the document is the same but for its accuracy.

import * as api from "./api.js";
import { createPlot } from "./accuracy_plot.js";
import { byId, el } from "./dom.js";

const kLookMs = 400; // how often the job is asked for
const kTold = 0.05; // the part that is done, before the rest can be told from it
const pause = (ms, signal) => new Promise((done, failed) => {
  const timer = setTimeout(done, ms);
  signal.addEventListener("abort", () => {
    clearTimeout(timer);
    failed(new DOMException("cancelled", "AbortError"));
  }, { once: true });
});
const isDark = () => window.matchMedia("(prefers-color-scheme: dark)").matches;
const seconds = (ms) => `${Math.round(ms / 1000)} s`;

// What a measurement is of: everything but what chooses the rung.
const matterOf = ({ accuracy: _accuracy, ...rest }) => Object.entries(rest);
const same = (a, b) => a.length === b.length && a.every(([name, value], i) => b[i][0] === name && b[i][1] === value);

// choose(name): a rung. measured(): there are figures now. rung() -> the name of the chosen one.
export function createSweep(store, { choose, measured, rung, failed, timeText, errorText }) {
  const dialog = byId("sweep");
  const busy = byId("sweep-busy");
  const close = byId("sweep-close");
  const image = byId("sweep-plot");
  const bar = el("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress of the measurement" });
  const plot = createPlot({ choose, timeText, errorText });
  const left = el("p", { class: "why", id: "sweep-left-out" });
  const pictures = el("button", { type: "button", id: "sweep-pictures", onclick: () => run(draw) }, "With the picture of every rung");
  const body = el("div", { id: "sweep-body", hidden: true }, plot.element, left, pictures);
  busy.after(bar);
  byId("sweep-scroll").prepend(body);
  let flight = null;
  let url = null;
  let known = null; // { matter, rungs: [{ rung, time_ms, error }], left_out }

  const isKnown = () => known !== null && same(known.matter, matterOf(store.scene));

  function forgetPicture() {
    image.hidden = true;
    image.removeAttribute("src");
    if (url) URL.revokeObjectURL(url);
    url = null;
  }
  // What there is, by what is known.
  function show() {
    body.hidden = !isKnown();
    if (body.hidden) return;
    plot.show(known.rungs, rung());
    left.textContent = known.left_out.map(({ rung: name, reason }) => `${name}: ${reason}.`).join(" ");
  }

  // A job, looked at until it ends. tell(progress 0..1)
  async function job(text, tell, signal) {
    let place = null;
    try {
      place = await api.beginJob(text, { signal });
      for (;;) {
        const { state, progress } = await api.job(place, { signal });
        tell(progress);
        if (!["queued", "running"].includes(state)) break;
        await pause(kLookMs, signal);
      }
      return await api.jobResult(place, { signal });
    } catch (error) {
      if (signal.aborted && place) api.dropJob(place).catch(() => {}); // it is over already
      throw error;
    }
  }
  async function measure(tell, signal) {
    const matter = matterOf(store.scene);
    const text = await (await job(`{"kind": "accuracy", "format": "json", "scene": ${store.text}}`, tell, signal)).text();
    const { rungs, left_out: out } = JSON.parse(text);
    known = { matter, rungs: rungs.filter(({ time_ms: ms, error }) => typeof ms === "number" && typeof error === "number"), left_out: out ?? [] };
    measured();
  }
  // The service's own plot, with pictures: measured once more, within the time of a request.
  async function draw(_tell, signal) {
    const blob = await api.accuracyPlot(store.text, { dark: isDark(), signal });
    forgetPicture();
    url = URL.createObjectURL(blob);
    image.src = url;
    await image.decode().catch(() => {});
    image.hidden = false;
  }

  async function run(what) {
    flight?.abort();
    const mine = new AbortController();
    flight = mine;
    const started = performance.now();
    let done = 0;
    const tick = () => {
      const took = performance.now() - started;
      const rest = done > kTold ? `, about ${seconds((took * (1 - done)) / done)} more` : "";
      busy.textContent = `Tracing the truth and timing every rung: ${seconds(took)}${rest}`;
    };
    tick();
    const clock = setInterval(tick, 1000);
    bar.removeAttribute("value"); // nothing is known of it yet
    body.hidden = true;
    forgetPicture();
    busy.hidden = bar.hidden = false;
    dialog.setAttribute("aria-busy", "true");
    close.textContent = "Cancel";
    if (!dialog.open) dialog.showModal();
    try {
      await what((progress) => {
        done = progress;
        if (progress > 0) bar.value = progress;
      }, mine.signal);
    } catch (error) {
      if (mine.signal.aborted) return; // closed, or begun anew
      dialog.close();
      failed(error);
    } finally {
      clearInterval(clock);
      if (flight === mine) {
        flight = null;
        dialog.setAttribute("aria-busy", "false");
        busy.hidden = bar.hidden = true;
        close.textContent = "Close";
        show();
      }
    }
  }
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("close", () => { // by Escape, too
    flight?.abort();
    flight = null;
    forgetPicture();
  });

  return {
    begin() {
      if (!isKnown()) {
        run(measure);
        return;
      }
      dialog.setAttribute("aria-busy", "false");
      busy.hidden = bar.hidden = true;
      close.textContent = "Close";
      show();
      dialog.showModal();
    },
    // Another rung is chosen.
    refresh() { if (dialog.open && !body.hidden) plot.mark(rung()); },
    // What was measured of the document as it stands: by the rung's name, { time_ms, error }.
    get figures() { return isKnown() ? new Map(known.rungs.map((one) => [one.rung, one])) : new Map(); },
    forget() { known = null; },
  };
}
