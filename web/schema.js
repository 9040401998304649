// What the service says a scene document may hold: the scene part of /openapi.json, asked for once. Every control takes
// its default, its ends, its words and its hint from here, so that the page has none of its own to go out of date.

import * as api from "./api.js";
import { at, steps } from "./document.js";

const { schemas } = (await api.contract()).components;

const isIndex = (name) => /^\d+$/.test(name);

// The schemas one of which a value has to fit: the node itself, or what it refers to and gives a choice of.
function alternatives(node) {
  const whole = node.$ref === undefined ? node : schemas[node.$ref.split("/").pop()];
  const choice = whole.properties ? undefined : whole.oneOf ?? whole.anyOf;
  return choice ? choice.flatMap(alternatives) : [whole];
}

function inside(node, name) {
  if (node.properties?.[name]) return node.properties[name];
  return node.items && isIndex(name) ? node.items : [];
}

// All schemas that the place of a pointer may have: a cloud's `density` stands in every model's. They are the same for
// every element of a list, so they are kept by the pointer of the first.
const known = new Map();
function schemasAt(pointer) {
  const first = pointer.replace(/\/\d+(?=\/|$)/g, "/0");
  if (!known.has(first)) {
    known.set(first, steps(first).reduce(
      (nodes, name) => nodes.flatMap(alternatives).flatMap((node) => inside(node, name)), [schemas.Scene]));
  }
  return known.get(first);
}

// What may stand at a pointer of a scene; null where nothing may.
//   standard       the default, unless another field decides it (standardAt)
//   least, most    both ends of a number, or of each component of a vector; `above`: more than `least`
//   whole, orZero  only whole numbers; 0, too, wherever the range begins
//   words          those it may be; []: none
//   pattern        that its text has, if any
//   examples       some of those it may be, where there are others
//   names, functions   what a formula may use, each with what it is
//   unit, says     for people; undefined where the service says nothing
export function fieldAt(pointer) {
  const nodes = schemasAt(pointer);
  if (nodes.length === 0) return null;
  const values = nodes.flatMap(alternatives);
  const numbers = values.flatMap((value) => (value.items ? alternatives(value.items) : [value]))
    .filter(({ type }) => type === "number" || type === "integer");
  const range = numbers.find(({ const: only }) => only === undefined) ?? {};
  const [{ description: says, "x-unit": unit, default: standard }] = nodes;
  return {
    standard, says, unit,
    least: range.exclusiveMinimum ?? range.minimum, above: range.exclusiveMinimum !== undefined, most: range.maximum,
    whole: range.type === "integer", orZero: numbers.some(({ const: only }) => only === 0),
    words: [...new Set(values.flatMap((value) => value.enum ?? []))],
    pattern: values.find((value) => value.pattern)?.pattern,
    examples: values.flatMap((value) => value.examples ?? []),
    names: values.find((value) => value["x-names"])?.["x-names"],
    functions: values.find((value) => value["x-functions"])?.["x-functions"],
  };
}

// What the word of one field decides about the others of an object: its primitives by the preset, say. A word may stand
// for the whole object. {}: nothing.
export function presetAt(scene, pointer) {
  const object = schemasAt(pointer).flatMap(alternatives).find((node) => node["x-presets"]);
  if (!object) return {};
  const { "x-presets-by": by, "x-presets": presets, properties } = object;
  const value = at(scene, pointer);
  const word = typeof value === "string" ? value : value?.[by];
  return presets[word] ?? presets[properties[by].default];
}

// What the service takes where the scene says nothing at the pointer; undefined where that is no value.
export function standardAt(scene, pointer) {
  if (pointer === "") return undefined;
  const cut = pointer.lastIndexOf("/");
  const [holder, member] = [pointer.slice(0, cut), pointer.slice(cut + 1)];
  const own = presetAt(scene, holder)[member] ?? fieldAt(pointer)?.standard;
  if (own !== undefined) return own;
  // A component of a vector's default, a member of an object's.
  const whole = standardAt(scene, holder);
  return whole !== null && typeof whole === "object" ? whole[member] : undefined;
}

export function atOrDefault(scene, pointer) {
  return at(scene, pointer) ?? standardAt(scene, pointer);
}

// The ends of a field that is shown in another measure.
export function scaled({ least, most, above }, factor) {
  return { least: least * factor, most: most === undefined ? undefined : most * factor, above };
}

// What is wrong with a number, in the service's words; "" when nothing is.
export function complaint({ least, most, above, whole, orZero }, value) {
  if (whole && typeof value !== "bigint" && !Number.isInteger(value)) return "must be a whole number";
  if (orZero && value === 0) return "";
  const enough = least === undefined || (above ? value > least : value >= least);
  if (enough && (most === undefined || value <= most)) return "";
  if (most === undefined) return above ? `must be more than ${least}` : `must be at least ${least}`;
  return `must be ${orZero ? "0 or " : ""}${above ? "above" : "from"} ${least} ${above ? "and at most" : "to"} ${most}`;
}
