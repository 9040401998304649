// The groups for what surrounds the clouds or is finer than they: ground, haze, detail. Each is "none" or an object.

import { checkbox, slider } from "./controls.js";
import { at, withAt } from "./document.js";
import { fieldAt, standardAt } from "./schema.js";
import { pictureButton } from "./textures.js";

// `fresh`: what it is when it is first switched on. Its fields write whole objects, so that what is required is there.
// What is there by itself ("auto") is switched off by the word "none".
// `within`: the scene with the object that this one is in, if it is in one. `inWords`: that it is off is said.
function optional(store, { title, pointer, label, fresh = {}, sliders, within = (scene) => scene, inWords = false }) {
  const now = () => {
    const value = at(store.scene, pointer);
    return value !== null && typeof value === "object" ? value : null;
  };
  const byItself = fieldAt(pointer).standard === "auto";
  let kept = byItself ? undefined : fresh; // what it was before it was switched off
  const isOn = () => now() !== null || (byItself && at(store.scene, pointer) !== "none");
  const fields = [
    checkbox({
      label, pointer, get: isOn,
      set: (on) => {
        if (!on) kept = now() ?? kept;
        if (on && within(store.scene) !== store.scene) store.update((scene) => withAt(within(scene), pointer, kept));
        else store.set(pointer, on ? kept : byItself || inWords ? "none" : undefined);
      },
    }),
    ...sliders.map(({ member, ...spec }) => slider(store, {
      ...spec, pointer: `${pointer}/${member}`,
      get: () => {
        const value = (now() ?? kept ?? {})[member] ?? standardAt(store.scene, `${pointer}/${member}`);
        // A colour is shown by its mean, and becomes grey when it is moved.
        return Array.isArray(value) ? Number(((value[0] + value[1] + value[2]) / 3).toFixed(4)) : value;
      },
      set: (value, options) => store.update(
        (scene) => withAt(within(scene), pointer, { ...(now() ?? kept ?? {}), [member]: value }),
        { key: `${pointer}/${member}`, ...options }),
    })),
  ];
  return { title, pointer, fields };
}

const albedo = { label: "Albedo", member: "albedo", step: 0.01 };

const FRESH_GROUND = { height: -6 };

// Hills are made by seed, or by a picture of the user's.
export function groundPanel(store) {
  const ground = optional(store, {
    title: "Ground", pointer: "/ground", label: "A level ground", fresh: FRESH_GROUND,
    sliders: [{ label: "Level", member: "height", min: -50, max: 10, step: 0.1 }, albedo],
  });
  const pointer = "/ground/terrain";
  const hills = optional(store, {
    title: "Hills", pointer, label: "Hills on it", fresh: { height: 5 }, inWords: true,
    within: (scene) => (typeof (at(scene, "/ground") ?? "none") !== "object" ? withAt(scene, "/ground", FRESH_GROUND) : scene),
    sliders: [
      { label: "Hills’ height", member: "height", min: 0.1, max: 100, log: true },
      { label: "Extent", member: "extent", min: 10, max: 1000, log: true },
      { label: "From hill to hill", member: "size", min: 1, max: 200, log: true },
      { label: "Roughness", member: "roughness", step: 0.01 },
      { label: "Below the plain", member: "level", step: 0.01 },
      { label: "Hills’ seed", member: "seed", min: 0, max: 99, step: 1 },
    ],
  });
  return { ...ground, fields: [...ground.fields, ...hills.fields], tail: [heightMap(store, `${pointer}/map`)] };
}

const heightMap = (store, pointer) => pictureButton({
  text: "A height map of your own…", label: "Height map to use", pointer,
  use: (name) => store.update((scene) => {
    const ground = at(scene, "/ground"), given = ground !== null && typeof ground === "object" ? ground : FRESH_GROUND;
    const hills = given.terrain !== null && typeof given.terrain === "object" ? given.terrain : { height: 5 };
    return withAt(scene, "/ground", { ...given, terrain: { ...hills, map: name } });
  }),
});

export const hazePanel = (store) => optional(store, {
  title: "Haze", pointer: "/haze", label: "Hazy air", fresh: { extinction: 0.01, height: -6, scale_height: 10 },
  sliders: [
    { label: "Extinction", member: "extinction", min: 0.0001, max: 1, log: true },
    { label: "Scale height", member: "scale_height", min: 0.1, max: 1000, log: true },
    { label: "Base", member: "height", min: -50, max: 10, step: 0.1 },
    albedo,
    { label: "Forward g", member: "g", min: -0.9, max: 0.98, step: 0.01 },
  ],
});

export const detailPanel = (store) => optional(store, {
  title: "Detail", pointer: "/detail", label: "Finer structure",
  sliders: [
    { label: "Amount", member: "amount", step: 0.01 },
    { label: "Bump size", member: "size", min: 0.05, max: 4, log: true },
  ],
});
