// Single controls. Each is { element, refresh(scene) }; each names its place in the document with
// data-pointer, so that errors find it (problems.js), and writes through the store. Where `pointer` is
// a function, the place depends on what is being edited (which cloud, which row). Defaults, ends, words
// and hints are the service's (schema.js); `field` stands for the schema's where a control shows
// something else than the document holds: its ends in that measure, or null.

import { el, fitting, freshId, plain } from "./dom.js";
import { atOrDefault, complaint, fieldAt } from "./schema.js";

const placeOf = (pointer) => (typeof pointer === "function" ? pointer : () => pointer);
function fieldOf({ pointer, field }) {
  if (field !== undefined) return field;
  const place = placeOf(pointer)();
  const found = fieldAt(place);
  if (!found) throw new RangeError(`No document has ${place}.`);
  return found;
}

export function hintOf({ hint, pointer, field }) {
  if (hint !== undefined || field === null) return hint;
  return field?.says ?? fieldAt(placeOf(pointer)())?.says;
}

// As short as units are written beside numbers.
const SYMBOLS = { degrees: "°", seconds: "s", stops: "EV", "units a second": "units/s" };
export function unitOf(spec) {
  const unit = spec.unit ?? fieldOf(spec)?.unit ?? "";
  return SYMBOLS[unit] ?? unit;
}

// Reads a number field. An empty or half-typed number never reaches the document: the field says
// so, and takes the document's value back when it is left. A number beyond its ends is marked, told
// to the page ("wrongnumber"), and written: the document is the writer's.
// `digits`: how many are shown while the field is not being edited, or fewer, that it has no more than `characters`.
export function numberInput({ pointer, field, get, set, optional = false, digits = 12, characters = Infinity, ...attributes }) {
  const place = placeOf(pointer);
  const ends = fieldOf({ pointer, field }) ?? {};
  const lowest = ends.orZero ? Math.min(0, ends.least) : ends.least;
  const input = el("input", {
    type: "number", step: "any", inputmode: "decimal", min: lowest, max: ends.most, ...attributes,
  });
  const mark = (sentence) => {
    input.classList.toggle("incomplete", sentence !== "");
    input.setCustomValidity(sentence);
  };
  const wrong = () => (input.value === "" ? "" : complaint(ends, input.valueAsNumber));
  input.addEventListener("input", () => {
    const missing = input.value === "";
    if (missing && optional && !input.validity.badInput) {
      mark("");
      set(undefined, { moving: false });
      return;
    }
    mark(missing ? "A number is needed here." : wrong());
    if (missing) return;
    set(input.valueAsNumber, { moving: false });
    if (!wrong()) return;
    input.dispatchEvent(new CustomEvent("wrongnumber", { bubbles: true, detail: { pointer: place(), message: wrong() } }));
  });
  const resting = () => fitting(get(), digits, characters);
  const show = (text) => {
    input.value = text;
    mark(wrong());
  };
  input.addEventListener("focus", () => {
    const whole = plain(get(), 12);
    if (input.value === whole) return;
    show(whole);
    input.select(); // setting the value has undone what the Tab key selects
  });
  input.addEventListener("blur", () => show(resting()));
  function refresh() {
    const value = get();
    // While someone types "1e" or "0.50", the field is theirs.
    if (document.activeElement === input && (input.value === "" || input.valueAsNumber === value)) return;
    const text = document.activeElement === input ? plain(value, 12) : resting();
    if (input.value !== text) show(text);
  }
  return { input, refresh };
}

// `step` is "any" so that every number is valid; the arrow keys then would step by one. They stop at the ends.
export function stepByArrows(input, step) {
  input.addEventListener("keydown", (event) => {
    const sign = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!sign || Number.isNaN(input.valueAsNumber)) return;
    event.preventDefault();
    const stepped = input.valueAsNumber + sign * step * (event.shiftKey ? 10 : 1);
    const below = input.max !== "" ? Math.min(Number(input.max), stepped) : stepped;
    const within = input.min !== "" ? Math.max(Number(input.min), below) : below;
    input.value = plain(Number(within.toFixed(6)), 12);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  });
}

