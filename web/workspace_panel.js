// The group "Shape": the outline, the numbers of what is selected, and the shape tools.

import * as api from "./api.js";
import { group, numberInput, stepByArrows } from "./controls.js";
import { at, withAt } from "./document.js";
import { el, freshId } from "./dom.js";
import { documentOf } from "./opening.js";
import { fieldAt } from "./schema.js";
import { around } from "./workspace_items.js";
import { STARTERS, THICKNESS, cloudsFrom, scattered, started, thickened, withClouds, withStarter } from "./workspace_shapes.js";

const kListed = 500; // lines of the outline; of more items, it has the clouds, and the parts of those at hand
const kMostListed = 2000; // the picture and the table have the rest
const kMostTwins = 200;

// ids() -> those to change, a cloud instead of its parts; the rest: what there is, what is selected, and the cloud at hand.
export function createPanel(store, { actions, select, ids, items, selection, active, cloud, failed, note }) {
  // --- the outline ---

  const outlineId = freshId("outline");
  const outline = el("select", { id: outlineId, multiple: true, size: 7, onchange: () => {
    const picked = [...outline.selectedOptions].map((option) => option.value);
    const kept = selection().filter((id) => picked.includes(id));
    select([...kept, ...picked.filter((id) => !kept.includes(id))]);
  } });
  outline.addEventListener("keydown", (event) => {
    if (event.key === "Delete") actions.remove();
    else if (event.key === "D" && event.shiftKey) actions.duplicate();
    else return;
    event.preventDefault();
  });
  const more = el("p", { class: "why", hidden: true });
  let listed = "";
  function refreshOutline() {
    // Of many items, the clouds, and the parts of those at hand.
    const all = items();
    const chosenOnes = new Set(selection());
    const near = new Set(all.filter(({ id }) => chosenOnes.has(id)).map((item) => item.cloud)).add(cloud());
    const shown = (all.length <= kListed ? all : all.filter((item) => item.whole || near.has(item.cloud))).slice(0, kMostListed);
    const now = shown.map(({ id, label }) => `${id} ${label}`).join();
    if (now !== listed) {
      listed = now;
      outline.replaceChildren(...shown.map(({ id, label, whole }) => el("option", { value: id }, whole ? label : `\u2003${label}`)));
    }
    for (const option of outline.options) if (option.selected !== chosenOnes.has(option.value)) option.selected = chosenOnes.has(option.value);
    more.hidden = shown.length === all.length;
    more.textContent = `${(all.length - shown.length).toLocaleString("en")} more: choose their cloud, or click in the picture.`;
  }

  // --- numbers ---

  const length = { above: true, least: 0 };
  // isFor(axis): whether what is selected has such a number.
  function axes(label, field, get, set, isFor = () => true) {
    const inputs = ["x", "y", "z"].map((axis, i) => {
      const one = numberInput({
        pointer: "", field, "aria-label": `${label}, ${axis}`, title: axis, digits: 5, get: () => get()?.[i],
        set: (value) => { if (active() && (!field || value > 0)) set(i, value); },
      });
      stepByArrows(one.input, 0.1);
      return one;
    });
    return {
      element: el("div", { class: "field vector", role: "group", "aria-label": label }, el("span", { class: "name" }, label),
        el("span", { class: "axes" }, ...inputs.map(({ input }, i) => el("span", { "data-axis": "xyz"[i] }, input)))),
      refresh: () => inputs.forEach((one, i) => {
        one.input.disabled = active() === null || !isFor(i);
        one.refresh();
      }),
    };
  }
  const centre = axes("Place", null, () => active()?.center, (axis, value) => {
    const move = [0, 0, 0];
    move[axis] = value - active().center[axis];
    actions.transform({ move }, `workspace-place-${axis}`);
  });
  const size = axes("Lengths", length, () => active()?.half.map((h) => 2 * h), (axis, value) => {
    const scale = [1, 1, 1];
    scale[axis] = value / (2 * active().half[axis]);
    actions.transform({ scale, pivot: active().center }, `workspace-size-${axis}`);
  });
  const turn = axes("Turned, °", null, () => active()?.angles?.map((degrees) => degrees ?? undefined),
    (axis, value) => actions.turnTo(axis, value), (axis) => typeof active().angles?.[axis] === "number");
  // What the selected cubes are painted with.
  const cubes = () => selection().filter((id) => /\/cubes\/\d+$/.test(id));
  const paint = (member, value) => store.update((scene) => cubes().reduce((next, id) => withAt(next, `${id}/${member}`, value), scene), { key: `workspace-${member}` });
  const ofActive = (member) => at(store.scene, `${cubes().at(-1) ?? "/cubes/0"}/${member}`);
  const textureId = freshId("texture");
  const texture = el("select", { id: textureId, onchange: () => paint("texture", texture.value || undefined) },
    el("option", { value: "" }, "as the cloud's"), ...fieldAt("/cubes/0/texture").examples.map((name) => el("option", { value: name }, name)));
  const billboards = numberInput({
    id: freshId("billboards"), class: "wide", pointer: "/cubes/0/billboards", optional: true, placeholder: "as particles",
    get: () => ofActive("billboards"), set: (value) => paint("billboards", value),
  });
  const painted = el("div", { hidden: true },
    el("div", { class: "field", title: fieldAt("/cubes/0/texture").says }, el("label", { for: textureId }, "Texture"), texture),
    el("div", { class: "field", title: fieldAt("/cubes/0/billboards").says }, el("label", { for: billboards.input.id }, "Billboards"), billboards.input));
  function refreshPaint() {
    painted.hidden = cubes().length === 0;
    if (painted.hidden) return;
    const name = ofActive("texture") ?? "";
    if (![...texture.options].some(({ value }) => value === name)) texture.append(el("option", { value: name }, name));
    texture.value = name;
    billboards.refresh();
  }

  const factorId = freshId("factor");
  const factor = el("input", { type: "number", id: factorId, min: "0.01", max: "100", step: "any", value: "1.25" });
  const scaleAll = el("button", { type: "button", onclick: () => {
    const by = factor.valueAsNumber;
    if (by > 0) actions.transform({ scale: [by, by, by] }, null);
  } }, "Scale all axes");
  const what = el("p", { class: "why", role: "status" });

  // --- shape tools ---

  const starterId = freshId("starter");
  const starter = el("select", { id: starterId }, ...STARTERS.map(([name, title]) => el("option", { value: name }, title)));
  const field = (label, id, ...children) => el("div", { class: "field" }, el("label", { for: id }, label), ...children);
  const button = (title, action) => el("button", { type: "button", onclick: async () => {
    try {
      await action();
    } catch (error) {
      if (error.name !== "AbortError") failed(error);
    }
  } }, title);
  const thickness = THICKNESS.map(([name, depth]) => button(name[0].toUpperCase() + name.slice(1), async () => {
    const { scene } = store;
    const { survey } = await api.plan(store.text);
    if (store.scene !== scene) return; // edited meanwhile
    const measured = survey?.optical_depth?.zenith;
    if (!(measured > 0)) throw new Error("There is no matter to make thicker.");
    store.update(() => thickened(scene, survey.density, depth / measured, fieldAt("/density").most));
    note(`${name}: an optical depth of ${depth} straight up.`);
  }));
  const countId = freshId("count");
  const count = el("input", { type: "number", id: countId, min: "1", max: String(kMostTwins), step: "1", value: "8" });
  const reachId = freshId("reach");
  const reach = el("input", { type: "number", id: reachId, min: "0", step: "any", value: "10" });
  let strewn = 0;
  const scatter = button("Scatter", () => {
    const [many, out] = [Math.round(count.valueAsNumber), reach.valueAsNumber];
    if (!selection().length) return note("Nothing is selected.");
    if (!(many >= 1 && many <= kMostTwins && out >= 0)) throw new Error(`Scatter makes from 1 to ${kMostTwins} twins.`);
    strewn += 1;
    actions.change(...scattered(store.scene, ids(), many, out, strewn));
  });
  const file = el("input", { type: "file", accept: ".json,.awn,.awa,application/json,text/x-awn", hidden: true, "aria-label": "File to insert" });
  file.addEventListener("change", async () => {
    const [chosen] = file.files;
    file.value = "";
    if (!chosen) return;
    try {
      const { text } = await documentOf(chosen);
      await api.plan(text); // the service judges it first
      const clouds = cloudsFrom(text);
      const next = withClouds(store.scene, clouds);
      const first = next.clouds.length - clouds.length;
      actions.change(next, clouds.map((_cloud, i) => `/clouds/${first + i}`));
      note(`${chosen.name} is in the scene.`);
    } catch (error) {
      failed(new Error(`${chosen.name}: ${error.message}`));
    }
  });

  const element = group("Shape", "", window.matchMedia("(min-width: 60rem)").matches,
    el("label", { for: outlineId, class: "unseen" }, "Outline"), outline, more, what, centre.element, size.element, turn.element,
    field("Factor", factorId, factor, scaleAll), painted,
    field("Start with", starterId, starter,
      button("New", () => actions.change(started(store.scene, starter.value), [])),
      button("Add", () => actions.change(withStarter(store.scene, starter.value)))),
    el("div", { class: "field", role: "group", "aria-label": "Thickness" }, el("span", { class: "name" }, "Thickness"), ...thickness),
    el("div", { class: "field scatter" }, el("label", { for: countId }, "Scatter twins"), count, el("label", { for: reachId }, "within"), reach, scatter),
    el("div", { class: "table-tools" }, el("button", { type: "button", onclick: () => file.click() }, "Insert a file…"), file));
  element.removeAttribute("data-pointer"); // it stands for no place of its own
  element.id = "shape";

  // Folded away, it is not kept up to date.
  function refresh() {
    if (!element.open) return;
    refreshOutline();
    const one = active();
    what.textContent = one ? `${selection().length > 1 ? `${selection().length} selected; ` : ""}${one.label}` : "Nothing selected: click in the picture, or choose above.";
    scaleAll.setAttribute("aria-disabled", String(one === null));
    centre.refresh();
    size.refresh();
    turn.element.hidden = !one?.angles;
    turn.refresh();
    refreshPaint();
  }
  element.addEventListener("toggle", refresh);

  return { element, refresh };
}
