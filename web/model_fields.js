// Controls from descriptions: model_*.js say which fields of a model are shown, and how; what they may be, the service
// says (schema.js). A description's `member` is its place within the object at hand ("wind/mutation"); where that
// object is in the document, `base()` says, for the cloud that is being edited changes.
//
//   { member, label, min, max, step | log }                       a slider; its useful range, where not the whole
//   { kind: "number", member, label, empty }                      a number; `empty`: what none of it means
//   { kind: "select", member, label, titles }                     titles: what its words are called
//   { kind: "vector", member, label, step, unit }                 three numbers; `unit`: "" where that is clear
//   { kind: "formula", member, label }                            a formula, and what it may use
//   { kind: "switch", member, label, fresh, fields }              an object that may be left out
//   { kind: "section", title, fields }                            folded away until the document has some of it
//   { kind: "table", member, title, one, fresh, columns }         a list of objects, a row each
//   { kind: "text", member, label }                               words of one's own; while they break the rule they stay here
//   { kind: "shape", member, label, titles, fresh }               words, of which "table" has a list of numbers beside it,
//                                                                 `${member}_table`, at first `fresh`
//   { kind: "cards", member, title, one, fresh, fields }          a list of objects, a box each
//
// Any may have a `hint`, shown by the pointer instead of what the service says of the field. `fresh` is what an object
// is when it is first put into the document: values of its own, or the names of members that are then written out as
// they are.

import { hintOf, select, slider, stepByArrows, numberInput, unitOf } from "./controls.js";
import { at, withAt } from "./document.js";
import { el, freshId } from "./dom.js";
import { createObjectTable } from "./object_table.js";
import { atOrDefault, fieldAt } from "./schema.js";

// Within these: `store`, `base()` the pointer to the object, `own()` the object of the model.
const pointerOf = ({ base }, spec) => () => `${base()}/${spec.member}`;

const freshOf = (place, { fresh }) => (Array.isArray(fresh)
  ? Object.fromEntries(fresh.map((member) => [member, fieldAt(`${place}/${member}`).standard])) : structuredClone(fresh));

function makeSlider({ store, ...context }, spec) {
  return slider(store, { ...spec, pointer: pointerOf(context, spec) });
}

function makeNumber(context, spec) {
  const id = freshId("number");
  const place = pointerOf(context, spec);
  const { store } = context;
  const optional = spec.empty !== undefined;
  const number = numberInput({
    id, pointer: place, optional, placeholder: spec.empty,
    get: () => (optional ? at : atOrDefault)(store.scene, place()), set: (value, options) => store.set(place(), value, options),
  });
  stepByArrows(number.input, spec.step ?? 1);
  const unit = unitOf({ ...spec, pointer: place });
  const element = el("div", { class: "field number", title: hintOf({ ...spec, pointer: place }) },
    el("label", { for: id }, spec.label), number.input,
    unit ? el("span", { class: "unit", "aria-hidden": "true" }, unit) : null);
  return {
    element,
    refresh() {
      element.dataset.pointer = place();
      number.refresh();
    },
  };
}

function makeSelect({ store, ...context }, spec) {
  return select(store, { ...spec, pointer: pointerOf(context, spec) });
}

function makeText(context, spec) {
  const { store } = context;
  const place = pointerOf(context, spec);
  const id = freshId("text");
  const rule = () => fieldAt(place()).pattern;
  const input = el("input", { id, type: "text", spellcheck: "false" });
  input.addEventListener("input", () => {
    const wrong = rule() !== undefined && !new RegExp(rule()).test(input.value);
    input.classList.toggle("incomplete", wrong);
    input.setCustomValidity(wrong ? "Names with commas between." : "");
    if (!wrong) store.set(place(), input.value);
  });
  const shown = () => String(atOrDefault(store.scene, place()) ?? "");
  input.addEventListener("blur", () => { input.value = shown(); });
  const element = el("div", { class: "field text", title: hintOf({ ...spec, pointer: place }) }, el("label", { for: id }, spec.label), input);
  return {
    element,
    refresh() {
      element.dataset.pointer = place();
      if (document.activeElement !== input) input.value = shown();
    },
  };
}

