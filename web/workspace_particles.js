// The particles of a scene, as the service's binary answer has them (PLY), with the light of each; and an estimate of it for
// as long as the service has not said it: what lies between a particle and the sun is summed up on a coarse grid.

const SIZES = { double: 8, float: 4, int: 4, uint: 4, short: 2, ushort: 2, char: 1, uchar: 1 };

// { count, places, radii, densities, covers, radiance } of a little-endian PLY; RangeError when it is none. radiance: three
// numbers a particle, or null where the file has none.
export function readPly(buffer) {
  const head = new TextDecoder("latin1").decode(new Uint8Array(buffer, 0, Math.min(buffer.byteLength, 4096)));
  const end = head.indexOf("end_header\n");
  if (!head.startsWith("ply\nformat binary_little_endian") || end < 0) throw new RangeError("The particles are not a binary PLY.");
  let count = 0;
  let stride = 0;
  const columns = {};
  for (const line of head.slice(0, end).split("\n")) {
    const [word, type, name] = line.split(" ");
    if (word === "element" && type === "vertex") count = Number(name);
    if (word !== "property") continue;
    columns[name] = { at: stride, double: type === "double" };
    stride += SIZES[type];
  }
  const begin = end + "end_header\n".length;
  if (buffer.byteLength < begin + count * stride) throw new RangeError("The particles end too early.");
  const view = new DataView(buffer, begin);
  const column = (name) => {
    const { at, double } = columns[name];
    return double ? (i) => view.getFloat64(i * stride + at, true) : (i) => view.getFloat32(i * stride + at, true);
  };
  const [x, y, z, radius, density] = ["x", "y", "z", "radius", "density"].map(column);
  const [places, radii, densities, covers] = [new Float32Array(3 * count), new Float32Array(count), new Float32Array(count), new Float32Array(count)];
  for (let i = 0; i < count; i += 1) {
    [places[3 * i], places[3 * i + 1], places[3 * i + 2]] = [x(i), y(i), z(i)];
    radii[i] = radius(i);
    densities[i] = density(i);
    covers[i] = coverOf(densities[i], radii[i]);
  }
  let radiance = null;
  if (columns.light_red) {
    radiance = new Float32Array(3 * count);
    ["light_red", "light_green", "light_blue"].map(column).forEach((value, c) => {
      for (let i = 0; i < count; i += 1) radiance[3 * i + c] = value(i);
    });
  }
  return { count, places, radii, densities, covers, radiance };
}

const coverOf = (density, radius) => 1 - Math.exp(-density * (radius / 2) * Math.sqrt(2 * Math.PI));

// The same with `factor` times the matter.
export function denser(set, factor) {
  if (factor === 1) return set;
  const densities = set.densities.map((density) => density * factor);
  return { ...set, densities, covers: densities.map((density, i) => coverOf(density, set.radii[i])) };
}

// `most` of them at most, evenly from the list, each as much larger as makes up for those that are left out: mass goes
// with the cube of the radius.
export function sparser(set, most) {
  const step = Math.ceil(set.count / most);
  if (step <= 1) return set;
  const count = Math.ceil(set.count / step);
  const larger = Math.cbrt(step);
  const pick = (list, width, factor) => Float32Array.from({ length: width * count }, (_none, i) =>
    factor * list[width * step * Math.floor(i / width) + (i % width)]);
  const [radii, densities] = [pick(set.radii, 1, larger), pick(set.densities, 1, 1)];
  return {
    count, places: pick(set.places, 3, 1), radii, densities, covers: densities.map((density, i) => coverOf(density, radii[i])),
    radiance: set.radiance && pick(set.radiance, 3, 1),
  };
}

