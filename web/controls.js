// Single controls. Each is { element, refresh(scene) }; each names its place in the document with
// data-pointer, so that errors find it (problems.js), and writes through the store. Where `pointer` is
// a function, the place depends on what is being edited (which cloud, which row).

import { atOrDefault } from "./document.js";
import { el, freshId, plain } from "./dom.js";

// Reads a number field. An empty or half-typed number never reaches the document: the field says
// so, and takes the document's value back when it is left.
// `digits`: how many are shown while the field is not being edited.
export function numberInput({ get, set, optional = false, digits = 12, ...attributes }) {
  const input = el("input", { type: "number", step: "any", inputmode: "decimal", ...attributes });
  const bad = (yes) => {
    input.classList.toggle("incomplete", yes);
    input.setCustomValidity(yes ? "A number is needed here." : "");
  };
  input.addEventListener("input", () => {
    const missing = input.value === "";
    if (missing && optional && !input.validity.badInput) {
      bad(false);
      set(undefined, { moving: false });
      return;
    }
    bad(missing);
    if (!missing) set(input.valueAsNumber, { moving: false });
  });
  const shownDigits = () => (document.activeElement === input ? 12 : digits);
  input.addEventListener("focus", () => {
    const whole = plain(get(), 12);
    if (input.value === whole) return;
    input.value = whole;
    input.select(); // setting the value has undone what the Tab key selects
  });
  input.addEventListener("blur", () => {
    bad(false);
    input.value = plain(get(), digits);
  });
  function refresh() {
    const value = get();
    // While someone types "1e" or "0.50", the field is theirs.
    if (document.activeElement === input && (input.value === "" || input.valueAsNumber === value)) return;
    const text = plain(value, shownDigits());
    if (input.value !== text) input.value = text;
  }
  return { input, refresh };
}

const placeOf = (pointer) => (typeof pointer === "function" ? pointer : () => pointer);

// `step` is "any" so that every number is valid; the arrow keys then would step by one.
export function stepByArrows(input, step) {
  input.addEventListener("keydown", (event) => {
    const sign = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!sign || Number.isNaN(input.valueAsNumber)) return;
    event.preventDefault();
    const stepped = input.valueAsNumber + sign * step * (event.shiftKey ? 10 : 1);
    input.value = plain(Number(stepped.toFixed(6)), 12);
    input.dispatchEvent(new Event("input", { bubbles: true }));
  });
}

// A slider with a number field beside it. The slider covers the useful range; the number may leave
// it. `log`: equal ratios take equal ways. get and set default to the value at the pointer.
export function slider(store, spec) {
  const { label, min, max, step, unit = "", log = false } = spec;
  const place = placeOf(spec.pointer);
  const get = spec.get ?? (() => atOrDefault(store.scene, place()));
  const set = spec.set ?? ((value, options) => store.set(place(), value, options));
  const id = freshId("slider");
  const to = log ? Math.log : (x) => x;
  const from = log ? (x) => Number(Math.exp(x).toPrecision(3)) : (x) => x;

  const range = el("input", {
    type: "range", id, min: to(min), max: to(max), step: log ? (to(max) - to(min)) / 200 : step,
  });
  const number = numberInput({ get, set, "aria-label": `${label}, ${unit || "number"}` });
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
  const element = el("div", { class: "field slider" },
    el("label", { for: id }, label), range, number.input, el("span", { class: "unit", "aria-hidden": "true" }, unit));
  return { element, refresh };
}

export function numberField(store, { label, pointer, optional = false, get, set, placeholder }) {
  const id = freshId("number");
  const number = numberInput({
    id, optional, placeholder,
    get: get ?? (() => atOrDefault(store.scene, pointer())),
    set: set ?? ((value, options) => store.set(pointer(), value, options)),
  });
  const element = el("div", { class: "field number" }, el("label", { for: id }, label), number.input);
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
  input.addEventListener("input", () => {
    const text = input.value.trim();
    const none = text === "" && placeholder !== undefined;
    const whole = /^-?\d+$/.test(text);
    input.classList.toggle("incomplete", !whole && !none);
    if (none) put(undefined);
    else if (whole) put(Number.isSafeInteger(Number(text)) ? Number(text) : BigInt(text));
  });
  const show = () => {
    if (document.activeElement !== input) input.value = String(value() ?? "");
  };
  input.addEventListener("blur", () => {
    input.classList.remove("incomplete");
    input.value = String(value() ?? "");
  });
  const element = el("div", { class: "field seed" }, el("label", { for: id }, label), input,
    another ? el("button", { type: "button", onclick: () => put(crypto.getRandomValues(new Uint32Array(1))[0]) }, "Another") : null);
  return {
    element,
    refresh() {
      element.dataset.pointer = pointer();
      show();
    },
  };
}

// choices: [[value, title]...]
export function select(store, { label, pointer, choices, get, set }) {
  const id = freshId("select");
  const value = get ?? (() => atOrDefault(store.scene, pointer()));
  const write = set ?? ((chosen) => store.set(pointer(), chosen));
  const input = el("select", { id, onchange: () => write(input.value) },
    ...choices.map(([name, title]) => el("option", { value: name }, title)));
  const element = el("div", { class: "field select" }, el("label", { for: id }, label), input);
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
  const element = el("div", { class: "field checkbox" }, input, el("label", { for: id }, label));
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
  const element = el("div", { class: "field colour", "data-pointer": pointer }, el("label", { for: id }, label), input);
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
