// The groups of controls beside the picture: what can be set, and the useful part of its range.

import { cameraOf, isAutomatic, kSteepest, orbitOf, sizeOf } from "./camera.js";
import { checkbox, colour, group, numberField, seedField, select, slider } from "./controls.js";
import { at, cloudsOf, modelOf, withAt } from "./document.js";
import { el } from "./dom.js";
import { atOrDefault, fieldAt, standardAt } from "./schema.js";
import { detailPanel, groundPanel, hazePanel } from "./surroundings.js";
import { texturePanel } from "./textures.js";

const turn = (degrees) => ((degrees % 360) + 360) % 360;
const kFirstColor = [1, 1, 1];
const SIZES = ["640 × 360", "960 × 600", "1280 × 720", "1920 × 1080", "3840 × 2160", "1024 × 1024"];

export const shownIf = (shown, { element, refresh }) => ({
  element,
  refresh() {
    element.hidden = !shown();
    refresh();
  },
});

// A box that leaves a number to the service, and a slider for when it is not. box: the box's own pointer. first: what the
// number begins with then.
function automatic(store, { label, box, first, ...spec }) {
  const value = () => atOrDefault(store.scene, spec.pointer);
  return [
    checkbox({
      label: `Automatic ${label.toLowerCase()}`, pointer: box, get: () => value() === "auto",
      set: (on) => store.set(spec.pointer, on ? undefined : first),
    }),
    slider(store, { label, get: () => (value() === "auto" ? first : value()), ...spec }),
  ];
}

function sunPanel(store) {
  // A document may give the sun as a direction; the angles then are read from it, and replace it
  // when one of them is moved.
  const angles = () => {
    const direction = at(store.scene, "/sun/direction");
    if (!Array.isArray(direction)) return null;
    const [x, y, z] = direction;
    const degrees = 180 / Math.PI;
    return { elevation: Math.atan2(y, Math.hypot(x, z)) * degrees, azimuth: turn(Math.atan2(x, z) * degrees) };
  };
  const angle = (name) => ({
    get: () => angles()?.[name] ?? atOrDefault(store.scene, `/sun/${name}`),
    set: (value, options) => {
      const before = angles();
      if (!before) return store.set(`/sun/${name}`, value, options);
      store.update((scene) => {
        const { direction: _replaced, ...sun } = scene.sun;
        return { ...scene, sun: { ...sun, ...before, [name]: value } };
      }, { key: "/sun/direction", ...options });
    },
  });
  let kept = kFirstColor; // its colour before that was left to the elevation
  const fields = [
    slider(store, { label: "Elevation", pointer: "/sun/elevation", min: -10, step: 0.5, ...angle("elevation") }),
    slider(store, { label: "Azimuth", pointer: "/sun/azimuth", min: 0, max: 360, step: 1, ...angle("azimuth") }),
    slider(store, { label: "Intensity", pointer: "/sun/intensity", min: 0.5, max: 400, log: true }),
    checkbox({
      label: "Colour from its elevation", pointer: "/sun/automatic-color", get: () => atOrDefault(store.scene, "/sun/color") === "auto",
      set: (on) => {
        if (on) kept = at(store.scene, "/sun/color");
        store.set("/sun/color", on ? undefined : kept);
      },
    }),
    shownIf(() => atOrDefault(store.scene, "/sun/color") !== "auto", colour(store, { label: "Colour", pointer: "/sun/color" })),
  ];
  return { title: "Sun", pointer: "/sun", fields };
}

