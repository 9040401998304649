// The path of a camera: keys in time, and where it is between them. It is what a document says under `sequence`, and as a
// file what `awan fly --path` reads:
//
//   { "from": seconds, "to": seconds, "frames": count, "interpolation": "smooth" | "linear", "clouds": "stand",
//     "camera": [{ "time": seconds, "eye": [x, y, z], "target": [x, y, z], "fov": degrees }, ...] }

export const KINDS = ["smooth", "linear"];

const minus = (a, b) => a.map((x, axis) => x - b[axis]);
const sizeOf = (v) => Math.hypot(...v);

// The tangent of the curve at a key between two others, times the seconds `own` of the segment that it is for: of the
// centripetal Catmull-Rom spline (Yuksel et al. 2011), whose knots are the roots of chords. The knot goes by as fast as in
// the slower of the two segments, so that rest begins and ends softly. `awan fly` has the same (core/scene/camera_keys.cpp).
function tangent(before, after, own, other, secondsOwn, secondsOther) {
  const [b, a] = [sizeOf(before), sizeOf(after)];
  if (!(b > 0 && a > 0)) return before.map(() => 0);
  const knots = ((own * other) / (own + other)) * Math.min(own, other * (secondsOwn / secondsOther));
  return before.map((x, axis) => knots * (x / b + after[axis] / a));
}

// The curve from one of four points to the next, those outside null where there are none. seconds: of the three segments.
function curved(before, from, to, after, seconds, share) {
  const chord = minus(to, from);
  const root = Math.sqrt(sizeOf(chord));
  if (!(root > 0)) return [...from]; // nothing moves, whatever the neighbours do
  const rootOf = (v) => Math.sqrt(sizeOf(v));
  const begins = before ? tangent(minus(from, before), chord, root, rootOf(minus(from, before)), seconds[1], seconds[0]) : chord;
  const ends = after ? tangent(chord, minus(after, to), root, rootOf(minus(after, to)), seconds[1], seconds[2]) : chord;
  const rest = 1 - share;
  return from.map((x, axis) =>
    x + share * chord[axis] + share * rest * (rest * (begins[axis] - chord[axis]) - share * (ends[axis] - chord[axis])));
}

// { eye, target, fov } at a time; before the first and after the last key, theirs.
export function viewAt({ interpolation, camera: keys }, time) {
  const last = keys.length - 1;
  if (time <= keys[0].time) return viewOf(keys[0]);
  if (time >= keys[last].time) return viewOf(keys[last]);
  let i = 0;
  while (keys[i + 1].time <= time) i += 1;
  const own = keys[i + 1].time - keys[i].time;
  const share = (time - keys[i].time) / own;
  const seconds = [i > 0 ? keys[i].time - keys[i - 1].time : own, own, i + 2 <= last ? keys[i + 2].time - keys[i + 1].time : own];
  const between = (get) => {
    const [from, to] = [get(keys[i]), get(keys[i + 1])];
    if (interpolation === "linear") return from.map((x, axis) => x + share * (to[axis] - x));
    return curved(i > 0 ? get(keys[i - 1]) : null, from, to, i + 2 <= last ? get(keys[i + 2]) : null, seconds, share);
  };
  const lenses = [keys[i].fov, keys[i + 1].fov];
  const [fov] = between((key) => [key.fov]);
  return {
    eye: between((key) => key.eye), target: between((key) => key.target),
    fov: Math.min(Math.max(...lenses), Math.max(Math.min(...lenses), fov)), // a lens does not zoom beyond its keys
  };
}
const viewOf = ({ eye, target, fov }) => ({ eye: [...eye], target: [...target], fov });

export const lengthOf = ({ from, to }) => to - from;

// The fewest of many keys that straight lines between them come within `near` of all others, eye and target alike
// (Ramer 1972, Douglas and Peucker 1973, in time instead of along the line).
export function thinned(keys, near) {
  const kept = new Set([0, keys.length - 1]);
  const open = [[0, keys.length - 1]];
  while (open.length) {
    const [from, to] = open.pop();
    let [worst, at] = [near, -1];
    for (let i = from + 1; i < to; i += 1) {
      const { eye, target } = viewAt({ interpolation: "linear", camera: [keys[from], keys[to]] }, keys[i].time);
      const off = Math.max(...["eye", "target"].map((member) =>
        Math.hypot(...keys[i][member].map((x, axis) => x - (member === "eye" ? eye : target)[axis]))));
      if (off > worst) [worst, at] = [off, i];
    }
    if (at < 0) continue;
    kept.add(at);
    open.push([from, at], [at, to]);
  }
  return keys.filter((_key, i) => kept.has(i));
}

const short = (x) => Number(x.toPrecision(7)) + 0; // + 0: no "-0" in files
const shortened = ({ time, eye, target, fov }) => ({ time: Number(time.toFixed(3)), eye: eye.map(short), target: target.map(short), fov: short(fov) });

const kFramesPerSecond = 12; // as `awan fly` has them where nothing else is said

// A path of these keys, from the second at which the clouds are seen; they stand while the camera flies.
export function pathOf(interpolation, keys, from = 0) {
  const camera = keys.map((key) => shortened({ ...key, time: from + key.time - keys[0].time }));
  const to = camera[camera.length - 1].time;
  return { from: camera[0].time, to, frames: Math.max(2, Math.round((to - from) * kFramesPerSecond) + 1), interpolation, clouds: "stand", camera };
}

// The file: a key a line.
export function textOf({ camera, ...rest }) {
  const members = Object.entries(rest).map(([name, value]) => `  ${JSON.stringify(name)}: ${JSON.stringify(value)},\n`);
  return `{\n${members.join("")}  "camera": [\n${camera.map((key) => `    ${JSON.stringify(key)}`).join(",\n")}\n  ]\n}\n`;
}
