// The sky that particles are seen before, while something moves: the service's own map of it, as a strip of colours along the
// height of the picture, for the way the camera looks. Until it is there, and where it does not come, that of workspace.css.

import * as api from "./api.js";
import { poseOf } from "./flight_motion.js";
import { compactJson } from "./json_text.js";

const kMapWide = 128, kMapHigh = 64; // pixels
const kTurn = 6; // degrees that the eye turns before the colours are looked up anew
const kHorizon = 0.64, kPicture = 0.4; // of the strip's height, as workspace.css has it: where the horizon is, how high the picture
const ELEVATIONS = [50, 35, 25, 17, 11, 7, 4, 2, 0.7, -0.7, -2, -5, -12, -30]; // degrees, of the colours of the strip
const kFarthest = 5; // pictures' heights that the horizon may be away: then it is out of sight anyway
const OF_SKY = ["sun", "sky", "haze", "image"]; // members of a scene that its sky depends on

const radians = (degrees) => (degrees * Math.PI) / 180;

// The colour [red, green, blue] of a map of the sky, { width, height, data } with four bytes a pixel, at an elevation and a
// heading (0: +z, in the map's middle; 90: +x, a quarter from the left).
export function colourOf({ width, height, data }, elevation, heading) {
  const column = Math.floor((((0.5 - heading / 360) % 1) + 1) % 1 * width) % width;
  const row = Math.min(height - 1, Math.max(0, ((90 - elevation) / 180) * height - 0.5));
  const low = Math.min(height - 2, Math.floor(row));
  return [0, 1, 2].map((channel) => {
    const [a, b] = [low, low + 1].map((line) => data[4 * (line * width + column) + channel]);
    return Math.round(a + (row - low) * (b - a));
  });
}
// Colours and where they are, 0 at the strip's top, 1 at its bottom; places may lie outside. fov: of the height, degrees.
export function stripOf(map, heading, fov) {
  return ELEVATIONS.map((elevation) => ({
    colour: `rgb(${colourOf(map, elevation, heading).join(" ")})`,
    at: kHorizon - (kPicture * Math.tan(radians(elevation))) / (2 * Math.tan(radians(fov) / 2)),
  }));
}

export function createSky(stage) {
  let map = null;
  let asked = null; // members of the scene that the map is of, or that it was asked for
  let shown = null; // { map, heading, fov } of what is on the screen
  let last = null; // what the camera saw

  function colour(heading, fov) {
    if (!map || (shown && shown.map === map && shown.fov === fov && Math.abs(((heading - shown.heading + 540) % 360) - 180) < kTurn)) return;
    shown = { map, heading, fov };
    const strip = stripOf(map, heading, fov);
    stage.style.setProperty("--sky", `linear-gradient(${strip.map((one) => `${one.colour} ${(100 * one.at).toFixed(1)}%`).join(", ")})`);
    stage.style.setProperty("--above", strip[0].colour);
    stage.style.setProperty("--below", strip[strip.length - 1].colour);
  }
  // The camera looks from `eye` to `target`; fov: of the height, degrees.
  function look({ eye, target, fov }) {
    last = { eye, target, fov };
    const { heading, pitch } = poseOf(eye, target);
    // Where the horizon is, of the picture's height.
    const down = 0.5 + (0.5 * Math.tan(radians(pitch))) / Math.tan(radians(fov) / 2);
    stage.style.setProperty("--horizon", `${(Math.max(-kFarthest, Math.min(kFarthest, down)) * stage.clientHeight).toFixed(1)}px`);
    stage.classList.toggle("below", down < 0);
    colour(heading, fov);
  }
  return {
    look,
    // Asks for the map where the scene's sky is another one.
    async ask(scene) {
      const members = JSON.stringify(OF_SKY.map((name) => scene[name] ?? null));
      if (members === asked) return;
      asked = members;
      try {
        const { sequence: _sequence, accuracy: _accuracy, ...rest } = scene;
        const image = await createImageBitmap(await api.sky(compactJson(rest), kMapWide));
        const pen = Object.assign(document.createElement("canvas"), { width: kMapWide, height: kMapHigh }).getContext("2d", { willReadFrequently: true });
        pen.drawImage(image, 0, 0);
        if (asked !== members) return;
        map = pen.getImageData(0, 0, kMapWide, kMapHigh);
        if (last) look(last);
      } catch {
        // There are colours already; with the next picture it is asked for again.
        if (asked === members) asked = null;
      }
    },
  };
}
