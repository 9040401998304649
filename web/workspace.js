// The workspace over the picture: what is selected, what is done with it, and how pointer and keys do it. The drawing is
// workspace_view.js's, which comes when the first picture is there; without WebGL the list, the numbers and the buttons
// of it work all the same.

import { cameraOf, kSteepest, orbitOf } from "./camera.js";
import { at } from "./document.js";
import { byId, el } from "./dom.js";
import { createFlight } from "./flight.js";
import { NONE } from "./rotation.js";
import { atOrDefault } from "./schema.js";
import { added, cleared, duplicated, removed, transformed, turnedTo } from "./workspace_edit.js";
import { around, isTriple, itemsOf } from "./workspace_items.js";
import { createPanel } from "./workspace_panel.js";
import { createSky } from "./workspace_sky.js";
import { createSpriteLoop } from "./workspace_sprite_loop.js";
import { createToolbar } from "./workspace_toolbar.js";

const SHOWN = "awan.workspace"; // whether it was wanted last time
const kClickPixels = 4;
const VIEWS = { 1: { azimuth: 0, elevation: 0 }, 3: { azimuth: 90, elevation: 0 }, 7: { azimuth: 0, elevation: kSteepest } };
const radians = (degrees) => (degrees * Math.PI) / 180;

function hasWebGL() {
  try {
    const context = document.createElement("canvas").getContext("webgl2");
    context?.getExtension("WEBGL_lose_context")?.loseContext(); // browsers keep few of them
    return context !== null;
  } catch {
    return false;
  }
}