export function cameraPanel(store, bounds) {
  const orbit = () => orbitOf(store.scene, bounds());
  const write = (part, options) =>
    store.update((scene) => ({ ...scene, camera: cameraOf(scene, { ...orbitOf(scene, bounds()), ...part }) }),
      { key: "/camera", ...options });
  const part = (name) => ({ get: () => Number(name === "distance" ? orbit()[name].toPrecision(4) : orbit()[name].toFixed(1)), set: (value, options) => write({ [name]: value }, options) });
  const radius = () => sizeOf(bounds()).radius;
  const fields = [
    checkbox({
      label: "Automatic: the whole cloud", pointer: "/camera", get: () => isAutomatic(store.scene),
      set: (on) => (on ? store.set("/camera", undefined) : write({})),
    }),
    slider(store, {
      label: "Azimuth", pointer: "/camera/eye", field: null, min: 0, max: 360, step: 1, unit: "°",
      get: () => Math.round(turn(orbit().azimuth) * 10) / 10, set: (azimuth, options) => write({ azimuth }, options),
    }),
    slider(store, { label: "Elevation", pointer: "/camera/elevation", field: null, min: -kSteepest, max: kSteepest, step: 0.5, unit: "°", ...part("elevation") }),
    slider(store, { label: "Distance", pointer: "/camera/distance", field: null, min: 0.5, max: 20000, log: true, ...part("distance") }),
    slider(store, { label: "Field of view", pointer: "/camera/fov", min: 5, max: 120, step: 1, ...part("fov") }),
  ];
  const aim = el("button", {
    type: "button",
    onclick: () => {
      const { fov } = orbit();
      write({ target: sizeOf(bounds()).center, distance: radius() / Math.sin((fov * Math.PI) / 360) });
    },
  }, "Aim at the cloud");
  return {
    title: "Camera", pointer: "/camera", fields, tail: [aim],
    // For dragging and for keys on the picture.
    nudge({ azimuth = 0, elevation = 0, nearer = 1 }, options) {
      const now = orbit();
      write({
        azimuth: now.azimuth + azimuth,
        elevation: Math.max(-kSteepest, Math.min(kSteepest, now.elevation + elevation)),
        distance: now.distance * nearer,
      }, options);
    },
  };
}

function skyPanel(store) {
  let kept = {}; // what the sky was before it was put out
  const other = {}; // what each model was before the other was chosen
  // The word "physical" is short for an object.
  const sky = () => {
    const value = at(store.scene, "/sky");
    if (value === "physical") return { model: "physical" };
    return value !== null && typeof value === "object" ? value : {};
  };
  // Colours of a gradient make it one.
  const model = () => sky().model ?? ("zenith" in sky() || "horizon" in sky() ? "gradient" : fieldAt("/sky/model").standard);
  const own = (member) => ({
    get: () => sky()[member] ?? standardAt(store.scene, `/sky/${member}`),
    set: (value, options) => store.update((scene) => ({ ...scene, sky: { ...sky(), [member]: value } }),
      { key: `/sky/${member}`, ...options }),
  });
  const ofGradient = (control) => shownIf(() => model() !== "physical", control);
  const fields = [
    checkbox({
      label: "Sky light", pointer: "/sky", get: () => at(store.scene, "/sky") !== "none",
      set: (on) => {
        if (!on) kept = at(store.scene, "/sky");
        store.set("/sky", on ? kept : "none");
      },
    }),
    select(store, {
      label: "Model", pointer: () => "/sky/model",
      titles: { gradient: "gradient: two colours", physical: "physical: clear daylight" },
      get: model,
      set: (chosen) => {
        const { turbidity } = sky();
        other[model()] = sky();
        const { turbidity: _old, ...before } = other[chosen] ?? {};
        store.set("/sky", {
          ...before, ...(turbidity === undefined ? {} : { turbidity }), ...(chosen === fieldAt("/sky/model").standard ? {} : { model: chosen }),
        });
      },
    }),
    slider(store, { label: "Turbidity", pointer: "/sky/turbidity", step: 0.1, ...own("turbidity") }),
    ofGradient(colour(store, { label: "Zenith", pointer: "/sky/zenith" })),
    ofGradient(colour(store, { label: "Horizon", pointer: "/sky/horizon" })),
    slider(store, { label: "Intensity", pointer: "/sky/intensity", min: 0.02, max: 50, log: true, ...own("intensity") }),
  ];
  return { title: "Sky", pointer: "/sky", fields };
}

