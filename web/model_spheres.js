// A hierarchy of spheres (core/scene/spheres.h): one divided into some, each of these again.

import { textureChoice } from "./textures.js";

const laws = { uniform: "evenly", falling: "mostly small", rising: "mostly large", middle: "mostly middling", ends: "mostly at the ends" };

export const spheres = {
  name: "spheres",
  title: "Hierarchy of spheres",
  moves: (value, own) => (own.morph !== null && typeof own.morph === "object") || value("turning") > 0 || own.poses?.length > 1,
  fields: [
    { kind: "select", member: "kind", label: "Kind" },
    { member: "levels", label: "Levels" },
    { member: "parts", label: "Parts", hint: "How many a sphere is divided into; more leave fewer levels" },
    { kind: "select", member: "places", label: "Places",
      titles: { cross: "a cross: as printed", turned: "crosses, turned by chance", dome: "a dome", ball: "all round", row: "a row" } },
    { kind: "vector", member: "size", label: "Size", step: 10 },
    { kind: "number", member: "visual_range", label: "Visual range",
      hint: "Meteorological optical range: how far one sees in the cloud", step: 5, empty: "from density" },
    { kind: "select", member: "growth", label: "Fifth sphere", titles: { up: "above: flat base", down: "below: as printed" } },
    { kind: "select", member: "scaling", label: "Sides count", titles: { first: "at the first step", every: "at every step" } },
    { kind: "section", title: "Randomness", fields: [
      { member: "ratio_min", label: "Ratio, least", hint: "Radius of a sphere over its parent’s", step: 0.01 },
      { member: "ratio_max", label: "… most", step: 0.01 },
      { kind: "select", member: "ratio_law", label: "Ratios are", titles: laws },
      { member: "shift_min", label: "Shift, least", hint: "How far out in its parent a sphere stands", step: 0.01 },
      { member: "shift_max", label: "… most", step: 0.01 },
      { kind: "select", member: "shift_law", label: "Shifts are", titles: laws },
    ] },
    { kind: "switch", member: "morph", label: "Becomes another cloud", fresh: ["seed", "duration", "steps"], fields: [
      { kind: "number", member: "seed", label: "Its seed" },
      { member: "duration", label: "Takes", min: 0.5, max: 60, step: 0.5 },
      { kind: "number", member: "steps", label: "How often" },
    ] },
    { kind: "section", title: "Motion", fields: [
      { member: "turning", label: "Parts turn", hint: "About each sphere’s upright axis, at speeds up to this", min: 0, max: 90, step: 1 },
      { kind: "cards", member: "poses", title: "Poses", noun: "pose", one: "a pose",
        why: "Rotation, shift and scaling of the whole cloud, linear from one pose to the next.", fresh: { time: 0 },
        fields: [
          { kind: "number", member: "time", label: "At" },
          { kind: "vector", member: "shift", label: "Shift", step: 10 },
          { kind: "vector", member: "turn", label: "Turn", step: 5 },
          { kind: "vector", member: "scale", label: "Scale", unit: "", step: 0.1 },
        ] },
    ] },
    { kind: "section", title: "Relief of the ostroushko look", fields: [
      { kind: "switch", member: "bump", label: "A relief of its own", fresh: ["height"], fields: [
        { member: "height", label: "Height", min: 0, max: 0.5, step: 0.01 },
        { make: ({ store, base }) => textureChoice(store, { label: "Texture", pointer: () => `${base()}/texture`, none: "none" }) },
        { member: "repeat", label: "… lies round", min: 1, max: 16, step: 1 },
        { kind: "cards", member: "waves", title: "Waves", noun: "wave", one: "a wave",
          why: "Without waves and texture, the relief is waves by chance.", fresh: ["amplitude", "around"],
          fields: [
            { member: "amplitude", label: "Amplitude", step: 0.05 },
            { member: "around", label: "Around", min: 0, max: 16, step: 1 },
            { kind: "number", member: "down", label: "Down", step: 0.5 },
            { member: "phase", label: "Phase", step: 0.01 },
          ] },
      ] },
    ] },
  ],
};
