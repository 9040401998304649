// The clouds of the document: which of them is being edited, of which model it is, where it stands and
// moves; and a group of controls for each model, of which the one that belongs is shown.

import { group, numberField, seedField, select } from "./controls.js";
import { at, cloudsOf, modelOf, withCloudList } from "./document.js";
import { el, freshId } from "./dom.js";
import { automaton } from "./model_automaton.js";
import { ellipsoids } from "./model_ellipsoids.js";
import { makeFields, vector } from "./model_fields.js";
import { implicit } from "./model_implicit.js";
import { spheres } from "./model_spheres.js";
import { shownIf } from "./panels.js";
import { atOrDefault, fieldAt } from "./schema.js";

const MODELS = [automaton, spheres, implicit, ellipsoids];
const TITLES = {
  cubes: "Cubes of particles",
  ...Object.fromEntries(MODELS.map(({ name, title }) => [name, title])),
  particles: "Ready-made particles",
};
// The look that each published system has of its own.
const LOOKS = { spheres: "ostroushko", ellipsoids: "gardner", automaton: "upchurch" };
const kAsItIs = "physical: light as it is";

const FRESH_CUBES = [{ particles: 200, size: [8, 2, 6], center: [0, 0, 0], radius: 1.5 }];
const ofModel = (name) => (name === "cubes" ? { cubes: FRESH_CUBES } : name === "particles" ? { positions: [[0, 0, 0]], radii: [1] } : { [name]: {} });

const PLACE = ["translate", "scale", "rotate_y", "velocity"];
// Models have sizes of their own, from 10 units to 500. What of a cloud goes with it to another model;
// and what of the scene does not, where it is the only cloud: it would drown or lose the other.
const KEPT = ["translate", "rotate_y", "velocity", "seed"];
const SURROUNDINGS = ["camera", "ground", "haze", "density"];

const split = (object, names) => {
  const [inside, outside] = [{}, {}];
  for (const [name, value] of Object.entries(object)) (names.includes(name) ? inside : outside)[name] = value;
  return [inside, outside];
};

// Whether another time shows another picture.
export function somethingMoves(scene) {
  return cloudsOf(scene).some(({ cloud, pointer }) => {
    const model = MODELS.find(({ name }) => name === modelOf(cloud));
    const own = model && cloud[model.name];
    return (Array.isArray(cloud.velocity) && cloud.velocity.some((v) => v !== 0)) ||
      (own !== null && typeof own === "object" && model.moves((member) => atOrDefault(scene, `${pointer}/${model.name}/${member}`), own));
  });
}

const LATTICES = ["implicit", "ellipsoids"]; // models that sample one, of `resolution` cells along its longest side
const kCoarsest = 32; // the shape is still the same

// For a picture of reduced size: its pixels are larger, so the cells may be.
export function coarser(scene, reduction) {
  if (!Array.isArray(scene.clouds)) return scene;
  const clouds = scene.clouds.map((cloud, k) => {
    const own = cloud?.[cloud.model];
    const cells = atOrDefault(scene, `/clouds/${k}/${cloud?.model}/resolution`);
    if (own === null || typeof own !== "object" || !LATTICES.includes(cloud.model) || !(cells > kCoarsest)) return cloud;
    return { ...cloud, [cloud.model]: { ...own, resolution: Math.max(kCoarsest, Math.round(cells / Math.sqrt(reduction))) } };
  });
  return { ...scene, clouds };
}

// Which cloud is being edited.
export function createChoice(store) {
  let index = 0;
  const entries = () => cloudsOf(store.scene);
  return {
    get index() { return (index = Math.max(0, Math.min(index, entries().length - 1))); },
    set index(k) { index = k; },
    get count() { return entries().length; },
    get cloud() { return entries()[this.index]?.cloud ?? {}; },
    // Of a document with `cubes` at its top, "".
    get pointer() { return entries()[this.index]?.pointer ?? "/clouds/0"; },
    get model() { return modelOf(this.cloud); },
  };
}

