// What of a scene can be taken hold of: cubes, parts of the other models that have a place and a size, and clouds as a
// whole. Each is an item
//
//   { id, kind, cloud, label, center, half, axes, angles, round, whole }
//
// id: the pointer of what it stands for. cloud: index of its cloud. center: in the scene's units; half: half its lengths
// along its own axes; axes: the rotation of these (rotation.js). angles: by which the document says how it is turned, about
// x, y and z, null about what it cannot; null: it stands along its cloud's axes, or is the same from all sides. round: an
// ellipsoid, else a box. whole: it is a cloud, and is taken hold of only from the list, or where the cloud has no parts.

import { at, cloudsOf, modelOf } from "./document.js";
import { NONE, about, applied, ofAngles, product } from "./rotation.js";
import { atOrDefault, fieldAt, presetAt } from "./schema.js";

const isNumber = (value) => typeof value === "number" && Number.isFinite(value);
export const isTriple = (v) => Array.isArray(v) && v.length === 3 && v.every(isNumber);
const triple = (value, otherwise) => (isTriple(value) ? value : otherwise);

// A vector of a frame that is turned about y, in the scene's; the other way with -turn.
export const turned = (point, turn) => (turn === 0 ? point : applied(about(1, turn), point));

// Where a cloud stands at the scene's time; given its pointer and a list of its parts, where these stand: parcels of an
// automaton are in cells from the corner of its grid, the middle of whose floor is the cloud's origin.
export function placeOf(scene, cloud, pointer, member) {
  const time = atOrDefault(scene, "/time");
  const velocity = triple(cloud.velocity, [0, 0, 0]);
  const moved = triple(cloud.translate, [0, 0, 0]).map((t, axis) => t + velocity[axis] * (isNumber(time) ? time : 0));
  const place = {
    translate: moved, scale: isNumber(cloud.scale) && cloud.scale > 0 ? cloud.scale : 1, turn: isNumber(cloud.rotate_y) ? cloud.rotate_y : 0,
  };
  if (member !== PARCELS) return place;
  const { cells, cell } = gridOf(scene, pointer);
  return { ...place, translate: outward(place, [-cells[0] * cell / 2, 0, -cells[2] * cell / 2]), scale: place.scale * cell };
}
export const PARCELS = "automaton/ellipsoids";
function gridOf(scene, pointer) {
  const cell = atOrDefault(scene, `${pointer}/automaton/cell`);
  return { cells: triple(atOrDefault(scene, `${pointer}/automaton/cells`), [96, 32, 96]), cell: isNumber(cell) && cell > 0 ? cell : 1 };
}

export const outward = (place, point) => turned(point, place.turn).map((x, axis) => place.translate[axis] + place.scale * x);
export const inward = (place, point) => turned(point.map((x, axis) => (x - place.translate[axis]) / place.scale), -place.turn);

const kUp = 1; // the axis
// How parts say that they are turned, by the list they stand in: the order of the rotations about the axes; the angles of a
// part, null about what it cannot be turned, or null; and the part with other angles. `of`: the primitive of a key.
const ROTATE = {
  order: [2, 1, 0],
  get: (part, of) => (["ellipsoid", "cylinder", "segment"].includes((of ?? part).shape) ? triple(part.rotate ?? of?.rotate, [0, 0, 0]) : null),
  set: (part, rotate) => ({ ...part, rotate }),
};
const angle = (value) => (isNumber(value) ? value : 0);
const TURNS = {
  "implicit/primitives": ROTATE,
  keys: ROTATE,
  "ellipsoids/ellipsoids": {
    order: [1, 0, 2],
    get: ({ rotate_x: x, rotate_y: y, rotate_z: z }) => [x, y, z].map(angle),
    set: (part, angles) => ["rotate_x", "rotate_y", "rotate_z"].reduce((next, member, axis) => (
      angles[axis] === 0 && next[member] === undefined ? next : { ...next, [member]: angles[axis] }), part),
  },
  "ellipsoids/formations": {
    get: ({ heading }) => [null, isNumber(heading) ? heading : fieldAt("/clouds/0/ellipsoids/formations/0/heading").standard, null],
    set: (part, angles) => ({ ...part, heading: angles[kUp] }),
  },
};
export const turnsOf = (member) => TURNS[member.endsWith("/keys") ? "keys" : member] ?? null;
// The primitive that a list is the keys of.
export const ownerOf = (scene, base, member) => (member.endsWith("/keys") ? partsAt(scene, base, "implicit/primitives")[Number(member.split("/")[2])] : undefined);

