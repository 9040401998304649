// What accuracy costs, measured: every rung where its time and its error are, both in powers of ten. A point is a button
// that chooses its rung.

import { el } from "./dom.js";

const kMargin = 0.08; // of the range, at either end
const kFewestMarks = 3;

const SIDES = [["after", "high"], ["after", "low"], ["before", "high"], ["before", "low"]]; // of a point, where its name may stand

const svg = (tag, attributes) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
};

// Round values between two, for an axis in powers of ten: the powers, and 2 and 5 times them where those are few.
export function marksBetween(least, most) {
  const within = (factors) => {
    const marks = [];
    for (let power = Math.floor(Math.log10(least)); power <= Math.log10(most); power += 1) {
      for (const factor of factors) {
        const value = Number((factor * 10 ** power).toPrecision(3));
        if (value >= least && value <= most) marks.push(value);
      }
    }
    return marks;
  };
  const powers = within([1]);
  return powers.length >= kFewestMarks ? powers : within([1, 2, 5]);
}

// { at(value) -> 0..1 along the axis, marks } of some values > 0.
function axisOf(values) {
  const logs = values.map(Math.log10);
  let [low, high] = [Math.min(...logs), Math.max(...logs)];
  if (high - low < 0.5) [low, high] = [(low + high) / 2 - 0.25, (low + high) / 2 + 0.25];
  const margin = kMargin * (high - low);
  [low, high] = [low - margin, high + margin];
  return { at: (value) => (Math.log10(value) - low) / (high - low), marks: marksBetween(10 ** low, 10 ** high) };
}

// Those that no other beats in both, by their time.
const best = (rungs) => rungs.filter((one) => !rungs.some((other) => other.time_ms < one.time_ms && other.error <= one.error))
  .sort((a, b) => a.time_ms - b.time_ms);

// choose(name): a point was clicked. timeText, errorText: of a number.
export function createPlot({ choose, timeText, errorText }) {
  const element = el("div", { class: "accuracy-plot", role: "group", "aria-label": "Error of every rung over its time" });
  let points = [];
  const put = (one, x, y) => {
    one.style.setProperty("left", `${(100 * x).toFixed(2)}%`);
    one.style.setProperty("bottom", `${(100 * y).toFixed(2)}%`);
    return one;
  };
  // Names stand where they hide no other and no point, as far as that can be.
  function settle() {
    const area = element.querySelector(".area");
    if (!area) return;
    const frame = area.getBoundingClientRect();
    const dots = points.map((point) => point.getBoundingClientRect());
    const placed = [];
    const over = (a, b) => Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
    for (const point of points) {
      const tries = SIDES.map((side) => {
        point.classList.remove(...SIDES.flat());
        point.classList.add(...side);
        const box = point.firstChild.getBoundingClientRect();
        const outside = Math.max(0, frame.left - box.left) + Math.max(0, box.right - frame.right);
        const hidden = [...placed, ...dots.filter((_dot, i) => points[i] !== point)].reduce((sum, other) => sum + over(box, other), 0);
        return { side, box, cost: hidden + 100 * outside };
      });
      const chosen = tries.reduce((a, b) => (b.cost < a.cost ? b : a));
      point.classList.remove(...SIDES.flat());
      point.classList.add(...chosen.side);
      placed.push(chosen.box);
    }
  }
  new ResizeObserver(settle).observe(element);

  return {
    element,
    // rungs: [{ rung, time_ms, error }], measured; here: the name of the chosen one.
    show(rungs, here) {
      const shown = rungs.filter(({ time_ms: ms, error }) => ms > 0 && error > 0);
      if (!shown.length) {
        element.replaceChildren(el("p", { class: "why" }, "No rung could be measured."));
        points = [];
        return;
      }
      const [across, up] = [axisOf(shown.map(({ time_ms: ms }) => ms)), axisOf(shown.map(({ error }) => error))];
      const front = best(shown).map(({ time_ms: ms, error }) => `${100 * across.at(ms)},${100 - 100 * up.at(error)}`).join(" ");
      const lines = svg("svg", { viewBox: "0 0 100 100", preserveAspectRatio: "none", "aria-hidden": "true" });
      for (const mark of across.marks) lines.append(svg("line", { x1: 100 * across.at(mark), x2: 100 * across.at(mark), y1: 0, y2: 100 }));
      for (const mark of up.marks) lines.append(svg("line", { y1: 100 - 100 * up.at(mark), y2: 100 - 100 * up.at(mark), x1: 0, x2: 100 }));
      lines.append(svg("polyline", { points: front }));
      points = [...shown].sort((a, b) => a.time_ms - b.time_ms).map(({ rung, time_ms: ms, error }) => {
        const text = `${rung}: ${errorText(error)} error in ${timeText(ms)}`;
        return put(el("button", { type: "button", class: "point", title: text, "aria-label": text, "data-rung": rung, onclick: () => choose(rung) },
          el("span", { "aria-hidden": "true" }, rung)), across.at(ms), up.at(error));
      });
      element.replaceChildren(
        el("div", { class: "area" }, lines, ...points),
        el("div", { class: "marks up", "aria-hidden": "true" }, ...up.marks.map((mark) => put(el("span", {}, errorText(mark)), 0, up.at(mark)))),
        el("div", { class: "marks across", "aria-hidden": "true" }, ...across.marks.map((mark) => put(el("span", {}, timeText(mark)), across.at(mark), 0))),
        el("p", { class: "why", "aria-hidden": "true" }, "Error against the traced truth, upwards; time of a picture, to the right. The line: no other is both faster and truer."));
      this.mark(here);
      settle();
    },
    mark(here) {
      for (const point of points) point.setAttribute("aria-pressed", String(point.dataset.rung === here));
    },
  };
}
