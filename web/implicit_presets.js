// What each preset of the model "implicit" comes to (core/scene/implicit_presets.cpp): what the controls
// show where the document is silent, and what "Edit the preset’s shapes" puts into it. page_defaults.mjs
// compares the two.

const kTen = 3; // units in ten metres, in which the places and radii below are
const units = (tens) => (Array.isArray(tens) ? tens.map(units) : kTen * tens);
const weighing = (weight) => (weight === 1 ? {} : { weight });

const sphere = (center, radius, weight = 1) => ({ center: units(center), radius: units(radius), ...weighing(weight) });
const ellipsoid = (center, radius, radii, weight = 1) =>
  ({ shape: "ellipsoid", center: units(center), radius: units(radius), radii, ...weighing(weight) });
const segment = (center, points, radius, weight = 1) =>
  ({ shape: "segment", center: units(center), radius: units(radius), points: units(points), ...weighing(weight) });

const OF_ALL = {
  exponent: 1, noise_size: 1, octaves: 6, gain: 0.5, stretch: 1, jet: [0, 0, 0], jet_turbulence: 0,
  ripple: [0, 0, 0], ripple_depth: 0, ripple_turbulence: 0,
};

export const IMPLICIT_PRESETS = {
  cumulus: {
    ...OF_ALL, base: -24, amount: 0.4, exponent: 0.5, blend: 0.4, displacement: 0.7, noise_size: 0.6, octaves: 6,
    primitives: [
      sphere([-72, 0, 2], 26), sphere([-38, 6, -10], 37, 1.1), sphere([-4, 8, 10], 39, 1.2),
      sphere([34, 4, -6], 37, 1.1), sphere([68, -2, 6], 26), sphere([-32, 38, -4], 31, 1.1),
      sphere([-26, 66, -6], 23, 1.1), sphere([20, 34, 0], 29, 1.1), sphere([30, 54, 4], 19),
    ],
  },
  cirrus: {
    ...OF_ALL, amount: 1.2, exponent: 3, blend: 0, displacement: 0.9, noise_size: 0.4, octaves: 6, stretch: 5,
    jet: [2.2, 0, 0.5], jet_turbulence: 1.5,
    primitives: [
      segment([-20, 0, -60], [[-170, -6, -10], [-40, 0, 0], [90, 5, -14]], 30, 0.9),
      segment([20, 4, 0], [[-190, -4, 14], [0, 0, 0], [170, 6, 22]], 36, 1),
      segment([-30, -2, 66], [[-120, -4, 0], [40, 2, 8], [160, 8, -6]], 28, 0.8),
      ellipsoid([30, 2, 10], 100, [1.7, 0.14, 0.95], 0.35),
    ],
  },
  stratus: {
    ...OF_ALL, amount: 0.5, exponent: 0.7, blend: 0.25, displacement: 0.1, noise_size: 0.45, octaves: 6,
    primitives: [
      ellipsoid([0, 0, 0], 150, [1, 0.09, 0.8], 1), ellipsoid([-90, 2, 40], 110, [1, 0.12, 0.7], 0.8),
      ellipsoid([95, -2, -45], 120, [1, 0.1, 0.7], 0.8),
    ],
  },
  mackerel: {
    ...OF_ALL, amount: 2, exponent: 1.6, blend: 0.3, displacement: 0.05, noise_size: 0.35, octaves: 6,
    ripple: [0.2, 0, 0.42], ripple_depth: 0.95, ripple_turbulence: 5,
    primitives: [
      ellipsoid([0, 0, 0], 170, [1, 0.045, 0.85], 1),
    ],
  },
  creature: {
    ...OF_ALL, amount: 0.4, exponent: 0.5, blend: 0.6, displacement: 0.35, noise_size: 0.9, octaves: 6,
    primitives: [
      sphere([-10, 0, 0], 40, 1.3), sphere([26, 4, 0], 38, 1.3), sphere([56, 26, 0], 24, 1.2),
      sphere([76, 48, 0], 27, 1.4), sphere([100, 42, 0], 15, 1.2), sphere([-34, -34, 8], 20, 1.2),
      sphere([36, -34, -8], 20, 1.2), sphere([-56, 14, 0], 26, 1.1), sphere([-84, 32, 0], 18, 1.1),
    ],
  },
};
