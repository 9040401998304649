// Gardner's textured sky plane and ellipsoids (core/scene/ellipsoids.h).

import { fieldAt } from "./schema.js";

const linked = fieldAt("/clouds/0/ellipsoids/formations/0/count").standard;
const triple = (over, member) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}`, step: 0.5 }));
const limits = [
  { member: "translucence_min", label: "Clear, least", hint: "Translucence is at least this", step: 0.01 },
  { member: "translucence_max", label: "… most", step: 0.01 },
];
const texture = [
  { kind: "select", member: "texture/form", label: "Sum of sines",
    titles: { clean: "clean: corrected", printed: "as printed" } },
  { member: "texture/terms", label: "Terms" },
  { member: "texture/frequency_x", label: "Frequency x", min: 0.05, max: 10, log: true },
  { member: "texture/frequency_z", label: "Frequency z", min: 0.05, max: 10, log: true },
  { member: "texture/offset", label: "Softness", min: 0, max: 3, step: 0.05 },
  { kind: "table", member: "texture/sines", title: "Sines by hand", bare: true, noun: "sine", one: "a sine",
    why: "Instead of terms by the rule.", fresh: { amplitude: 1, frequency_x: 1, frequency_z: 1 },
    columns: [{ title: "C", member: "amplitude", step: 0.1 }, { title: "x", over: "frequency", member: "frequency_x", step: 0.1 },
      { title: "z", over: "frequency", member: "frequency_z", step: 0.1 }, { title: "x, °", over: "phase", member: "phase_x", step: 5 },
      { title: "z, °", over: "phase", member: "phase_z", step: 5 }] },
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
        { member: "tilt", label: "Tilt", step: 1 },
      ] },
    { kind: "vector", member: "drift", label: "Texture drifts", step: 0.1 },
    { member: "join", label: "Join", hint: "How far ellipsoids that overlap are one; 0, as printed, leaves creases", step: 0.05 },
    { member: "resolution", label: "Resolution" },
    { kind: "section", title: "Single ellipsoids", fields: [
      { kind: "table", member: "ellipsoids", title: "Ellipsoids", bare: true, noun: "ellipsoid", one: "an ellipsoid",
        fresh: { center: [0, 0, 0], radii: [3, 2, 3] },
        columns: [...triple("centre", "center"), ...triple("radii", "radii"), { title: "y", over: "turn, °", member: "rotate_y", step: 5 },
          { title: "x", over: "turn, °", member: "rotate_x", step: 5 }, { title: "z", over: "turn, °", member: "rotate_z", step: 5 }] },
      { kind: "table", member: "quadrics", title: "Quadrics", bare: true, noun: "quadric", one: "a quadric",
        why: "q1 X² + q2 Y² + q3 Z² + q4 XY + q5 YZ + q6 XZ + q7 X + q8 Y + q9 Z + q0 = 0, where X, Y, Z are x, z, y.",
        fresh: { q1: 1, q2: 1, q3: 1, q0: -4 },
        columns: ["q1", "q2", "q3", "q4", "q5", "q6", "q7", "q8", "q9", "q0"].map((member) => ({ title: member, member, step: 0.1 })) },
    ] },
    { kind: "section", title: "Texture", fields: texture },
    { kind: "section", title: "Translucence", fields: [
      { member: "threshold", label: "In the middle", hint: "Threshold of the texture, T1", min: -0.5, max: 1,
        step: 0.01 },
      { member: "threshold_edge", label: "At the edge", hint: "Threshold of the texture on the silhouette, T2",
        min: -0.5, max: 1.5, step: 0.01 },
      ...limits,
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
        { kind: "number", member: "horizon", label: "Horizon", empty: "no end", step: 10 },
        ...limits,
        ...texture,
        { kind: "cards", member: "patterns", title: "Patterns", noun: "pattern", one: "a pattern",
          why: "Other textures over parts of the plane; later ones lie over earlier ones.", fresh: ["x", "z", "radius_x", "radius_z"],
          fields: [
            { kind: "number", member: "x", label: "Middle x", step: 5 },
            { kind: "number", member: "z", label: "Middle z", step: 5 },
            { member: "radius_x", label: "Reach x", min: 1, max: 1000, log: true },
            { member: "radius_z", label: "Reach z", min: 1, max: 1000, log: true },
            { member: "edge", label: "Soft edge", step: 0.05 },
            { member: "threshold", label: "Threshold", min: -0.5, max: 1, step: 0.01 },
            { member: "range", label: "Fade", min: 0.01, max: 1, step: 0.01 },
            ...texture,
          ] },
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
