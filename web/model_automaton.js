// Clouds grown by a cellular automaton (core/scene/automaton.h): a grid of cells, parcels of wet air in
// it, wind over it. Lengths are in cells.

import { fieldAt } from "./schema.js";

const parcels = fieldAt("/clouds/0/automaton/random/count").standard;
const share = { step: 0.01 };
const speed = [
  { title: "v0", over: "cells a step", member: "constant", step: 0.1 },
  { title: "· y", over: "cells a step", member: "linear", step: 0.01 },
  { title: "· y²", over: "cells a step", member: "quadratic", step: 0.001 },
];
const bearing = [
  { title: "towards, °", over: "direction", member: "direction", step: 5, empty: "wind’s" },
  { title: "turn", over: "direction", member: "turn", step: 1 },
];
const heights = [{ title: "from", over: "height", member: "from" }, { title: "to", over: "height", member: "to" }];
const shapes = { linear: "linear", quadratic: "quadratic", smooth: "smooth", table: "a table of my own" };
const triple = (over, member) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}` }));

export const automaton = {
  name: "automaton",
  title: "Cellular automaton",
  // Also without wind: at every step clouds are born and vanish.
  moves: (value) => value("steps_per_second") !== 0,
  fields: [
    { kind: "vector", member: "cells", label: "Grid", unit: "cells", step: 8 },
    { member: "cell", label: "Cell size", min: 0.1, max: 50, log: true },
    { member: "warm_up", label: "Warm-up", hint: "Steps made before second 0", min: 0, max: 200 },
    { member: "steps_per_second", label: "Steps / second", min: 0, max: 10, step: 0.1 },
    { kind: "section", title: "Wet air", fields: [
      { member: "humidity", label: "Vapour", hint: "Chance a step that the middle of a parcel becomes humid", ...share, max: 0.5 },
      { member: "activation", label: "Activation",
        hint: "Chance a step that humid air in the middle of a parcel begins to condense", min: 0.0001, max: 0.1, log: true },
      { member: "extinction", label: "Vanishing", hint: "Chance a step that cloud at the edge of a parcel vanishes",
        ...share, max: 0.5 },
      { member: "outside_extinction", label: "… outside", hint: "The same away from every parcel", ...share },
      { kind: "shape", member: "fall_off", label: "Fall-off", titles: shapes, fresh: [1, 0.9, 0.5, 0],
        hint: "How vapour and activation fall off from a parcel’s middle to its edge; vanishing is what is left" },
      { member: "base", label: "Flat base", hint: "No vapour below this height, in cells", min: 0, max: 32, step: 0.5 },
    ] },
    { kind: "section", title: "Parcels", fields: [
      { kind: "switch", member: "random", label: "Random parcels of my own", fresh: ["count"], fields: [
        { member: "count", label: "How many", min: 0, max: 200 },
        { kind: "vector", member: "smallest", label: "Smallest radii" },
        { kind: "vector", member: "largest", label: "Largest radii" },
      ] },
      { kind: "select", member: "overlap", label: "Overlap", titles: { deepest: "the deepest counts", first: "the first counts" } },
      { kind: "table", member: "ellipsoids", title: "Placed parcels", noun: "parcel", one: "a parcel",
        why: `With none of its own the model takes ${parcels} random ones.`, fresh: { center: [48, 6, 48], radii: [14, 10, 14] },
        columns: [...triple("centre", "center"), ...triple("radii", "radii")] },
    ] },
    { kind: "section", title: "Wind", fields: [
      { member: "wind/direction", label: "Towards", hint: "0 blows along z, 90 along x, as the sun’s azimuth", min: 0, max: 360, step: 5 },
      { member: "wind/layers/constant", label: "Cells a step",
        hint: "All cells shift so far a step, whatever their height", min: -3, max: 3, step: 0.05 },
      { member: "wind/layers/linear", label: "+ per height", min: -0.2, max: 0.2, step: 0.005 },
      { member: "wind/layers/quadratic", label: "+ per height²", min: -0.01, max: 0.01, step: 0.0005 },
      { member: "wind/layers/turn", label: "Turn per height", hint: "How far the wind turns with each cell of height", min: -20, max: 20, step: 0.5 },
      { kind: "number", member: "wind/layers/direction", label: "Layers towards", empty: "the wind’s", step: 5 },
      { kind: "table", member: "wind/layer_bands", title: "Wind on layers of cells", noun: "layer band", one: "a band",
        fresh: { from: 0, to: 8, constant: 0.5 }, columns: [...heights, ...speed, ...bearing] },
      { member: "wind/mutation", label: "Mutation",
        hint: "How much a parcel that comes in again differs from what it was", ...share },
      { kind: "table", member: "wind/ellipsoids", title: "Wind on parcels", noun: "band", one: "a band",
        fresh: { from: 0, to: 32, constant: 0.5 },
        columns: [...heights, ...speed, ...bearing] },
    ] },
    { kind: "section", title: "From cells to matter", fields: [
      { kind: "vector", member: "smooth", label: "Smoothing" },
      { kind: "shape", member: "smooth_weight", label: "Weights", titles: { even: "even", ...shapes }, fresh: [1, 0.5, 0],
        hint: "How much cells count towards their neighbours’ density, by their distance" },
      { member: "smooth_steps", label: "… over steps", min: 1, max: 8 },
      { member: "metaball_radius", label: "Metaballs", min: 1.5, max: 8, step: 0.1, hint: "Radius of each cell’s, in cells" },
      { member: "threshold", label: "Threshold", ...share },
    ] },
    { kind: "section", title: "Drawing of the upchurch look", fields: [
      { kind: "select", member: "drawing/mode", label: "Cells are",
        titles: { textures: "billboards of textures", generated: "billboards made by rule", density: "points by density", presence: "points by presence" } },
      { kind: "text", member: "drawing/textures", label: "Textures" },
      { member: "drawing/billboard_scale", label: "Billboards", min: 1, max: 40, step: 0.5 },
      { member: "drawing/point_size", label: "Points", min: 0.1, max: 4, step: 0.1 },
      { member: "drawing/color_multiplier", label: "Whiteness", min: 0, max: 5, step: 0.1 },
      { member: "drawing/opacity", label: "Opacity", min: 0, max: 2, step: 0.05 },
      { kind: "select", member: "drawing/between_steps", label: "Between steps", titles: { blend: "densities blend", hold: "the step before stays" } },
      { kind: "number", member: "chosen", label: "Red parcel, displayed", empty: "none" },
    ] },
  ],
};
