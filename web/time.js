// Time: a bar under the picture with a slider and play, where something can move; and the group that
// says which frames a sequence has. While it plays, the document stays as it is: each picture is of the
// document at the time that the clock shows, and only the last of them becomes the document's own.

import * as api from "./api.js";
import { cameraOf, isAutomatic, orbitOf } from "./camera.js";
import { checkbox, group, numberField, numberInput, stepByArrows } from "./controls.js";
import { at } from "./document.js";
import { byId, el } from "./dom.js";
import { compactJson } from "./json_text.js";
import { somethingMoves } from "./models.js";
import { createObjectTable } from "./object_table.js";
import { atOrDefault, fieldAt } from "./schema.js";

const FRESH = { from: fieldAt("/sequence/from").standard, to: 10, frames: 100 };
const kFewestFrames = 12; // a round shows so many at least, however long each takes
const COMMANDS = [
  ["Numbered pictures", "awan render scene.json --frames all -o cloud.%04d.png"],
  ["An animation", "awan render scene.json -o cloud.webp"],
];

const isNumber = (value) => typeof value === "number" && Number.isFinite(value);

// [first, last] second of the slider.
function spanOf(scene) {
  const from = atOrDefault(scene, "/sequence/from");
  const to = at(scene, "/sequence/to") ?? FRESH.to;
  if (!isNumber(from) || !isNumber(to) || from === to) return [0, FRESH.to];
  return [Math.min(from, to), Math.max(from, to)];
}
const timeOf = (scene) => (isNumber(at(scene, "/time")) ? at(scene, "/time") : fieldAt("/time").standard);
const short = (seconds) => Number(seconds.toFixed(3));

function unionOf(boxes) {
  const all = boxes.filter(Boolean);
  if (!all.length) return null;
  const pick = (side, choose) => [0, 1, 2].map((axis) => choose(...all.map((box) => box[side][axis])));
  return { min: pick("min", Math.min), max: pick("max", Math.max) };
}

// As for the frames of a sequence: what holds the clouds at the first, the middle and the last second.
// An automatic camera that followed them would show no movement.
async function steadyCamera(scene, signal) {
  const [from, to] = spanOf(scene);
  const boxes = [];
  for (const time of [from, (from + to) / 2, to]) {
    const { sequence: _left, ...still } = scene;
    const { survey } = await api.plan(compactJson({ ...still, time }), { signal });
    boxes.push(survey?.bounds);
  }
  return cameraOf(scene, orbitOf(scene, unionOf(boxes)));
}

const hasCameraKeys = (scene) => at(scene, "/sequence/camera")?.length > 0;

