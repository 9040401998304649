// Gardner's textured sky plane and ellipsoids (core/scene/ellipsoids.h).

const triple = (over, member, standard) => ["x", "y", "z"].map((title, axis) => ({ title, over, member: `${member}/${axis}`, standard, step: 0.5 }));
const texture = (frequency) => [
  { kind: "select", member: "texture/form", label: "Sum of sines",
    choices: [["clean", "clean: corrected"], ["printed", "as printed"]], standard: "clean" },
  { member: "texture/terms", label: "Terms", min: 1, max: 8, step: 1, standard: 6 },
  { member: "texture/frequency_x", label: "Frequency x", min: 0.05, max: 10, log: true, standard: frequency },
  { member: "texture/frequency_z", label: "Frequency z", min: 0.05, max: 10, log: true, standard: frequency },
  { member: "texture/offset", label: "Softness", min: 0, max: 3, step: 0.05, standard: 1 },
];
const share = { min: 0, max: 1, step: 0.01 };

export const ellipsoids = {
  name: "ellipsoids",
  title: "Textured ellipsoids",
  moves: (own) => Array.isArray(own.drift) && own.drift.some((v) => v !== 0),
  fields: [
    { kind: "cards", member: "formations", title: "Formations", noun: "formation", one: "a formation",
      why: "Where there is nothing at all, the model takes one of 40 ellipsoids.", fresh: { kind: "combined", count: 40 },
      fields: [
        { kind: "select", member: "kind", label: "Kind",
          choices: [["horizontal", "horizontal: rows and patches"], ["vertical", "vertical: towers"], ["combined", "combined: towers on a patch"]], standard: "combined" },
        { member: "count", label: "Ellipsoids", min: 1, max: 200, step: 1, standard: 40 },
        { kind: "vector", member: "center", label: "First at", step: 0.5, standard: [0, 0, 0] },
        { kind: "vector", member: "radii", label: "Radii", step: 0.1, standard: [2.4, 1.6, 2.4] },
        { member: "variation", label: "Variation", min: 0, max: 0.9, step: 0.01, standard: 0.3 },
        { member: "link", label: "Overlap", min: 0.05, max: 0.95, step: 0.01, standard: 0.5 },
        { member: "heading", label: "Heading", min: 0, max: 360, step: 1, unit: "°", standard: 90 },
        { member: "spread", label: "Spread", min: 0, max: 180, step: 1, unit: "°", standard: 50 },
      ] },
    { kind: "vector", member: "drift", label: "Texture drifts", unit: "units/s", step: 0.1, standard: [0, 0, 0] },
    { member: "resolution", label: "Resolution", min: 8, max: 160, step: 1, standard: 64 },
    { kind: "section", title: "Single ellipsoids", fields: [
      { kind: "table", member: "ellipsoids", title: "Ellipsoids", bare: true, noun: "ellipsoid", one: "an ellipsoid",
        fresh: { center: [0, 0, 0], radii: [3, 2, 3] },
        columns: [...triple("centre", "center", 0), ...triple("radii", "radii", 1), { title: "turn, °", member: "rotate_y", standard: 0, step: 5 }] },
    ] },
    { kind: "section", title: "Texture", fields: texture(0.9) },
    { kind: "section", title: "Translucence", fields: [
      { member: "threshold", label: "In the middle", hint: "Threshold of the texture, T1", min: -0.5, max: 1,
        step: 0.01, standard: 0 },
      { member: "threshold_edge", label: "At the edge", hint: "Threshold of the texture on the silhouette, T2",
        min: -0.5, max: 1.5, step: 0.01, standard: 0.65 },
      { member: "range", label: "Fade", hint: "Range of the texture, D", min: 0.01, max: 1, step: 0.01, standard: 0.2 },
      { member: "density", label: "Density factor", min: 0.1, max: 100, log: true, standard: 10 },
    ] },
    { kind: "section", title: "Sky plane", fields: [
      { kind: "switch", member: "plane", label: "A textured plane", fresh: { altitude: 10 }, fields: [
        { member: "altitude", label: "Altitude", min: -10, max: 60, step: 0.5, standard: 10 },
        { member: "extent", label: "Extent", min: 10, max: 1000, log: true, standard: 120 },
        { member: "thickness", label: "Thickness", min: 0, max: 10, step: 0.1, standard: 1.5 },
        { member: "threshold", label: "Threshold", min: -0.5, max: 1, step: 0.01, standard: 0.3 },
        { member: "range", label: "Fade", hint: "Range of the texture, D", min: 0.01, max: 1, step: 0.01, standard: 0.3 },
        { member: "density", label: "Density factor", min: 0.1, max: 100, log: true, standard: 10 },
        ...texture(0.3),
      ] },
    ] },
    { kind: "section", title: "Shading of the gardner look", fields: [
      { member: "shading/specular", label: "Specular", ...share, standard: 0.1 },
      { member: "shading/texture", label: "Texture", ...share, standard: 0.35 },
      { member: "shading/ambient", label: "Ambient", ...share, standard: 0.25 },
      { member: "shading/shininess", label: "Shininess", min: 1, max: 50, log: true, standard: 4 },
    ] },
  ],
};
