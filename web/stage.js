// The picture itself: showing it without flicker, and moving around the cloud with pointer, wheel
// and keys.

import { byId } from "./dom.js";

const DEGREES_PER_PIXEL = 0.35;
const kSlopPixels = 8; // a finger that has moved less has not said where it goes
const KEY_DEGREES = 5;
const KEY_RATIO = 0.9;

// nudge(step, options): around the cloud. letGo(): the pointer has been. toggle(): play or pause; false when nothing can move.
export function createStage({ nudge, letGo, toggle }) {
  const stage = byId("stage");
  const image = byId("picture");
  let url = null;
  let order = 0; // of calls to show(): decoding may end out of order

  async function show(blob, description) {
    const mine = ++order;
    const next = URL.createObjectURL(blob);
    const loaded = new Image();
    loaded.src = next;
    await loaded.decode().catch(() => {});
    if (mine !== order) {
      URL.revokeObjectURL(next);
      return;
    }
    image.src = next;
    image.alt = description;
    if (url) URL.revokeObjectURL(url);
    url = next;
  }

  // The box keeps the shape of the full picture, so that nothing moves when a small one is shown.
  function shape(width, height, transparent) {
    if (width > 0 && height > 0) byId("left").style.setProperty("--ratio", String(width / height));
    stage.classList.toggle("transparent", transparent);
  }

  // A finger may be on its way down the page: it orbits once it has gone sideways first, and the browser scrolls where it
  // has not (touch-action in page.css). Two fingers go nearer and farther, and tilt.
  const fingers = new Map(); // of pointers that are down: { x, y }
  let decided = false; // that what moves is for the picture
  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || event.target.closest("#status")) return;
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    decided = event.pointerType !== "touch" || fingers.size > 1;
    stage.setPointerCapture(event.pointerId);
    stage.classList.add("dragging");
  });
  const middle = ([a, b = a]) => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) });
  stage.addEventListener("pointermove", (event) => {
    const finger = fingers.get(event.pointerId);
    if (!finger || fingers.size > 2) return;
    const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
    if (!dx && !dy) return;
    if (!decided) {
      if (Math.hypot(dx, dy) < kSlopPixels) return;
      if (Math.abs(dy) > Math.abs(dx)) return;
      decided = true;
    }
    const before = middle([...fingers.values()]);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const now = middle([...fingers.values()]);
    nudge({
      azimuth: (before.x - now.x) * DEGREES_PER_PIXEL, elevation: (now.y - before.y) * DEGREES_PER_PIXEL,
      nearer: before.apart > kSlopPixels && now.apart > kSlopPixels ? before.apart / now.apart : 1,
    }, { moving: true });
  });
  const release = (event) => {
    if (!fingers.delete(event.pointerId)) return;
    if (fingers.size) return;
    letGo();
    stage.classList.remove("dragging");
  };
  stage.addEventListener("pointerup", release);
  stage.addEventListener("pointercancel", release);
  stage.addEventListener("wheel", (event) => {
    if (event.ctrlKey) return; // the browser's own zoom
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 30 : 1);
    nudge({ nearer: Math.exp(Math.max(-200, Math.min(200, pixels)) * 0.0012) }, { moving: true });
  }, { passive: false });

  const KEYS = {
    ArrowLeft: { azimuth: -KEY_DEGREES }, ArrowRight: { azimuth: KEY_DEGREES },
    ArrowUp: { elevation: KEY_DEGREES }, ArrowDown: { elevation: -KEY_DEGREES },
    "+": { nearer: KEY_RATIO }, "=": { nearer: KEY_RATIO }, "-": { nearer: 1 / KEY_RATIO },
  };
  stage.addEventListener("keydown", (event) => {
    if (event.key === " " && event.target === stage && toggle()) {
      event.preventDefault(); // the page would scroll
      return;
    }
    const step = KEYS[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    nudge(step, { moving: true });
  });
  return { show, shape };
}
