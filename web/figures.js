// What the service says about the picture: how many particles, what ran and why, where time went.

import { duration, percent } from "./accuracy.js";
import { at } from "./document.js";
import { byId, el, plain } from "./dom.js";

const milliseconds = (ms) => `${ms >= 100 ? Math.round(ms) : plain(Number(ms.toFixed(1)), 3)} ms`;
const words = (name) => name.replaceAll("_", " ");

// Numbers and yes/no of the survey, each with its path as a name; lists are left out.
function* figuresOf(survey, path = "") {
  for (const [name, value] of Object.entries(survey)) {
    if (typeof value === "number" || typeof value === "boolean") yield [`${path}${words(name)}`, value];
    else if (value !== null && typeof value === "object" && !Array.isArray(value)) yield* figuresOf(value, `${path}${words(name)} `);
  }
}

// What a person cares for first: how long it took, and how far it is from the truth.
function inShort({ particles, error }, took, isKept) {
  const count = particles === null ? [] : [`${Number(particles).toLocaleString("en")} particles`];
  const made = isKept ? "kept from before" : `made in ${duration(took)}`;
  return [...count, made, ...(error === null ? [] : [`about ${percent(Number(error))} from the truth`])].join(", ");
}

export function createFigures(store) {
  const body = byId("plan-body");
  let choices = []; // [{ name, input }]

  // After every picture, small ones too.
  function picture(said, width, height, isKept) {
    const { particles, rung, error, errorForecast, timeMs, effects, timing, roundTripMs } = said;
    if (particles !== null) byId("particles").textContent = Number(particles).toLocaleString("en");
    if (rung !== null) byId("rung").textContent = rung;
    // Effects are parts of the stages.
    const ofEffects = new Map(timing.filter(({ name }) => effects?.includes(name)).map(({ name, ms }) => [name, ms]));
    const ofStages = timing.filter(({ name }) => !ofEffects.has(name));
    if (effects !== null) byId("effects").textContent = effects.map(words).join(", ") || "none";
    byId("timing-effects").textContent = ofEffects.size === 0 ? ""
      : `For effects, of that: ${[...ofEffects].map(([name, ms]) => `${words(name)} ${milliseconds(ms)}`).join(", ")}`;
    byId("pixels").textContent = `${width} × ${height}`;
    byId("total").textContent = milliseconds(roundTripMs);
    const expected = errorForecast === null ? "" : ` (${percent(Number(errorForecast))} expected)`;
    byId("error").textContent = error === null ? "–" : percent(Number(error)) + expected;
    const took = timing.filter(({ name }) => ["generate", "survey", "light", "draw", "measure"].includes(name)).reduce((sum, { ms }) => sum + ms, 0);
    byId("time").textContent = timeMs === null ? milliseconds(took) : `${milliseconds(took)} of ${milliseconds(Number(timeMs))}`;

    const text = inShort(said, took, isKept);
    byId("in-short").textContent = text[0].toUpperCase() + text.slice(1);

    const inside = ofStages.reduce((sum, { ms }) => sum + ms, 0);
    // What the service did not account for: the way there and back.
    const parts = [...ofStages, { name: "network", ms: Math.max(0, roundTripMs - inside) }].filter(({ ms }) => ms > 0);
    byId("timing-bar").replaceChildren(...parts.map(({ name, ms }) => {
      const piece = el("span", { class: `part ${name}` });
      piece.style.flexGrow = String(ms);
      return piece;
    }));
    byId("timing").replaceChildren(...parts.map(({ name, ms }) =>
      el("li", {}, el("span", { class: `key ${name}` }), `${name} ${milliseconds(ms)}`)));
  }

  // One row an effect: whether it runs, why, and a choice that overrides the plan.
  function plan({ survey, effects, rung }) {
    if (survey?.particles !== undefined) byId("particles").textContent = Number(survey.particles).toLocaleString("en");
    if (rung) byId("rung").textContent = rung;
    const focused = document.activeElement?.dataset?.effect;
    choices = [];
    const rows = (effects ?? []).map(({ name, on, available = true, reason }) => {
      const input = el("select", {
        "aria-label": `${words(name)}: automatic, on or off`, "data-effect": name,
        onchange: () => store.set(`/effects/${name}`, { auto: undefined, on: true, off: false }[input.value]),
      }, ...["auto", "on", "off"].map((value) => el("option", { value }, value)));
      choices.push({ name, input });
      return el("tr", { class: on ? "on" : "off", "data-pointer": `/effects/${name}` },
        el("th", { scope: "row" }, words(name)),
        el("td", {}, on ? "on" : "off"),
        el("td", {}, available ? input : "–"),
        el("td", { class: "reason" }, reason ?? ""));
    });
    const facts = [...figuresOf(survey ?? {})];
    body.replaceChildren(
      el("div", { class: "table-scroll" }, el("table", { class: "effects" },
        el("thead", {}, el("tr", {}, ...["effect", "runs", "choice", "because"].map((h) => el("th", { scope: "col" }, h)))),
        el("tbody", {}, ...rows))),
      el("h2", {}, "Measured"),
      el("dl", { class: "facts" }, ...facts.map(([name, value]) =>
        el("div", {}, el("dt", {}, name), el("dd", {}, typeof value === "number" ? plain(value, 4) : value ? "yes" : "no")))));
    refresh();
    if (focused) body.querySelector(`[data-effect="${CSS.escape(focused)}"]`)?.focus();
  }

  function refresh() {
    for (const { name, input } of choices) {
      const wanted = at(store.scene, `/effects/${name}`);
      input.value = wanted === true ? "on" : wanted === false ? "off" : "auto";
    }
  }
  // The document is another one: its figures come with its picture.
  function forget() {
    choices = [];
    body.replaceChildren();
    for (const id of ["particles", "rung", "error", "time", "pixels", "total", "effects", "in-short"]) byId(id).textContent = "–";
  }
  return { picture, plan, refresh, forget };
}