// changed(): another cloud is being edited. bounds() -> of all clouds, or null.
export function createModels(store, choice, { changed, bounds, note }) {
  let kept = []; // a cloud, by model: what it was when that model was left
  let said = null; // whether place and motion said something, when last looked at

  let keptAccuracy; // a look has none

  const withoutLook = ({ look: _look, ...scene }) =>
    (_look === undefined || keptAccuracy === undefined ? scene : { accuracy: keptAccuracy, ...scene });
  const changeClouds = (change) => store.update((scene) => {
    const listed = withCloudList(scene);
    return { ...listed, clouds: change(listed.clouds) };
  });
  // Fields of any cloud make a list of clouds of a document that has only cubes.
  const common = (member) => ({
    pointer: () => `/clouds/${choice.index}/${member}`,
    get: () => at(store.scene, `${choice.pointer}/${member}`),
    set: (value, options = {}) => {
      if (!Array.isArray(store.scene.clouds) && value === undefined) return;
      if (!Array.isArray(store.scene.clouds)) store.update(withCloudList, { key: `/clouds/0/${member}` });
      store.set(`/clouds/${choice.index}/${member}`, value, options);
    },
  });
  // At its top, a document with cubes has these for all of it.
  const own = (member) => {
    const field = common(member);
    return { ...field, get: () => (Array.isArray(store.scene.clouds) ? field.get() : undefined) };
  };

  function setModel(name) {
    const { index, model } = choice;
    let left = false;
    store.update((scene) => {
      const { clouds, ...rest } = withoutLook(withCloudList(scene));
      const alone = clouds.length === 1;
      const { model: _old, ...cloud } = clouds[index];
      const [shared, matter] = split(cloud, KEPT);
      const [around, elsewhere] = split(rest, alone ? SURROUNDINGS : []);
      kept[index] = { ...kept[index], [model]: { matter, around } };
      left = Object.keys(around).length > 0;
      const before = kept[index][name];
      const next = { model: name, ...(before?.matter ?? ofModel(name)), ...shared };
      return { clouds: clouds.map((one, k) => (k === index ? next : one)), ...elsewhere, ...before?.around };
    });
    if (left) note("Camera, ground, haze and density stay with the other model.");
  }
  function duplicate() {
    const { index } = choice;
    const { cloud, model } = choice;
    const box = bounds();
    const step = model === "cubes" || !box ? 6 * (cloud.scale ?? 1) : (box.max[0] - box.min[0]) / (choice.count > 1 ? 2 : 1);
    kept = [...kept.slice(0, index + 1), kept[index], ...kept.slice(index + 1)];
    changeClouds((clouds) => {
      const copy = structuredClone(clouds[index]);
      const [x = 0, y = 0, z = 0] = copy.translate ?? [];
      copy.translate = [Number((x + step).toPrecision(4)), y, z];
      return [...clouds.slice(0, index + 1), copy, ...clouds.slice(index + 1)];
    });
    choice.index = index + 1;
    changed();
  }
  function drop() {
    const { index } = choice;
    kept = kept.filter((_one, k) => k !== index);
    changeClouds((clouds) => clouds.filter((_cloud, k) => k !== index));
    choice.index = index - 1;
    changed();
    cloudSelect.focus();
  }

  // --- the group of every cloud ---

  const cloudSelect = el("select", {
    id: freshId("cloud"),
    onchange: () => {
      choice.index = Number(cloudSelect.value);
      changed();
    },
  });
  const cloudChoice = el("span", { class: "buttons" }, el("label", { for: cloudSelect.id }, "Cloud"), cloudSelect);
  const dropButton = el("button", { type: "button", onclick: drop }, "Delete cloud");
  const cloudLine = el("div", { class: "cloud-line" }, cloudChoice);
  const buttons = el("div", { class: "buttons cloud-buttons" },
    el("button", { type: "button", onclick: duplicate }, "Duplicate cloud"), dropButton);

  const model = select(store, {
    label: "Model", pointer: () => `${choice.pointer}/model`, field: fieldAt("/clouds/0/model"),
    titles: TITLES, get: () => choice.model, set: setModel,
  });
  const lookNow = () => atOrDefault(store.scene, "/look");
  const lookOfAll = () => {
    const names = new Set(cloudsOf(store.scene).map(({ cloud }) => LOOKS[modelOf(cloud)]));
    return names.size === 1 ? [...names][0] : undefined;
  };
  const look = select(store, {
    label: "Look", pointer: () => "/look", titles: { physical: kAsItIs }, get: lookNow,
    set: (name) => store.update((scene) => {
      if (name === "physical") return withoutLook(scene);
      const { accuracy, ...rest } = scene;
      if (accuracy !== undefined) keptAccuracy = accuracy;
      return { ...rest, look: name };
    }),
  });
  const looks = look.element.querySelector("select");
  const shownLook = shownIf(() => lookOfAll() !== undefined || lookNow() !== "physical", {
    element: look.element,
    refresh() {
      const names = ["physical", ...new Set([lookOfAll(), lookNow()])].filter((name, i) => name !== undefined && (i === 0 || name !== "physical"));
      if ([...looks.options].map((option) => option.value).join() !== names.join()) {
        looks.replaceChildren(...names.map((name) =>
          el("option", { value: name }, name === "physical" ? kAsItIs : `${name}: as published`)));
      }
      look.refresh();
    },
  });
  const readyMade = el("p", { class: "why" });

  const number = (label, member, placeholder) => numberField(store, { label, placeholder, optional: true, ...own(member) });
  const small = [
    number("Scale", "scale"), number("Turn, °", "rotate_y"), number("Own density", "density", "the scene’s"),
    seedField(store, { label: "Own seed", placeholder: "the scene’s", ...own("seed") }),
    shownIf(() => choice.model === "cubes", select(store, {
      label: "Own fill", none: "the scene’s",
      ...own("fill"), set: (fill) => own("fill").set(fill || undefined),
    })),
  ];
  const orDefault = (member) => {
    const field = own(member);
    return { ...field, get: () => field.get() ?? fieldAt(field.pointer()).standard };
  };
  const placement = [
    vector(store, { label: "Move", step: 0.5, ...orDefault("translate") }),
    vector(store, { label: "Velocity", step: 0.5, ...orDefault("velocity") }),
    ...small,
  ];
  const placementBox = el("details", { class: "section" }, el("summary", {}, el("h3", {}, "Place and motion")),
    placement[0].element, placement[1].element, el("div", { class: "placement" }, ...small.map((field) => field.element)));
  const cloudGroup = group("Cloud", "/clouds", true, cloudLine, model.element, shownLook.element, readyMade, placementBox, buttons);

  // --- a group for each model ---

  const panels = MODELS.map(({ name, title, fields }) => {
    const base = () => `/clouds/${choice.index}/${name}`;
    const of = () => {
      const value = choice.cloud[name];
      return value !== null && typeof value === "object" ? value : {};
    };
    const made = makeFields({ store, base, own: of }, fields);
    const element = group(title, base(), true, ...made.map((field) => field.element));
    return {
      element,
      refresh() {
        element.hidden = choice.model !== name;
        element.dataset.pointer = base();
        if (!element.hidden) made.forEach((field) => field.refresh());
      },
    };
  });

  function refresh() {
    const { count, index, cloud } = choice;
    if (cloudSelect.options.length !== count) {
      cloudSelect.replaceChildren(...Array.from({ length: count }, (_unused, k) => el("option", { value: k }, `${k + 1} of ${count}`)));
    }
    cloudSelect.value = String(index);
    cloudLine.hidden = dropButton.hidden = count < 2;
    model.refresh();
    shownLook.refresh();
    readyMade.hidden = choice.model !== "particles";
    readyMade.textContent = `${(cloud.positions?.length ?? 0).toLocaleString("en")} particles; edit them as JSON below.`;
    placement.forEach((field) => field.refresh());
    // Unfolded where it says something; then as the reader leaves it.
    const says = Array.isArray(store.scene.clouds) && (count > 1 || PLACE.some((member) => cloud[member] !== undefined));
    if (said !== says) placementBox.open = said = says;
    panels.forEach((panel) => panel.refresh());
  }

  return {
    elements: [cloudGroup, ...panels.map((panel) => panel.element)],
    refresh,
    forget() { // the document is another one
      kept = [];
      keptAccuracy = undefined;
    },
    // Shows the cloud that holds the place of a pointer.
    reveal(pointer) {
      const [, k] = /^\/clouds\/(\d+)/.exec(pointer) ?? [];
      if (k === undefined || Number(k) === choice.index) return;
      choice.index = Number(k);
      changed();
    },
  };
}
