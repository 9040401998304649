// Flying, as in Pakawan: the keys move the eye, particles are shown for the cloud, and where it rests the picture of the
// service follows. A path can be recorded, replayed and saved. All of a flight is one step of undo: the camera where it
// ended. How it moves is flight_motion.js's, what a path is flight_path.js's, the buttons are flight_bar.js's.

import * as api from "./api.js";
import { isAutomatic, sizeOf } from "./camera.js";
import { at } from "./document.js";
import { byId } from "./dom.js";
import { save } from "./saving.js";
import { createFlightBar } from "./flight_bar.js";
import { moved, poseOf, targetOf, turnedBy } from "./flight_motion.js";
import { lengthOf, pathOf, textOf, thinned, viewAt } from "./flight_path.js";
import { fieldAt, atOrDefault } from "./schema.js";
import { THICKNESS, thickened } from "./workspace_shapes.js";

const kRestMs = 400; // without a key, before the picture is asked for
const kKeyMs = 100; // between two keys of a path that is recorded
const kMostKeys = 6000; // ten minutes
const kNear = 0.004; // of the cloud's radius: a recorded path is kept as exactly as that
const kLongestStep = 0.25; // seconds: after a pause, nobody leaps
const kFigureMs = 250; // between two figures on the screen
const kCoarseMs = 150; // between two pictures, where there are no particles to show
const kStillMs = 1000; // between two steps of a replay, for whoever wants less motion

const short = (x) => Number(x.toFixed(4)) + 0; // + 0: no "-0" in documents

// What keys do, by what they write or, on other layouts, by where they are.
const HOLD = {
  w: "forward", s: "back", a: "left", d: "right", arrowup: "lookUp", arrowdown: "lookDown", arrowleft: "turnLeft", arrowright: "turnRight",
  KeyW: "forward", KeyS: "back", KeyA: "left", KeyD: "right",
};
const SPEED = { 1: 1, 2: 2, 3: 3, Digit1: 1, Digit2: 2, Digit3: 3 };
const isOwnOf = (target) => target.closest?.("input, select, textarea, [contenteditable]") !== null;