// Radiance as a picture shows it, 0..1 a channel: by the tone curves of the service (core/shaders/tone.glsl) and sRGB.
const kKnee = 0.5, kWhite = 8, kDesaturation = 0.15;
function curve(x) {
  if (x <= kKnee) return Math.max(x, 0);
  const t = (Math.min(x, kWhite) - kKnee) / (1 - kKnee);
  const white = (kWhite - kKnee) / (1 - kKnee);
  return kKnee + ((1 - kKnee) * t * (1 + t / (white * white))) / (1 + t);
}
const encoded = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
// exposure: in stops. tone: "neutral" or "reinhard".
export function displayed(radiance, exposure, tone) {
  const gain = 2 ** exposure;
  const shown = new Float32Array(radiance.length);
  for (let i = 0; i < radiance.length; i += 3) {
    const [r, g, b] = [gain * radiance[i], gain * radiance[i + 1], gain * radiance[i + 2]];
    const peak = Math.max(r, g, b);
    const level = curve(peak);
    const pale = 1 - 1 / (1 + kDesaturation * (peak - level));
    const of = (x) => {
      if (tone === "reinhard") return curve(x);
      return peak <= kKnee ? x : (x * level * (1 - pale)) / peak + level * pale;
    };
    shown[i] = encoded(of(r));
    shown[i + 1] = encoded(of(g));
    shown[i + 2] = encoded(of(b));
  }
  return shown;
}

const kLeastLight = 0.02; // of an estimate, to be divided by
const kMostRelit = 4;

// The light that was known when it was estimated to be `then`, now that it is estimated to be `now`; all of one length.
export const relit = (known, then, now) => known.map((light, i) =>
  Math.min(1, light * Math.min(kMostRelit, now[i] / Math.max(kLeastLight, then[i]))));

const kCells = 24; // along each side of the grid

// Three numbers a particle, 0..1. towards: unit vector to the sun.
export function litFrom({ count, places, radii, densities }, towards) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < count; i += 1) {
    for (let axis = 0; axis < 3; axis += 1) {
      low[axis] = Math.min(low[axis], places[3 * i + axis]);
      high[axis] = Math.max(high[axis], places[3 * i + axis]);
    }
  }
  const side = Math.max(1e-6, ...high.map((h, axis) => h - low[axis])) / kCells;
  const cell = (value, axis) => Math.min(kCells - 1, Math.max(0, Math.floor((value - low[axis]) / side)));
  const matter = new Float32Array(kCells ** 3);
  for (let i = 0; i < count; i += 1) {
    const [a, b, c] = [0, 1, 2].map((axis) => cell(places[3 * i + axis], axis));
    matter[(c * kCells + b) * kCells + a] += (densities[i] * (2 * Math.PI) ** 1.5 * (radii[i] / 2) ** 3) / side ** 3;
  }
  const depthFrom = (a, b, c) => {
    let depth = 0;
    for (let step = 1; step < 2 * kCells; step += 1) {
      const p = [a + 0.5 + step * towards[0], b + 0.5 + step * towards[1], c + 0.5 + step * towards[2]].map(Math.floor);
      if (p.some((x) => x < 0 || x >= kCells)) break;
      depth += matter[(p[2] * kCells + p[1]) * kCells + p[0]] * side;
    }
    return depth;
  };
  const known = new Float32Array(kCells ** 3).fill(-1);
  const light = new Float32Array(3 * count);
  for (let i = 0; i < count; i += 1) {
    const [a, b, c] = [0, 1, 2].map((axis) => cell(places[3 * i + axis], axis));
    const at = (c * kCells + b) * kCells + a;
    if (known[at] < 0) known[at] = depthFrom(a, b, c);
    // Scattered light goes on where the direct ray is long gone: diffusion falls as 1 / (1 + depth).
    const sun = 0.7 / (1 + 0.25 * known[at]);
    light.set([0.26 + sun, 0.29 + sun * 0.98, 0.34 + sun * 0.94], 3 * i);
  }
  return light;
}

const kCovered = 0.8; // of a pixel, before its colour says something of the cloud
const kFewest = 12; // such pixels
const kLeast = 0.4, kMost = 2.5; // times

// How much brighter a picture of the service has the cloud than sprites have it, [red, green, blue]; null where it cannot
// be told. Both of one size, RGBA bytes; sprites premultiplied, with their lowest row first.
export function gainOf(sprites, picture, width, height) {
  const [theirs, ours] = [[0, 0, 0], [0, 0, 0]];
  let count = 0;
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      const from = 4 * ((height - 1 - y) * width + x);
      const alpha = sprites[from + 3] / 255;
      if (alpha < kCovered) continue;
      count += 1;
      for (let c = 0; c < 3; c += 1) {
        ours[c] += sprites[from + c] / alpha;
        theirs[c] += picture[4 * (y * width + x) + c];
      }
    }
  }
  if (count < kFewest) return null;
  return theirs.map((sum, c) => Math.min(kMost, Math.max(kLeast, sum / Math.max(1, ours[c]))));
}
