// Where errors are shown: at the field that the service's JSON pointer names, or at the nearest
// enclosing group that the page has; and always in the status line.

import { el, freshId } from "./dom.js";

// Elements that stand for a place in the document carry its pointer in data-pointer. One that the
// document at hand does not show (of another model, of a switch that is off) can show no problem.
function elementAt(pointer) {
  for (let p = pointer; p; p = p.slice(0, p.lastIndexOf("/"))) {
    const found = [...document.querySelectorAll(`[data-pointer="${CSS.escape(p)}"]`)].find((element) => !element.closest("[hidden]"));
    if (found) return found;
  }
  return document.querySelector('[data-pointer=""]'); // the document as text
}

const inputsOf = (element) =>
  element.matches("input, select, textarea") ? [element] : [...element.querySelectorAll("input, select, textarea")];

let marked = []; // undo functions of what mark() did
let shown = null; // { element, text, message } of the problem that is marked

function mark(element, text) {
  const id = freshId("problem");
  const message = el("p", { id, class: "problem" }, text);
  const row = element.closest("tr");
  let placed = message;
  if (row) { // a cell is too narrow for a sentence
    placed = el("tr", { class: "problem-row" }, el("td", { colspan: row.cells.length }, message));
    row.after(placed);
  } else if (element.matches("details")) {
    element.querySelector("summary").after(message);
  } else {
    (element.closest(".field") ?? element).append(message); // an axis of a vector: beneath all three
  }
  const inputs = element.matches("details") ? [] : inputsOf(element);
  for (const input of inputs) {
    input.setAttribute("aria-invalid", "true");
    input.setAttribute("aria-describedby", id);
  }
  shown = { element, text, message };
  marked.push(() => {
    placed.remove();
    for (const input of inputs) {
      input.removeAttribute("aria-invalid");
      input.removeAttribute("aria-describedby");
    }
  });
}

export function clearMarks() {
  marked.forEach((undo) => undo());
  marked = [];
  shown = null;
}

// Marks the field of the problem. True when one was found.
export function markProblem({ pointer, message }) {
  const element = pointer ? elementAt(pointer) : null;
  // What stands there already stays: whoever reads it is not interrupted.
  if (element && shown?.element === element && shown.text === message && shown.message.isConnected) return true;
  clearMarks();
  if (element) mark(element, message);
  return element !== null;
}

// Puts the focus where the problem is, opening what hides it.
export function focusProblem(pointer) {
  const element = elementAt(pointer);
  if (!element) return;
  for (let box = element.closest("details"); box; box = box.parentElement.closest("details")) box.open = true;
  const [input] = inputsOf(element);
  (input ?? element).focus();
  (input ?? element).scrollIntoView({ block: "center" });
}

// What one element of a list is called; "ellipsoids" is also the name of a model.
const NOUNS = { cubes: "cube", clouds: "cloud", primitives: "primitive", formations: "formation", attractors: "attractor", vortices: "vortex", keys: "key" };
const VECTORS = ["size", "center", "eye", "target", "up", "translate", "direction", "velocity", "radii", "cells", "smooth",
  "smallest", "largest", "drift", "jet", "ripple", "rotate", "spread", "force", "at", "axis", "min", "max"];

// "/cubes/3/size/1" -> "cube 4, size y": people count from one. What is no JSON pointer ("line 14")
// stays as it is.
export function placeName(pointer) {
  if (!pointer.startsWith("/")) return pointer;
  const words = [];
  const parts = pointer.split("/").slice(1);
  const axes = ["x", "y", "z"];
  parts.forEach((part, i) => {
    const list = parts[i - 1];
    if (!/^\d+$/.test(part)) words.push(NOUNS[part] ?? part.replaceAll("_", " "));
    else if (NOUNS[list] || (list === "ellipsoids" && i + 1 < parts.length)) words.push(`${Number(part) + 1},`);
    else if (VECTORS.includes(list)) words.push(axes[part] ?? part);
    else words.push(String(Number(part) + 1));
  });
  return words.join(" ").replace(/,$/, "");
}
