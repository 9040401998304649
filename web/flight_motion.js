// How a camera flies: a pose, the keys that are held, and where it is a moment later. Angles in degrees, y up; a heading
// of 0 looks along +z, one of 90 along +x.
//
//   pose { eye: [x, y, z], heading, pitch }
//   held: a set of the words forward, back, left, right (the way it moves), lookUp, lookDown, turnLeft, turnRight

const radians = (degrees) => (degrees * Math.PI) / 180;
const degrees = (angle) => (angle * 180) / Math.PI;

export const kSteepest = 85; // straight up and down, left and right would have no meaning

// The three speeds of Pakawan: radii of the cloud a second, degrees a second.
export const SPEEDS = { 1: { travel: 0.12, turn: 20 }, 2: { travel: 0.4, turn: 45 }, 3: { travel: 1.2, turn: 90 } };
// Around the cloud, the camera looks at its middle and stays outside; through it, it goes where it looks.
export const WAYS = ["through", "around"];
const kNearest = 1.02; // radii from the middle, around

export function forwardOf({ heading, pitch }) {
  const [h, p] = [radians(heading), radians(pitch)];
  return [Math.sin(h) * Math.cos(p), Math.sin(p), Math.cos(h) * Math.cos(p)];
}

// The pose of an eye that looks at `target`.
export function poseOf(eye, target) {
  const along = target.map((t, axis) => t - eye[axis]);
  const length = Math.hypot(...along);
  if (!(length > 0)) return { eye: [...eye], heading: 0, pitch: 0 };
  const pitch = degrees(Math.asin(along[1] / length));
  return { eye: [...eye], heading: degrees(Math.atan2(along[0], along[2])), pitch: Math.max(-kSteepest, Math.min(kSteepest, pitch)) };
}

// What a pose looks at: the point of its line of sight nearest to the cloud's middle, or one before it, where the cloud is
// behind. The picture turns about it when the flight is over.
export function targetOf(pose, { center, radius }) {
  const forward = forwardOf(pose);
  const ahead = forward.reduce((sum, f, axis) => sum + f * (center[axis] - pose.eye[axis]), 0);
  const reach = Math.max(radius / 4, ahead);
  return pose.eye.map((e, axis) => e + reach * forward[axis]);
}

const between = (held, more, less) => (held.has(more) ? 1 : 0) - (held.has(less) ? 1 : 0);

function through(pose, held, { travel, turn }) {
  const heading = pose.heading - between(held, "turnRight", "turnLeft") * turn;
  const pitch = Math.max(-kSteepest, Math.min(kSteepest, pose.pitch + between(held, "lookUp", "lookDown") * turn));
  const forward = forwardOf({ heading, pitch });
  const right = [-Math.cos(radians(heading)), 0, Math.sin(radians(heading))];
  const [ahead, aside] = [between(held, "forward", "back") * travel, between(held, "right", "left") * travel];
  return { eye: pose.eye.map((e, axis) => e + ahead * forward[axis] + aside * right[axis]), heading, pitch };
}

// Left and right go round the cloud, up and down over it and under it, forward and back nearer and farther.
function around(pose, held, { travel, turn }, { center, radius }) {
  const from = pose.eye.map((e, axis) => e - center[axis]);
  const away = Math.max(1e-6 * radius, Math.hypot(...from));
  // Whoever begins inside is not thrown out, but comes no nearer.
  const least = Math.min(kNearest * radius, away);
  const distance = Math.max(least, away - between(held, "forward", "back") * travel);
  const sideways = between(held, "right", "left") + between(held, "turnRight", "turnLeft");
  const azimuth = degrees(Math.atan2(from[0], from[2])) + Math.max(-1, Math.min(1, sideways)) * turn;
  const height = degrees(Math.asin(Math.max(-1, Math.min(1, from[1] / away)))) + between(held, "lookUp", "lookDown") * turn;
  const elevation = Math.max(-kSteepest, Math.min(kSteepest, height));
  const out = forwardOf({ heading: azimuth, pitch: elevation });
  return poseOf(center.map((c, axis) => c + distance * out[axis]), center);
}

// The pose `seconds` later. cloud: { center, radius }; speed: 1, 2 or 3.
export function moved(pose, held, seconds, { way, speed, cloud }) {
  const { travel, turn } = SPEEDS[speed];
  const step = { travel: travel * cloud.radius * seconds, turn: turn * seconds };
  return way === "around" ? around(pose, held, step, cloud) : through(pose, held, step);
}

const kDegreesPerPixel = 0.35; // around, as where nobody flies

// A look to the side by a drag of so many pixels, of a picture `height` pixels high: what is under the pointer goes with it.
export function turnedBy(pose, dx, dy, { way, cloud, fov, height }) {
  if (way !== "around") {
    const perPixel = fov / Math.max(1, height);
    return {
      ...pose, heading: pose.heading + dx * perPixel, pitch: Math.max(-kSteepest, Math.min(kSteepest, pose.pitch + dy * perPixel)),
    };
  }
  const turned = (from, word, pixels) => around(from, new Set([word]), { travel: 0, turn: kDegreesPerPixel * pixels }, cloud);
  return turned(turned(pose, "left", dx), "lookUp", dy);
}
