// While something moves, the particles are shown at once and the picture follows; when it is there, the one goes over into
// the other. Particles are asked for when the matter has changed: one request under way, and the latest state waits. Their
// light is asked of the service while nothing moves; until it is there, and where sun or matter have moved since, it is
// estimated, and what is known is changed as the estimate changes.

import * as api from "./api.js";
import { compactJson } from "./json_text.js";
import { denser, displayed, gainOf, litFrom, readPly, relit, sparser } from "./workspace_particles.js";

const kMost = 100_000, kMostSoftware = 5000; // sprites; more would not be drawn in time, with a GPU and without
const kFadeMs = 220;
const kRestMs = 350;
const kMostLit = 400_000; // particles; the light of more is not waited for
const kSlowFrameMs = 60; // where frames take longer, the pictures of the service are as quick
const kFramesWatched = 12;
// Of the screen's pixels along a side that sprites are drawn with: the fewest, in flights whose frames take too long; without a
// GPU from the beginning; and what frames are meant to take then.
const kLeastDetail = 1 / 10, kSoftwareDetail = 1 / 4, kWantedMs = 25;
const kTriedAgainMs = 30_000;
const kSeenWide = 64, kSeenHigh = 40; // pixels that brightness is compared at
const ELSEWHERE = new Set(["camera", "image", "sun", "sky", "ground", "haze", "accuracy", "effects", "sequence", "look", "display"]);

