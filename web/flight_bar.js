// What a flight shows: its figures over the picture, as Pakawan had them, and its buttons under it.

import { byId, el } from "./dom.js";
import { WAYS } from "./flight_motion.js";
import { KINDS } from "./flight_path.js";
import { THICKNESS } from "./workspace_shapes.js";

const SPEED_WORDS = { 1: "Slow", 2: "Medium speed", 3: "Fast" };
const WAY_WORDS = { through: "Where it looks, and through the cloud", around: "Around the cloud, with the eye on its middle" };
const STICK = [["left", "←", "Left"], ["forward", "↑", "Forward"], ["back", "↓", "Back"], ["right", "→", "Right"]];
const capital = (word) => word[0].toUpperCase() + word.slice(1);

export function createFlightBar(actions) {
  const button = (text, title, action, attributes = {}) => el("button", { type: "button", title, onclick: action, ...attributes }, text);
  const together = (label, attributes, ...children) => el("span", { class: "buttons", role: "group", "aria-label": label, ...attributes }, ...children);
  const speeds = Object.entries(SPEED_WORDS).map(([value, words]) =>
    button(value, `${words} (${value})`, () => actions.speed(Number(value)), { "aria-label": words, "aria-keyshortcuts": value, "data-value": value }));
  const ways = WAYS.map((way) => button(capital(way), WAY_WORDS[way], () => actions.way(way), { "data-value": way }));
  const thickness = el("select", { "aria-label": "Thickness of the cloud", onchange: () => actions.thickness(thickness.value) },
    el("option", { value: "" }, "as it is"), ...THICKNESS.map(([word]) => el("option", { value: word }, word)));
  const record = button("Record", "Keep the path that is flown from now on", actions.record);
  const replay = button("Replay", "Fly the recorded path again", actions.replay);
  const kind = el("select", { "aria-label": "Between the keys of a path", onchange: () => actions.kind(kind.value) },
    ...KINDS.map((word) => el("option", { value: word }, word)));
  const download = button("Save the path", "As JSON, for awan fly --path", actions.save);
  // For fingers: held down, as keys are.
  const stick = together("Move", { class: "buttons stick" }, ...STICK.map(([word, sign, label]) => {
    const one = button(sign, label, undefined, { "aria-label": label });
    one.addEventListener("pointerdown", (event) => {
      one.setPointerCapture(event.pointerId);
      actions.hold(word, true);
    });
    for (const type of ["pointerup", "pointercancel", "lostpointercapture"]) one.addEventListener(type, () => actions.hold(word, false));
    one.addEventListener("contextmenu", (event) => event.preventDefault());
    return one;
  }));
  const element = el("div", { id: "flight-bar", role: "toolbar", "aria-label": "Flight", hidden: true },
    button("Leave", "Leave the flight (Esc)", actions.leave, { "aria-keyshortcuts": "Escape" }),
    stick, together("Speed", {}, ...speeds), together("Way", {}, ...ways), thickness,
    together("Path", {}, record, replay, kind, download));
  const line = el("p", { id: "flight-figures", hidden: true });
  const help = el("span", { class: "hint", id: "flight-help" },
    "W S A D: forward, back, left, right. Arrow keys or drag: look and turn. 1 2 3: speed. Esc: leave. On the way, particles stand for the cloud.");
  byId("stage-help").after(help);
  byId("stage").append(line);

  const pressed = (list, value) => list.forEach((one) => one.setAttribute("aria-pressed", String(one.dataset.value === String(value))));
  return {
    element,
    refresh({ on, way, speed, thickness: chosen, recording, replaying, hasPath, kind: between }) {
      element.hidden = line.hidden = !on;
      byId("stage").setAttribute("aria-labelledby", on ? "flight-help" : "stage-help");
      pressed(speeds, speed);
      pressed(ways, way);
      thickness.value = chosen;
      kind.value = between;
      record.textContent = recording ? "Stop recording" : "Record";
      record.setAttribute("aria-pressed", String(recording));
      replay.textContent = replaying ? "Stop" : "Replay";
      // Not `disabled`: they stay reachable.
      for (const one of [replay, download]) one.setAttribute("aria-disabled", String(!hasPath));
    },
    // The size of the window, the time, the rate: Pakawan's, and how many sprites. Where their light falls is the page's own
    // guess, how bright it is comes from the last picture of the service (workspace_particles.js).
    figures({ width, height, seconds, rate, sprites, recorded }) {
      line.textContent = [
        `${width} × ${height}`, `${seconds.toFixed(1)} s`, rate > 0 ? `${rate.toFixed(rate < 10 ? 1 : 0)} frames/s` : "at rest",
        sprites > 0 ? `${sprites.toLocaleString("en")} particles` : null, recorded === null ? null : `recording ${recorded.toFixed(1)} s`,
      ].filter(Boolean).join(" · ");
    },
  };
}
