// The page: puts the parts together. Everything follows from the document (document.js): an edit
// refreshes the controls and asks for a picture; nothing else holds state that matters.

import { createAccuracyPanel } from "./accuracy.js";
import * as api from "./api.js";
import { boundsOfCubes } from "./camera.js";
import { group } from "./controls.js";
import { cloudsOf, createStore, modelOf, withAt } from "./document.js";
import { byId, el } from "./dom.js";
import { createFigures } from "./figures.js";
import { copy, createFiles } from "./files.js";
import { compactJson } from "./json_text.js";
import { createLayoutTable } from "./layout_table.js";
import { coarser, createChoice, createModels } from "./models.js";
import { cameraPanel, createPanels } from "./panels.js";
import { createRenderLoop } from "./picture.js";
import { clearMarks, focusProblem, markProblem, placeName } from "./problems.js";
import { atOrDefault } from "./schema.js";
import { createStage } from "./stage.js";
import { createTime } from "./time.js";
import { createTokenField } from "./token.js";
import { createWorkspace } from "./workspace.js";

const DRAFT = "awan.draft";

const store = createStore();
let measured = null; // { scene, bounds } of the last plan
let problem = null; // what is wrong with the document as it stands
let presetName = "";

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
  clearMarks();
  button.hidden = true;
  if (!problem) {
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
const layout = createLayoutTable(store, choice);
const figures = createFigures(store);
const time = createTime(store, { failed: fail, copy, note: say, show: () => loop.changed({ moving: true, playing: true }) });
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
const workspace = createWorkspace(store, choice, { bounds, letGo: () => loop.letGo(), chosen: refreshControls, failed: fail, note: say });
const files = createFiles(store, { name: () => presetName || "cloud", failed: fail, note: say });

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
const kQuick = { time_ms: 120 };
// Rungs that are quicker than what a short time would choose keep their look.
const isQuick = ({ rung: named, time_ms: ms }) => (named !== undefined && !/^(transport-|truth$)/.test(named)) || ms < kQuick.time_ms;

function quickened(scene) {
  if (time.playing) return time.playedScene(/^transport-/.test(rung) ? "transport-16" : null);
  if (atOrDefault(scene, "/look") !== "physical" || isQuick(scene.accuracy ?? {})) return scene; // a look has no error
  return { ...scene, accuracy: kQuick };
}
function textFor({ reduction, quick }) {
  if (reduction === 1 && !quick) return store.text;
  const scene = quick ? coarser(quickened(store.scene), reduction) : store.scene;
  const side = (member) => Math.max(1, Math.round(atOrDefault(scene, `/image/${member}`) / reduction));
  return compactJson(withAt(withAt(scene, "/image/width", side("width")), "/image/height", side("height")));
}

const MARKS = { "": "", coarse: "coarse, being refined", earlier: "of an earlier state" };

const loop = createRenderLoop({
  async render(how, signal) {
    const { reduction } = how;
    const width = atOrDefault(store.scene, "/image/width");
    const height = atOrDefault(store.scene, "/image/height");
    const transparent = atOrDefault(store.scene, "/image/background") === "transparent";
    const picture = await api.render(textFor(how), { signal });
    return { ...picture, width, height, reduction, transparent };
  },
  async shown({ blob, figures: said, width, height, reduction, transparent }, { whole }) {
    stage.shape(width, height, transparent);
    const count = said.particles === null ? "" : ` of ${said.particles} particles`;
    await stage.show(blob, `Cloud${count}, ${width} by ${height} pixels`);
    figures.picture(said, Math.round(width / reduction), Math.round(height / reduction));
    problem = null;
    showProblem();
    tokenField.done();
    rung = said.rung ?? "";
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
  accuracy.element.hidden = atOrDefault(store.scene, "/look") !== "physical"; // a look has no error
  layout.refresh();
  figures.refresh();
  workspace.refresh();
  files.refresh();
  refreshText();
  byId("undo").disabled = !store.canUndo;
  byId("redo").disabled = !store.canRedo;
}
store.subscribe(({ moving, preset, replaced, same = false }) => {
  planFlight?.abort();
  if (replaced) {
    time.forget();
    models.forget();
    choice.index = 0;
  }
  if (!same && !moving) follow(preset ?? "");
  refreshControls();
  if (problem) showProblem(); // rows may have been rebuilt
  loop.changed({ moving, playing: time.playing, same, another: replaced });
});

byId("undo").addEventListener("click", () => store.undo());
byId("redo").addEventListener("click", () => store.redo());

// --- presets, the address and the draft ---

const presetSelect = byId("preset");
// The address names the preset while the document is one; else the document is kept as a draft.
function follow(preset) {
  presetName = preset;
  presetSelect.value = preset;
  history.replaceState(null, "", preset ? `#${preset}` : location.pathname);
  try {
    if (preset) localStorage.removeItem(DRAFT);
    else localStorage.setItem(DRAFT, store.text);
  } catch {
    // No room or no permission: then there is no draft.
  }
}
async function choosePreset(name) {
  try {
    store.replaceText(await api.presetText(name), { preset: name });
  } catch (error) {
    fail(error);
    presetSelect.value = presetName;
  }
}
presetSelect.addEventListener("change", () => {
  if (presetSelect.value) choosePreset(presetSelect.value);
});
addEventListener("hashchange", () => {
  const name = decodeURIComponent(location.hash.slice(1));
  if (name && name !== presetName && name !== "groups") choosePreset(name);
});

let begun = false; // the presets are there, and a document
async function begin() {
  let draft = null;
  try {
    draft = localStorage.getItem(DRAFT);
  } catch {
    // As above.
  }
  try {
    const list = await api.presets();
    presetSelect.replaceChildren(el("option", { value: "" }, "Your own"),
      ...list.map(({ name, title }) => el("option", { value: name }, title)));
    const asked = decodeURIComponent(location.hash.slice(1));
    const known = list.some(({ name }) => name === asked);
    if (draft !== null && !known) {
      store.replaceText(draft);
      say("Your last document is open again.");
    } else {
      await choosePreset(known ? asked : list[0].name);
    }
    store.forgetHistory();
    refreshControls();
    begun = true;
  } catch (error) {
    fail(error);
  }
}
begin();
