// A hierarchy of spheres (core/scene/spheres.h): one divided into five, each of these again.

const cumulus = (yes, no) => (own) => ((own.kind ?? "cumulus") === "cumulus" ? yes : no);
const ratio = { min: 0.05, max: 0.9, step: 0.01 };

export const spheres = {
  name: "spheres",
  title: "Hierarchy of spheres",
  moves: (own) => own.morph !== null && typeof own.morph === "object",
  fields: [
    { kind: "select", member: "kind", label: "Kind", choices: [["cumulus", "cumulus"], ["cirrus", "cirrus"]],
      standard: "cumulus" },
    { member: "levels", label: "Levels", min: 0, max: 10, step: 1, standard: 6 },
    { kind: "vector", member: "size", label: "Size", unit: "units", step: 10, standard: [500, 300, 400] },
    { kind: "number", member: "visual_range", label: "Visual range",
      hint: "Meteorological optical range: how far one sees in the cloud", unit: "units", step: 5, empty: "from density" },
    { kind: "select", member: "growth", label: "Fifth sphere",
      choices: [["up", "above: flat base"], ["down", "below: as printed"]], standard: "up" },
    { kind: "select", member: "scaling", label: "Sides count",
      choices: [["first", "at the first step"], ["every", "at every step"]], standard: "first" },
    { kind: "section", title: "Randomness", fields: [
      { member: "ratio_min", label: "Ratio, least", hint: "Radius of a sphere over its parent’s", ...ratio,
        standard: cumulus(0.26, 0.2) },
      { member: "ratio_max", label: "… most", ...ratio, standard: cumulus(0.76, 0.7) },
      { member: "shift_min", label: "Shift, least", hint: "How far out in its parent a sphere stands", min: 0, max: 1,
        step: 0.01, standard: cumulus(0.9, 0.5) },
      { member: "shift_max", label: "… most", min: 0, max: 1, step: 0.01, standard: 1 },
    ] },
    { kind: "switch", member: "morph", label: "Becomes another cloud", fresh: { seed: 2, duration: 10, steps: 1 }, fields: [
      { kind: "number", member: "seed", label: "Its seed", standard: 2 },
      { member: "duration", label: "Takes", min: 0.5, max: 60, step: 0.5, unit: "s", standard: 10 },
      { kind: "number", member: "steps", label: "How often", standard: 1 },
    ] },
  ],
};
