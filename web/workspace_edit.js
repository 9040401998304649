// Edits of a scene by its items (workspace_items.js). Each takes a scene and gives another.

import { at, cloudsOf, modelOf, withAt, withCloudList } from "./document.js";
import { NONE, about, anglesOf, applied, ofAngles, product, transposed } from "./rotation.js";
import { PARCELS, inward, isTriple, outward, ownerOf, partsAt, placeOf, turned, turnsOf } from "./workspace_items.js";

const short = (x) => Number(x.toPrecision(7)) + 0; // + 0: no "-0" in documents
const LIST = /^(.*?)\/(cubes|implicit\/primitives\/\d+\/keys|implicit\/primitives|ellipsoids\/ellipsoids|ellipsoids\/formations|automaton\/ellipsoids)\/(\d+)$/;
export const FRESH_CUBE = { particles: 50, size: [2, 2, 2], center: [0, 0, 0], radius: 1 };

// { base, member, index } of a part's id, or null for a cloud's.
function partOf(id) {
  const [, base, member, index] = LIST.exec(id) ?? [];
  return base === undefined ? null : { base, member, index: Number(index) };
}
const cloudOf = (id) => Number(/^\/clouds\/(\d+)/.exec(id)?.[1] ?? 0);

// A change of several lists: change(list, indices, place, turns, owner) -> list, for each list that holds some of the ids.
function withLists(scene, ids, change) {
  const lists = new Map();
  for (const id of ids) {
    const part = partOf(id);
    if (!part) continue;
    const key = `${part.base}|${part.member}`;
    lists.set(key, [...(lists.get(key) ?? []), part.index]);
  }
  let next = scene;
  // Lists within others come first, while their pointers hold.
  for (const [key, indices] of [...lists].sort(([a], [b]) => b.length - a.length)) {
    const [base, member] = key.split("|");
    const own = Array.isArray(at(scene, `${base}/${member}`));
    if (!own && member === "implicit/primitives") next = withOwnShapes(next, base);
    const list = partsAt(next, base, member);
    const { cloud, pointer } = cloudsOf(scene)[cloudOf(base)];
    next = withAt(next, `${base}/${member}`, change(
      [...list], new Set(indices), placeOf(scene, cloud, pointer, member), turnsOf(member), ownerOf(next, base, member)));
  }
  return next;
}
// The shapes of a preset are not in the document until someone changes them; its base goes with them.
function withOwnShapes(scene, base) {
  const primitives = partsAt(scene, base, "implicit/primitives");
  return withAt(scene, `${base}/implicit/primitives`, structuredClone(primitives));
}
const clouds = (ids) => new Set([...ids].filter((id) => !partOf(id)).map(cloudOf));

const kUp = 1; // the axis
const angleAbout = (turn) => anglesOf(turn, [kUp, 0, 2])[kUp];
const within180 = (degrees) => short((((degrees % 360) + 540) % 360) - 180);

// A part turned by a rotation of its cloud's coordinates, as far as it can be.
function turnedPart(part, turn, turns, owner) {
  const angles = turns?.get(part, owner);
  if (!angles) return part;
  const next = turns.order ? anglesOf(product(turn, ofAngles(angles, turns.order)), turns.order)
    : angles.map((degrees, axis) => (axis === kUp ? degrees + angleAbout(turn) : degrees));
  return turns.set(part, next.map((degrees) => (degrees === null ? null : within180(degrees))));
}

// { move: [x, y, z], scale: [x, y, z], turn: a rotation or null }, about `pivot`; scale: along the axes of the rotation `frame`.
// What has to be uniform (the radius of particles, a cloud's scale) takes the mean of the factors, by volume; clouds turn
// about y only, and what stands along its cloud's axes goes round and stays as it is.
export function transformed(scene, ids, { move = [0, 0, 0], scale = [1, 1, 1], turn = null, pivot, frame = NONE }) {
  const isEven = scale.every((factor) => Math.abs(factor - scale[0]) < 1e-9);
  const mean = Math.cbrt(scale[0] * scale[1] * scale[2]);
  const [into, outOf] = [transposed(frame), turn ? product(turn, frame) : frame];
  const carried = (point) => {
    const inFrame = applied(into, point.map((x, axis) => x - pivot[axis])).map((x, axis) => x * scale[axis]);
    return applied(outOf, inFrame).map((x, axis) => x + pivot[axis] + move[axis]);
  };
  let next = withLists(scene, ids, (list, indices, place, turns, owner) => (
    list.map((part, i) => {
      if (!indices.has(i)) return part;
      const center = inward(place, carried(outward(place, part.center ?? [0, 0, 0]))).map(short);
      const grown = { ...part, center };
      if (turn) return turnedPart(grown, product(about(kUp, -place.turn), turn, about(kUp, place.turn)), turns, owner);
      if (scale.every((factor) => factor === 1)) return grown;
      if (isTriple(part.size)) {
        grown.size = part.size.map((side, axis) => short(side * scale[axis]));
        if (isEven) grown.radius = short(part.radius * mean);
      } else if (part.radius !== undefined || part.shape !== undefined) {
        if (part.shape === "ellipsoid" && !isEven) {
          grown.radii = (isTriple(part.radii) ? part.radii : [1, 1, 1]).map((ratio, axis) => short(ratio * scale[axis]));
        } else if (part.radius !== undefined) grown.radius = short(part.radius * mean);
        if (Array.isArray(part.points)) grown.points = part.points.map((p) => p.map((x, axis) => short(x * scale[axis])));
      } else if (isTriple(part.radii)) grown.radii = part.radii.map((r, axis) => short(r * scale[axis]));
      return grown;
    })));
  const whole = clouds(ids);
  if (whole.size) {
    next = withCloudList(next);
    next = { ...next, clouds: next.clouds.map((cloud, k) => {
      if (!whole.has(k)) return cloud;
      const place = placeOf(scene, cloud);
      const there = carried(place.translate);
      const before = isTriple(cloud.translate) ? cloud.translate : [0, 0, 0];
      const changed = { ...cloud, translate: before.map((t, axis) => short(t + there[axis] - place.translate[axis])) };
      if (mean !== 1) changed.scale = short(place.scale * mean);
      if (turn) changed.rotate_y = within180(place.turn + angleAbout(turn));
      return changed;
    }) };
  }
  return next;
}

