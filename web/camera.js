// A camera as an orbit: where it looks, from which side, from how far. Angles in degrees and with
// the service's axes: y up, azimuth 0 = +z, 90 = +x, as for the sun.

import { at, cloudsOf } from "./document.js";
import { atOrDefault } from "./schema.js";

const radians = (degrees) => (degrees * Math.PI) / 180;
const degrees = (angle) => (angle * 180) / Math.PI;
export const kSteepest = 89; // straight up or down the azimuth would have no meaning

const isTriple = (v) => Array.isArray(v) && v.length === 3 && v.every((x) => typeof x === "number" && Number.isFinite(x));
const short = (x) => Number(x.toFixed(4)) + 0; // + 0: no "-0" in documents

// The box around all cubes with their largest particles, for as long as the service has not said
// what it measured. null when there is nothing to put a box around.
export function boundsOfCubes(scene) {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (const { cloud } of cloudsOf(scene)) {
    const translate = isTriple(cloud?.translate) ? cloud.translate : [0, 0, 0];
    const scale = cloud?.scale ?? 1;
    const turn = radians(cloud?.rotate_y ?? 0);
    const cubes = Array.isArray(cloud?.cubes) ? cloud.cubes : [];
    for (const cube of cubes) {
      if (!isTriple(cube?.size) || !isTriple(cube?.center) || !(cube.particles > 0)) continue;
      const half = cube.size.map((side) => side / 2 + (cube.radius ?? 0));
      const [x, y, z] = cube.center;
      const center = [
        x * Math.cos(turn) + z * Math.sin(turn), y, z * Math.cos(turn) - x * Math.sin(turn),
      ];
      const reach = Math.hypot(half[0], half[2]); // of the turned cube, generously
      for (const [axis, r] of [[0, turn ? reach : half[0]], [1, half[1]], [2, turn ? reach : half[2]]]) {
        min[axis] = Math.min(min[axis], translate[axis] + scale * (center[axis] - r));
        max[axis] = Math.max(max[axis], translate[axis] + scale * (center[axis] + r));
      }
    }
  }
  return isTriple(min) && isTriple(max) ? { min, max } : null;
}

export function sizeOf(bounds) {
  if (!bounds) return { center: [0, 0, 0], radius: 5 };
  const center = bounds.min.map((low, axis) => (low + bounds.max[axis]) / 2);
  const radius = Math.hypot(...bounds.min.map((low, axis) => (bounds.max[axis] - low) / 2));
  return { center, radius: radius || 5 };
}

// The view that the service's "auto" gives (core/survey/view.cpp), so that leaving it moves nothing:
// from this side and height, every corner of the box in the picture, with a margin.
const AUTO = { azimuth: 30, elevation: -10, fov: 40, margin: 1.08 };

function automaticOrbit(bounds, aspect) {
  const { azimuth, elevation, fov, margin } = AUTO;
  const [a, e, tan] = [radians(azimuth), radians(elevation), Math.tan(radians(fov) / 2)];
  const forward = [-Math.sin(a) * Math.cos(e), -Math.sin(e), -Math.cos(a) * Math.cos(e)];
  const right = [Math.cos(a), 0, -Math.sin(a)];
  const up = [-Math.sin(a) * Math.sin(e), Math.cos(e), -Math.cos(a) * Math.sin(e)];
  const { min, max } = bounds ?? { min: [-5, -5, -5], max: [5, 5, 5] };
  const target = min.map((low, axis) => (low + max[axis]) / 2);
  let distance = 1e-3;
  for (let corner = 0; corner < 8; corner += 1) {
    const p = target.map((t, axis) => ((corner >> axis) & 1 ? max[axis] : min[axis]) - t);
    const along = (v) => p[0] * v[0] + p[1] * v[1] + p[2] * v[2];
    const tanX = (tan * aspect) / margin;
    distance = Math.max(distance, Math.abs(along(right)) / tanX - along(forward), Math.abs(along(up)) / (tan / margin) - along(forward));
  }
  return { target, azimuth, elevation, distance, fov };
}

const aspectOf = (scene) => atOrDefault(scene, "/image/width") / atOrDefault(scene, "/image/height") || 1;

export const isAutomatic = (scene) => atOrDefault(scene, "/camera") === "auto";

export function orbitOf(scene, bounds) {
  const [eye, target] = [at(scene, "/camera/eye"), at(scene, "/camera/target")];
  if (!isTriple(eye) || !isTriple(target)) return automaticOrbit(bounds, aspectOf(scene));
  const fov = atOrDefault(scene, "/camera/fov");
  const [x, y, z] = eye.map((e, axis) => e - target[axis]);
  const distance = Math.hypot(x, y, z);
  const elevation = distance > 0 ? degrees(Math.asin(y / distance)) : 0;
  return { target, azimuth: degrees(Math.atan2(x, z)), elevation, distance, fov };
}

// The document's camera for an orbit; keeps what else the camera says (`up`).
export function cameraOf(scene, { target, azimuth, elevation, distance, fov }) {
  const steep = radians(Math.max(-kSteepest, Math.min(kSteepest, elevation)));
  const around = radians(azimuth);
  const from = [Math.cos(steep) * Math.sin(around), Math.sin(steep), Math.cos(steep) * Math.cos(around)];
  const camera = isAutomatic(scene) ? {} : at(scene, "/camera");
  return {
    ...camera,
    eye: from.map((component, axis) => short(target[axis] + distance * component)),
    target: target.map(short),
    fov: short(fov),
  };
}
