// How accurate the picture shall be: the choice, what is predicted of it, and what accuracy costs
// this scene, measured on request.

import { group, select, slider } from "./controls.js";
import { at } from "./document.js";
import { el, plain } from "./dom.js";
import { createLadder, errorText, timeText } from "./ladder.js";
import { fieldAt, scaled, standardAt } from "./schema.js";
import { createSweep } from "./sweep.js";

const WAYS = [
  ["error", "largest error"],
  ["time_ms", "longest time"],
  ["rung", "name of a rung"],
];
// What a way begins with, when it is chosen.
const FIRST = { error: standardAt({}, "/accuracy/error"), time_ms: 500, rung: "harris" };

export const percent = (error) => `${plain(100 * error, 2)} %`;
export const duration = (ms) => (ms >= 1000 ? `${plain(ms / 1000, 2)} s` : `${plain(ms, 2)} ms`);

export function createAccuracyPanel(store, { failed, open }) {
  const way = () => WAYS.map(([name]) => name).find((name) => at(store.scene, `/accuracy/${name}`) !== undefined) ?? "error";
  const value = (name) => at(store.scene, `/accuracy/${name}`) ?? FIRST[name];
  const choose = (name, chosen, options) =>
    store.update((scene) => ({ ...scene, accuracy: { [name]: chosen } }), { key: `/accuracy/${name}`, ...options });

  const fields = {
    error: slider(store, {
      label: "Error", pointer: "/accuracy/error", field: scaled(fieldAt("/accuracy/error"), 100), min: 0.2, max: 200, log: true, unit: "%",
      get: () => Number((100 * value("error")).toPrecision(10)),
      set: (shown, options) => choose("error", Number((shown / 100).toPrecision(10)), options),
    }),
    time_ms: slider(store, {
      label: "Time", pointer: "/accuracy/time_ms", min: 1, max: 20000, log: true,
      get: () => value("time_ms"), set: (ms, options) => choose("time_ms", ms, options),
    }),
    rung: select(store, {
      label: "Rung", pointer: () => "/accuracy/rung",
      get: () => value("rung"), set: (name) => choose("rung", name),
    }),
  };
  const by = select(store, {
    label: "Chosen by", pointer: () => "/accuracy", choices: WAYS,
    get: way, set: (name) => choose(name, FIRST[name]),
  });
  const ladder = createLadder((name, options) => choose("rung", name, options));
  const rungs = fields.rung.element.querySelector("select");
  const expects = el("p", { id: "expected" });
  const predicted = el("p", { class: "why", id: "predicted" });
  const simulates = el("p", { class: "why" });
  let planned = ""; // the rung of the last plan
  const here = () => (way() === "rung" ? value("rung") : planned);
  const sweep = createSweep(store, {
    choose: (name) => choose("rung", name), rung: here, failed, timeText, errorText,
    measured: () => ladder.measured(sweep.figures),
  });
  const ask = el("button", { type: "button", id: "ask-accuracy", onclick: sweep.begin }, "What does accuracy cost?");

  // A rung that a document names is there before the first plan, and if there is none of that name.
  function offer(names) {
    const all = [...new Set([...names, value("rung")])];
    if (all.join() === [...rungs.options].map((option) => option.value).join()) return;
    rungs.replaceChildren(...all.map((name) => el("option", { value: name }, name)));
  }
  let known = fieldAt("/accuracy/rung").words;

  return {
    element: group("Accuracy", "/accuracy", open, ladder.element, by.element, fields.error.element, fields.time_ms.element,
      fields.rung.element, expects, el("details", { class: "how" }, el("summary", {}, "How"), predicted, simulates), ask),
    refresh() {
      offer(known);
      by.refresh();
      ladder.measured(sweep.figures);
      if (way() === "rung") ladder.show(value("rung"));
      sweep.refresh();
      for (const [name, field] of Object.entries(fields)) {
        field.element.hidden = name !== way();
        field.refresh();
      }
    },
    // The document is another one: what was said of the last is not of it.
    forget() {
      expects.textContent = predicted.textContent = simulates.textContent = "";
      ladder.offer([], "");
      sweep.forget();
    },
    // The answer of /v1/plan.
    plan({ rung, rung_reason: reason, predicted: expected, rungs: all }) {
      known = (all ?? []).map((one) => one.rung);
      planned = rung ?? "";
      ladder.offer(all ?? [], rung);
      const said = [];
      if (typeof expected?.error === "number") said.push(`error ${percent(expected.error)}`);
      if (typeof expected?.time_ms === "number") said.push(`time ${duration(expected.time_ms)}`);
      predicted.textContent = said.length ? `${rung}, predicted: ${said.join(", ")}.` : "";
      expects.textContent = said.length < 2 ? "" : `Expected: about ${percent(expected.error)} from the truth, in ${duration(expected.time_ms)}.`;
      const what = (all ?? []).find((one) => one.rung === rung)?.simulates ?? "";
      simulates.textContent = [what, reason].filter(Boolean).map((text) => text[0].toUpperCase() + text.slice(1)).join(". ") + (what || reason ? "." : "");
      offer(known);
      fields.rung.refresh();
    },
  };
}