const reachOf = ({ radius = 30, radii, points, shape }) => {
  let half = [radius, radius, radius];
  if (shape === "ellipsoid" && isTriple(radii)) half = radii.map((ratio) => ratio * radius);
  if (Array.isArray(points) && points.every(isTriple)) half = half.map((r, axis) => r + Math.max(0, ...points.map((p) => Math.abs(p[axis]))));
  return half;
};
// The lists that a model's parts stand in: [member of the cloud, kind, [center, half, round] of a part].
const PARTS = {
  cubes: [["cubes", "cube", ({ center, size }) => [center, isTriple(size) ? size.map((side) => side / 2) : null, false]]],
  implicit: [["implicit/primitives", "primitive", (part) => [part.center ?? [0, 0, 0], reachOf(part), true]]],
  ellipsoids: [
    ["ellipsoids/ellipsoids", "ellipsoid", ({ center, radii }) => [center, radii, true]],
    ["ellipsoids/formations", "formation", ({ center, radii }) => [center ?? [0, 0, 0], triple(radii, [3, 2, 3]), true]],
  ],
  automaton: [[PARCELS, "parcel", ({ center, radii }) => [center, radii, true]]],
};
// Where a primitive's key says where it is by then, the key is a part, too: its size is the key's, or the primitive's.
const keyLists = (cloud) => (modelOf(cloud) === "implicit" && Array.isArray(cloud.implicit?.primitives) ? cloud.implicit.primitives : [])
  .flatMap((primitive, i) => (Array.isArray(primitive?.keys) ? [[`implicit/primitives/${i}/keys`, `primitive ${i + 1}, key`,
    (key) => [key.center, reachOf({ ...primitive, ...key }), true]]] : []));

// A list as it holds in the document, or as the model's preset has it.
export function partsAt(scene, base, member) {
  const own = at(scene, `${base}/${member}`);
  if (Array.isArray(own)) return own;
  const cut = member.lastIndexOf("/");
  const preset = cut < 0 ? undefined : presetAt(scene, `${base}/${member.slice(0, cut)}`)[member.slice(cut + 1)];
  return Array.isArray(preset) ? preset : [];
}

const kMostPlaces = 20_000; // of ready particles that are looked at for the box around them

// A box around a cloud that has no parts, in its own coordinates: [center, half].
function boxOf(scene, cloud, pointer) {
  if (modelOf(cloud) === "spheres") {
    const size = atOrDefault(scene, `${pointer}/spheres/size`);
    return [[0, 0, 0], triple(size, [10, 10, 10]).map((side) => side / 2)];
  }
  if (modelOf(cloud) === "automaton") {
    const { cells, cell } = gridOf(scene, pointer);
    const half = cells.map((count) => (count * cell) / 2);
    return [[0, half[1], 0], half];
  }
  const places = Array.isArray(cloud.positions) ? cloud.positions.slice(0, kMostPlaces).filter(isTriple) : [];
  if (!places.length) return [[0, 0, 0], [1, 1, 1]];
  const ends = [0, 1, 2].map((axis) => places.reduce(([low, high], p) => [Math.min(low, p[axis]), Math.max(high, p[axis])], [Infinity, -Infinity]));
  return [ends.map(([low, high]) => (low + high) / 2), ends.map(([low, high]) => Math.max((high - low) / 2, 0.5))];
}

const MODEL_WORDS = {
  cubes: "cubes", implicit: "implicit functions", ellipsoids: "ellipsoids", spheres: "spheres", automaton: "automaton", particles: "particles",
};

// All items of a scene: of every cloud itself and then its parts, in their order.
export function itemsOf(scene) {
  return cloudsOf(scene).flatMap(({ cloud, pointer }, index) => {
    const place = placeOf(scene, cloud);
    const upright = place.turn === 0 ? NONE : about(kUp, place.turn);
    const parts = [...(PARTS[modelOf(cloud)] ?? []), ...keyLists(cloud)].flatMap(([member, kind, shape]) => {
      const own = placeOf(scene, cloud, pointer, member);
      return partsAt(scene, pointer, member).map((part, i) => {
        const [center, half, round] = shape(part ?? {});
        if (!isTriple(center) || !isTriple(half)) return null;
        const turns = turnsOf(member);
        const angles = turns?.get(part ?? {}, ownerOf(scene, pointer, member)) ?? null;
        return {
          id: `${pointer}/${member}/${i}`, kind, cloud: index, label: `${kind} ${i + 1}`, whole: false, round, angles,
          center: outward(own, center), half: half.map((h) => own.scale * h),
          axes: angles && turns.order ? product(upright, ofAngles(angles, turns.order)) : upright,
        };
      }).filter(Boolean);
    });
    let [center, half] = parts.length ? around(parts) : boxOf(scene, cloud, pointer);
    if (!parts.length) [center, half] = [outward(place, center), half.map((h) => place.scale * h)];
    const whole = {
      id: pointer === "" ? "/clouds/0" : pointer, kind: "cloud", cloud: index, label: `cloud ${index + 1}: ${MODEL_WORDS[modelOf(cloud)] ?? modelOf(cloud)}`,
      whole: true, bare: parts.length === 0, round: modelOf(cloud) === "spheres", center, half,
      axes: parts.length ? NONE : upright, angles: [null, place.turn, null],
    };
    return [whole, ...parts];
  });
}

// The box around items, along the scene's axes: [center, half].
export function around(items) {
  const [min, max] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (const { center, half, axes, round } of items) {
    const reach = axes.map((row) => row.map((x, axis) => Math.abs(x * half[axis])))
      .map(([a, b, c]) => (round ? Math.hypot(a, b, c) : a + b + c));
    for (let axis = 0; axis < 3; axis += 1) {
      min[axis] = Math.min(min[axis], center[axis] - reach[axis]);
      max[axis] = Math.max(max[axis], center[axis] + reach[axis]);
    }
  }
  return [min.map((low, axis) => (low + max[axis]) / 2), min.map((low, axis) => (max[axis] - low) / 2)];
}