function matterPanel(store) {
  const isMie = () => atOrDefault(store.scene, "/medium/phase") === "mie";
  const fields = [
    ...automatic(store, { label: "Density", box: "/automatic-density", first: 1, pointer: "/density", min: 0.001, max: 100, log: true }),
    slider(store, { label: "Albedo", pointer: "/medium/albedo", min: 0.5, step: 0.001 }),
    shownIf(() => !isMie(), slider(store, { label: "Forward g", pointer: "/medium/g", min: -0.9, max: 0.98, step: 0.01 })),
    select(store, {
      label: "Phase function", pointer: () => "/medium/phase",
      titles: { "henyey-greenstein": "Henyey–Greenstein", "cornette-shanks": "Cornette–Shanks", mie: "Droplets of water" },
      // What belongs to the other functions alone is an error beside this one.
      set: (phase) => store.update((scene) => {
        const { g: _g, droplet: _droplet, ...both } = scene.medium ?? {};
        const { g, droplet } = scene.medium ?? {};
        const own = phase === "mie" ? { droplet } : { g };
        return { ...scene, medium: JSON.parse(JSON.stringify({ ...both, ...own, phase })) };
      }),
    }),
    shownIf(isMie, slider(store, { label: "Droplets, µm", pointer: "/medium/droplet", min: 2, max: 50, step: 1 })),
    shownIf(() => cloudsOf(store.scene).some(({ cloud }) => modelOf(cloud) === "cubes"), select(store, {
      label: "Filling", pointer: () => "/fill",
      titles: {
        uniform: "uniform", gardner: "gardner: with phase shift", printed: "printed: as in the source",
        cumulus: "cumulus: domes on a base", stratus: "stratus: a round layer",
      },
    })),
    seedField(store, { another: true }),
  ];
  return { title: "Matter", pointer: "/medium", fields };
}

function imagePanel(store) {
  const side = (label, member) => numberField(store, { label, pointer: () => `/image/${member}` });
  const sizeNow = () => `${atOrDefault(store.scene, "/image/width")} × ${atOrDefault(store.scene, "/image/height")}`;
  const fields = [
    select(store, {
      label: "Size", pointer: () => "/image", choices: [["", "other"], ...SIZES.map((size) => [size, size])],
      get: () => (SIZES.includes(sizeNow()) ? sizeNow() : ""),
      set: (size) => {
        const [width, height] = size.split(" × ").map(Number);
        if (height) store.update((scene) => withAt(withAt(scene, "/image/width", width), "/image/height", height));
      },
    }),
    side("Width", "width"), side("Height", "height"),
    select(store, { label: "Background", pointer: () => "/image/background" }),
    ...automatic(store, { label: "Exposure", box: "/image/automatic-exposure", first: -3, pointer: "/image/exposure", min: -8, max: 4, step: 0.1 }),
    select(store, {
      label: "Layers of an EXR", pointer: () => "/image/layers",
      choices: [["none", "none: its colours"], ["depth", "depth"], ["depth,transmittance", "depth, transmittance"], ["all", "all: light by its way, too"]],
      set: (layers) => store.set("/image/layers", layers === "none" ? undefined : layers),
    }),
  ];
  return { title: "Picture", pointer: "/image", fields };
}

// All groups: [{ element, refresh }].
export function createPanels(store, camera) {
  const open = window.matchMedia("(min-width: 60rem)").matches; // on a phone, a list of titles
  const build = ({ title, pointer, fields, tail = [] }, unfolded) => ({
    element: group(title, pointer, unfolded, ...fields.map((field) => field.element), ...tail),
    refresh() { fields.forEach((field) => field.refresh()); },
  });
  return [
    build(sunPanel(store), true), build(camera, open), build(skyPanel(store), open),
    build(matterPanel(store), open), build(groundPanel(store), false), build(hazePanel(store), false),
    build(detailPanel(store), false), build(texturePanel(store), false), build(imagePanel(store), false),
  ];
}