// The list is in the document with its word alone.
function makeShape(context, spec) {
  const { store, base } = context;
  const word = pointerOf(context, spec);
  const list = () => `${base()}/${spec.member}_table`;
  const words = select(store, {
    ...spec, pointer: word,
    set: (chosen) => store.update((scene) => withAt(withAt(scene, word(), chosen), list(), chosen === "table" ? [...spec.fresh] : undefined)),
  });
  const id = freshId("numbers");
  const input = el("input", { id, type: "text", inputmode: "decimal", spellcheck: "false" });
  const read = () => input.value.split(/[\s,;]+/).filter((part) => part !== "").map(Number);
  input.addEventListener("input", () => {
    const values = read();
    const wrong = values.length < 2 || !values.every((value) => value >= 0 && value <= 1);
    input.classList.toggle("incomplete", wrong);
    input.setCustomValidity(wrong ? "Two numbers at least, from 0 to 1." : "");
    if (!wrong) store.set(list(), values);
  });
  const shown = () => {
    const values = at(store.scene, list());
    return Array.isArray(values) ? values.join(", ") : "";
  };
  input.addEventListener("blur", () => { input.value = shown(); });
  const row = el("div", { class: "field numbers", title: hintOf({ pointer: list }) }, el("label", { for: id }, `${spec.label}, table`), input);
  return {
    element: el("div", {}, words.element, row),
    refresh() {
      words.refresh();
      row.dataset.pointer = list();
      row.hidden = atOrDefault(store.scene, word()) !== "table";
      if (document.activeElement !== input) input.value = shown();
    },
  };
}

// Three numbers in a row. Writing one writes all: a document has whole vectors only.
export function vector(store, { label, pointer, get: given, set, step = 1, unit: its, hint }) {
  const get = given ?? (() => atOrDefault(store.scene, pointer()));
  const unit = unitOf({ pointer, unit: its });
  const write = set ?? ((value, options) => store.set(pointer(), value, options));
  const axes = ["x", "y", "z"].map((axis, i) => {
    const field = numberInput({
      pointer: () => `${pointer()}/${i}`, "aria-label": `${label}, ${axis}`, title: axis, digits: 5,
      get: () => get()?.[i],
      set: (value, options) => {
        const before = get();
        write([0, 1, 2].map((k) => (k === i ? value : before?.[k] ?? 0)), options);
      },
    });
    stepByArrows(field.input, step);
    return field;
  });
  const element = el("div", { class: "field vector", role: "group", "aria-label": label, title: hintOf({ pointer, hint }) },
    el("span", { class: "name" }, label),
    el("span", { class: "axes" }, ...axes.map(({ input }, i) => el("span", { "data-axis": "xyz"[i] }, input))),
    unit ? el("span", { class: "unit", "aria-hidden": "true" }, unit) : null);
  return {
    element,
    refresh() {
      element.dataset.pointer = pointer();
      axes.forEach(({ input, refresh }, i) => {
        input.dataset.pointer = `${pointer()}/${i}`;
        refresh();
      });
    },
  };
}

// Written as it is typed; the service says what is wrong with it, and where.
function makeFormula({ store, ...context }, spec) {
  const place = pointerOf(context, spec);
  const id = freshId("formula");
  const { examples, names, functions } = fieldAt(place());
  const input = el("textarea", {
    id, rows: 3, spellcheck: "false", autocomplete: "off", autocapitalize: "off", placeholder: examples[0],
    oninput: () => store.set(place(), input.value.trim() === "" ? undefined : input.value),
  });
  const list = (of) => Object.entries(of).flatMap(([name, says]) => [el("dt", {}, el("code", {}, name)), el("dd", {}, says)]);
  const element = el("div", { class: "field formula", title: hintOf({ ...spec, pointer: place }) },
    el("label", { for: id }, spec.label), input,
    el("details", { class: "words" }, el("summary", {}, "What it may use"), el("dl", {}, ...list(names), ...list(functions))));
  return {
    element,
    refresh() {
      element.dataset.pointer = place();
      const value = at(store.scene, place()) ?? "";
      if (document.activeElement !== input && input.value !== value) input.value = value;
    },
  };
}

function makeVector({ store, ...context }, spec) {
  return vector(store, { ...spec, pointer: pointerOf(context, spec) });
}

