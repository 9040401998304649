// The layout as a table, a row a cube; and the cloud that it belongs to.

import { at, cloudsOf, withAt, withCloudList } from "./document.js";
import { el, freshId, plain } from "./dom.js";
import { group, numberField, numberInput, select } from "./controls.js";

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

export function createLayoutTable(store) {
  let chosen = 0; // index of the cloud that is shown
  let page = 0;
  let shape = ""; // what the rows on screen were built for
  let rows = []; // of refresh functions
  const cloudPointer = () => cloudsOf(store.scene)[chosen]?.pointer ?? "";
  const cubesPointer = () => `${cloudPointer()}/cubes`;
  const cubes = () => {
    const list = at(store.scene, cubesPointer());
    return Array.isArray(list) ? list : [];
  };
  const inSeveral = () => Array.isArray(store.scene.clouds);

  const cloudSelect = el("select", { id: freshId("cloud"), onchange: () => { chosen = Number(cloudSelect.value); page = 0; refresh(); } });
  const body = el("tbody");
  const summary = el("span", { class: "table-summary" });
  const previous = el("button", { type: "button", onclick: () => turn(-1) }, "Previous");
  const next = el("button", { type: "button", onclick: () => turn(1) }, "Next");
  const pager = el("span", { class: "buttons" }, previous, next);
  const add = el("button", { type: "button", onclick: () => insert(cubes().length, null) }, "Add a cube");
  const copyCloud = el("button", { type: "button", onclick: duplicateCloud }, "Duplicate cloud");
  const dropCloud = el("button", { type: "button", onclick: deleteCloud }, "Delete cloud");
  const elsewhere = el("p", { class: "why", hidden: true });
  const table = el("table", {},
    el("caption", { class: "unseen" }, "Cubes of the cloud"),
    head(),
    body);
  const scroll = el("div", { class: "table-scroll", tabindex: "0", role: "region", "aria-label": "Table of cubes" }, table);

  const ofCloud = (label, member, placeholder, extra = {}) => numberField(store, {
    label, placeholder, optional: true, pointer: () => `${cloudPointer()}/${member}`,
    get: () => at(store.scene, `${cloudPointer()}/${member}`), ...extra,
  });
  const translate = [0, 1, 2].map((axis) => ofCloud(`Move ${"xyz"[axis]}`, `translate/${axis}`, "0", {
    set: (value, options) => {
      const pointer = `${cloudPointer()}/translate`;
      const before = at(store.scene, pointer);
      const moved = Array.isArray(before) ? [...before] : [0, 0, 0];
      moved[axis] = value ?? 0;
      store.set(pointer, moved, options);
    },
  }));
  const placement = [...translate, ofCloud("Scale", "scale", "1"), ofCloud("Turn, °", "rotate_y", "0"),
    ofCloud("Own density", "density", "the scene’s"),
    select(store, {
      label: "Own fill", pointer: () => `${cloudPointer()}/fill`,
      choices: [["", "the scene’s"], ["uniform", "uniform"], ["gardner", "gardner"], ["printed", "printed"]],
      get: () => at(store.scene, `${cloudPointer()}/fill`), set: (v) => store.set(`${cloudPointer()}/fill`, v || undefined),
    })];
  const placementBox = el("div", { class: "placement" }, ...placement.map((field) => field.element));
  const cloudChoice = el("span", { class: "buttons" }, el("label", { for: cloudSelect.id }, "Cloud"), cloudSelect);
  const cloudLine = el("div", { class: "cloud-line" }, cloudChoice, copyCloud, dropCloud);
  const element = group("Layout", "/cubes", true, cloudLine, placementBox, elsewhere,
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
  function duplicateCloud() {
    store.update((scene) => {
      const listed = withCloudList(scene);
      const copy = structuredClone(listed.clouds[chosen]);
      const [x = 0, y = 0, z = 0] = copy.translate ?? [];
      copy.translate = [x + 6 * (copy.scale ?? 1), y, z];
      return { ...listed, clouds: [...listed.clouds.slice(0, chosen + 1), copy, ...listed.clouds.slice(chosen + 1)] };
    });
    chosen += 1;
    refresh();
  }
  function deleteCloud() {
    store.update((scene) => ({ ...scene, clouds: scene.clouds.filter((_cloud, i) => i !== chosen) }));
    chosen = Math.max(0, chosen - 1);
    refresh();
    cloudSelect.focus();
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
        get: () => at(store.scene, pointer), set: (value, options) => store.set(pointer, value, options), optional,
        "aria-label": `cube ${index + 1}, ${name}`, "data-pointer": pointer, "data-step": step,
        placeholder: optional ? "1" : undefined, digits: 5,
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

  // `step` is "any" so that every number is valid; the arrow keys then would step by one.
  function stepByArrows(input, step) {
    input.addEventListener("keydown", (event) => {
      const sign = { ArrowUp: 1, ArrowDown: -1 }[event.key];
      if (!sign || Number.isNaN(input.valueAsNumber)) return;
      event.preventDefault();
      const stepped = input.valueAsNumber + sign * step * (event.shiftKey ? 10 : 1);
      input.value = plain(Number(stepped.toFixed(6)), 12);
      input.dispatchEvent(new Event("input", { bubbles: true }));
    });
  }

  function refresh() {
    const clouds = cloudsOf(store.scene);
    chosen = Math.max(0, Math.min(chosen, clouds.length - 1));
    const { cloud } = clouds[chosen] ?? { cloud: {} };
    const model = cloud?.model ?? "cubes";
    const list = cubes();
    page = Math.max(0, Math.min(page, Math.ceil(list.length / kRowsShown) - 1));
    const first = page * kRowsShown;
    const count = Math.min(kRowsShown, list.length - first);

    element.dataset.pointer = inSeveral() ? "/clouds" : "/cubes";
    scroll.dataset.pointer = cubesPointer();
    const wanted = `${cubesPointer()} ${first} ${count} ${clouds.length}`;
    if (wanted !== shape) {
      shape = wanted;
      cloudSelect.replaceChildren(...clouds.map((_c, k) => el("option", { value: k }, `${k + 1} of ${clouds.length}`)));
      rows = Array.from({ length: count }, (_unused, i) => buildRow(first + i));
      body.replaceChildren(...rows.map(({ row }) => row));
    }
    cloudSelect.value = String(chosen);
    rows.forEach((row) => row.refresh());
    placementBox.hidden = !inSeveral();
    if (inSeveral()) placement.forEach((field) => field.refresh());
    cloudChoice.hidden = clouds.length < 2;
    dropCloud.hidden = clouds.length < 2;
    scroll.hidden = add.hidden = model !== "cubes";
    elsewhere.hidden = model === "cubes";
    elsewhere.textContent = `This cloud's model is “${model}”; edit it as JSON below.`;
    pager.hidden = list.length <= kRowsShown;
    previous.disabled = page === 0;
    next.disabled = first + count >= list.length;
    const total = list.reduce((sum, cube) => sum + (Number(cube?.particles) || 0), 0);
    summary.textContent = `${list.length} cubes, ${total.toLocaleString("en")} particles` +
      (pager.hidden ? "" : `; rows ${first + 1}–${first + count}`);
  }

  // Shows the cloud and the page that hold the place of a pointer.
  function reveal(pointer) {
    const [, k] = /^\/clouds\/(\d+)/.exec(pointer) ?? [];
    if (k !== undefined) chosen = Number(k);
    const [, i] = /\/cubes\/(\d+)/.exec(pointer) ?? [];
    if (i !== undefined) page = Math.floor(Number(i) / kRowsShown);
    refresh();
  }
  return { element, refresh, reveal };
}
