// When to render. What is shown ends up being the latest state, whatever happens on the way:
//  * one request is in flight at a time; a change waits kSettleMs for its fellows;
//  * while a slider moves, the picture is made at reduced size; a small picture that is under way
//    may finish if it is young (so that a long drag shows something), anything else is cancelled;
//  * kIdleMs after the last movement the full picture is made;
//  * while time plays, small pictures are made one after the other, and none is cancelled.

import { Problem } from "./api.js";

const kSettleMs = 40;
const kIdleMs = 160;
const kYoungMs = 400;
const kSlowPreviewMs = 150; // a half-size picture that takes longer makes the next one a quarter

// render(reduction, signal) -> promise of a picture; reduction 1 is full size.
// shown(picture, { full }) -> promise, failed(problem); busy(true) from the first change until the
// full picture of the latest state is shown or has failed.
export function createRenderLoop({ render, shown, failed, busy }) {
  let want = null; // "full" | "preview" | null
  let flight = null; // { kind, started, controller }
  let startTimer = 0;
  let idleTimer = 0;
  let retryTimer = 0;
  let reduction = 2;

  function start() {
    startTimer = 0;
    if (flight || want === null) return; // the end of the flight calls start() again
    const kind = want;
    want = null;
    const mine = { kind, started: performance.now(), controller: new AbortController() };
    flight = mine;
    render(kind === "full" ? 1 : reduction, mine.controller.signal)
      .then((picture) => {
        if (mine.controller.signal.aborted) return undefined;
        if (kind === "preview") {
          const slow = performance.now() - mine.started > kSlowPreviewMs;
          reduction = slow ? 4 : 2;
        }
        return shown(picture, { full: kind === "full" });
      })
      .catch((error) => {
        if (mine.controller.signal.aborted) return;
        failed(error);
        if (error instanceof Problem && error.retryAfterSeconds !== null && want === null) {
          retryTimer = setTimeout(() => changed({ moving: false }), error.retryAfterSeconds * 1000);
        }
      })
      .finally(() => {
        flight = null;
        if (want !== null && !startTimer) start();
        if (want === null && !flight && !idleTimer) busy(false);
      });
  }

  function changed({ moving, playing = false }) {
    clearTimeout(retryTimer);
    clearTimeout(idleTimer);
    idleTimer = 0;
    busy(true);
    want = moving || playing ? "preview" : "full";
    if (moving && !playing) idleTimer = setTimeout(() => changed({ moving: false }), kIdleMs);
    if (flight) {
      const young = playing || performance.now() - flight.started < kYoungMs;
      if (!(want === "preview" && flight.kind === "preview" && young)) flight.controller.abort();
    }
    if (!startTimer) startTimer = setTimeout(start, playing ? 0 : kSettleMs);
  }

  return { changed };
}
