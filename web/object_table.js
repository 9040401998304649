// A list of objects as a table, a row each: ellipsoids, primitives, bands of wind.

import { choicesOf, hintOf, numberInput, stepByArrows } from "./controls.js";
import { at, withAt } from "./document.js";
import { el } from "./dom.js";
import { atOrDefault, fieldAt, standardAt } from "./schema.js";

const kRowsShown = 100; // the rest is there, and is edited as JSON

// Vectors are written whole: [member, axis] of "center/0".
function axisOf(member) {
  const [, whole, axis] = /^(.*)\/([012])$/.exec(member) ?? [];
  return whole === undefined ? null : [whole, Number(axis)];
}

// Columns that stand under one heading share its `over`. row: the pointer of any of the rows.
function head(columns, row) {
  const hint = (member) => hintOf({ pointer: `${row}/${axisOf(member)?.[0] ?? member}` });
  const th = (attributes, ...children) => el("th", attributes, ...children);
  const upper = [];
  for (const { title, over, member } of columns) {
    const last = upper[upper.length - 1];
    if (over && last?.over === over) last.count += 1;
    else upper.push({ title, over, member, count: 1 });
  }
  const tall = { rowspan: "2", scope: "col" };
  return el("thead", {},
    el("tr", {}, th(tall, "#"),
      ...upper.map(({ title, over, member, count }) => (over
        ? th({ colspan: count, scope: "colgroup", class: "over" }, over) : th({ ...tall, title: hint(member) }, title))),
      th(tall, el("span", { class: "unseen" }, "actions"))),
    el("tr", {}, ...columns.filter(({ over }) => over).map(({ title, member }) => th({ scope: "col", title: hint(member) }, title))));
}

// spec: { title, noun, pointer(), fresh, columns: [{ title, over, member, step, change, empty }], why,
// make(rows): the row that is added, in place of another like the last. change(row, chosen): the row with a choice among
// words that other fields of it follow. empty: what no number there means. bare: the title is only for those who listen }
export function createObjectTable(store, spec) {
  const { pointer, noun, columns } = spec;
  const list = () => {
    const value = at(store.scene, pointer());
    return Array.isArray(value) ? value : [];
  };
  // No element: no list, so that the model's own default holds again.
  const change = (next) => store.update((scene) => withAt(scene, pointer(), next.length ? next : undefined));
  const body = el("tbody");
  const more = el("p", { class: "why", hidden: true });
  let rows = [];

  const add = el("button", {
    type: "button",
    onclick: () => {
      const all = list();
      change([...all, spec.make ? spec.make(all) : structuredClone(all[all.length - 1] ?? spec.fresh)]);
      body.lastElementChild?.querySelector("input, select")?.focus();
    },
  }, `Add ${spec.one}`);

  function cellOf(index, { title, over, member, step = 1, change: changed, empty }) {
    const place = () => `${pointer()}/${index}/${member}`;
    const name = `${noun} ${index + 1}, ${over ? `${over} ` : ""}${title}`;
    const value = () => atOrDefault(store.scene, place());
    const set = (next, options) => {
      if (!axisOf(member)) return store.set(place(), next, options);
      const [whole, axis] = axisOf(member);
      const vector = `${pointer()}/${index}/${whole}`;
      const before = at(store.scene, vector);
      const copy = [...(Array.isArray(before) ? before : standardAt(store.scene, vector) ?? [0, 0, 0])];
      copy[axis] = next;
      store.set(vector, copy, options);
    };
    const choices = choicesOf(fieldAt(place()));
    if (choices.length) {
      const row = () => `${pointer()}/${index}`;
      const write = () => (changed ? store.set(row(), changed(at(store.scene, row()) ?? {}, input.value)) : set(input.value));
      const input = el("select", { "aria-label": name, onchange: write },
        ...choices.map(([word, shown]) => el("option", { value: word }, shown)));
      return { input, refresh: () => { input.dataset.pointer = place(); input.value = value() ?? ""; } };
    }
    const optional = empty !== undefined;
    const field = numberInput({
      pointer: place, optional, placeholder: empty, get: optional ? () => at(store.scene, place()) : value, set, "aria-label": name, digits: 5, characters: 8,
    });
    stepByArrows(field.input, step);
    return { input: field.input, refresh: () => { field.input.dataset.pointer = place(); field.refresh(); } };
  }

  function buildRow(index) {
    const cells = columns.map((column) => cellOf(index, column));
    const drop = el("button", {
      type: "button", class: "delete", title: "Delete", "aria-label": `Delete ${noun} ${index + 1}`,
      onclick: () => {
        change(list().filter((_one, i) => i !== index));
        (body.children[Math.min(index, body.children.length - 1)]?.querySelector(".delete") ?? add).focus();
      },
    }, "×");
    const row = el("tr", {}, el("th", { scope: "row" }, String(index + 1)),
      ...cells.map(({ input }) => el("td", {}, input)), el("td", { class: "row-buttons" }, drop));
    return {
      row,
      refresh() {
        row.dataset.pointer = `${pointer()}/${index}`;
        cells.forEach((cell) => cell.refresh());
      },
    };
  }

  const table = el("table", {}, el("caption", { class: "unseen" }, spec.title), head(columns, `${pointer()}/0`), body);
  const scroll = el("div", { class: "table-scroll short", tabindex: "0", role: "region", "aria-label": spec.title }, table);
  const element = el("div", { class: "list" }, spec.bare ? null : el("h3", {}, spec.title), spec.why ? el("p", { class: "why" }, spec.why) : null,
    scroll, more, el("div", { class: "table-tools" }, add));
  return {
    element,
    refresh() {
      element.dataset.pointer = pointer();
      const count = Math.min(list().length, kRowsShown);
      if (count !== rows.length) {
        rows = Array.from({ length: count }, (_unused, i) => buildRow(i));
        body.replaceChildren(...rows.map(({ row }) => row));
      }
      rows.forEach((row) => row.refresh());
      scroll.hidden = count === 0;
      more.hidden = list().length <= kRowsShown;
      more.textContent = `${list().length - kRowsShown} more: edit them as JSON below.`;
    },
  };
}
