// When to render, and how finely. What is shown ends up being the latest state, whatever happens on the way:
//  * one request is in flight at a time, and the latest state waits for it;
//  * while something moves, and first of all after any other edit, a picture is made coarsely: small, and with little
//    time for its light. Coarse pictures are never cancelled, so that a long drag shows one after the other;
//  * once the pointer is let go, or nothing has moved for kRestMs, the picture is refined: at half its size, if the whole
//    takes long, and whole. A newer state cancels what refines an older one;
//  * while time plays, coarse pictures are made one after the other.
// Coarse pictures have the cloud's lumps, which make most of its shape. Where even small ones take too long with them, those of
// something that moves are without, and where that takes too long, they have a glow instead of the light of the whole picture.
// The first of a document is as the service thinks it can be in a short time.

import { Problem } from "./api.js";

const kSettleMs = 30; // a change waits so long for its fellows
const kRestMs = 400;
// How many times smaller the sides of coarse pictures are than the whole one's: more after one that took long, fewer after one
// that took next to nothing.
const COARSE = [2, 4, 8, 12];
const kSlowCoarseMs = 150;
const kVerySlowCoarseMs = 350;
const kFastCoarseMs = 40;
const LOOKS = ["lumps", "plain", "glow"];
// Two after the other that take so long at the smallest size, or one that takes so very long at any, are followed by others.
const SLOW_LOOK_MS = [220, 400, Infinity], kVerySlowLookMs = 700;
const kVerySlowFirstMs = 900; // the first of a document has all its light to make
const kShortWholeMs = 250; // what is expected to take no longer needs none before it
const kLongWholeMs = 1200; // what is expected to take longer is shown at half its size before

// render({ reduction, quick, look }, signal) -> promise of a picture with sides `reduction` times smaller, `quick`: coarsely, of
// one of LOOKS, or "any". isKept of it: the service had it already, so that it says nothing of times; isLit: as a whole one is.
// shown(picture, { whole }) -> promise, failed(problem).
// busy(true) from the first change until the whole picture of the latest state is shown or has failed.
// marked(how): what the picture on the screen is: "" of the latest state and whole, "coarse" of it, "earlier" of a state
// before, and there will be none of the latest; "unrefined": coarse, and what was to follow has failed.
export function createRenderLoop({ render, shown, failed, busy, marked }) {
  let version = 0; // of the state
  let onScreen = { version: -1, step: "" };
  let failedVersion = -1;
  let want = null; // the next step: "coarse" | "half" | "whole" | null
  let flight = null; // { step, version, started, controller }
  let moving = false;
  let playing = false;
  let startTimer = 0;
  let restTimer = 0;
  let retryTimer = 0;
  let size = 2; // of coarse pictures: which of COARSE
  let look = -1; // of those that move: which of LOOKS; -1: nothing is known yet
  let slow = 0; // of these, one after the other
  let wholeMs = Infinity; // what the whole picture is expected to take

  function nextStep() {
    if (failedVersion === version) return null;
    const shownOfIt = onScreen.version === version ? onScreen.step : "";
    if (shownOfIt === "whole") return null;
    const isPoor = shownOfIt === "" || (shownOfIt === "coarse" && onScreen.look > lookAtRest());
    if (isPoor && wholeMs > kShortWholeMs) return "coarse";
    return shownOfIt !== "half" && wholeMs > kLongWholeMs ? "half" : "whole";
  }

  function mark() {
    if (onScreen.version === version) marked(onScreen.step === "whole" ? "" : failedVersion === version ? "unrefined" : "coarse");
    else if (failedVersion === version) marked("earlier");
  }

  // What can be had with lumps at all, has them when it rests.
  const lookAtRest = () => (look === 1 ? 0 : look);
  // What a coarse picture took says how the next will be.
  function learn(took, of, isLit) {
    const last = COARSE.length - 1;
    const isVerySlow = took > kVerySlowLookMs;
    const isSlow = isVerySlow || (size === last && took > SLOW_LOOK_MS[Math.max(of, 0)]);
    slow = isSlow ? slow + 1 : 0;
    const before = look;
    if (of === -1) look = took > kVerySlowFirstMs ? LOOKS.length - 1 : isLit ? 0 : 1;
    else if (of === look && (slow > 1 || isVerySlow)) look = Math.min(look + 1, LOOKS.length - 1);
    else if (of < look && !isSlow) look = of;
    if (look !== before) slow = 0;
    if (took > kSlowCoarseMs) size = Math.min(size + (took > kVerySlowCoarseMs ? 2 : 1), last);
    if (took < kFastCoarseMs) size = Math.max(size - 1, 0);
  }

  function start() {
    startTimer = 0;
    if (flight) return; // its end calls start() again
    if (want === null && !moving && !playing) want = nextStep();
    if (want === null) {
      if (!restTimer) busy(false);
      return;
    }
    const quick = want === "coarse";
    const mine = { step: want, version, started: performance.now(), controller: new AbortController() };
    mine.look = moving || playing ? look : lookAtRest();
    const { signal } = mine.controller;
    want = null;
    flight = mine;
    render({ reduction: { coarse: COARSE[size], half: 2, whole: 1 }[mine.step], quick, look: LOOKS[mine.look] ?? "any" }, signal)
      .then(async (picture) => {
        if (signal.aborted) return;
        const took = performance.now() - mine.started;
        if (!picture.isKept && mine.step === "whole") wholeMs = took;
        if (!picture.isKept && quick) learn(took, mine.look, picture.isLit);
        await shown(picture, { whole: mine.step === "whole" });
        onScreen = mine;
      })
      .catch((error) => {
        if (signal.aborted || (mine.version !== version && want !== null)) return; // the latest state speaks for itself
        failedVersion = mine.version;
        failed(error);
        if (error instanceof Problem && error.retryAfterSeconds !== null && mine.version === version) {
          retryTimer = setTimeout(() => changed({ moving: false }), error.retryAfterSeconds * 1000);
        }
      })
      .finally(() => {
        flight = null;
        mark();
        if (!startTimer) start();
      });
  }

  function rest() {
    restTimer = 0;
    moving = false;
    if (!startTimer) start();
  }

  // same: the state is what it was. another: it is another document, whose pictures take another time.
  function changed({ moving: moves, playing: plays = false, same = false, another = false }) {
    clearTimeout(retryTimer);
    clearTimeout(restTimer);
    restTimer = 0;
    if (!same) version += 1;
    if (another) [wholeMs, look] = [Infinity, -1];
    [moving, playing] = [moves && !plays, plays];
    busy(true);
    if (flight && flight.step !== "coarse" && flight.version !== version) flight.controller.abort();
    want = !same && (moving || playing) ? "coarse" : null;
    if (moving) restTimer = setTimeout(rest, kRestMs);
    if (!startTimer) startTimer = setTimeout(start, playing ? 0 : kSettleMs);
  }

  // The pointer is let go: nothing is waited for.
  function letGo() {
    if (!restTimer) return;
    clearTimeout(restTimer);
    rest();
  }

  return { changed, letGo };
}
