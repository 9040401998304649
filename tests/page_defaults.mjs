// Of page.mjs: the controls against the service. What they show where a document is silent is what the service takes
// then: a document that says so in words is the same scene, and the service, which names scenes by their values, gives
// it the same name. What they begin with when something is switched on or added, it accepts. What is beyond an end is
// said at once.

import assert from "node:assert/strict";

import { group, openQuiet, origin } from "./page_browser.mjs";

// Only what is required, so that the controls of everything else show defaults.
const HAZE = { extinction: 0.01, scale_height: 10 };
const AROUND = {
  sun: {}, ground: { terrain: { height: 5 } }, haze: HAZE, detail: {}, sequence: { to: 1, frames: 2 }, camera: { eye: [0, 0, 20], target: [0, 0, 0] },
};
const cloud = (model, own) => ({ clouds: [{ model, [model]: own }] });
const SILENT = {
  "cubes": { clouds: [{ cubes: [{ particles: 1, size: [1, 1, 1], center: [0, 0, 0], radius: 1 }] }], ...AROUND },
  "physical sky": { ...cloud("cubes", []), sky: { model: "physical" } },
  "physical sky as a word": { ...cloud("cubes", []), sky: "physical" },
  "automaton": cloud("automaton", {}),
  "automaton in full": cloud("automaton", {
    random: {}, ellipsoids: [{ center: [48, 6, 48], radii: [14, 10, 14] }], wind: { ellipsoids: [{}] },
  }),
  "cumulus of spheres": cloud("spheres", {}),
  "cirrus of spheres": cloud("spheres", { kind: "cirrus", morph: {} }),
  ...Object.fromEntries(["cumulus", "cirrus", "stratus", "mackerel", "creature"].map(
    (preset) => [preset, cloud("implicit", { preset })])),
  "implicit without a preset": cloud("implicit", {}),
  "implicit in full": cloud("implicit", {
    primitives: [{}], growth: {}, attractors: [{ strength: 1, reach: 60 }], vortices: [{ angle: 90, reach: 60 }],
    bubbles: {}, billows: {}, cells: {}, squash: {},
  }),
  "ellipsoids": cloud("ellipsoids", {}),
  "ellipsoids in full": cloud("ellipsoids", { formations: [{}], ellipsoids: [{ center: [0, 0, 0], radii: [1, 1, 1] }], plane: {} }),
};

// Controls of what is no field of a document: the camera as an orbit.
const NO_FIELDS = ["/camera/elevation", "/camera/distance"];
// Choices that stand for several fields, or for which of them there is.
const COMPOUND = ["/image", "/accuracy"];

// What means nothing in some of these documents: where nothing moves, where no light is by the air.
const IDLE = ["/time", "/clouds/0/velocity", "/sky/turbidity"];

// Shown in words: what holds goes with the preset's shapes, and is in the document as soon as these are.
const IN_WORDS = ["/clouds/0/implicit/base"];

// The name that the service has for a scene, or what is wrong with it; nothing is made.
async function nameOf(scene) {
  const answer = await fetch(`${origin}/v1/particles`, {
    method: "POST", body: JSON.stringify(scene),
    headers: { "Content-Type": "application/json", Accept: "text/csv", "If-None-Match": "*" },
  });
  return answer.status === 304 ? answer.headers.get("ETag") : answer.text();
}
const isName = (text) => /^"[^"]+"$/.test(text);

function withAt(scene, [step, ...rest], value) {
  const copy = Array.isArray(scene) ? [...scene] : scene !== null && typeof scene === "object" ? { ...scene } : {};
  copy[step] = rest.length ? withAt(copy[step], rest, value) : value;
  return copy;
}
const put = (scene, pointer, value) => {
  // A word that stands for an object gives place to it.
  const sky = scene.sky === "physical" && pointer.startsWith("/sky/") ? { ...scene, sky: { model: "physical" } } : scene;
  return withAt(sky, pointer.split("/").slice(1), value);
};

