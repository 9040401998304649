// The page: puts the parts together. Everything follows from the document (document.js): an edit
// refreshes the controls and asks for a picture; nothing else holds state that matters.

import { createAccuracyPanel } from "./accuracy.js";
import * as api from "./api.js";
import { boundsOfCubes } from "./camera.js";
import { group } from "./controls.js";
import { cloudsOf, createStore, modelOf, withAt } from "./document.js";
import { byId, el } from "./dom.js";
import { createDrafts } from "./drafts.js";
import { createFigures } from "./figures.js";
import { copy, createFiles } from "./files.js";
import { compactJson } from "./json_text.js";
import { createKeeping } from "./keeping.js";
import { createLayoutTable } from "./layout_table.js";
import { coarser, createChoice, createModels } from "./models.js";
import { cameraPanel, createPanels } from "./panels.js";
import { createRenderLoop } from "./picture.js";
import { clearMarks, focusProblem, markProblem, placeName } from "./problems.js";
import { atOrDefault } from "./schema.js";
import { isShared, sharedText } from "./share.js";
import { createStage } from "./stage.js";
import { createTime } from "./time.js";
import { createTokenField } from "./token.js";
import { createWorkspace } from "./workspace.js";

const store = createStore();
let measured = null; // { scene, bounds } of the last plan
let problem = null; // what is wrong with the document as it stands
let wholePicture = null; // of the document as it stands

// The service's bounds while they are of the layout at hand, else an estimate; for models that only the
// service can make, its last ones. Edits share what they do not touch, so the same list is the same layout.
function bounds() {
  const { scene } = store;
  const current = measured && measured.scene.cubes === scene.cubes && measured.scene.clouds === scene.clouds;
  const onlyCubes = cloudsOf(scene).every(({ cloud }) => modelOf(cloud) === "cubes");
  return current || (measured && !onlyCubes) ? measured.bounds : boundsOfCubes(scene);
}

// --- the status line ---

let fade = 0;
function say(text) {
  byId("note").textContent = text;
  clearTimeout(fade);
  if (text) fade = setTimeout(() => say(""), 6000);
}
function showProblem() {
  const alert = byId("alert");
  const button = byId("go-to-field");
  if (!problem) {
    clearMarks();
    button.hidden = true;
    alert.textContent = "";
    return;
  }
  markProblem(problem);
  const place = problem.pointer ? `${placeName(problem.pointer)}: ` : "";
  const text = place + problem.message;
  if (alert.textContent !== text) alert.textContent = text;
  button.hidden = !problem.pointer;
}
function fail(error) {
  if (error.name === "AbortError") return;
  time.forget();
  problem = { message: error.message, pointer: error.pointer ?? null };
  say("");
  showProblem();
  if (error.status === 401) tokenField.ask();
}
// Said at once, whatever the service is busy with; it is asked all the same, and says it in its own words.
addEventListener("wrongnumber", ({ detail }) => {
  problem = detail;
  showProblem();
});
byId("go-to-field").addEventListener("click", () => {
  models.reveal(problem.pointer);
  layout.reveal(problem.pointer);
  showProblem();
  focusProblem(problem.pointer);
});

// --- the parts ---

const tokenField = createTokenField(() => (begun ? loop.changed({ moving: false }) : begin()));
const camera = cameraPanel(store, bounds);
const panels = createPanels(store, camera);
const accuracy = createAccuracyPanel(store, { failed: fail, open: window.matchMedia("(min-width: 60rem)").matches });
const choice = createChoice(store);
const models = createModels(store, choice, { bounds, note: say, changed: refreshControls });
const layout = createLayoutTable(store, choice, { redrawn: () => problem && showProblem() });
const figures = createFigures(store);
const time = createTime(store, { bounds, failed: fail, copy, note: say, show: () => loop.changed({ moving: true, playing: true }) });
const stage = createStage({
  nudge: camera.nudge,
  letGo() {
    workspace.letGo();
    loop.letGo();
  },
  toggle() {
    if (time.canMove) time.toggle();
    return time.canMove;
  },
});
const fileName = () => store.preset || store.work.title.replace(/[^\w-]+/g, "-").toLowerCase() || "cloud";
const workspace = createWorkspace(store, choice, {
  bounds, letGo: () => loop.letGo(), chosen: refreshControls, seen: () => loop.changed({ moving: false }), failed: fail, note: say, name: fileName,
});
const files = createFiles(store, {
  name: fileName,
  picture: () => wholePicture,
  failed: fail, note: say,
});
const keeping = createKeeping(store, { failed: () => say("The browser keeps no drafts for this page.") });
const drafts = createDrafts(store, keeping, { open: (text, options) => store.replaceText(text, options), note: say, failed: fail });