// The useful part of a field's range, all of it where the page names none. Never more.
function travelOf(place, field, { min = field.least, max = field.most }) {
  for (const end of [min, max]) {
    const wrong = field && complaint(field, end);
    if (wrong) throw new RangeError(`The slider of ${place} goes to ${end}; ${place} ${wrong}.`);
  }
  return [min, max];
}

// A slider with a number field beside it. The slider covers the useful range, from `min` to `max`; the
// number may leave it. `log`: equal ratios take equal ways. get and set default to the value at the pointer.
export function slider(store, spec) {
  const { label, log = false } = spec;
  const place = placeOf(spec.pointer);
  const field = fieldOf(spec);
  const [min, max] = travelOf(place(), field, spec);
  const step = spec.step ?? (field?.whole ? 1 : undefined);
  const unit = unitOf(spec).length <= 2 ? unitOf(spec) : ""; // there is no room for more
  const get = spec.get ?? (() => atOrDefault(store.scene, place()));
  const set = spec.set ?? ((value, options) => store.set(place(), value, options));
  const id = freshId("slider");
  const to = log ? Math.log : (x) => x;
  const from = log ? (x) => Number(Math.exp(x).toPrecision(3)) : (x) => x;

  const range = el("input", {
    type: "range", id, min: to(min), max: to(max), step: log ? (to(max) - to(min)) / 200 : step,
  });
  const number = numberInput({ pointer: place, field, get, set, "aria-label": `${label}, ${unit || "number"}` });
  range.addEventListener("input", () => set(from(range.valueAsNumber), { moving: true }));
  range.addEventListener("change", () => set(from(range.valueAsNumber), { moving: false }));

  function refresh() {
    const value = get();
    element.dataset.pointer = place();
    number.refresh();
    if (typeof value !== "number") return;
    const position = to(value);
    // Its own last event put it there; moving it by a rounding error would make it jump.
    if (document.activeElement !== range || Math.abs(from(range.valueAsNumber) - value) > 1e-9 * Math.abs(value)) {
      range.value = String(position);
    }
    const span = (Math.max(to(min), Math.min(to(max), position)) - to(min)) / (to(max) - to(min));
    range.style.setProperty("--fill", `${100 * span}%`);
    range.setAttribute("aria-valuetext", `${plain(value, 4)} ${unit}`.trim());
  }
  const element = el("div", { class: "field slider", title: hintOf(spec) },
    el("label", { for: id }, label), range, number.input, el("span", { class: "unit", "aria-hidden": "true" }, unit));
  return { element, refresh };
}

// `optional`: empty, it is not in the document; then it shows the default as what would be there.
export function numberField(store, { label, pointer, optional = false, get, set, placeholder }) {
  const id = freshId("number");
  const number = numberInput({
    id, pointer, optional, placeholder: placeholder ?? (optional ? plain(fieldAt(pointer()).standard) : undefined),
    get: get ?? (() => atOrDefault(store.scene, pointer())),
    set: set ?? ((value, options) => store.set(pointer(), value, options)),
  });
  const element = el("div", { class: "field number", title: hintOf({ pointer }) }, el("label", { for: id }, label), number.input);
  return {
    element,
    refresh() {
      element.dataset.pointer = pointer();
      number.refresh();
    },
  };
}

