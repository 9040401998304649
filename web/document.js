// The scene document and its edits. Documents are never changed in place: every edit makes a new
// one that shares the untouched parts, so that undo keeps old ones for free.

import { compactJson, parseJson, prettyJson } from "./json_text.js";

// The members and indices that a JSON pointer goes through.
export const steps = (pointer) =>
  pointer.split("/").slice(1).map((step) => step.replaceAll("~1", "/").replaceAll("~0", "~"));

// The value at a JSON pointer, or undefined.
export function at(scene, pointer) {
  return steps(pointer).reduce(
    (value, step) => (value !== null && typeof value === "object" ? value[step] : undefined),
    scene,
  );
}

// `scene` with `value` at the pointer; undefined takes the member away. Words such as "auto" or
// "none" on the way give place to an object.
export function withAt(scene, pointer, value) {
  const put = (node, [step, ...rest]) => {
    const copy = Array.isArray(node) ? [...node] : node !== null && typeof node === "object" ? { ...node } : {};
    const member = rest.length ? put(copy[step], rest) : value;
    if (member === undefined) delete copy[step];
    else copy[step] = member;
    return copy;
  };
  return put(scene, steps(pointer));
}

// The clouds of a document with the pointer of each; a document with `cubes` at its top is one
// cloud, whose pointer is "". Documents may be wrong in any way; here, what is no cloud is empty.
export function cloudsOf(scene) {
  const known = (cloud) => (cloud !== null && typeof cloud === "object" ? cloud : {});
  if (Array.isArray(scene.clouds)) return scene.clouds.map((cloud, k) => ({ cloud: known(cloud), pointer: `/clouds/${k}` }));
  return [{ cloud: scene, pointer: "" }];
}

export const modelOf = (cloud) => cloud.model ?? "cubes";

// As cloudsOf, in a document that has `clouds`, so that another can be added.
export function withCloudList(scene) {
  if (Array.isArray(scene.clouds)) return scene;
  const { cubes, ...rest } = scene;
  return { clouds: [{ model: "cubes", cubes: cubes ?? [] }], ...rest };
}

// Why the document cannot be written as one .awn layout; "" when it can.
export function whyNoLayout(scene) {
  const clouds = cloudsOf(scene);
  if (clouds.length !== 1) return "An .awn file holds one layout; this document has several clouds.";
  const { cloud } = clouds[0];
  if ((cloud.model ?? "cubes") !== "cubes") return `An .awn file holds cubes, not the model “${cloud.model}”.`;
  const shift = Array.isArray(cloud.translate) ? cloud.translate : [];
  const moved = shift.some((t) => t !== 0) || (cloud.scale ?? 1) !== 1 || (cloud.rotate_y ?? 0) !== 0;
  if (Array.isArray(cloud.velocity) && cloud.velocity.some((v) => v !== 0)) return "An .awn file cannot say that its cloud moves.";
  if (moved) return "An .awn file cannot say that its cloud is moved, scaled or turned.";
  return "";
}

// The document of a layout, .awn or .awa, that the service has accepted.
export function sceneFromLayout(text) {
  const words = text.replace(/^\uFEFF/, "").split(/\r?\n/).map((line) => line.split(/[\s,]+/).filter(Boolean));
  const lines = words.filter((line) => line.length > 0 && line[0] !== "awa");
  return {
    cubes: lines.slice(2).map((line) => {
      const [particles, lx, ly, lz, cx, cy, cz, radius] = line.slice(0, 8).map(Number);
      const texture = line[8] ?? "none";
      return { particles, size: [lx, ly, lz], center: [cx, cy, cz], radius, ...(texture === "none" ? {} : { texture }) };
    }),
  };
}

const HISTORY = 200; // steps of undo
const ONE_STEP_MS = 1000; // edits of one field this close together are undone together; of one gesture (a Symbol), all of them

// A state of the page's document:
//   scene     the document
//   written   the text as someone wrote it, while it still says the same as `scene`; else null
//   work      { id, title }: which piece of work it is a state of; edits keep it, opening something begins another
//   preset    the preset that it is, unchanged; else ""
const kNothing = { scene: { cubes: [] }, written: null, work: { id: "", title: "" }, preset: "" };

let works = 0;
// Unlike those of other tabs and other days.
function freshWork(title) {
  works += 1;
  return { id: `${Date.now().toString(36)}-${works}-${Math.random().toString(36).slice(2, 8)}`, title };
}

// Holds the document. Listeners get { moving, replaced, same }: whether a slider or a drag is under way, whether the
// document is another one, whether nothing has changed.
export function createStore() {
  let state = kNothing;
  let past = [];
  let future = [];
  let lastKey = null;
  let lastTime = 0;
  const listeners = [];
  const tell = (change) => listeners.forEach((listener) => listener(change));

  function become(next, { key = null, moving = false, text = null, preset = "", replaced = false, title, work } = {}) {
    const now = performance.now();
    const together = key !== null && key === lastKey && (typeof key === "symbol" || now - lastTime < ONE_STEP_MS);
    if (!together) past = [...past.slice(1 - HISTORY), state];
    future = [];
    [lastKey, lastTime] = [key, now];
    state = { scene: next, written: text, work: work ?? (replaced ? freshWork(title ?? "") : state.work), preset };
    tell({ moving, replaced });
  }
  function travel(from, to) {
    if (!from.length) return;
    to.push(state);
    const before = state.work.id;
    state = from.pop();
    lastKey = null;
    tell({ moving: false, replaced: state.work.id !== before });
  }

  return {
    get scene() { return state.scene; },
    // What is sent, saved and shown: the writer's own text if there is one, so that the service
    // judges exactly what was written (duplicate keys, numbers of any size).
    get text() { return state.written ?? prettyJson(state.scene) + "\n"; },
    get work() { return state.work; },
    get preset() { return state.preset; },
    set(pointer, value, { moving = false } = {}) {
      const before = at(state.scene, pointer);
      const same = value === undefined ? before === undefined : before !== undefined && compactJson(before) === compactJson(value);
      if (same) tell({ moving, same }); // a slider let go where it was: no step of undo
      else become(withAt(state.scene, pointer, value), { key: pointer, moving });
    },
    update(change, options = {}) { become(change(state.scene), options); },
    // Throws SyntaxError when the text is not JSON, TypeError when it is not an object. `key`: it is edited; else it is
    // another document, of this title, or a state of the piece of work.
    replaceText(text, { preset = "", key = null, title, work } = {}) {
      const value = parseJson(text);
      if (value === null || typeof value !== "object" || Array.isArray(value)) {
        throw new TypeError("A scene document is a JSON object: { … }.");
      }
      become(value, { text, preset, key, replaced: key === null, title, work });
    },
    undo() { travel(past, future); },
    redo() { travel(future, past); },
    get canUndo() { return past.length > 0; },
    get canRedo() { return future.length > 0; },
    forgetHistory() { past = []; future = []; },
    // All of it, to be kept and brought back. `steps`: of undo and of redo, at most.
    history(steps) { return { state, past: past.slice(-steps), future: future.slice(-steps) }; },
    bringBack(history) {
      ({ state, past, future } = history);
      lastKey = null;
      tell({ moving: false, replaced: true });
    },
    subscribe(listener) { listeners.push(listener); },
  };
}