// view(): of workspace_view.js, or null. sky: of workspace_sky.js. eye() -> { eye, target, fov, ... } of the document. changed(): what is to be seen of
// the document is another thing. name() -> stem of file names.
export function createFlight(store, { view, sky, eye, bounds, sprites, changed, failed, note, name, refresh }) {
  const stage = byId("stage");
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  let on = false;
  let pose = null;
  let lens = null; // { fov, up, aspect }
  let cloud = null; // { center, radius }
  let way = "through";
  let speed = 2;
  const held = new Set();
  const fresh = new Set(); // of these, what no frame has seen
  const ending = new Set(); // of these, what is let go of already: it moves for one frame all the same
  let key = null; // of undo
  let mine = null; // the scene that the flight has made
  let lastMove = 0;
  let rested = true; // the document has the camera
  let dirty = false;
  let frames = { since: 0, drawn: 0 };
  let begun = 0;
  let recording = null; // [keys]
  let path = null;
  let kind = "smooth";
  let replay = null; // { begun, shown }
  let thickness = { name: "", factor: 1, densities: [] };
  let asked = 0; // of thicknesses: the last counts

  const lookOf = () => ({ eye: pose.eye, target: targetOf(pose, cloud), fov: lens.fov });

  // --- what is seen ---

  // The document as the flight shows it: as thick as was chosen.
  function seen(scene) {
    if (!on || !thickness.name) return scene;
    return thickened(scene, thickness.densities, thickness.factor, fieldAt("/density").most);
  }
  async function thicken(chosen) {
    asked += 1;
    const turn = asked;
    let factor = 1;
    let densities = [];
    if (chosen) {
      const [, depth] = THICKNESS.find(([word]) => word === chosen);
      const { survey } = await api.plan(store.text);
      if (turn !== asked || !on) return;
      const measured = survey?.optical_depth?.zenith;
      if (!(measured > 0)) throw new Error("There is no matter to make thicker.");
      factor = depth / measured;
      densities = survey.density;
    }
    thickness = { name: chosen, factor, densities };
    sprites().flies(true, factor);
    dirty = true;
    show();
    changed();
  }

  function draw() {
    const look = lookOf();
    view().camera({ ...look, up: lens.up, aspect: lens.aspect });
    sky.look(look);
  }
  // The camera of the document becomes the flight's. All of it is one step of undo. False when it is that already.
  function write(moving) {
    const { eye: place, target, fov } = lookOf();
    const before = isAutomatic(store.scene) ? {} : at(store.scene, "/camera");
    const camera = { ...before, eye: place.map(short), target: target.map(short), fov };
    if (JSON.stringify(camera) === JSON.stringify(before)) return false;
    key ??= Symbol("flight");
    mine = { ...store.scene, camera };
    store.update(() => mine, { key, moving });
    return true;
  }
  function rest() {
    rested = true;
    sprites().letGo();
    if (!write(false)) sprites().settled();
  }

  // --- from frame to frame ---

  function record(now) {
    if (!recording) return;
    const time = (now - recording.begun) / 1000;
    const { keys } = recording;
    if (keys.length && time < keys[keys.length - 1].time + kKeyMs / 1000) return;
    keys.push({ time, ...lookOf() });
    if (keys.length >= kMostKeys) {
      note("The path is as long as it can be.");
      endRecording();
    }
  }
  function follow(now) {
    let time = (now - replay.begun) / 1000;
    if (still.matches) time = Math.floor((time * 1000) / kStillMs) * (kStillMs / 1000);
    if (time === replay.shown) return;
    replay.shown = time;
    const { eye: place, target, fov } = viewAt(path, path.from + time);
    pose = poseOf(place, target);
    lens = { ...lens, fov };
    dirty = true;
    if (time >= lengthOf(path)) {
      replay = null;
      show();
    }
  }
  let last = 0;
  let coarse = 0;
  function tick(now) {
    if (!on) return;
    const seconds = Math.min(kLongestStep, (now - last) / 1000);
    last = now;
    if (replay) follow(now);
    else if (held.size) {
      pose = moved(pose, held, seconds, { way, speed, cloud });
      dirty = true;
      fresh.clear();
      for (const word of ending) held.delete(word);
      ending.clear();
    }
    record(now);
    if (dirty) {
      dirty = false;
      rested = false;
      lastMove = now;
      frames.drawn += 1;
      draw();
    }
    if (!rested) {
      const hasParticles = sprites().moves();
      if (now - lastMove >= kRestMs) {
        rest();
      } else if (!hasParticles && now - coarse > kCoarseMs) {
        coarse = now;
        write(true);
      }
    }
    if (now - frames.since >= kFigureMs) figures(now);
    requestAnimationFrame(tick);
  }
  function figures(now) {
    const { clientWidth: width, clientHeight: height } = stage;
    bar.figures({
      width, height, seconds: (now - begun) / 1000, rate: frames.drawn ? (1000 * frames.drawn) / (now - frames.since) : 0,
      sprites: sprites().count, recorded: recording ? (now - recording.begun) / 1000 : null,
    });
    frames = { since: now, drawn: 0 };
  }

  // --- the path ---

  function endRecording() {
    if (!recording) return;
    const { keys } = recording;
    recording = null;
    if (keys.length >= 2) path = pathOf(kind, thinned(keys, kNear * cloud.radius), Number(atOrDefault(store.scene, "/time")) || 0);
    show();
  }
  const actions = {
    speed(next) { speed = next; show(); },
    way(next) {
      way = next;
      if (way === "around") pose = poseOf(pose.eye, cloud.center);
      dirty = true;
      show();
    },
    thickness: (chosen) => thicken(chosen).catch((error) => {
      show();
      failed(error);
    }),
    record() {
      if (recording) {
        endRecording();
        return;
      }
      stop();
      recording = { begun: performance.now(), keys: [] };
      record(recording.begun);
      show();
    },
    replay() {
      if (replay || !path) {
        stop();
        return;
      }
      endRecording();
      replay = { begun: performance.now(), shown: -1 };
      show();
    },
    kind(next) {
      kind = next;
      if (path) path = { ...path, interpolation: kind };
      show();
    },
    save() {
      if (path) save(new Blob([textOf(path)], { type: "application/json" }), `${name()}.path.json`);
    },
    leave: () => leave(),
    hold(word, down) { hold(word, down); },
  };
  const bar = createFlightBar(actions);
  function show() {
    bar.refresh({ on, way, speed, thickness: thickness.name, recording: recording !== null, replaying: replay !== null, hasPath: path !== null, kind });
  }
  // Whoever takes the stick ends the replay.
  function stop() {
    if (!replay) return;
    replay = null;
    show();
  }
  function hold(word, down) {
    if (down) {
      stop();
      if (!held.has(word)) fresh.add(word);
      held.add(word);
      ending.delete(word);
    } else if (fresh.has(word)) ending.add(word);
    else held.delete(word);
  }
  function letGo() {
    for (const words of [held, fresh, ending]) words.clear();
  }

  // --- on and off ---

  function enter() {
    if (on) return;
    const { eye: place, target, fov, up, aspect } = eye();
    on = true;
    cloud = sizeOf(bounds());
    pose = poseOf(place, target);
    lens = { fov, up, aspect };
    letGo();
    [key, mine, rested, dirty] = [null, store.scene, true, false];
    [replay, recording] = [null, null];
    thickness = { name: "", factor: 1 };
    begun = last = performance.now();
    frames = { since: begun, drawn: 0 };
    stage.classList.add("flying");
    view().flies(true);
    sprites().flies(true);
    show();
    refresh();
    stage.focus({ preventScroll: true });
    stage.scrollIntoView({ block: "nearest" });
    requestAnimationFrame(tick);
  }
  // kept: the document gets the camera; not where it is another one by now.
  function leave({ kept = true } = {}) {
    if (!on) return;
    endRecording();
    const wasThick = thickness.name !== "";
    if (kept && !rested) rest();
    on = false;
    replay = null;
    letGo();
    stage.classList.remove("flying");
    view().flies(false);
    sprites().flies(false);
    show();
    refresh();
    if (wasThick) changed();
    if (kept) stage.focus({ preventScroll: true });
  }

  // --- keys and pointer, before the workspace and the stage have them ---

  addEventListener("keydown", (event) => {
    if (!on || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const written = event.key.toLowerCase();
    if (event.key === "Escape") {
      event.preventDefault();
      event.stopImmediatePropagation();
      leave();
      return;
    }
    // A choice of the bar keeps its arrows, but nobody has to leave it to fly on.
    if (isOwnOf(event.target) && !(event.target.closest("#flight-bar select") && "wasd".includes(written))) return;
    const word = HOLD[written] ?? HOLD[event.code];
    const gear = SPEED[written] ?? SPEED[event.code];
    if (word) hold(word, true);
    else if (gear) actions.speed(gear);
    else if (event.target !== stage || event.key === "Tab") return; // a button's own, or the way to the next
    event.preventDefault();
    event.stopImmediatePropagation();
  }, { capture: true });
  addEventListener("keyup", (event) => {
    const word = HOLD[event.key.toLowerCase()] ?? HOLD[event.code];
    if (on && word) hold(word, false);
  }, { capture: true });
  addEventListener("blur", letGo);
  document.addEventListener("visibilitychange", letGo);
  document.addEventListener("focusin", (event) => { if (isOwnOf(event.target)) letGo(); });

  let grip = null; // { id, x, y } of the pointer that looks around
  const taken = (event) => {
    if (!on || event.target.closest("#status")) return false;
    event.stopImmediatePropagation();
    return true;
  };
  stage.addEventListener("pointerdown", (event) => {
    if (!taken(event) || event.button !== 0) return;
    event.preventDefault();
    stop();
    stage.focus({ preventScroll: true });
    stage.setPointerCapture(event.pointerId);
    grip = { id: event.pointerId, x: event.clientX, y: event.clientY };
  }, { capture: true });
  stage.addEventListener("pointermove", (event) => {
    if (!taken(event) || event.pointerId !== grip?.id) return;
    pose = turnedBy(pose, event.clientX - grip.x, event.clientY - grip.y, { way, cloud, fov: lens.fov, height: stage.clientHeight });
    grip = { id: grip.id, x: event.clientX, y: event.clientY };
    dirty = true;
  }, { capture: true });
  for (const type of ["pointerup", "pointercancel"]) {
    stage.addEventListener(type, (event) => {
      if (event.pointerId === grip?.id) grip = null;
      taken(event);
    }, { capture: true });
  }
  stage.addEventListener("wheel", (event) => {
    if (!on || event.ctrlKey) return; // the browser's own zoom
    event.preventDefault();
    event.stopImmediatePropagation();
    stop();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : 1);
    pose = moved(pose, new Set([pixels < 0 ? "forward" : "back"]), Math.min(1, Math.abs(pixels) / 500), { way, speed, cloud });
    dirty = true;
  }, { capture: true, passive: false });

  // Another document ends the flight; undo and redo of this one take the eye along.
  store.subscribe(({ replaced }) => {
    if (!on || store.scene === mine) return;
    if (replaced) {
      leave({ kept: false });
      return;
    }
    const isKept = at(store.scene, "/camera") === mine.camera;
    mine = store.scene;
    if (isKept) return;
    const { eye: place, target, fov } = eye();
    pose = poseOf(place, target);
    lens = { ...lens, fov };
    [key, rested] = [null, true];
    sprites().letGo();
    draw();
  });

  return {
    bar, enter, leave, seen,
    get on() { return on; },
    look: () => ({ ...lookOf(), up: lens.up, aspect: lens.aspect }),
  };
}