// bounds() -> of all clouds, or null. show(): a picture of the time that playedScene() has. failed(problem), copy(text),
// note(text).
export function createTime(store, { bounds, show, failed, copy, note }) {
  let playing = null; // { time, clock, camera, preparing }
  let steady = { key: [], camera: null }; // and what it was found for

  // --- the bar ---

  const play = el("button", { type: "button", id: "play", onclick: toggle });
  const range = el("input", { type: "range", "aria-label": "Time", step: "any" });
  const number = numberInput({
    id: "seconds", pointer: "/time", "aria-label": "Time, seconds", digits: 4,
    get: () => (playing ? Number(playing.time.toFixed(1)) : timeOf(store.scene)), set: (value, options) => moveTo(value, options),
  });
  stepByArrows(number.input, 0.1);
  const ends = el("span", { class: "unit", "aria-hidden": "true" });
  const bar = el("div", { id: "time-bar", role: "group", "aria-label": "Time", hidden: true },
    play, range, number.input, ends);
  byId("stage").after(bar);
  range.addEventListener("input", () => moveTo(short(range.valueAsNumber), { moving: true }));
  range.addEventListener("change", () => moveTo(short(range.valueAsNumber), { moving: false }));

  function moveTo(time, options) {
    forget();
    store.set("/time", time, options);
  }

  // --- playing ---

  function forget() {
    playing?.preparing.abort();
    playing = null;
    refreshBar();
  }
  function pause() {
    if (!playing) return;
    const { time } = playing;
    forget();
    store.set("/time", short(time));
  }
  async function begin() {
    const { scene } = store;
    const [from, to] = spanOf(scene);
    const time = timeOf(scene);
    const mine = { time: time >= from && time < to ? time : from, clock: 0, preparing: new AbortController() };
    playing = mine;
    refreshBar();
    try {
      const key = [scene.cubes, scene.clouds, scene.sequence, scene.image];
      if (isAutomatic(scene) && !hasCameraKeys(scene) && key.some((part, i) => part !== steady.key[i] || !steady.camera)) {
        steady = { key, camera: await steadyCamera(scene, mine.preparing.signal) };
      }
    } catch (error) {
      if (playing === mine) forget();
      failed(error);
      return;
    }
    if (playing !== mine) return;
    mine.clock = performance.now();
    show();
  }
  function toggle() {
    if (playing) pause();
    else begin();
  }
  // The picture asked for is on the screen: the next is of what the clock says by now.
  function shown() {
    if (!playing || !playing.clock) return;
    const [from, to] = spanOf(store.scene);
    const now = performance.now();
    playing.time += Math.min((now - playing.clock) / 1000, (to - from) / kFewestFrames);
    if (playing.time > to) playing.time = from + ((playing.time - to) % (to - from));
    playing.clock = now;
    refreshBar();
    show();
  }
  // The sequence's own planning is for its three frames; a frame that passes by needs only its own, unless the sequence
  // moves its camera.
  // `rung`: the quickest that looks like the document's own, or null.
  function playedScene(rung) {
    const { sequence, ...rest } = store.scene;
    const scene = hasCameraKeys(store.scene) ? { ...rest, sequence } : rest;
    const camera = isAutomatic(scene) && steady.camera ? { camera: steady.camera } : {};
    return { ...scene, ...camera, ...(rung ? { accuracy: { rung } } : {}), time: short(playing.time) };
  }
  document.addEventListener("visibilitychange", () => {
    if (document.hidden) pause();
  });

  function refreshBar() {
    const [from, to] = spanOf(store.scene);
    bar.hidden = !playing && at(store.scene, "/sequence") === undefined && !somethingMoves(store.scene);
    byId("space-plays").hidden = bar.hidden;
    if (play.textContent !== (playing ? "Pause" : "Play")) play.textContent = playing ? "Pause" : "Play";
    play.classList.toggle("playing", playing !== null);
    const time = playing ? playing.time : timeOf(store.scene);
    range.min = String(from);
    range.max = String(to);
    if (document.activeElement !== range || Math.abs(range.valueAsNumber - time) > 1e-3) range.value = String(time);
    range.style.setProperty("--fill", `${(100 * (Math.max(from, Math.min(to, time)) - from)) / (to - from)}%`);
    range.setAttribute("aria-valuetext", `${short(time)} seconds of ${from} to ${to}`);
    ends.textContent = (from === 0 ? `of ${to} s` : `${from} to ${to} s`).replaceAll("-", "−");
    number.refresh();
  }

  // --- the group ---

  const sequence = () => {
    const value = at(store.scene, "/sequence");
    return value !== null && typeof value === "object" ? value : null;
  };
  let kept = FRESH;
  const ofSequence = (label, member) => numberField(store, {
    label, pointer: () => `/sequence/${member}`, get: () => sequence()?.[member] ?? FRESH[member],
    // Whole, so that what is required is there.
    set: (value, options) => store.update((scene) => ({ ...scene, sequence: { ...FRESH, ...sequence(), [member]: value } }),
      { key: `/sequence/${member}`, ...options }),
  });
  const now = numberField(store, { label: "Time, s", pointer: () => "/time", set: moveTo });
  const on = checkbox({
    label: "A sequence of frames", pointer: "/sequence", get: () => sequence() !== null,
    set: (yes) => {
      if (!yes) kept = sequence() ?? kept;
      store.set("/sequence", yes ? kept : undefined);
    },
  });
  const limits = [ofSequence("From, s", "from"), ofSequence("To, s", "to"), ofSequence("Frames", "frames")];
  const triple = (over, member) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}` }));
  const keys = createObjectTable(store, {
    title: "Camera keys", noun: "camera key", one: "the camera as a key", pointer: () => "/sequence/camera",
    why: "A camera that moves: where it is at some times, and smoothly so between them.",
    // As it stands, a second after the last key.
    make: (all) => {
      const { eye, target, fov } = cameraOf(store.scene, orbitOf(store.scene, bounds()));
      const last = all.at(-1)?.time;
      return { time: isNumber(last) ? short(last + 1) : timeOf(store.scene), eye, target, fov };
    },
    columns: [{ title: "time", member: "time", step: 0.1 }, ...triple("eye", "eye"), ...triple("target", "target"), { title: "fov", member: "fov" }],
  });
  const command = ([what, line]) => el("div", { class: "command" }, el("code", { tabindex: "0", role: "group", "aria-label": what }, line), el("button", {
    type: "button", "aria-label": `Copy the command: ${what}`,
    onclick: async () => {
      try {
        await copy(line);
        note("The command is on the clipboard.");
      } catch (error) {
        failed(error);
      }
    },
  }, "Copy"));
  const details = el("div", { class: "inner" }, ...limits.map((field) => field.element),
    el("p", { class: "why" }, "An automatic camera holds the clouds of all frames. All of them, from the scene saved as JSON:"),
    ...COMMANDS.map(command), keys.element);
  const element = group("Time", "/time-and-frames", false, now.element, on.element, details);

  return {
    element,
    get playing() { return playing !== null; },
    get canMove() { return !bar.hidden; },
    toggle, forget, pause, shown, playedScene,
    refresh() {
      refreshBar();
      now.refresh();
      on.refresh();
      details.hidden = sequence() === null;
      limits.forEach((field) => field.refresh());
      keys.refresh();
    },
  };
}
