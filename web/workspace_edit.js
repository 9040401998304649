// Edits of a scene by its items (workspace_items.js). Each takes a scene and gives another.

import { at, cloudsOf, modelOf, withAt, withCloudList } from "./document.js";
import { PARCELS, inward, isTriple, outward, partsAt, placeOf, turned } from "./workspace_items.js";

const short = (x) => Number(x.toPrecision(7)) + 0; // + 0: no "-0" in documents
const LIST = /^(.*?)\/(cubes|implicit\/primitives\/\d+\/keys|implicit\/primitives|ellipsoids\/ellipsoids|ellipsoids\/formations|automaton\/ellipsoids)\/(\d+)$/;
export const FRESH_CUBE = { particles: 50, size: [2, 2, 2], center: [0, 0, 0], radius: 1 };

// { base, member, index } of a part's id, or null for a cloud's.
function partOf(id) {
  const [, base, member, index] = LIST.exec(id) ?? [];
  return base === undefined ? null : { base, member, index: Number(index) };
}
const cloudOf = (id) => Number(/^\/clouds\/(\d+)/.exec(id)?.[1] ?? 0);

// A change of several lists: change(list, indices, place) -> list, for each list that holds some of the ids.
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
    next = withAt(next, `${base}/${member}`, change([...list], new Set(indices), placeOf(scene, cloud, pointer, member)));
  }
  return next;
}
// The shapes of a preset are not in the document until someone changes them; its base goes with them.
function withOwnShapes(scene, base) {
  const primitives = partsAt(scene, base, "implicit/primitives");
  return withAt(scene, `${base}/implicit/primitives`, structuredClone(primitives));
}
const clouds = (ids) => new Set([...ids].filter((id) => !partOf(id)).map(cloudOf));

// { move: [x, y, z], scale: [x, y, z], turn: degrees about y }, about `pivot`, along axes turned by `frame` degrees.
// What has to be uniform (the radius of particles, a cloud's scale) takes the mean of the factors, by volume.
export function transformed(scene, ids, { move = [0, 0, 0], scale = [1, 1, 1], turn = 0, pivot, frame = 0 }) {
  const isEven = scale.every((factor) => Math.abs(factor - scale[0]) < 1e-9);
  const mean = Math.cbrt(scale[0] * scale[1] * scale[2]);
  const carried = (point) => {
    const inFrame = turned(point.map((x, axis) => x - pivot[axis]), -frame).map((x, axis) => x * scale[axis]);
    return turned(inFrame, frame + turn).map((x, axis) => x + pivot[axis] + move[axis]);
  };
  let next = withLists(scene, ids, (list, indices, place) => (
    list.map((part, i) => {
      if (!indices.has(i)) return part;
      const center = inward(place, carried(outward(place, part.center ?? [0, 0, 0]))).map(short);
      const grown = { ...part, center };
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
      if (turn !== 0) changed.rotate_y = short((((place.turn + turn) % 360) + 540) % 360 - 180);
      return changed;
    }) };
  }
  return next;
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