// Puts a document into the page, and unfolds everything.
async function write(page, scene) {
  await page.evaluate(() => document.querySelectorAll("#groups details").forEach((details) => { details.open = true; }));
  await page.locator("#json").fill(JSON.stringify(scene));
  await page.locator("#json").blur(); // while it is being written, it is not rewritten
}

// (The group "Shape" is of tools, which are of no place in the document, and of the places of what is selected.)
// Every control for which the document at hand says nothing: { pointer, shown, standard, other }. `shown` is what the
// control says there is; a colour comes as linear light. `standard` is what it was made from, `other` another value.
// And of those for which it says something { pointer, said, standard }.
const silentControls = (page, scene) => page.evaluate(async (document_) => {
  const { fieldAt, standardAt } = await import("/schema.js");
  const { at } = await import("/document.js");
  const decode = (byte) => (byte <= 0.04045 ? byte / 12.92 : ((byte + 0.055) / 1.055) ** 2.4);
  const linear = (hex) => [1, 3, 5].map((i) => decode(parseInt(hex.slice(i, i + 2), 16) / 255));
  const said = new Set();
  const found = new Map();
  for (const input of document.querySelectorAll(".group:not(#shape) input, .group:not(#shape) select")) {
    if (input.closest("[hidden]") || input.type === "range" || input.type === "checkbox") continue;
    const pointer = input.dataset.pointer ?? input.closest("[data-pointer]").dataset.pointer;
    const text = input.value || input.placeholder || "";
    const number = input.type === "number" || /^\d+$/.test(text);
    const shown = input.type === "color" ? linear(text) : number ? Number(text || NaN) : text;
    const [, whole, axis] = /^(.*)\/([012])$/.exec(pointer) ?? [];
    const place = whole ?? pointer;
    const holder = place.slice(0, place.lastIndexOf("/"));
    const held = at(document_, holder);
    if (at(document_, place) !== undefined || (typeof held === "string" && place === "/sky/model")) {
      said.add(place);
      continue;
    }
    // A switch is off: they show what it begins with.
    if (held === undefined && typeof standardAt(document_, holder) === "string") continue;
    if (!found.has(place)) found.set(place, { pointer: place, shown: [] });
    found.get(place).shown[axis === undefined ? 0 : Number(axis)] = shown;
  }
  const standardOf = (pointer) => standardAt(document_, pointer) ?? null;
  const silent = [...found.values()].map(({ pointer, shown }) => {
    const field = fieldAt(pointer);
    if (!field) return { pointer, field: false };
    const standard = standardOf(pointer);
    const first = Array.isArray(standard) ? standard[0] : standard;
    const ends = [field.least, field.most].filter((end) => end !== undefined).map((end) => (typeof end === "bigint" ? 7 : end));
    const other = [...field.words, ...ends].find((one) => one !== first);
    return {
      pointer, field: true, shown: shown.flat(), standard, other: Array.isArray(standard) ? [other, ...standard.slice(1)] : other,
    };
  });
  return [...silent, ...[...said].map((pointer) => ({ pointer, said: true, standard: standardOf(pointer) }))];
}, scene);

const near = (a, b) => a === b || (typeof a === "number" && Math.abs(a - b) <= 0.005 * Math.max(1, Math.abs(b)));

// What a control shows where the document is silent.
function isShown({ pointer, shown, standard }) {
  if (["/image/exposure", "/density"].includes(pointer)) return standard === "auto"; // the automatic one has a box of its own
  if (standard === null) return shown.every((one) => typeof one !== "number" || Number.isNaN(one)); // in words, if at all
  const wanted = [standard].flat();
  const asByte = /color|zenith|horizon/.test(pointer);
  if (pointer === "/accuracy/error") return near(shown[0], 100 * standard);
  const mean = wanted.reduce((sum, one) => sum + one, 0) / 3;
  if (shown.length === 1 && wanted.length === 3) return near(shown[0], mean); // a colour on a slider
  return shown.length === wanted.length && shown.every((one, i) => (asByte ? near(one, wanted[i]) : one === wanted[i]));
}