// Off, the object is not there; what it was is kept for when it is on again.
function makeSwitch(context, spec) {
  const { store } = context;
  const place = pointerOf(context, spec);
  const now = () => {
    const value = at(store.scene, place());
    return value !== null && typeof value === "object" ? value : null;
  };
  let kept = freshOf(place(), spec);
  const id = freshId("switch");
  const input = el("input", {
    type: "checkbox", id,
    onchange: () => {
      if (!input.checked) kept = now() ?? kept;
      store.set(place(), input.checked ? structuredClone(kept) : undefined);
    },
  });
  const inner = makeFields({ ...context, base: place }, spec.fields);
  const box = el("div", { class: "inner" }, ...inner.map(({ element }) => element));
  const element = el("div", { class: "switched" },
    el("div", { class: "field checkbox", title: hintOf({ ...spec, pointer: place }) }, input, el("label", { for: id }, spec.label)), box);
  return {
    element,
    refresh() {
      element.dataset.pointer = place();
      box.hidden = now() === null;
      input.checked = !box.hidden;
      if (!box.hidden) inner.forEach((field) => field.refresh());
    },
  };
}

function makeSection(context, spec) {
  const inner = makeFields(context, spec.fields);
  const element = el("details", { class: "section" }, el("summary", {}, el("h3", {}, spec.title)), ...inner.map((field) => field.element));
  const isIn = ({ member }) => member !== undefined && at(context.store.scene, `${context.base()}/${member}`) !== undefined;
  let said = false; // whether the document said something of it, when last looked at
  return {
    element,
    refresh() {
      const says = spec.fields.some(isIn);
      if (says && !said) element.open = true;
      said = says;
      inner.forEach((field) => field.refresh());
    },
  };
}

function makeTable(context, spec) {
  return createObjectTable(context.store, { ...spec, pointer: pointerOf(context, spec) });
}

const kCardsShown = 12; // documents with more are not written by hand

function makeCards(context, spec) {
  const { store } = context;
  const place = pointerOf(context, spec);
  const list = () => {
    const value = at(store.scene, place());
    return Array.isArray(value) ? value : [];
  };
  const change = (next) => store.update((scene) => withAt(scene, place(), next.length ? next : undefined));
  const box = el("div", { class: "cards" });
  const add = el("button", {
    type: "button",
    onclick: () => {
      change([...list(), freshOf(`${place()}/0`, spec)]);
      box.lastElementChild?.querySelector("input, select")?.focus();
    },
  }, `Add ${spec.one}`);
  const more = el("p", { class: "why", hidden: true });
  let cards = [];

  function build(index) {
    const inner = makeFields({ ...context, base: () => `${place()}/${index}` }, spec.fields);
    const drop = el("button", {
      type: "button", class: "delete", "aria-label": `Delete ${spec.noun} ${index + 1}`,
      onclick: () => {
        change(list().filter((_one, i) => i !== index));
        (box.children[Math.min(index, box.children.length - 1)]?.querySelector(".delete") ?? add).focus();
      },
    }, "Delete");
    const element = el("fieldset", { class: "card" }, el("legend", {}, `${spec.noun[0].toUpperCase()}${spec.noun.slice(1)} ${index + 1}`),
      ...inner.map((field) => field.element), drop);
    return {
      element,
      refresh() {
        element.dataset.pointer = `${place()}/${index}`;
        inner.forEach((field) => field.refresh());
      },
    };
  }

  const element = el("div", { class: "list" }, el("h3", {}, spec.title), spec.why ? el("p", { class: "why" }, spec.why) : null,
    box, more, el("div", { class: "table-tools" }, add));
  return {
    element,
    refresh() {
      element.dataset.pointer = place();
      const count = Math.min(list().length, kCardsShown);
      if (count !== cards.length) {
        cards = Array.from({ length: count }, (_unused, i) => build(i));
        box.replaceChildren(...cards.map((card) => card.element));
      }
      cards.forEach((card) => card.refresh());
      more.hidden = list().length <= kCardsShown;
      more.textContent = `${list().length - kCardsShown} more: edit them as JSON below.`;
    },
  };
}

const MAKERS = {
  formula: makeFormula, number: makeNumber, select: makeSelect, vector: makeVector, switch: makeSwitch,
  section: makeSection, shape: makeShape, text: makeText, table: makeTable, cards: makeCards, slider: makeSlider,
};

// A field that only some documents have says so by `when(own)`.
function shownWhen(context, { when }, field) {
  if (!when) return field;
  return {
    element: field.element,
    refresh() {
      field.element.hidden = !when(context.own());
      if (!field.element.hidden) field.refresh();
    },
  };
}

export function makeFields(context, specs) {
  return specs.map((spec) => {
    const field = spec.make && !spec.kind ? spec.make(context) : MAKERS[spec.kind ?? "slider"](context, spec);
    return shownWhen(context, spec, field);
  });
}
