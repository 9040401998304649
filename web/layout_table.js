// The layout as a table, a row a cube, of a cloud that has cubes. Layouts may have 10,000 of them: only rows near what can
// be seen are there, between empty ones of the others' height, and a row is refreshed when its cube is another.
//
// The table is one stop of the Tab key, at the cell that had the focus last. Within it, arrows go along the row until
// something is typed or F2 pressed, and along the figures from then on; up and down step the number; Enter and
// Shift+Enter go down and up the column, PageUp and PageDown ten rows, Home and End to the ends of the row, with Ctrl of
// the table.

import { group, numberInput, stepByArrows } from "./controls.js";
import { at, withAt } from "./document.js";
import { el, plain } from "./dom.js";
import { fieldAt } from "./schema.js";

const kAllRows = 60; // so many are all there
const kSpareRows = 15; // above and below what can be seen
const kPageRows = 10; // of PageUp and PageDown
const kCharacters = 8; // a cell has room for
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

// `choice`: the cloud that is being edited (models.js). redrawn(): other rows are there than before.
export function createLayoutTable(store, choice, { redrawn = () => {} } = {}) {
  let shown = { pointer: null, list: null }; // what the rows were last refreshed for
  let rows = new Map(); // those that are there, by index
  let height = 30; // of a row, pixels; measured once there is one
  let active = { row: 0, column: 0 }; // the cell that Tab comes to
  const cubesPointer = () => `${choice.pointer}/cubes`;
  const cubes = () => {
    const list = at(store.scene, cubesPointer());
    return Array.isArray(list) ? list : [];
  };

  const body = el("tbody");
  const summary = el("span", { class: "table-summary" });
  const add = el("button", { type: "button", onclick: () => insert(cubes().length, null) }, "Add a cube");
  const table = el("table", { class: "layout" },
    el("caption", { class: "unseen" }, "Cubes of the cloud. Enter and Shift+Enter: down and up the column; left and right: along the row."),
    head(),
    body);
  const scroll = el("div", { class: "table-scroll", role: "region", "aria-label": "Table of cubes" }, table);
  const element = group("Layout", "/cubes", true,
    // Before the table: the keyboard need not pass it to get here.
    el("div", { class: "table-tools" }, add, summary), scroll);

  const change = (list) => store.update((scene) => withAt(scene, cubesPointer(), list));
  function insert(index, cube) {
    const list = cubes();
    const last = list[list.length - 1];
    const fresh = cube ?? (last ? { ...FRESH, center: last.center ?? FRESH.center, radius: last.radius ?? FRESH.radius } : FRESH);
    change([...list.slice(0, index), structuredClone(fresh), ...list.slice(index)]);
    focusCell(index, 0);
  }
  function remove(index) {
    change(cubes().filter((_cube, i) => i !== index));
    if (cubes().length) focusCell(Math.min(index, cubes().length - 1), COLUMNS.length + 1);
    else add.focus();
  }

  function buildRow(index) {
    const base = `${cubesPointer()}/${index}`;
    const cells = COLUMNS.map(([name, member, step]) => {
      const pointer = `${base}/${member}`;
      const optional = member === "density";
      const field = numberInput({
        pointer, get: () => at(store.scene, pointer), set: (value, options) => store.set(pointer, value, options), optional,
        "aria-label": `cube ${index + 1}, ${name}`, "data-pointer": pointer, "data-step": step, tabindex: "-1",
        placeholder: optional ? plain(fieldAt(pointer).standard) : undefined, digits: 5, characters: kCharacters,
      });
      stepByArrows(field.input, step);
      return field;
    });
    const button = (name, sign, action, kind) => el("button", {
      type: "button", class: kind, title: name, "aria-label": `${name} cube ${index + 1}`, tabindex: "-1", onclick: action,
    }, sign);
    const buttons = [
      button("Duplicate", "", () => insert(index + 1, cubes()[index]), "duplicate"),
      button("Delete", "×", () => remove(index), "delete"),
    ];
    const row = el("tr", { "data-index": index, "data-pointer": base, "aria-rowindex": index + 3 },
      el("th", { scope: "row" }, String(index + 1)),
      ...cells.map(({ input }) => el("td", {}, input)),
      el("td", { class: "row-buttons" }, ...buttons));
    const one = {
      row, controls: [...cells.map(({ input }) => input), ...buttons], cube: null,
      refresh(cube) {
        if (cube === one.cube) return;
        one.cube = cube;
        cells.forEach((cell) => cell.refresh());
      },
    };
    return one;
  }

  // --- which rows are there ---

  const focused = () => (body.contains(document.activeElement) ? Number(document.activeElement.closest("tr").dataset.index ?? -1) : -1);
  function seen(count) {
    if (count <= kAllRows) return [0, count];
    const first = Math.floor(scroll.scrollTop / height);
    return [Math.min(first, count), Math.min(count, first + Math.ceil((scroll.clientHeight || 500) / height) + 1)];
  }
  // The indices of the rows that should be there, in order; a row with the focus stays wherever it is.
  function wanted(count, more) {
    const [first, last] = seen(count);
    const from = Math.max(0, first - kSpareRows), to = Math.min(count, last + kSpareRows);
    const all = new Set(more.filter((index) => index >= 0 && index < count));
    for (let index = from; index < to; index += 1) all.add(index);
    return [...all].sort((a, b) => a - b);
  }
  const space = (count) => {
    const cell = el("td", { colspan: COLUMNS.length + 2 });
    cell.style.height = `${count * height}px`;
    return el("tr", { class: "space", "aria-hidden": "true" }, cell);
  };
  function draw(list, more = []) {
    const indices = wanted(list.length, [focused(), ...more]);
    rows = new Map(indices.map((index) => [index, rows.get(index) ?? buildRow(index)]));
    const nodes = [];
    let next = 0;
    for (const index of [...indices, list.length]) {
      if (index > next) nodes.push(space(index - next));
      if (rows.has(index)) nodes.push(rows.get(index).row);
      next = index + 1;
    }
    // Rows that stay are not touched, so that the focus stays in them.
    const staying = new Set(nodes);
    for (const node of [...body.children]) if (!staying.has(node)) node.remove();
    let before = body.firstChild;
    for (const node of nodes) {
      if (node === before) before = before.nextSibling;
      else body.insertBefore(node, before);
    }
    for (const [index, row] of rows) row.refresh(list[index]);
    const [first] = rows.values();
    if (first?.row.offsetHeight) height = first.row.offsetHeight;
    rove();
    redrawn();
  }
  let frame = 0;
  scroll.addEventListener("scroll", () => {
    cancelAnimationFrame(frame);
    frame = requestAnimationFrame(() => {
      const list = cubes();
      const [first, last] = seen(list.length);
      for (const index of [first, last - 1]) {
        if (index >= 0 && index < list.length && !rows.has(index)) {
          draw(list);
          return;
        }
      }
    });
  });

  // --- one stop of the Tab key ---

  let stop = null;
  function rove() {
    const [some] = rows.values();
    const to = (rows.get(active.row) ?? some)?.controls[active.column];
    if (stop && stop !== to) stop.tabIndex = -1;
    stop = to ?? null;
    if (stop) stop.tabIndex = 0;
  }
  function placeOf(control) {
    const index = Number(control.closest("tr").dataset.index);
    return { row: index, column: rows.get(index)?.controls.indexOf(control) ?? 0 };
  }
  function focusCell(row, column) {
    const list = cubes();
    const to = Math.max(0, Math.min(list.length - 1, row));
    if (!rows.has(to)) {
      scroll.scrollTop = Math.max(0, to * height - scroll.clientHeight / 2);
      draw(list, [to]);
    }
    const control = rows.get(to)?.controls[Math.max(0, Math.min(COLUMNS.length + 1, column))];
    control?.focus();
    control?.closest("tr").scrollIntoView({ block: "nearest" });
  }
  let typing = false; // in the cell that has the focus
  body.addEventListener("focusin", ({ target }) => {
    if (!target.closest("tr[data-index]")) return;
    active = placeOf(target);
    typing = false;
    rove();
  });
  body.addEventListener("pointerdown", ({ target }) => {
    if (target === document.activeElement) typing = true; // a second click is for a place between the figures
  });
  body.addEventListener("beforeinput", () => { typing = true; });
  body.addEventListener("keydown", (event) => {
    if (event.altKey || event.metaKey || !event.target.closest("tr[data-index]")) return;
    const isField = event.target.tagName === "INPUT";
    if (event.key === "F2" && isField) {
      typing = !typing;
      return;
    }
    const { row, column } = placeOf(event.target);
    const last = cubes().length - 1;
    const ends = COLUMNS.length + 1;
    const along = !typing && !event.shiftKey && !event.ctrlKey;
    const to = {
      Enter: isField && !event.ctrlKey && [row + (event.shiftKey ? -1 : 1), column],
      PageDown: [row + kPageRows, column], PageUp: [row - kPageRows, column],
      ArrowLeft: along && [row, column - 1], ArrowRight: along && [row, column + 1],
      ArrowDown: !isField && [row + 1, column], ArrowUp: !isField && [row - 1, column],
      Home: event.ctrlKey ? [0, column] : along && [row, 0],
      End: event.ctrlKey ? [last, column] : along && [row, ends],
    }[event.key];
    if (!to) return;
    event.preventDefault();
    focusCell(...to);
  });

  function refresh() {
    element.hidden = choice.model !== "cubes";
    if (element.hidden) return;
    const [pointer, list] = [cubesPointer(), cubes()];
    if (pointer === shown.pointer && list === shown.list) return;
    if (pointer !== shown.pointer) {
      rows = new Map();
      scroll.scrollTop = 0;
    }
    shown = { pointer, list };
    element.dataset.pointer = pointer;
    table.setAttribute("aria-rowcount", String(list.length + 2));
    scroll.hidden = list.length === 0;
    draw(list);
    const total = list.reduce((sum, cube) => sum + (Number(cube?.particles) || 0), 0);
    summary.textContent = `${list.length.toLocaleString("en")} cubes, ${total.toLocaleString("en")} particles`;
  }

  // Brings the row of a pointer there.
  function reveal(pointer) {
    refresh();
    const [, i] = /\/cubes\/(\d+)/.exec(pointer) ?? [];
    if (i === undefined || element.hidden) return;
    scroll.scrollTop = Math.max(0, Number(i) * height - scroll.clientHeight / 2);
    draw(cubes(), [Number(i)]);
  }
  return { element, refresh, reveal };
}