// view(): of workspace_view.js, or null. scene() -> the document; seen() -> the same, as thick as a flight shows it; sun() ->
// unit vector to it; tone() -> of the picture.
export function createSpriteLoop({ view, scene, seen, sun, tone }) {
  let known = null; // { matter, set } of what is shown
  let flight = false;
  let wanted = null;
  let moving = false;
  let lastMove = 0;
  let opacity = 0;
  let fading = 0;
  let slowUntil = 0; // no sprites before
  let frames = [];
  let isShown = false; // the picture on the screen is of the latest state
  let detail = null; // share of the screen's pixels along a side, once it is known what draws
  let slowFrames = 0; // of a flight, one after the other
  let flying = false; // whoever flies has nothing else to see by: sprites are shown however slowly
  let thickness = 1; // times the matter of the document
  let shown = null; // { light, then } of the service's last answer: as it is shown, and what was estimated of the same
  let lightFlight = null; // an AbortController of the request for it
  let litScene = null; // what it was last asked for
  const stage = document.getElementById("stage");
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");

  const matterOf = (document) => Object.entries(document).filter(([name]) => !ELSEWHERE.has(name));
  const same = (a, b) => a.length === b.length && a.every(([name, value], i) => b[i][0] === name && b[i][1] === value);

  function fade(to) {
    cancelAnimationFrame(fading);
    const from = opacity;
    const begun = performance.now();
    const step = (now) => {
      const share = to > from || still.matches ? 1 : Math.min(1, (now - begun) / kFadeMs);
      opacity = from + (to - from) * share;
      view()?.spritesAt(opacity);
      stage.classList.toggle("sprites", opacity > 0.5);
      if (share < 1) fading = requestAnimationFrame(step);
    };
    step(begun);
  }
  // The light of the service, as far as its picture tells: how bright, and of what colour, it has the same cloud.
  function learn() {
    const picture = document.getElementById("picture");
    if (!isReady() || !picture.naturalWidth || !same(known.matter, matterOf(scene()))) return;
    const pen = Object.assign(document.createElement("canvas"), { width: kSeenWide, height: kSeenHigh }).getContext("2d", { willReadFrequently: true });
    pen.drawImage(picture, 0, 0, kSeenWide, kSeenHigh);
    const { data } = pen.getImageData(0, 0, kSeenWide, kSeenHigh);
    const gain = gainOf(view().spritesSeen(kSeenWide, kSeenHigh), data, kSeenWide, kSeenHigh);
    if (gain) view().spritesGain(gain);
  }
  const most = () => (view()?.isSoftware ? kMostSoftware : kMost);
  // Without a GPU, the pictures of the service are quicker.
  const isQuick = () => flying || (performance.now() >= slowUntil && !view().isSoftware);
  const isReady = () => known !== null && known.set !== null && view() !== null && isQuick();
  function sharpen(share) {
    [detail, slowFrames] = [share, 0];
    view()?.detail(share);
  }
  function light() {
    const set = denser(known.set, thickness);
    const estimate = litFrom(set, sun());
    const isKnown = shown?.light.length === estimate.length;
    view()?.particles(set, isKnown ? relit(shown.light, shown.then, estimate) : estimate);
    document.getElementById("stage").dataset.light = isKnown ? "service" : "estimate";
  }
  // The service's own, when nothing moves. Nobody misses it where it does not come.
  async function askLight() {
    const document = seen();
    if (!known?.set || !view() || document === litScene || lightFlight || known.whole > kMostLit) return;
    if ((document.look ?? "physical") !== "physical") return; // a look has no light
    const controller = new AbortController();
    lightFlight = controller;
    litScene = document;
    const { sequence: _sequence, accuracy: _accuracy, ...rest } = document;
    try {
      const { buffer, exposure } = await api.litParticles(compactJson(rest), { signal: controller.signal });
      const set = sparser(readPly(buffer), most());
      if (controller.signal.aborted || !set.radiance || set.count !== known.set?.count) return;
      shown = { light: displayed(set.radiance, exposure, tone()), then: litFrom(set, sun()) };
      view()?.spritesGain([1, 1, 1]);
      light();
      if (isShown) learn();
    } catch {
      // The estimate does.
    } finally {
      lightFlight = null;
    }
  }
  // Whoever moves something wants pictures first.
  function dropLight() {
    if (!lightFlight) return;
    lightFlight.abort();
    litScene = null;
  }

  async function ask() {
    const document = scene();
    const matter = matterOf(document);
    if (known && same(known.matter, matter)) return;
    if (flight) {
      wanted = true;
      return;
    }
    flight = true;
    try {
      const { image: _image, sequence: _sequence, ...rest } = document;
      const blob = await api.particles(compactJson(rest), "application/x-ply");
      const set = readPly(await blob.arrayBuffer());
      known = { matter, set: sparser(set, most()), whole: set.count };
      light();
      if (isShown) {
        learn();
        askLight();
      }
      if (moving && isReady() && opacity === 0) fade(1);
    } catch {
      // The picture says what is wrong.
      known = { matter, set: null };
      if (opacity > 0) fade(0);
    } finally {
      flight = false;
      if (wanted) {
        wanted = null;
        ask();
      }
    }
  }
  function watch(now) {
    if (!moving || opacity === 0) {
      frames = [];
      return;
    }
    frames.push(now);
    if (frames.length > kFramesWatched && !flying) {
      const isSlow = (now - frames[0]) / (frames.length - 1) > kSlowFrameMs;
      frames = [];
      if (isSlow) {
        slowUntil = now + kTriedAgainMs;
        fade(0);
      }
    }
    requestAnimationFrame(watch);
  }

  return {
    // The document has changed; `moves`: something is being dragged; `another`: it is another one.
    changed(moves, another) {
      isShown = false;
      dropLight();
      if (another) shown = null;
      if (!view()) return;
      const begins = moves && !moving;
      moving = moves;
      if (moves) lastMove = performance.now();
      ask();
      if (moving && isReady() && opacity === 0) fade(1);
      if (begins) requestAnimationFrame(watch);
    },
    lit() {
      if (known?.set && view()) light();
    },
    letGo() { moving = false; },
    // There is something to draw with.
    begin() {
      sharpen(view().isSoftware ? kSoftwareDetail : 1);
      ask();
    },
    // A flight begins or ends; of a cloud that is so many times as thick as the document's.
    flies(yes, times = 1) {
      flying = yes;
      if (times !== thickness) {
        thickness = times;
        this.lit();
      }
      if (!yes) moving = false;
      ask();
    },
    // The eye of a flight moves. False when there are no particles to show.
    moves() {
      isShown = false;
      const now = performance.now();
      const took = now - lastMove;
      slowFrames = moving && took > kSlowFrameMs ? slowFrames + 1 : 0;
      // One long frame says nothing: others had the processor.
      if (slowFrames >= 2) sharpen(Math.max(kLeastDetail, detail * Math.max(Math.sqrt(kWantedMs / took), 1 / 4)));
      moving = true;
      lastMove = now;
      if (isReady() && opacity === 0) fade(1);
      return isReady();
    },
    get count() { return known?.set?.count ?? 0; },
    // A picture of the latest state is on the screen. While the pointer is on its way, the next is about to be late again.
    settled() {
      if (moving && performance.now() - lastMove < kRestMs) return;
      moving = false;
      isShown = true;
      if (!view()?.isSoftware) sharpen(1);
      if (opacity > 0) fade(0);
      learn();
      askLight();
    },
  };
}
