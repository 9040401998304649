// A hierarchy of spheres (core/scene/spheres.h): one divided into five, each of these again.

export const spheres = {
  name: "spheres",
  title: "Hierarchy of spheres",
  moves: (_value, own) => own.morph !== null && typeof own.morph === "object",
  fields: [
    { kind: "select", member: "kind", label: "Kind" },
    { member: "levels", label: "Levels" },
    { kind: "vector", member: "size", label: "Size", step: 10 },
    { kind: "number", member: "visual_range", label: "Visual range",
      hint: "Meteorological optical range: how far one sees in the cloud", step: 5, empty: "from density" },
    { kind: "select", member: "growth", label: "Fifth sphere", titles: { up: "above: flat base", down: "below: as printed" } },
    { kind: "select", member: "scaling", label: "Sides count", titles: { first: "at the first step", every: "at every step" } },
    { kind: "section", title: "Randomness", fields: [
      { member: "ratio_min", label: "Ratio, least", hint: "Radius of a sphere over its parent’s", step: 0.01 },
      { member: "ratio_max", label: "… most", step: 0.01 },
      { member: "shift_min", label: "Shift, least", hint: "How far out in its parent a sphere stands", step: 0.01 },
      { member: "shift_max", label: "… most", step: 0.01 },
    ] },
    { kind: "switch", member: "morph", label: "Becomes another cloud", fresh: ["seed", "duration", "steps"], fields: [
      { kind: "number", member: "seed", label: "Its seed" },
      { member: "duration", label: "Takes", min: 0.5, max: 60, step: 0.5 },
      { kind: "number", member: "steps", label: "How often" },
    ] },
  ],
};
