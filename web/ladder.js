// One track from faster to truer, with the rungs of the ladder as its ticks: above each the time that its picture is
// expected to take, below it the error; or both as they were measured, where they were.

import { el, freshId, plain } from "./dom.js";

// The service's own, where nobody has set another (awan serve --deadline): what is expected to take longer is refused.
const kDeadlineMs = 30_000;

export const timeText = (ms) => (ms >= 3_600_000 ? `${plain(ms / 3_600_000, 1)} h` : ms >= 60_000 ? `${plain(ms / 60_000, 2)} min`
  : ms >= 1000 ? `${plain(ms / 1000, 2)} s` : `${plain(ms, 1)} ms`);
export const errorText = (error) => `${plain(100 * error, error < 0.1 ? 1 : 2)} %`;

// choose(name, { moving }): a rung.
export function createLadder(choose) {
  const id = freshId("ladder");
  let expected = []; // [{ rung, time_ms, error }], the cheapest first
  let figures = new Map(); // of those that were measured: { time_ms, error }
  let rungs = []; // as they are shown: `expected`, and what was measured in its place
  let chosenOne = "";
  const times = el("ol", { class: "ticks", "aria-hidden": "true" });
  const errors = el("ol", { class: "ticks", "aria-hidden": "true" });
  const range = el("input", { type: "range", id, min: 0, max: 1, step: 1, disabled: true });
  const legend = el("p", { class: "why", hidden: true }, "Underlined: measured here.");
  const element = el("div", { class: "ladder", "data-pointer": "/accuracy/ladder" },
    el("label", { for: id }, el("span", {}, "Faster"), el("span", {}, "Truer")), times, range, errors, legend);
  const chosen = (moving) => () => {
    const one = rungs[range.valueAsNumber];
    if (one) choose(one.rung, { moving });
  };
  range.addEventListener("input", chosen(true));
  range.addEventListener("change", chosen(false));

  function show(name) {
    chosenOne = name;
    const index = rungs.findIndex(({ rung }) => rung === name);
    range.disabled = rungs.length < 2;
    if (index < 0) return;
    const { time_ms: ms, error, measured } = rungs[index];
    range.value = String(index);
    range.style.setProperty("--fill", `${(100 * index) / Math.max(1, rungs.length - 1)}%`);
    const late = ms > kDeadlineMs ? ", longer than the service waits" : "";
    range.setAttribute("aria-valuetext", `${name}: ${measured ? "measured" : "about"} ${errorText(error)} error, ${timeText(ms)}${late}`);
    [times, errors].forEach((list) => [...list.children].forEach((tick, i) => tick.classList.toggle("here", i === index)));
  }
  function fill() {
    rungs = expected.map((one) => (figures.has(one.rung) ? { ...one, ...figures.get(one.rung), measured: true } : one));
    range.max = String(Math.max(1, rungs.length - 1));
    const classOf = (one) => [one.time_ms > kDeadlineMs && "late", one.measured && "measured"].filter(Boolean).join(" ") || undefined;
    const ticks = (text) => rungs.map((one) => el("li", { class: classOf(one), title: one.rung }, text(one)));
    times.replaceChildren(...ticks((one) => timeText(one.time_ms)));
    errors.replaceChildren(...ticks((one) => errorText(one.error)));
    legend.hidden = !rungs.some((one) => one.measured);
    show(chosenOne);
  }
  return {
    element,
    // Of the answer of /v1/plan; [] when nothing is known of the document yet.
    offer(all, name) {
      expected = all.filter(({ time_ms: ms, error }) => typeof ms === "number" && typeof error === "number");
      chosenOne = name;
      fill();
    },
    // By the rung's name, { time_ms, error }: what a sweep has found of the document as it stands.
    measured(found) {
      if (found.size === 0 && figures.size === 0) return;
      figures = found;
      fill();
    },
    show,
  };
}
