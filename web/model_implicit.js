// Volumetric implicit functions (core/scene/implicit.h): primitives whose densities add up, and
// turbulence that moves and modulates them.

import { at, withAt } from "./document.js";
import { el, freshId } from "./dom.js";
import { fieldAt, presetAt } from "./schema.js";

const triple = (over, member, step = 1) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}`, step }));
const MAKERS = ["growth", "bubbles", "billows", "cells"];
const has = (own, member) => own[member] !== null && typeof own[member] === "object";
const shapesOfItsOwn = (own) => Array.isArray(own.primitives) || own.particles?.length > 0 || MAKERS.some((member) => has(own, member));
const keyed = (rows) => Array.isArray(rows) && rows.some((row) => row?.keys?.length > 0);
const changes = (own) => shapesOfItsOwn(own) || own.keys?.length > 0 || own.squash?.keys?.length > 0
  || keyed(own.attractors) || keyed(own.vortices) || /\btime\b/.test(own.formula ?? "");

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

const ROW = ["time", "id", "x", "y", "z", "radius"];

// Rows of a table, one a particle and time, by the names in its first line; what is wrong with it is thrown.
export function particlesOf(text) {
  const [head, ...lines] = text.split(/\r?\n/).filter((line) => line.trim() !== "" && !line.startsWith("#"))
    .map((line) => line.trim().split(/\s*[,;\t]\s*|\s+/));
  const names = (head ?? []).map((name) => name.toLowerCase());
  const missing = ROW.filter((name) => !names.includes(name));
  if (missing.length) throw new Error(`The table needs a first line with ${ROW.join(", ")}; ${missing.join(", ")} is not there.`);
  return lines.map((cells, i) => {
    const number = (name) => {
      const value = Number(cells[names.indexOf(name)] ?? "");
      if (cells[names.indexOf(name)] === "" || !Number.isFinite(value)) throw new Error(`Row ${i + 1}: ${name} is no number.`);
      return value;
    };
    return {
      time: number("time"), id: number("id"), center: ["x", "y", "z"].map(number), radius: number("radius"),
      ...(names.includes("weight") ? { weight: number("weight") } : {}),
    };
  });
}

// Particles that were moved elsewhere come as a file.
function particleFile({ store, base }) {
  const place = () => `${base()}/particles`;
  const id = freshId("particles");
  const said = el("p", { class: "why", role: "status" });
  const input = el("input", {
    id, type: "file", accept: ".csv,.tsv,.txt,text/csv",
    onchange: async () => {
      const [file] = input.files;
      input.value = "";
      if (!file) return;
      try {
        store.set(place(), particlesOf(await file.text()));
      } catch (error) {
        said.textContent = error.message;
      }
    },
  });
  const drop = el("button", { type: "button", onclick: () => store.set(place(), undefined) }, "Without the particles");
  const element = el("div", { class: "table-tools" }, el("label", { for: id }, "Particles of a table "), input, drop, said);
  return {
    element,
    refresh() {
      element.dataset.pointer = place();
      const rows = at(store.scene, place());
      const some = Array.isArray(rows) && rows.length > 0;
      drop.hidden = !some;
      said.textContent = some ? `${rows.length} rows, ${new Set(rows.map((row) => row?.id)).size} particles`
        : `A row each time: ${ROW.join(", ")}, weight`;
    },
  };
}

const afterTheLast = (of) => (rows) => ({ ...(rows.length ? structuredClone(rows[rows.length - 1]) : of), ...(rows.length ? { time: rows[rows.length - 1].time + 1 } : {}) });

export const implicit = {
  name: "implicit",
  title: "Implicit functions",
  moves: (value, own) => value("swirl") !== 0 || changes(own) || value("warp_to") > value("warp_from"),
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
        why: "With none of its own the cloud has the preset’s. Points and keys: as JSON below.",
        fresh: { shape: "sphere", center: [0, 0, 0], radius: 30 },
        columns: [
          { title: "shape", member: "shape", change: reshaped },
          ...triple("centre", "center"), { title: "radius", member: "radius" },
          { title: "weight", member: "weight", step: 0.1 }, { title: "core", member: "core" },
          ...triple("× radius", "radii", 0.05), ...triple("turn, °", "rotate", 5),
        ] },
      { kind: "number", member: "base", label: "Flat base", empty: "the preset’s" },
    ] },
    { kind: "section", title: "Formula", fields: [{ kind: "formula", member: "formula", label: "Density" }] },
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
        { kind: "table", member: "keys", title: "Keys of the growth", noun: "growth key", one: "a key of the growth",
          why: "Centre, radius and weight are of the whole colony then; the others act on its particles. The force: as JSON below.",
          fresh: { time: 0 }, make: afterTheLast({ time: 0 }),
          columns: [
            { title: "time", member: "time" }, ...triple("centre", "center"), { title: "radius", member: "radius" },
            { title: "weight", member: "weight", step: 0.1 }, { title: "turbulence", member: "turbulence", step: 0.005 },
            { title: "drag", member: "drag", step: 0.01 }, { title: "children / s", member: "rate", step: 0.01 },
          ] },
      ] },
    ] },
    { kind: "section", title: "Processes", fields: [
      { kind: "switch", member: "bubbles", label: "Bubbles rise", fresh: ["most", "knobs"], fields: [
        { member: "most", label: "Bubbles", min: 1, max: 200, step: 1 },
        { member: "knobs", label: "Knobs on each", step: 1 },
        { member: "radius", label: "Radius", min: 1, max: 300, log: true },
        { kind: "vector", member: "spread", label: "Spread", step: 0.1 },
        { member: "rise", label: "Rise", min: 0, max: 2, step: 0.01 },
        { member: "ceiling", label: "Ceiling", min: 0.1, max: 20, step: 0.1 },
        { member: "entrainment", label: "Entrainment", step: 0.01 },
        { member: "rate", label: "Bubbles / s", min: 0.05, max: 20, log: true },
        { kind: "number", member: "began", label: "Began" },
      ] },
      { kind: "switch", member: "billows", label: "Billows roll up (Kelvin-Helmholtz)", fresh: ["waves"], fields: [
        { member: "waves", label: "Billows", step: 1 },
        { member: "wavelength", label: "Wavelength", min: 10, max: 1000, log: true },
        { member: "length", label: "Length of crests", min: 10, max: 2000, log: true },
        { member: "radius", label: "Thickness", min: 1, max: 100, log: true },
        { member: "shear", label: "Shear", min: 0, max: 50, step: 0.5 },
        { member: "amplitude", label: "First wave", step: 0.01 },
        { member: "smoothing", label: "Smoothing", step: 0.01 },
        { member: "variation", label: "Variation", step: 0.01 },
        { kind: "number", member: "began", label: "Began" },
      ] },
      { kind: "switch", member: "cells", label: "Bénard cells turn over", fresh: ["rings"], fields: [
        { kind: "select", member: "kind", label: "Kind" },
        { member: "rings", label: "Rings of cells", step: 1 },
        { member: "parcels", label: "Parcels in each", step: 1 },
        { member: "spacing", label: "Spacing", min: 5, max: 1000, log: true },
        { member: "depth", label: "Depth", min: 1, max: 300, log: true },
        { member: "radius", label: "Radius", min: 1, max: 300, log: true },
        { member: "irregular", label: "Irregular", step: 0.01 },
        { member: "turnover", label: "Turnover", min: 1, max: 600, log: true },
      ] },
      { make: particleFile },
    ] },
    { kind: "section", title: "Keys", fields: [
      { kind: "table", member: "keys", title: "Keys of the cloud", noun: "key", one: "a key of the cloud",
        why: "In rising order of time; what a key leaves out goes on by the others. Its other parameters: as JSON below.",
        fresh: { time: 0 }, make: afterTheLast({ time: 0 }),
        columns: [
          { title: "time", member: "time" }, { title: "p1", member: "amount", step: 0.1 }, { title: "p2", member: "exponent", step: 0.1 },
          { title: "p3", member: "blend", step: 0.1 }, { title: "p4", member: "displacement", step: 0.1 },
          { title: "warp", member: "warp", step: 0.1 }, { title: "base", member: "base" },
        ] },
      { kind: "switch", member: "squash", label: "Squash and stretch", fresh: ["amount"], fields: [
        { member: "amount", label: "Amount", log: true },
        { kind: "vector", member: "axis", label: "Axis", unit: "", step: 0.1 },
        { kind: "vector", member: "at", label: "About", step: 1 },
        { kind: "table", member: "keys", title: "Its keys", noun: "squash key", one: "a key of it",
          fresh: { time: 0, amount: 1 }, make: afterTheLast({ time: 0, amount: 1 }),
          columns: [{ title: "time", member: "time" }, { title: "amount", member: "amount", step: 0.1 }] },
      ] },
    ] },
    { kind: "section", title: "Warps", fields: [
      { kind: "number", member: "warp_from", label: "From" },
      { kind: "number", member: "warp_to", label: "Full at" },
      { kind: "table", member: "attractors", title: "Attractors", noun: "attractor", one: "an attractor",
        why: "Their keys: as JSON below.",
        fresh: { at: [0, 40, 0], strength: 1, reach: 60 },
        columns: [...triple("at", "at"), { title: "strength", member: "strength", step: 0.1 }, { title: "reach", member: "reach" }] },
      { kind: "table", member: "vortices", title: "Vortices", noun: "vortex", one: "a vortex",
        why: "Their keys: as JSON below.",
        fresh: { at: [0, 0, 0], axis: [0, 1, 0], angle: 180, reach: 80 },
        columns: [...triple("at", "at"), { title: "angle, °", member: "angle", step: 10 }, { title: "reach", member: "reach" }, ...triple("axis", "axis", 0.1)] },
    ] },
  ],
};
