// Gardner's textured sky plane and ellipsoids (core/scene/ellipsoids.h).

import { fieldAt } from "./schema.js";

const linked = fieldAt("/clouds/0/ellipsoids/formations/0/count").standard;
const triple = (over, member) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}`, step: 0.5 }));
const texture = [
  { kind: "select", member: "texture/form", label: "Sum of sines",
    titles: { clean: "clean: corrected", printed: "as printed" } },
  { member: "texture/terms", label: "Terms" },
  { member: "texture/frequency_x", label: "Frequency x", min: 0.05, max: 10, log: true },
  { member: "texture/frequency_z", label: "Frequency z", min: 0.05, max: 10, log: true },
  { member: "texture/offset", label: "Softness", min: 0, max: 3, step: 0.05 },
];
const share = { step: 0.01 };

export const ellipsoids = {
  name: "ellipsoids",
  title: "Textured ellipsoids",
  moves: (value) => Array.isArray(value("drift")) && value("drift").some((v) => v !== 0),
  fields: [
    { kind: "cards", member: "formations", title: "Formations", noun: "formation", one: "a formation",
      why: `Where there is nothing at all, the model takes one of ${linked} ellipsoids.`, fresh: ["kind", "count"],
      fields: [
        { kind: "select", member: "kind", label: "Kind",
          titles: { horizontal: "horizontal: rows and patches", vertical: "vertical: towers", combined: "combined: towers on a patch" } },
        { member: "count", label: "Ellipsoids", min: 1, max: 200 },
        { kind: "vector", member: "center", label: "First at", unit: "", step: 0.5 },
        { kind: "vector", member: "radii", label: "Radii", unit: "", step: 0.1 },
        { member: "variation", label: "Variation", step: 0.01 },
        { member: "link", label: "Overlap", step: 0.01 },
        { member: "heading", label: "Heading", min: 0, max: 360, step: 1 },
        { member: "spread", label: "Spread", step: 1 },
      ] },
    { kind: "vector", member: "drift", label: "Texture drifts", step: 0.1 },
    { member: "resolution", label: "Resolution" },
    { kind: "section", title: "Single ellipsoids", fields: [
      { kind: "table", member: "ellipsoids", title: "Ellipsoids", bare: true, noun: "ellipsoid", one: "an ellipsoid",
        fresh: { center: [0, 0, 0], radii: [3, 2, 3] },
        columns: [...triple("centre", "center"), ...triple("radii", "radii"), { title: "turn, °", member: "rotate_y", step: 5 }] },
    ] },
    { kind: "section", title: "Texture", fields: texture },
    { kind: "section", title: "Translucence", fields: [
      { member: "threshold", label: "In the middle", hint: "Threshold of the texture, T1", min: -0.5, max: 1,
        step: 0.01 },
      { member: "threshold_edge", label: "At the edge", hint: "Threshold of the texture on the silhouette, T2",
        min: -0.5, max: 1.5, step: 0.01 },
      { member: "range", label: "Fade", hint: "Range of the texture, D", min: 0.01, max: 1, step: 0.01 },
      { member: "density", label: "Density factor", min: 0.1, max: 100, log: true },
    ] },
    { kind: "section", title: "Sky plane", fields: [
      { kind: "switch", member: "plane", label: "A textured plane", fresh: ["altitude"], fields: [
        { member: "altitude", label: "Altitude", min: -10, max: 60, step: 0.5 },
        { member: "extent", label: "Extent", min: 10, max: 1000, log: true },
        { member: "thickness", label: "Thickness", min: 0, max: 10, step: 0.1 },
        { member: "threshold", label: "Threshold", min: -0.5, max: 1, step: 0.01 },
        { member: "range", label: "Fade", hint: "Range of the texture, D", min: 0.01, max: 1, step: 0.01 },
        { member: "density", label: "Density factor", min: 0.1, max: 100, log: true },
        ...texture,
      ] },
    ] },
    { kind: "section", title: "Shading of the gardner look", fields: [
      { member: "shading/specular", label: "Specular", ...share },
      { member: "shading/texture", label: "Texture", ...share },
      { member: "shading/ambient", label: "Ambient", ...share },
      { member: "shading/shininess", label: "Shininess", min: 1, max: 50, log: true },
    ] },
  ],
};