// One of the angles of an item, as the document says them.
export function turnedTo(scene, id, axis, degrees) {
  if (!partOf(id)) {
    const next = withCloudList(scene);
    return { ...next, clouds: next.clouds.map((cloud, k) => (k === cloudOf(id) ? { ...cloud, rotate_y: degrees } : cloud)) };
  }
  return withLists(scene, [id], (list, indices, _place, turns, owner) => list.map((part, i) => (
    indices.has(i) ? turns.set(part, turns.get(part, owner).map((angle, other) => (other === axis ? degrees : angle))) : part)));
}

// Twins of items, behind the last of their list. [scene, ids of the twins].
export function duplicated(scene, ids, step) {
  const made = [];
  // No two keys are of one time.
  const parts = [...ids].filter((id) => partOf(id) && !partOf(id).member.endsWith("/keys"));
  let next = withLists(scene, parts, (list, indices, place) => {
    const shift = turned(step, -place.turn).map((x) => x / place.scale);
    return [...list, ...list.filter((_one, i) => indices.has(i)).map((part) => ({
      ...structuredClone(part), center: (part.center ?? [0, 0, 0]).map((x, axis) => short(x + shift[axis])),
    }))];
  });
  const counts = new Map();
  for (const id of parts) {
    const { base, member } = partOf(id);
    const key = `${base}/${member}`;
    const nth = counts.get(key) ?? 0;
    counts.set(key, nth + 1);
    made.push(`${key}/${partsAt(scene, base, member).length + nth}`);
  }
  const whole = [...clouds(ids)].sort((a, b) => a - b);
  if (whole.length) {
    next = withCloudList(next);
    const before = next.clouds.length;
    next = { ...next, clouds: [...next.clouds, ...whole.map((k) => {
      const copy = structuredClone(next.clouds[k]);
      const translate = isTriple(copy.translate) ? copy.translate : [0, 0, 0];
      return { ...copy, translate: translate.map((t, axis) => short(t + step[axis])) };
    })] };
    whole.forEach((_k, i) => made.push(`/clouds/${before + i}`));
  }
  return [next, made];
}

// Without the items. A cloud goes whole; the last one, with all of its cubes, stays as an empty one.
export function removed(scene, ids) {
  let next = withLists(scene, ids, (list, indices) => list.filter((_one, i) => !indices.has(i)));
  const whole = clouds(ids);
  if (!whole.size) return next;
  next = withCloudList(next);
  const left = next.clouds.filter((_cloud, k) => !whole.has(k));
  return { ...next, clouds: left.length ? left : [{ model: "cubes", cubes: [] }] };
}

// Every cube, primitive and cloud but for one empty cloud; sun, camera and the rest stay.
export function cleared(scene) {
  const { clouds: _gone, cubes: _all, look: _look, ...rest } = scene;
  return { cubes: [], ...rest };
}

// A part like the last of the cloud's, at a place of the scene. [scene, [its id]]; null where the model has no parts.
export function added(scene, index, center, size) {
  const { cloud, pointer } = cloudsOf(scene)[index] ?? {};
  if (!cloud) return null;
  const place = placeOf(scene, cloud, pointer, modelOf(cloud) === "automaton" ? PARCELS : "");
  const inside = inward(place, center).map(short);
  const side = short(size / place.scale);
  const [member, fresh] = {
    cubes: ["cubes", { ...FRESH_CUBE, size: [side, side, side], radius: short(side / 2) }],
    implicit: ["implicit/primitives", { shape: "sphere", radius: short(side / 2) }],
    ellipsoids: ["ellipsoids/ellipsoids", { radii: [short(side / 2), short(side / 3), short(side / 2)] }],
    automaton: [PARCELS, { radii: [short(side / 2), short(side / 3), short(side / 2)] }],
  }[modelOf(cloud)] ?? [];
  if (!member) return null;
  const list = partsAt(scene, pointer, member);
  const next = member === "implicit/primitives" && !Array.isArray(at(scene, `${pointer}/${member}`)) ? withOwnShapes(scene, pointer) : scene;
  return [withAt(next, `${pointer}/${member}`, [...list, { ...fresh, center: inside }]), [`${pointer}/${member}/${list.length}`]];
}
