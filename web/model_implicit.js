// Volumetric implicit functions (core/scene/implicit.h): primitives whose densities add up, and
// turbulence that moves and modulates them.

import { at, withAt } from "./document.js";
import { el } from "./dom.js";
import { fieldAt, presetAt } from "./schema.js";

const triple = (over, member, step = 1) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}`, step }));
const shapesOfItsOwn = (own) => Array.isArray(own.primitives) || (own.growth !== null && typeof own.growth === "object");

// Cylinders and segments need a line, and only they may have one; only ellipsoids have radii, and no core.
function reshaped({ points, radii, ...row }, shape) {
  if (shape === "ellipsoid") {
    const { core: _solid, ...soft } = row;
    return { ...soft, shape, ...(radii ? { radii } : {}) };
  }
  if (shape === "sphere") return { ...row, shape };
  const along = row.radius ?? fieldAt("/clouds/0/implicit/primitives/0/radius").standard;
  const two = points?.length >= 2 ? (shape === "cylinder" ? points.slice(0, 2) : points) : [[-along, 0, 0], [along, 0, 0]];
  return { ...row, shape, points: two };
}

// The primitives of a preset are not in the document until someone wants to change them.
function copyButton({ store, base }) {
  const button = el("button", {
    type: "button",
    onclick: () => store.update((scene) => {
      const { primitives, base: floor } = presetAt(scene, base());
      const before = at(scene, base()) ?? {};
      return withAt(scene, base(), { ...before, ...(floor === undefined ? {} : { base: floor }), ...before, primitives: structuredClone(primitives) });
    }),
  }, "Edit the preset’s shapes");
  return { element: el("div", { class: "table-tools" }, button), refresh() {} };
}

export const implicit = {
  name: "implicit",
  title: "Implicit functions",
  moves: (value, own) => value("swirl") !== 0 || shapesOfItsOwn(own) || value("warp_to") > value("warp_from"),
  fields: [
    { kind: "select", member: "preset", label: "Preset" },
    { member: "amount", label: "Amount p1", min: 0, max: 3, step: 0.01 },
    { member: "exponent", label: "Exponent p2", min: 0.1, max: 4, step: 0.05 },
    { member: "blend", label: "Blend p3", step: 0.01 },
    { member: "displacement", label: "Displace p4", min: 0, max: 2, step: 0.01 },
    { member: "swirl", label: "Swirl", hint: "Of the turbulence in time: frames a second, 30 is video", min: 0,
      max: 30, step: 0.5 },
    { member: "resolution", label: "Resolution" },
    { kind: "section", title: "Shapes", fields: [
      { make: copyButton, when: (own) => !shapesOfItsOwn(own) },
      { kind: "table", member: "primitives", title: "Primitives", noun: "primitive", one: "a primitive",
        why: "With none of its own the cloud has the preset’s. Points, rotation and keys: as JSON below.",
        fresh: { shape: "sphere", center: [0, 0, 0], radius: 30 },
        columns: [
          { title: "shape", member: "shape", change: reshaped },
          ...triple("centre", "center"), { title: "radius", member: "radius" },
          { title: "weight", member: "weight", step: 0.1 }, { title: "core", member: "core" },
          ...triple("× radius", "radii", 0.05),
        ] },
      { kind: "number", member: "base", label: "Flat base", empty: "the preset’s" },
    ] },
    { kind: "section", title: "Turbulence", fields: [
      { member: "noise_size", label: "Bump size", min: 0.05, max: 5, log: true },
      { member: "octaves", label: "Octaves" },
      { member: "gain", label: "Gain", step: 0.01 },
      { member: "stretch", label: "Stretch", min: 1, max: 30, log: true },
      { kind: "select", member: "displace", label: "Direction",
        titles: { every_way: "every way", diagonal: "diagonally: as printed" } },
      { kind: "vector", member: "jet", label: "Jet stream", unit: "", step: 0.1 },
      { member: "jet_turbulence", label: "… turbulence", min: 0, max: 5, step: 0.05 },
      { kind: "vector", member: "ripple", label: "Ripples", unit: "", step: 0.05 },
      { member: "ripple_depth", label: "… depth", step: 0.01 },
      { member: "ripple_turbulence", label: "… turbulence", min: 0, max: 20, step: 0.1 },
    ] },
    { kind: "section", title: "Growth", fields: [
      { kind: "switch", member: "growth", label: "Grows from seeds", fresh: ["seeds", "most"], fields: [
        { member: "seeds", label: "Seeds", min: 1, max: 100, step: 1 },
        { member: "most", label: "Most particles", min: 1, max: 300, step: 1 },
        { member: "radius", label: "Radius", min: 1, max: 300, log: true },
        { member: "shrink", label: "Child’s radius", step: 0.01 },
        { kind: "vector", member: "spread", label: "Spread", step: 0.1 },
        { kind: "vector", member: "force", label: "Force", unit: "", step: 0.001 },
        { member: "turbulence", label: "Turbulence", min: 0, max: 0.5, step: 0.005 },
        { member: "drag", label: "Drag", min: 0, max: 1, step: 0.01 },
        { member: "lifetime", label: "Lifetime", min: 1, max: 120, step: 1 },
        { member: "rate", label: "Children / s", min: 0, max: 3, step: 0.005 },
        { member: "duration", label: "Duration", min: 1, max: 300, step: 1 },
      ] },
    ] },
    { kind: "section", title: "Warps", fields: [
      { kind: "number", member: "warp_from", label: "From" },
      { kind: "number", member: "warp_to", label: "Full at" },
      { kind: "table", member: "attractors", title: "Attractors", noun: "attractor", one: "an attractor",
        fresh: { at: [0, 40, 0], strength: 1, reach: 60 },
        columns: [...triple("at", "at"), { title: "strength", member: "strength", step: 0.1 }, { title: "reach", member: "reach" }] },
      { kind: "table", member: "vortices", title: "Vortices", noun: "vortex", one: "a vortex",
        fresh: { at: [0, 0, 0], axis: [0, 1, 0], angle: 180, reach: 80 },
        columns: [...triple("at", "at"), { title: "angle, °", member: "angle", step: 10 }, { title: "reach", member: "reach" }, ...triple("axis", "axis", 0.1)] },
    ] },
  ],
};