const text = el("textarea", { id: "json", rows: 24, spellcheck: "false", autocomplete: "off", "aria-label": "Scene document as JSON" });
const jsonGroup = group("JSON", "", false, el("p", { class: "why" }, "The whole document. What is written here is what is sent."), text);
jsonGroup.addEventListener("toggle", () => refreshText());
byId("groups").append(...workspace.elements, ...models.elements, time.element, ...panels.map((panel) => panel.element), accuracy.element, layout.element, jsonGroup);

text.addEventListener("input", () => {
  try {
    store.replaceText(text.value, { key: "text" });
    text.removeAttribute("aria-invalid");
  } catch (error) {
    text.setAttribute("aria-invalid", "true");
    problem = { message: `Not a document yet: ${error.message}`, pointer: null };
    showProblem();
  }
});
text.addEventListener("blur", () => {
  if (text.getAttribute("aria-invalid") !== "true") refreshText();
});
// Long documents make a slow text area: it is filled only while it can be seen.
function refreshText() {
  if (!jsonGroup.open || document.activeElement === text) return;
  text.removeAttribute("aria-invalid");
  if (text.value !== store.text) text.value = store.text;
}

// --- the picture ---

let planFlight = null;
async function askPlan() {
  planFlight = new AbortController();
  const scene = store.scene;
  try {
    const answer = await api.plan(store.text, { signal: planFlight.signal });
    if (answer.survey?.bounds) measured = { scene, bounds: answer.survey.bounds };
    figures.plan(answer);
    accuracy.plan(answer);
    panels.forEach((panel) => panel.refresh());
    workspace.refresh();
  } catch (error) {
    if (error.name !== "AbortError") say(`No plan: ${error.message}`);
  }
}

let rung = ""; // of the last picture
// What coarse pictures are asked for by.
const QUICK = { any: { time_ms: 400 }, lumps: { rung: "transport-16" }, plain: { rung: "transport-16" }, glow: { rung: "harris" } };
// Rungs that are quicker than what a short time would choose keep their look.
const isQuick = ({ rung: named, time_ms: ms }) => (named !== undefined && !/^(transport-|truth$)/.test(named)) || ms < 120;

function quickened(scene, look) {
  if (time.playing) return time.playedScene(/^transport-/.test(rung) ? "transport-16" : null);
  if (atOrDefault(scene, "/look") !== "physical" || isQuick(scene.accuracy ?? {})) return scene; // a look has no error
  const isLumpy = ["any", "lumps"].includes(look);
  return { ...scene, ...(isLumpy ? {} : { detail: "none" }), accuracy: QUICK[look] };
}
function textFor({ reduction, quick, look }) {
  const seen = workspace.seen(store.scene);
  if (reduction === 1 && !quick && seen === store.scene) return store.text;
  const scene = quick ? coarser(quickened(seen, look), reduction) : seen;
  const side = (member) => Math.max(1, Math.round(atOrDefault(scene, `/image/${member}`) / reduction));
  return compactJson(withAt(withAt(scene, "/image/width", side("width")), "/image/height", side("height")));
}

const MARKS = { "": "", coarse: "coarse, being refined", unrefined: "coarse: the whole picture failed", earlier: "of an earlier state" };

const loop = createRenderLoop({
  async render(how, signal) {
    const { reduction } = how;
    const width = atOrDefault(store.scene, "/image/width");
    const height = atOrDefault(store.scene, "/image/height");
    const transparent = atOrDefault(store.scene, "/image/background") === "transparent";
    const isOwn = workspace.seen(store.scene) === store.scene; // a flight shows other thicknesses
    const picture = await api.render(textFor(how), { preview: how.quick, signal });
    return { ...picture, isLit: /^transport-/.test(picture.figures.rung), width, height, reduction, transparent, isOwn };
  },
  async shown({ blob, figures: said, isKept, width, height, reduction, transparent, isOwn }, { whole }) {
    stage.shape(width, height, transparent);
    const count = said.particles === null ? "" : ` of ${said.particles} particles`;
    await stage.show(blob, `Cloud${count}, ${width} by ${height} pixels`);
    figures.picture(said, Math.round(width / reduction), Math.round(height / reduction), isKept);
    problem = null;
    showProblem();
    tokenField.done();
    rung = said.rung ?? "";
    wholePicture = whole && isOwn && blob.type === "image/png" ? blob : null;
    if (whole) askPlan();
    time.shown();
  },
  failed: fail,
  busy(yes) {
    byId("stage").setAttribute("aria-busy", String(yes));
    byId("busy").hidden = !yes || time.playing;
  },
  marked(how) {
    byId("left").dataset.picture = how;
    byId("mark").textContent = time.playing ? "" : MARKS[how];
    workspace.marked(how);
  },
});