// A seed has 64 bits, more than a number field can hold exactly. `placeholder`: what none of it means.
export function seedField(store, { label = "Seed", pointer = () => "/seed", get, set, placeholder, another = false }) {
  const id = freshId("seed");
  const value = get ?? (() => atOrDefault(store.scene, pointer()));
  const put = set ?? ((seed) => store.set(pointer(), seed));
  const input = el("input", { id, type: "text", inputmode: "numeric", autocomplete: "off", placeholder });
  const field = fieldAt(pointer());
  const asNumber = (text) => (Number.isSafeInteger(Number(text)) ? Number(text) : BigInt(text));
  input.addEventListener("input", () => {
    const text = input.value.trim();
    const none = text === "" && placeholder !== undefined;
    const whole = /^-?\d+$/.test(text);
    const wrong = whole ? complaint(field, asNumber(text)) : "";
    input.classList.toggle("incomplete", wrong !== "" || (!whole && !none));
    if (none) put(undefined);
    else if (whole) put(asNumber(text));
    if (wrong) input.dispatchEvent(new CustomEvent("wrongnumber", { bubbles: true, detail: { pointer: pointer(), message: wrong } }));
  });
  const show = () => {
    if (document.activeElement !== input) input.value = String(value() ?? "");
  };
  input.addEventListener("blur", () => {
    input.classList.remove("incomplete");
    input.value = String(value() ?? "");
  });
  const element = el("div", { class: "field seed", title: hintOf({ pointer }) }, el("label", { for: id }, label), input,
    another ? el("button", { type: "button", onclick: () => put(crypto.getRandomValues(new Uint32Array(1))[0]) }, "Another") : null);
  return {
    element,
    refresh() {
      element.dataset.pointer = pointer();
      show();
    },
  };
}

// [[word, title]...] of a field with words: first those with titles here, in their order, then the others by their
// names.
export function choicesOf({ words }, titles = {}) {
  const unknown = Object.keys(titles).filter((word) => !words.includes(word));
  if (unknown.length) throw new RangeError(`“${unknown[0]}” is none of ${words.join(", ")}.`);
  return [...Object.entries(titles), ...words.filter((word) => !(word in titles)).map((word) => [word, word])];
}

// `titles`: what the field's words are called; or choices, [[value, title]...], where it has none. `none`: what it is
// called that the document says nothing.
export function select(store, { label, pointer, field, titles, none, choices, get, set, hint }) {
  const id = freshId("select");
  const value = get ?? (() => atOrDefault(store.scene, pointer()));
  const write = set ?? ((chosen) => store.set(pointer(), chosen));
  const all = [...(none === undefined ? [] : [["", none]]), ...(choices ?? choicesOf(fieldOf({ pointer, field }), titles))];
  const input = el("select", { id, onchange: () => write(input.value) },
    ...all.map(([name, title]) => el("option", { value: name }, title)));
  const element = el("div", { class: "field select", title: hintOf({ pointer, field, hint }) }, el("label", { for: id }, label), input);
  return {
    element,
    refresh() {
      element.dataset.pointer = pointer();
      input.value = value() ?? "";
    },
  };
}

export function checkbox({ label, pointer, get, set }) {
  const place = placeOf(pointer);
  const id = freshId("checkbox");
  const input = el("input", { type: "checkbox", id, onchange: () => set(input.checked) });
  const element = el("div", { class: "field checkbox", title: hintOf({ pointer }) }, input, el("label", { for: id }, label));
  return {
    element,
    refresh() {
      element.dataset.pointer = place();
      input.checked = get();
    },
  };
}

// Documents hold linear light; the browser's colour fields hold 8-bit sRGB.
const encode = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
const decode = (x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);
const byte = (x) => Math.round(255 * encode(Math.min(1, Math.max(0, Number(x) || 0)))).toString(16).padStart(2, "0");

export function colour(store, { label, pointer }) {
  const id = freshId("colour");
  const input = el("input", { type: "color", id });
  const write = (options) => store.set(pointer,
    [1, 3, 5].map((i) => Number(decode(parseInt(input.value.slice(i, i + 2), 16) / 255).toFixed(4))), options);
  input.addEventListener("input", () => write({ moving: true }));
  input.addEventListener("change", () => write({ moving: false }));
  const element = el("div", { class: "field colour", "data-pointer": pointer, title: hintOf({ pointer }) }, el("label", { for: id }, label), input);
  return {
    element,
    refresh() {
      const value = atOrDefault(store.scene, pointer);
      if (Array.isArray(value) && value.length === 3) input.value = `#${value.map(byte).join("")}`;
    },
  };
}

// A section that can be folded away. Returns its element; refresh is the caller's.
export function group(title, pointer, open, ...children) {
  return el("details", { class: "group", open, "data-pointer": pointer },
    el("summary", {}, el("h2", {}, title)), ...children);
}