// bounds() -> of all clouds, or null. letGo(): the pointer has been. chosen(): another cloud is being edited. seen(): what is
// to be seen of the document is another thing. name() -> stem of file names.
export function createWorkspace(store, choice, { bounds, letGo, chosen, seen, failed, note, name }) {
  const stage = byId("stage");
  let view = null;
  let loading = null;
  let state = "waiting"; // "waiting" for the first picture, "off", "on", "none": no WebGL
  let selection = []; // ids; the last is the active one
  let items = [];
  let shownItems = null; // the scene that `items` are of
  let mode = "translate";
  let step = 0; // of snapping; 0: none
  let boxTool = false;

  // --- what there is, and what is selected ---

  function readItems() {
    const { scene } = store;
    if (shownItems === scene) return;
    shownItems = scene;
    items = itemsOf(scene);
    const known = new Set(items.map(({ id }) => id));
    selection = selection.filter((id) => known.has(id));
  }
  const chosenItems = () => {
    const ids = new Set(selection);
    return items.filter(({ id }) => ids.has(id));
  };
  const active = () => items.find(({ id }) => id === selection[selection.length - 1]) ?? null;
  // A cloud carries its parts: they are not moved twice.
  const ids = () => {
    const whole = new Set(chosenItems().filter((item) => item.whole).map((item) => item.cloud));
    return chosenItems().filter((item) => item.whole || !whole.has(item.cloud)).map(({ id }) => id);
  };

  function select(list) {
    selection = list;
    const item = active();
    if (item && item.cloud !== choice.index) {
      choice.index = item.cloud;
      chosen();
    }
    refresh();
  }
  // One alone, or one more, or one less.
  function pick(id, more) {
    if (!more) select(id ? [id] : []);
    else if (id) select(selection.includes(id) ? selection.filter((one) => one !== id) : [...selection, id]);
  }

  // --- edits ---

  const change = (next, list) => {
    store.update(() => next);
    if (list) {
      readItems();
      select(list);
    }
  };
  const pivotOf = () => around(chosenItems())[0];
  const needsSelection = () => {
    if (selection.length) return true;
    note("Nothing is selected.");
    return false;
  };
  const actions = {
    add() {
      const made = added(store.scene, choice.index, active()?.center ?? around(items)[0].map((x) => (Number.isFinite(x) ? x : 0)),
        active()?.whole === false ? 2 * active().half[1] : 2);
      if (made) change(...made);
      else note("Nothing can be added to a cloud of this model: it has no parts.");
    },
    duplicate() {
      if (!needsSelection()) return;
      const width = Math.max(...chosenItems().map(({ half }) => half[0]));
      change(...duplicated(store.scene, ids(), [Number((2 * width).toPrecision(3)), 0, 0]));
    },
    remove() {
      if (needsSelection()) change(removed(store.scene, ids()), []);
    },
    removeAll: () => change(cleared(store.scene), []),
    // Another document; what there was comes back with Undo.
    fresh() {
      store.replaceText(JSON.stringify({ cubes: [{ particles: 200, size: [6, 2, 4], center: [0, 0, 0], radius: 1.5 }] }, null, 2) + "\n");
      readItems();
      select(["/cubes/0"]);
    },
    frame() {
      const found = chosenItems();
      const [center, half] = around(found.length ? found : items);
      aim({ target: center, distance: (1.25 * Math.hypot(...half)) / Math.sin(radians(orbit().fov) / 2) });
    },
    look: (name) => aim(VIEWS[name]),
    selectAll: () => select(items.filter((item) => !item.whole || item.bare).map(({ id }) => id)),
    // By numbers. `key` keeps what belongs together in one step of undo.
    transform(spec, key) {
      store.update((scene) => transformed(scene, ids(), { pivot: pivotOf(), frame: active()?.axes ?? NONE, ...spec }), { key });
    },
    turnTo: (axis, degrees) => store.update((scene) => turnedTo(scene, active().id, axis, degrees), { key: `workspace-turn-${axis}` }),
    change,
  };
  const orbit = () => orbitOf(store.scene, bounds());
  const aim = (part) => store.update((scene) => ({ ...scene, camera: cameraOf(scene, { ...orbitOf(scene, bounds()), ...part }) }), { key: "/camera" });

  // --- the gizmo and the sun: one gesture is one step of undo ---

  let gesture = null; // { key, scene, ids } as it was when it began
  let pendingChange = null;
  function applyGesture() {
    const spec = pendingChange;
    pendingChange = null;
    if (!spec || !gesture) return;
    store.update(() => transformed(gesture.scene, gesture.ids, spec), { key: gesture.key, moving: true });
  }
  const told = {
    gizmo(spec) {
      gesture ??= { key: Symbol("gizmo"), scene: store.scene, ids: mode === "rotate" ? turning().ids : ids() };
      if (!pendingChange) requestAnimationFrame(applyGesture);
      pendingChange = spec;
    },
    gizmoEnds() {
      applyGesture();
      gesture = null;
      end();
    },
  };
  // What a turn takes along, about where, and whether about every axis. What stands along its cloud's axes, as cubes do, takes
  // all of the cloud with it, and that turns about y.
  function turning() {
    const chosenOnes = chosenItems();
    if (chosenOnes.every(({ angles }) => angles)) {
      return { ids: ids(), center: pivotOf(), freely: chosenOnes.every(({ angles }) => !angles.includes(null)) };
    }
    const clouds = new Set(chosenOnes.map(({ cloud }) => cloud));
    return {
      ids: [...clouds].map((k) => `/clouds/${k}`), center: items.find((one) => one.whole && one.cloud === active().cloud).center, freely: false,
    };
  }
  function end() {
    sprites.letGo();
    letGo();
    refresh();
  }
  function moveSun(angles, key) {
    store.update((scene) => {
      const { direction: _replaced, ...sun } = at(scene, "/sun") ?? {};
      return { ...scene, sun: { ...sun, ...angles } };
    }, { key, moving: true });
  }
  function sunAngles() {
    const direction = at(store.scene, "/sun/direction");
    if (isTriple(direction)) {
      const [x, y, z] = direction;
      return { elevation: (Math.atan2(y, Math.hypot(x, z)) * 180) / Math.PI, azimuth: (Math.atan2(x, z) * 180) / Math.PI };
    }
    return { elevation: Number(atOrDefault(store.scene, "/sun/elevation")) || 0, azimuth: Number(atOrDefault(store.scene, "/sun/azimuth")) || 0 };
  }
  function towardsSun() {
    const { elevation, azimuth } = sunAngles();
    const [e, a] = [radians(elevation), radians(azimuth)];
    return [Math.cos(e) * Math.sin(a), Math.sin(e), Math.cos(e) * Math.cos(a)];
  }

  // --- flying: it has pointer and keys before the workspace ---

  const sky = createSky(stage);
  const flight = createFlight(store, {
    view: () => view, sky, eye: eyeOf, bounds, sprites: () => sprites, changed: seen, failed, note, name, refresh: () => refresh(),
  });
  async function fly() {
    if (state === "off" || state === "waiting") await toggle();
    if (state === "on") flight.enter();
    else note("Flying needs WebGL, which this browser does not have: arrow keys and wheel move the camera.");
  }

  // --- the pointer: before the stage has it, which turns the camera with what is left ---

  const canvas = el("canvas", { id: "workspace", "aria-hidden": "true" });
  const frame = el("div", { id: "select-box", hidden: true });
  let press = null; // { kind: "click" | "box" | "sun", x, y, more, key }
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  const take = (event) => event.stopImmediatePropagation();
  stage.addEventListener("pointerdown", (event) => {
    press = null;
    if (state !== "on" || event.button !== 0 || event.target !== canvas) return;
    const [x, y] = place(event);
    const more = event.shiftKey || event.ctrlKey || event.metaKey;
    if (view.holdsGizmo) return;
    press = { kind: "click", x, y, more };
    if (view.holdsSun(x, y)) Object.assign(press, { kind: "sun", key: Symbol("sun") });
    else if (boxTool || event.shiftKey) press.kind = "box";
    if (press.kind === "click") return;
    stage.setPointerCapture(event.pointerId);
    stage.focus({ preventScroll: true });
    event.preventDefault();
    take(event);
  }, { capture: true });
  stage.addEventListener("pointermove", (event) => {
    if (state === "on" && !event.buttons && event.target === canvas) {
      stage.classList.toggle("takes", view.holdsGizmo || view.holdsSun(...place(event)));
    }
    if (!press || press.kind === "click" || !event.buttons) return;
    take(event);
    const [x, y] = place(event);
    if (press.kind === "sun") {
      moveSun(view.sunAt(x, y), press.key);
      return;
    }
    frame.hidden = Math.hypot(x - press.x, y - press.y) < kClickPixels;
    for (const [name, value] of [["left", Math.min(x, press.x)], ["top", Math.min(y, press.y)], ["width", Math.abs(x - press.x)], ["height", Math.abs(y - press.y)]]) {
      frame.style.setProperty(name, `${value}px`);
    }
  }, { capture: true });
  const release = (event) => {
    const mine = press;
    press = null;
    if (!mine) return;
    if (mine.kind !== "click") take(event);
    frame.hidden = true;
    const [x, y] = place(event);
    if (mine.kind === "sun") {
      end();
    } else if (Math.hypot(x - mine.x, y - mine.y) < kClickPixels) {
      const under = view.pick(x, y);
      // Again at the same place: the next one behind.
      const next = under[(under.indexOf(active()?.id) + 1) % under.length];
      pick(mine.more ? under[0] : next, mine.more);
    } else if (mine.kind === "box") {
      const found = view.within(Math.min(x, mine.x), Math.min(y, mine.y), Math.max(x, mine.x), Math.max(y, mine.y));
      select(mine.more ? [...new Set([...selection, ...found])] : found);
    }
  };
  stage.addEventListener("pointerup", release, { capture: true });
  stage.addEventListener("pointercancel", () => { press = null; frame.hidden = true; }, { capture: true });

  // --- keys ---

  const KEYS = {
    w: () => setMode("translate"), e: () => setMode("rotate"), r: () => setMode("scale"),
    Delete: actions.remove, Backspace: actions.remove, f: actions.frame, a: actions.selectAll, Escape: () => select([]),
    1: () => actions.look(1), 3: () => actions.look(3), 7: () => actions.look(7),
    b: () => toggleBox(), n: actions.add,
  };
  stage.addEventListener("keydown", (event) => {
    if (state !== "on" || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "D" && event.shiftKey) actions.duplicate();
    else if (!event.shiftKey && KEYS[event.key]) KEYS[event.key]();
    else return;
    event.preventDefault();
  });
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    if (event.target.closest?.("textarea, input:not([type=range], [type=checkbox])")) return; // the field's own
    event.preventDefault();
    if (event.shiftKey) store.redo();
    else store.undo();
  });
  // Whoever is in a row of the table or of a list of shapes has that one selected.
  byId("groups").addEventListener("focusin", (event) => {
    const id = event.target.closest("tr[data-pointer]")?.dataset.pointer;
    if (!id || selection.includes(id) || !items.some((item) => item.id === id)) return;
    select([id]);
  });

  // --- tools ---

  function setMode(next) {
    mode = next;
    refresh();
  }
  function toggleBox() {
    boxTool = !boxTool;
    refresh();
  }
  function setStep(next) {
    step = next;
    refresh();
  }
  const toolbar = createToolbar({ actions, setMode, toggleBox, setStep, toggle, fly });
  const panel = createPanel(store, { actions, select, ids, items: () => items, selection: () => selection, active, cloud: () => choice.index, failed, note });
  stage.after(toolbar.element, flight.bar.element);

  const sprites = createSpriteLoop({
    view: () => (state === "on" ? view : null), scene: () => store.scene, seen: () => flight.seen(store.scene), sun: towardsSun,
    tone: () => atOrDefault(store.scene, "/image/tone"),
  });

  // --- on and off ---

  async function load() {
    if (!hasWebGL()) {
      state = "none";
      refresh();
      return;
    }
    stage.querySelector("#picture").after(canvas, frame);
    try {
      const { createView } = await import(new URL("workspace_view.js", import.meta.url).href);
      view = createView(canvas, told);
    } catch (error) {
      canvas.remove();
      state = "none";
      refresh();
      failed(new Error(`The workspace is not there: ${error.message}`));
      return;
    }
    new ResizeObserver(() => view.resize()).observe(canvas);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => refresh());
    state = "on";
    view.resize();
    refresh();
    sprites.begin();
    sky.ask(store.scene);
  }
  function remember() {
    try {
      localStorage.setItem(SHOWN, state);
    } catch {
      // No permission: it is as it is the next time.
    }
  }
  async function toggle() {
    if (state === "on") state = "off";
    else if (view) state = "on";
    else await (loading ??= load());
    canvas.hidden = state !== "on";
    if (state !== "on") stage.classList.remove("sprites");
    remember();
    refresh();
  }
  // The first picture is there.
  function begin() {
    if (state !== "waiting") return;
    let wanted = null;
    try {
      wanted = localStorage.getItem(SHOWN);
    } catch {
      // As above.
    }
    state = "off";
    if (wanted !== "off") loading ??= load();
    else refresh();
  }

  // --- following the document ---

  function eyeOf() {
    const aspect = atOrDefault(store.scene, "/image/width") / atOrDefault(store.scene, "/image/height") || 1;
    const { target, azimuth, elevation, distance, fov } = orbit();
    const up = at(store.scene, "/camera/up");
    const own = at(store.scene, "/camera/eye");
    const [e, a] = [radians(elevation), radians(azimuth)];
    const eye = isTriple(own) ? own : [Math.cos(e) * Math.sin(a), Math.sin(e), Math.cos(e) * Math.cos(a)].map((d, axis) => target[axis] + distance * d);
    return { eye, target, up: isTriple(up) ? up : [0, 1, 0], fov, aspect };
  }
  let litBy = "";
  function refresh() {
    readItems();
    toolbar.refresh({ state, mode, boxTool, step, count: selection.length, flying: flight.on });
    panel.refresh();
    if (state !== "on") return;
    const chosenOnes = new Set(selection);
    const activeId = selection[selection.length - 1];
    const drawn = items.filter((item) => !item.whole || item.bare || chosenOnes.has(item.id))
      .map((item) => ({ ...item, selected: chosenOnes.has(item.id), active: item.id === activeId }));
    const [center, half] = items.length ? around(items) : [[0, 0, 0], [5, 5, 5]];
    const measured = bounds() ?? { min: center.map((c, i) => c - half[i]), max: center.map((c, i) => c + half[i]) };
    if (!gesture) view.bounds(measured);
    const look = flight.on ? flight.look() : eyeOf();
    view.camera(look);
    sky.look(look);
    view.items(drawn);
    view.sun(sunAngles());
    const item = active();
    const grip = item && mode === "rotate" ? turning() : { center: item && pivotOf(), freely: true };
    view.gizmo(item && !flight.on ? { mode, center: grip.center, axes: grip.freely ? item.axes : NONE, freely: grip.freely, snap: step } : null);
    const sunNow = JSON.stringify(sunAngles());
    if (sunNow !== litBy && !gesture) sprites.lit();
    litBy = sunNow;
  }
  store.subscribe(({ moving, replaced }) => {
    if (replaced) selection = [];
    sprites.changed(moving, replaced);
  });

  return {
    elements: [panel.element],
    refresh, letGo: sprites.letGo, seen: flight.seen,
    // What the picture on the screen is of (picture.js).
    marked(how) {
      begin();
      if (how === "earlier") return;
      sprites.settled();
      if (state === "on") sky.ask(store.scene);
    },
  };
}