// --- following the document ---

function refreshControls() {
  models.refresh();
  time.refresh();
  panels.forEach((panel) => panel.refresh());
  accuracy.refresh();
  // Neither a look nor what is displayed has an error.
  accuracy.element.hidden = atOrDefault(store.scene, "/look") !== "physical" || atOrDefault(store.scene, "/display") !== "lit";
  layout.refresh();
  figures.refresh();
  workspace.refresh();
  files.refresh();
  refreshText();
  byId("undo").disabled = !store.canUndo;
  byId("redo").disabled = !store.canRedo;
}
store.subscribe(({ moving, replaced, same = false }) => {
  planFlight?.abort();
  if (!same) wholePicture = null;
  if (replaced) {
    time.forget();
    models.forget();
    accuracy.forget();
    figures.forget();
    choice.index = 0;
  }
  if (!same) followed = false;
  clearTimeout(followTimer);
  if (!moving) follow();
  else followTimer = setTimeout(follow, 500); // a drag over the picture has no last word
  refreshControls();
  if (problem) showProblem(); // rows may have been rebuilt
  loop.changed({ moving, playing: time.playing, same, another: replaced });
});

byId("undo").addEventListener("click", () => store.undo());
byId("redo").addEventListener("click", () => store.redo());

// --- presets, the address and the drafts ---

const presetSelect = byId("preset");
// The address names the preset while the document is one. Everything is kept at every step (keeping.js).
let followed = true;
let followTimer = 0;
function follow() {
  if (followed) return;
  followed = true;
  const { preset } = store;
  presetSelect.value = preset;
  history.replaceState(null, "", preset ? `#${preset}` : location.pathname + location.search);
  keeping.save();
}
async function choosePreset(name) {
  const { preset, work } = store;
  try {
    const [option] = [...presetSelect.options].filter(({ value }) => value === name);
    store.replaceText(await api.presetText(name), { preset: name, title: option?.textContent ?? name });
    if (!preset && work.id) drafts.kept(work.title);
  } catch (error) {
    fail(error);
    presetSelect.value = store.preset;
  }
}
async function openShared(hash) {
  const text = await sharedText(hash);
  store.replaceText(text, { title: "A shared scene" }); // and the address lets go of it: it is a draft now
}
presetSelect.addEventListener("change", () => {
  if (presetSelect.value) choosePreset(presetSelect.value);
  else presetSelect.value = store.preset;
});
addEventListener("hashchange", () => {
  if (isShared(location.hash)) {
    openShared(location.hash).catch(fail);
    return;
  }
  const name = decodeURIComponent(location.hash.slice(1));
  if (name && name !== store.preset && name !== "groups") choosePreset(name);
});

let begun = false; // the presets are there, and a document
// What this tab had before it was loaded again; else what the address names; else the last draft; else the first preset.
async function firstDocument(list) {
  const session = await keeping.session();
  if (session && (!session.state.preset || session.past.length + session.future.length > 0)) {
    store.bringBack(session);
    return;
  }
  if (isShared(location.hash)) {
    await openShared(location.hash);
    return;
  }
  const asked = decodeURIComponent(location.hash.slice(1));
  const [draft] = list.some(({ name }) => name === asked) ? [] : await keeping.drafts();
  if (draft) {
    const { id, title, scene, written } = draft;
    store.bringBack({ state: { scene, written, work: { id, title }, preset: "" }, past: [], future: [] });
    say("Your last document is open again.");
  } else {
    await choosePreset(list.some(({ name }) => name === asked) ? asked : list[0].name);
    store.forgetHistory();
  }
}
async function begin() {
  try {
    const list = await api.presets();
    presetSelect.replaceChildren(el("option", { value: "" }, "Your own"),
      ...list.map(({ name, title }) => el("option", { value: name }, title)));
    try {
      await firstDocument(list);
    } catch (error) { // an address that cannot be read
      await choosePreset(list[0].name);
      store.forgetHistory();
      say(error.message);
    }
    refreshControls();
    byId("groups").classList.remove("waiting");
    begun = true;
  } catch (error) {
    fail(error);
  }
}
begin();
