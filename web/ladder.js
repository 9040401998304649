// One track from faster to truer, with the rungs of the ladder as its ticks: above each the time that its picture is
// expected to take, below it the error.

import { el, freshId, plain } from "./dom.js";

// The service's own, where nobody has set another (awan serve --deadline): what is expected to take longer is refused.
const kDeadlineMs = 30_000;

const timeText = (ms) => (ms >= 3_600_000 ? `${plain(ms / 3_600_000, 1)} h` : ms >= 60_000 ? `${plain(ms / 60_000, 2)} min`
  : ms >= 1000 ? `${plain(ms / 1000, 2)} s` : `${plain(ms, 1)} ms`);
const errorText = (error) => `${plain(100 * error, error < 0.1 ? 1 : 2)} %`;

// choose(name, { moving }): a rung.
export function createLadder(choose) {
  const id = freshId("ladder");
  let rungs = []; // [{ rung, time_ms, error }], the cheapest first
  const times = el("ol", { class: "ticks", "aria-hidden": "true" });
  const errors = el("ol", { class: "ticks", "aria-hidden": "true" });
  const range = el("input", { type: "range", id, min: 0, max: 1, step: 1, disabled: true });
  const element = el("div", { class: "ladder", "data-pointer": "/accuracy/ladder" },
    el("label", { for: id }, el("span", {}, "Faster"), el("span", {}, "Truer")), times, range, errors);
  const chosen = (moving) => () => {
    const one = rungs[range.valueAsNumber];
    if (one) choose(one.rung, { moving });
  };
  range.addEventListener("input", chosen(true));
  range.addEventListener("change", chosen(false));

  function show(name) {
    const index = rungs.findIndex(({ rung }) => rung === name);
    range.disabled = rungs.length < 2;
    if (index < 0) return;
    const { time_ms: ms, error } = rungs[index];
    range.value = String(index);
    range.style.setProperty("--fill", `${(100 * index) / Math.max(1, rungs.length - 1)}%`);
    const late = ms > kDeadlineMs ? ", longer than the service waits" : "";
    range.setAttribute("aria-valuetext", `${name}: about ${errorText(error)} error, ${timeText(ms)}${late}`);
    [times, errors].forEach((list) => [...list.children].forEach((tick, i) => tick.classList.toggle("here", i === index)));
  }
  return {
    element,
    // Of the answer of /v1/plan; [] when nothing is known of the document yet.
    offer(all, name) {
      rungs = all.filter(({ time_ms: ms, error }) => typeof ms === "number" && typeof error === "number");
      range.max = String(Math.max(1, rungs.length - 1));
      const ticks = (text) => rungs.map((one) => el("li", { class: one.time_ms > kDeadlineMs ? "late" : undefined, title: one.rung }, text(one)));
      times.replaceChildren(...ticks((one) => timeText(one.time_ms)));
      errors.replaceChildren(...ticks((one) => errorText(one.error)));
      show(name);
    },
    show,
  };
}
