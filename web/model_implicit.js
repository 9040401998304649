// Volumetric implicit functions (core/scene/implicit.h): primitives whose densities add up, and
// turbulence that moves and modulates them.

import { at, withAt } from "./document.js";
import { el } from "./dom.js";
import { IMPLICIT_PRESETS } from "./implicit_presets.js";

const presetOf = (own) => IMPLICIT_PRESETS[own.preset ?? "cumulus"] ?? IMPLICIT_PRESETS.cumulus;
const ofPreset = (member) => (own) => presetOf(own)[member];
const triple = (over, member, standard, step = 1) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}`, standard, step }));
const shapesOfItsOwn = (own) => Array.isArray(own.primitives) || (own.growth !== null && typeof own.growth === "object");

// Cylinders and segments need a line, and only they may have one; only ellipsoids have radii, and no core.
function reshaped({ points, radii, ...row }, shape) {
  if (shape === "ellipsoid") {
    const { core: _solid, ...soft } = row;
    return { ...soft, shape, ...(radii ? { radii } : {}) };
  }
  if (shape === "sphere") return { ...row, shape };
  const along = row.radius ?? 1;
  const two = points?.length >= 2 ? (shape === "cylinder" ? points.slice(0, 2) : points) : [[-along, 0, 0], [along, 0, 0]];
  return { ...row, shape, points: two };
}

// The primitives of a preset are not in the document until someone wants to change them.
function copyButton({ store, base, own }) {
  const button = el("button", {
    type: "button",
    onclick: () => store.update((scene) => {
      const { primitives, base: floor } = presetOf(own());
      const before = at(scene, base()) ?? {};
      return withAt(scene, base(), { ...before, ...(floor === undefined ? {} : { base: floor }), ...before, primitives: structuredClone(primitives) });
    }),
  }, "Edit the preset’s shapes");
  return { element: el("div", { class: "table-tools" }, button), refresh() {} };
}

export const implicit = {
  name: "implicit",
  title: "Implicit functions",
  moves: (own) => (own.swirl ?? 3) !== 0 || shapesOfItsOwn(own) || (own.warp_to ?? 0) > (own.warp_from ?? 0),
  fields: [
    { kind: "select", member: "preset", label: "Preset",
      choices: Object.keys(IMPLICIT_PRESETS).map((name) => [name, name]), standard: "cumulus" },
    { member: "amount", label: "Amount p1", min: 0, max: 3, step: 0.01, standard: ofPreset("amount") },
    { member: "exponent", label: "Exponent p2", min: 0.1, max: 4, step: 0.05, standard: ofPreset("exponent") },
    { member: "blend", label: "Blend p3", min: 0, max: 1, step: 0.01, standard: ofPreset("blend") },
    { member: "displacement", label: "Displace p4", min: 0, max: 2, step: 0.01, standard: ofPreset("displacement") },
    { member: "swirl", label: "Swirl", hint: "Of the turbulence in time: frames a second, 30 is video", min: 0,
      max: 30, step: 0.5, standard: 3 },
    { member: "resolution", label: "Resolution", min: 16, max: 160, step: 1, standard: 72 },
    { kind: "section", title: "Shapes", fields: [
      { make: copyButton, when: (own) => !shapesOfItsOwn(own) },
      { kind: "table", member: "primitives", title: "Primitives", noun: "primitive", one: "a primitive",
        why: "With none of its own the cloud has the preset’s. Points, rotation and keys: as JSON below.",
        fresh: { shape: "sphere", center: [0, 0, 0], radius: 30 },
        columns: [
          { title: "shape", member: "shape", standard: "sphere", change: reshaped,
            choices: ["sphere", "ellipsoid", "cylinder", "segment"].map((name) => [name, name]) },
          ...triple("centre", "center", 0), { title: "radius", member: "radius", standard: 1 },
          { title: "weight", member: "weight", standard: 1, step: 0.1 }, { title: "core", member: "core", standard: 0 },
          ...triple("× radius", "radii", 1, 0.05),
        ] },
      { kind: "number", member: "base", label: "Flat base", unit: "units", empty: "the preset’s" },
    ] },
    { kind: "section", title: "Turbulence", fields: [
      { member: "noise_size", label: "Bump size", min: 0.05, max: 5, log: true, standard: ofPreset("noise_size") },
      { member: "octaves", label: "Octaves", min: 1, max: 10, step: 1, standard: ofPreset("octaves") },
      { member: "gain", label: "Gain", min: 0, max: 1, step: 0.01, standard: ofPreset("gain") },
      { member: "stretch", label: "Stretch", min: 1, max: 30, log: true, standard: ofPreset("stretch") },
      { kind: "select", member: "displace", label: "Direction",
        choices: [["every_way", "every way"], ["diagonal", "diagonally: as printed"]], standard: "every_way" },
      { kind: "vector", member: "jet", label: "Jet stream", step: 0.1, standard: ofPreset("jet") },
      { member: "jet_turbulence", label: "… turbulence", min: 0, max: 5, step: 0.05, standard: ofPreset("jet_turbulence") },
      { kind: "vector", member: "ripple", label: "Ripples", step: 0.05, standard: ofPreset("ripple") },
      { member: "ripple_depth", label: "… depth", min: 0, max: 1, step: 0.01, standard: ofPreset("ripple_depth") },
      { member: "ripple_turbulence", label: "… turbulence", min: 0, max: 20, step: 0.1,
        standard: ofPreset("ripple_turbulence") },
    ] },
    { kind: "section", title: "Growth", fields: [
      { kind: "switch", member: "growth", label: "Grows from seeds", fresh: { seeds: 12, most: 50 }, fields: [
        { member: "seeds", label: "Seeds", min: 1, max: 100, step: 1, standard: 12 },
        { member: "most", label: "Most particles", min: 1, max: 300, step: 1, standard: 50 },
        { member: "radius", label: "Radius", min: 1, max: 300, log: true, standard: 54 },
        { member: "shrink", label: "Child’s radius", min: 0.1, max: 1, step: 0.01, standard: 0.85 },
        { kind: "vector", member: "spread", label: "Spread", step: 0.1, unit: "radii", standard: [2.2, 0.15, 1.6] },
        { kind: "vector", member: "force", label: "Force", step: 0.001, standard: [0, 0.006, 0] },
        { member: "turbulence", label: "Turbulence", min: 0, max: 0.5, step: 0.005, standard: 0.05 },
        { member: "drag", label: "Drag", min: 0, max: 1, step: 0.01, standard: 0.12 },
        { member: "lifetime", label: "Lifetime", min: 1, max: 120, step: 1, unit: "s", standard: 25 },
        { member: "rate", label: "Children / s", min: 0, max: 3, step: 0.005, standard: 0.175 },
        { member: "duration", label: "Duration", min: 1, max: 300, step: 1, unit: "s", standard: 60 },
      ] },
    ] },
    { kind: "section", title: "Warps", fields: [
      { kind: "number", member: "warp_from", label: "From", unit: "s", standard: 0 },
      { kind: "number", member: "warp_to", label: "Full at", unit: "s", standard: 0 },
      { kind: "table", member: "attractors", title: "Attractors", noun: "attractor", one: "an attractor",
        fresh: { at: [0, 40, 0], strength: 1, reach: 60 },
        columns: [...triple("at", "at", 0), { title: "strength", member: "strength", step: 0.1 }, { title: "reach", member: "reach" }] },
      { kind: "table", member: "vortices", title: "Vortices", noun: "vortex", one: "a vortex",
        fresh: { at: [0, 0, 0], axis: [0, 1, 0], angle: 180, reach: 80 },
        columns: [...triple("at", "at", 0), { title: "angle, °", member: "angle", step: 10 }, { title: "reach", member: "reach" }, ...triple("axis", "axis", 0, 0.1)] },
    ] },
  ],
};
