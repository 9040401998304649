// Shape tools: what one starts from, how thick it is, what is strewn about, and another file put into the scene.

import { parseJson } from "./json_text.js";
import { cloudsOf, withCloudList } from "./document.js";
import { duplicated, transformed } from "./workspace_edit.js";
import { around, itemsOf } from "./workspace_items.js";

const cube = (particles, size, center, radius) => ({ particles, size, center, radius });

// A stream of 0..1 that is the same for the same seed.
export function randomFrom(seed) {
  let state = (Math.imul(seed, 0x9e3779b1) ^ 0x5bd1e995) >>> 0 || 1;
  return () => {
    state ^= state << 13;
    state >>>= 0;
    state ^= state >>> 17;
    state ^= state << 5;
    state >>>= 0;
    return state / 2 ** 32;
  };
}
const short = (x) => Number(x.toPrecision(4));

function field() {
  const random = randomFrom(7);
  return Array.from({ length: 12 }, (_unused, i) => {
    const size = 0.9 + 0.9 * random();
    return {
      model: "cubes", seed: i + 1, translate: [short(7 * ((i % 4) - 1.5) + 3 * (random() - 0.5)), 0, short(7 * (Math.floor(i / 4) - 1) + 3 * (random() - 0.5))],
      cubes: [
        cube(80, [short(4 * size), 0.8, short(3.2 * size)], [0, 0, 0], short(0.9 * size)),
        cube(60, [short(2.2 * size), short(1.4 * size), short(2 * size)], [short(0.6 * (random() - 0.5)), short(0.9 * size), 0], short(0.8 * size)),
      ],
    };
  });
}

// [name, what it is called, its clouds]
export const STARTERS = [
  ["tower", "Flat base and tower", () => [{ model: "cubes", cubes: [
    cube(170, [8, 1, 6], [0, -2.5, 0], 1.5), cube(90, [4.8, 2.2, 4], [-0.6, -0.8, 0.2], 1.7),
    cube(70, [2.6, 3, 2.4], [0.4, 1.7, 0], 1.4), cube(40, [3.2, 1.2, 2.8], [0.3, 3.7, -0.1], 1.1),
  ] }]],
  ["field", "Field of small clouds", field],
  ["sheet", "Sheet", () => [{ model: "cubes", cubes: [cube(700, [26, 0.8, 20], [0, 0, 0], 1.4), cube(200, [20, 0.5, 14], [2, 0.6, -1], 1)] }]],
  ["wisp", "Wisp", () => [{ model: "cubes", cubes: [
    cube(120, [9, 0.4, 1.4], [0, 0, 0], 0.6), cube(90, [7, 0.3, 1], [3, 0.5, 1.6], 0.5),
    cube(90, [8, 0.3, 0.9], [-3, 0.3, -1.5], 0.5),
  ] }]],
];
const one = (clouds) => (clouds.length === 1 ? { cubes: clouds[0].cubes } : { clouds });

// A scene of a starter alone: light, sky and picture stay, and what belongs to the shape that was there goes.
export function started(scene, name) {
  const [, , make] = STARTERS.find(([known]) => known === name);
  const { clouds: _clouds, cubes: _cubes, camera: _camera, density: _density, look: _look, ground: _ground, haze: _haze, sequence: _sequence, ...rest } = scene;
  return { ...one(make()), ...rest };
}
export function withStarter(scene, name) {
  const [, , make] = STARTERS.find(([known]) => known === name);
  return withClouds(scene, make());
}
export function withClouds(scene, clouds) {
  const listed = withCloudList(scene);
  const kept = listed.clouds.filter(({ model, cubes }) => (model ?? "cubes") !== "cubes" || cubes?.length); // not the empty one
  return { ...listed, clouds: [...kept, ...clouds] };
}

// Thin, medium, thick: optical depths straight up through the thickest place.
export const THICKNESS = [["thin", 1], ["medium", 6], ["thick", 30]];

// The scene `factor` times as thick: depth is proportional to density. densities: of its clouds as the service has them
// (survey.density). most: the largest density there may be.
export function thickened(scene, densities, factor, most) {
  const times = (value) => Number(Math.min(most, value * factor).toPrecision(4));
  if (!Array.isArray(scene.clouds)) return { ...scene, density: times(densities[0]) };
  const clouds = scene.clouds.map((cloud, k) => (
    typeof cloud?.density === "number" || typeof scene.density !== "number" ? { ...cloud, density: times(densities[k]) } : cloud));
  return typeof scene.density === "number" ? { ...scene, density: times(scene.density), clouds } : { ...scene, clouds };
}

// `count` twins of the items, strewn level over a disc of `reach`, from .7 to 1.3 times as large. [scene, ids].
export function scattered(scene, ids, count, reach, seed) {
  const random = randomFrom(seed);
  let next = scene;
  const made = [];
  for (let i = 0; i < count; i += 1) {
    const [angle, out, size] = [2 * Math.PI * random(), reach * Math.sqrt(random()), 0.7 + 0.6 * random()];
    const [grown, twins] = duplicated(next, ids, [out * Math.sin(angle), 0, out * Math.cos(angle)]);
    const known = new Set(twins);
    const [pivot] = around(itemsOf(grown).filter(({ id }) => known.has(id)));
    next = transformed(grown, twins, { scale: [size, size, size], pivot });
    made.push(...twins);
  }
  return [next, made];
}

// The clouds of another document. What it says for all of its clouds goes into each.
export function cloudsFrom(text) {
  const scene = parseJson(text);
  if (scene === null || typeof scene !== "object" || Array.isArray(scene)) throw new TypeError("A scene document is a JSON object: { … }.");
  const common = {};
  for (const member of ["fill", "seed"]) if (scene[member] !== undefined) common[member] = scene[member];
  if (typeof scene.density === "number") common.density = scene.density;
  return cloudsOf(withCloudList(scene)).map(({ cloud }) => {
    const { fill, ...rest } = { ...common, ...cloud };
    return fill !== undefined && (cloud.model ?? "cubes") === "cubes" ? { ...rest, fill } : rest;
  });
}