export const defaultsTests = {
  async "shows what the service takes where a document is silent"() {
    const page = await openQuiet();
    const wrong = [];
    const seen = new Set();
    const withDefault = new Set(); // and said in some document; in another it is not
    for (const [title, scene] of Object.entries(SILENT)) {
      await write(page, scene);
      const name = await nameOf(scene);
      assert.ok(isName(name), `${title}: ${name}`);
      for (const control of await silentControls(page, scene)) {
        const { pointer, said, field, standard, other } = control;
        if (said) {
          if (standard !== null) withDefault.add(pointer);
          continue;
        }
        seen.add(pointer);
        if (!field) {
          if (!NO_FIELDS.includes(pointer)) wrong.push(`${title}: ${pointer} is no field`);
          continue;
        }
        if (COMPOUND.includes(pointer)) continue;
        if (IN_WORDS.includes(pointer)) {
          if (!Number.isNaN(control.shown[0])) wrong.push(`${title}: ${pointer} shows ${control.shown}`);
          continue;
        }
        if (!isShown(control)) wrong.push(`${title}: ${pointer} shows ${control.shown}, its default is ${JSON.stringify(standard)}`);
        if (standard === null) continue;
        const same = await nameOf(put(scene, pointer, standard));
        if (same !== name) wrong.push(`${title}: ${pointer} is not ${JSON.stringify(standard)}: ${same}`);
        if (other === undefined) continue; // the contract names no other value
        const another = await nameOf(put(scene, pointer, other));
        if (another === name && !IDLE.includes(pointer)) wrong.push(`${title}: ${pointer} makes no difference`);
      }
    }
    for (const [title, scene] of Object.entries(SILENT)) {
      const { model } = scene.clouds[0];
      if (model !== "implicit" && model !== "spheres") continue;
      const place = `/clouds/0/${model}`;
      const preset = await page.evaluate(async ([of, pointer]) => (await import("/schema.js")).presetAt(of, pointer), [scene, place]);
      const own = { ...preset, ...scene.clouds[0][model] };
      if (own.growth) continue; // which has none of the preset's shapes
      if ((await nameOf(put(scene, place, own))) !== (await nameOf(scene))) wrong.push(`${title}: its preset spelled out`);
    }
    assert.deepEqual(wrong, []);
    assert.deepEqual([...withDefault].filter((pointer) => !seen.has(pointer)), [], "every default is held against the service");
    assert.ok(seen.size > 150, `${seen.size} controls`);
    for (const pointer of ["/sky/intensity", "/clouds/0/implicit/resolution", "/clouds/0/spheres/ratio_min"]) assert.ok(seen.has(pointer), pointer);
    await page.close();
  },

  async "makes every control within its range, and begins with what is allowed"() {
    const page = await openQuiet();
    const wrong = [];
    for (const model of ["cubes", "automaton", "spheres", "implicit", "ellipsoids"]) {
      await write(page, model === "cubes" ? { cubes: [] } : cloud(model, {}));
      await page.evaluate(() => {
        const shown = (selector) => [...document.querySelectorAll(selector)].filter((element) => !element.closest("[hidden]"));
        const boxes = shown('.group:not(#shape) input[type="checkbox"]')
          .filter((box) => !box.checked && box.closest(".field").dataset.pointer !== "/camera");
        for (const box of boxes) box.click();
        for (const button of shown(".group:not(#shape) button").filter(({ textContent }) => textContent.startsWith("Add "))) button.click();
      });
      const text = await page.locator("#json").inputValue();
      const scene = JSON.parse(text);
      for (const part of ["ground", "haze", "sequence"]) assert.ok(scene[part], `${model}: ${part} is on`);
      assert.notEqual(scene.detail, "none", `${model}: detail is on by itself`);
      const name = await nameOf(scene);
      if (!isName(name)) wrong.push(`${model}: ${name}`);
      wrong.push(...await page.evaluate(() => [...document.querySelectorAll(".group:not(#shape) input")]
        .filter((input) => !input.closest("[hidden]") && (!input.validity.valid || input.classList.contains("incomplete")))
        .map((input) => `${input.closest("[data-pointer]").dataset.pointer}: ${input.value} ${input.validationMessage}`)));
    }
    assert.deepEqual(wrong, []);
    // What a slider of the page cannot be.
    const made = (spec) => page.evaluate(async (one) => {
      const { slider, select } = await import("/controls.js");
      try {
        (one.titles ? select : slider)({ scene: {} }, { ...one, pointer: () => one.pointer });
        return "made";
      } catch (error) {
        return error.message;
      }
    }, { label: "x", ...spec });
    assert.equal(await made({ pointer: "/haze/g", min: -0.9, max: 0.9, step: 0.1 }), "made");
    assert.match(await made({ pointer: "/haze/g", min: -0.9, max: 1.5, step: 0.1 }), /\/haze\/g goes to 1.5/);
    assert.match(await made({ pointer: "/haze/albedo", min: -0.1 }), /\/haze\/albedo goes to -0.1/);
    assert.match(await made({ pointer: "/haze/gg", min: 0, max: 1 }), /No document has \/haze\/gg/);
    assert.match(await made({ pointer: "/fill", titles: { unform: "even" } }), /unform/);
    await page.close();
  },

  async "says at once what is beyond the ends of a field"() {
    const page = await openQuiet({ pictures: false }); // the service is busy
    await write(page, cloud("implicit", { primitives: [{}] }));
    const said = async (input, value, sentence) => {
      await input.fill(String(value));
      assert.match(await page.textContent("#alert"), sentence);
      assert.equal(await input.getAttribute("aria-invalid"), "true", `${value}`);
      assert.match(await page.textContent(`#${await input.getAttribute("aria-describedby")}`), sentence);
      assert.ok(await input.evaluate((element) => element.classList.contains("incomplete")));
    };
    const own = group(page, "Implicit functions");
    await said(group(page, "Sun").getByLabel("Elevation, °"), 200, /must be from -90 to 90$/);
    await said(own.getByLabel("Resolution, number"), 15, /must be from 16 to 400$/);
    await said(own.getByLabel("Resolution, number"), 20.5, /must be a whole number$/);
    await said(own.getByLabel("Ripples, y"), 0.001, /must be 0 or from 0.01 to 1000$/);
    await said(own.getByLabel("primitive 1, radius", { exact: true }), -1, /must be from /);
    await said(group(page, "Matter").getByLabel("Seed"), "18446744073709551616", /must be from 0 to 18446744073709551615$/);
    await said(group(page, "Accuracy").getByLabel("Error, %"), 0, /must be more than 0$/);
    const ripple = own.getByLabel("Ripples, y");
    await ripple.fill("0");
    assert.equal(await ripple.evaluate((input) => input.validity.valid && !input.classList.contains("incomplete")), true, "0 is no wave");
    const elevation = group(page, "Sun").getByLabel("Elevation, °");
    await elevation.fill("200");
    await elevation.blur();
    const message = await elevation.evaluate((input) => input.validationMessage);
    assert.equal(message, "must be from -90 to 90", "as long as it is in the document");
    const place = own.getByLabel("primitive 1, centre x", { exact: true });
    await said(place, 1e9, /must be from /);
    await place.fill(await place.getAttribute("max"));
    await place.press("ArrowUp");
    assert.equal(await place.inputValue(), await place.getAttribute("max"), "the arrow keys stop at the end");
    await page.close();
  },

  async "says so when the service does not say what a document may hold"() {
    const page = await openQuiet({ contract: false });
    await page.waitForSelector("#alert:not(:empty)");
    assert.match(await page.textContent("#alert"), /The page cannot be built: .*503/);
    await page.close();
  },
};
