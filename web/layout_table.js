// The layout as a table, a row a cube, of a cloud that has cubes.

import { group, numberInput, stepByArrows } from "./controls.js";
import { at, withAt } from "./document.js";
import { el, plain } from "./dom.js";
import { fieldAt } from "./schema.js";

const kRowsShown = 100; // of a page of the table; layouts may have 10,000 cubes
const FRESH = { particles: 50, size: [2, 1, 2], center: [0, 0, 0], radius: 1 };

// [name, place in the cube, smallest step of the arrow keys]
const COLUMNS = [
  ["particles", "particles", 1],
  ["size x", "size/0", 0.1], ["size y", "size/1", 0.1], ["size z", "size/2", 0.1],
  ["center x", "center/0", 0.1], ["center y", "center/1", 0.1], ["center z", "center/2", 0.1],
  ["largest radius", "radius", 0.1],
  ["density factor", "density", 0.1],
];

function head() {
  const th = (attributes, ...children) => el("th", attributes, ...children);
  const tall = { rowspan: "2", scope: "col" };
  const three = { colspan: "3", scope: "colgroup", class: "over" };
  return el("thead", {},
    el("tr", {}, th(tall, "#"), th({ ...tall, title: "Number of particles" }, "n"),
      th(three, "size"), th(three, "center"),
      th({ ...tall, title: "Radius of the largest particle" }, "radius"),
      th({ ...tall, title: "Multiplies the cloud’s density" }, "dens. ×"),
      th(tall, el("span", { class: "unseen" }, "actions"))),
    el("tr", {}, ...["x", "y", "z", "x", "y", "z"].map((axis) => th({ scope: "col" }, axis))));
}

// `choice`: the cloud that is being edited (models.js).
export function createLayoutTable(store, choice) {
  let page = 0;
  let shown = 0; // index of the cloud that `page` is of
  let shape = ""; // what the rows on screen were built for
  let rows = []; // of refresh functions
  const cubesPointer = () => `${choice.pointer}/cubes`;
  const cubes = () => {
    const list = at(store.scene, cubesPointer());
    return Array.isArray(list) ? list : [];
  };

  const body = el("tbody");
  const summary = el("span", { class: "table-summary" });
  const previous = el("button", { type: "button", onclick: () => turn(-1) }, "Previous");
  const next = el("button", { type: "button", onclick: () => turn(1) }, "Next");
  const pager = el("span", { class: "buttons" }, previous, next);
  const add = el("button", { type: "button", onclick: () => insert(cubes().length, null) }, "Add a cube");
  const table = el("table", {},
    el("caption", { class: "unseen" }, "Cubes of the cloud"),
    head(),
    body);
  const scroll = el("div", { class: "table-scroll", tabindex: "0", role: "region", "aria-label": "Table of cubes" }, table);

  const element = group("Layout", "/cubes", true,
    // Before the table: the keyboard need not pass every cell to get here.
    el("div", { class: "table-tools" }, add, pager, summary), scroll);

  function turn(by) {
    page += by;
    refresh();
    scroll.scrollTop = 0;
  }
  const focusRow = (index, what) => {
    page = Math.floor(index / kRowsShown);
    refresh();
    const row = body.querySelector(`tr[data-index="${index}"]`);
    (row?.querySelector(what) ?? add).focus();
    row?.scrollIntoView({ block: "nearest" });
  };
  const change = (list) => store.update((scene) => withAt(scene, cubesPointer(), list));
  function insert(index, cube) {
    const list = cubes();
    const last = list[list.length - 1];
    const fresh = cube ?? (last ? { ...FRESH, center: last.center ?? FRESH.center, radius: last.radius ?? FRESH.radius } : FRESH);
    change([...list.slice(0, index), structuredClone(fresh), ...list.slice(index)]);
    focusRow(index, "input");
  }
  function remove(index) {
    change(cubes().filter((_cube, i) => i !== index));
    focusRow(Math.min(index, cubes().length - 1), "button.delete");
  }

  // Enter goes down the column, as in a spreadsheet.
  body.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || event.target.tagName !== "INPUT") return;
    event.preventDefault();
    const column = event.target.closest("td").cellIndex;
    const rowsNow = [...body.querySelectorAll("tr[data-index]")];
    const to = rowsNow[rowsNow.indexOf(event.target.closest("tr")) + (event.shiftKey ? -1 : 1)];
    to?.cells[column].querySelector("input").focus();
  });

  function buildRow(index) {
    const base = `${cubesPointer()}/${index}`;
    const cells = COLUMNS.map(([name, member, step]) => {
      const pointer = `${base}/${member}`;
      const optional = member === "density";
      const field = numberInput({
        pointer, get: () => at(store.scene, pointer), set: (value, options) => store.set(pointer, value, options), optional,
        "aria-label": `cube ${index + 1}, ${name}`, "data-pointer": pointer, "data-step": step,
        placeholder: optional ? plain(fieldAt(pointer).standard) : undefined, digits: 5,
      });
      stepByArrows(field.input, step);
      return field;
    });
    const button = (name, sign, action, kind) =>
      el("button", { type: "button", class: kind, title: name, "aria-label": `${name} cube ${index + 1}`, onclick: action }, sign);
    const row = el("tr", { "data-index": index, "data-pointer": base },
      el("th", { scope: "row" }, String(index + 1)),
      ...cells.map(({ input }) => el("td", {}, input)),
      el("td", { class: "row-buttons" },
        button("Duplicate", "", () => insert(index + 1, cubes()[index]), "duplicate"),
        button("Delete", "×", () => remove(index), "delete")));
    return { row, refresh: () => cells.forEach((cell) => cell.refresh()) };
  }

  function refresh() {
    element.hidden = choice.model !== "cubes";
    if (element.hidden) return;
    if (shown !== choice.index) page = 0;
    shown = choice.index;
    const list = cubes();
    page = Math.max(0, Math.min(page, Math.ceil(list.length / kRowsShown) - 1));
    const first = page * kRowsShown;
    const count = Math.min(kRowsShown, list.length - first);

    element.dataset.pointer = cubesPointer();
    const wanted = `${cubesPointer()} ${first} ${count}`;
    if (wanted !== shape) {
      shape = wanted;
      rows = Array.from({ length: count }, (_unused, i) => buildRow(first + i));
      body.replaceChildren(...rows.map(({ row }) => row));
    }
    rows.forEach((row) => row.refresh());
    pager.hidden = list.length <= kRowsShown;
    previous.disabled = page === 0;
    next.disabled = first + count >= list.length;
    const total = list.reduce((sum, cube) => sum + (Number(cube?.particles) || 0), 0);
    summary.textContent = `${list.length} cubes, ${total.toLocaleString("en")} particles` +
      (pager.hidden ? "" : `; rows ${first + 1}–${first + count}`);
  }

  // Shows the page that holds the place of a pointer.
  function reveal(pointer) {
    const [, i] = /\/cubes\/(\d+)/.exec(pointer) ?? [];
    if (i !== undefined) page = Math.floor(Number(i) / kRowsShown);
    refresh();
  }
  return { element, refresh, reveal };
}
