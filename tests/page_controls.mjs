// page_controls.mjs ORIGIN SCRATCH: every control beside the picture once: each changes the document, and undo takes it back.
// Then files of textures, there and back, and keys of a camera. Started by page_test.sh.

import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";

import { download, group, openQuiet, runTests, scratch } from "./page_browser.mjs";

// What changes no document, by what it is called.
const NO_EDITS = [
  "Outline", "Factor", "Start with", "Scatter twins", "within", "Insert a file…", "A texture of your own…", "A height map of your own…", "Aim at the cloud",
  "What does accuracy cost?", "Copy the command: Numbered pictures", "Copy the command: An animation", "With the picture of every rung",
];
// What needs something else first: a thickness, a measurement.
const AFTER_THE_SERVICE = ["Thin", "Medium", "Thick", "Scatter", "Scale all axes"];

const CUBES = [{ particles: 20, size: [2, 2, 2], center: [0, 0, 0], radius: 1 }, { particles: 9, size: [1, 2, 3], center: [3, 0, 0], radius: 0.5, density: 2 }];
const FULL = {
  cubes: CUBES, texture: "puff", billboards: 4, time: 1, seed: 5, density: 0.5,
  sun: { elevation: 30, azimuth: 50, intensity: 20, color: [1, 0.9, 0.8] }, camera: { eye: [3, 2, 20], target: [0, 0, 0], fov: 40 },
  sky: { model: "gradient" }, ground: { height: -5 }, haze: { extinction: 0.01, scale_height: 10 }, detail: { amount: 0.5, size: 2 },
  medium: { phase: "mie", droplet: 20 },
  sequence: { to: 4, frames: 8, camera: [{ time: 0, eye: [0, 0, 20], target: [0, 0, 0], fov: 40 }, { time: 2, eye: [9, 0, 20], target: [0, 0, 0], fov: 30 }] },
  image: { width: 320, height: 200, exposure: -2 }, accuracy: { error: 0.2 },
};
const cloud = (model, own) => ({ clouds: [{ model, [model]: own, translate: [1, 0, 0], velocity: [1, 0, 0], density: 0.5 }] });
const DOCUMENTS = {
  cubes: FULL,
  "cubes as words": { cubes: CUBES },
  automaton: cloud("automaton", { random: {}, ellipsoids: [{ center: [48, 6, 48], radii: [14, 10, 14] }], fall_off: "table", fall_off_table: [1, 0], smooth_weight: "table", smooth_weight_table: [1, 0],
    wind: { layer_bands: [{ from: 1, to: 9 }], ellipsoids: [{ from: 1, to: 9 }] } }),
  spheres: cloud("spheres", { kind: "cirrus", morph: {} }),
  implicit: cloud("implicit", { primitives: [{}], growth: {}, attractors: [{ strength: 1, reach: 60 }], vortices: [{ angle: 90, reach: 60 }],
    bubbles: {}, billows: {}, cells: {}, squash: { keys: [{ time: 0, amount: 1 }] }, keys: [{ time: 0 }], formula: "density",
    particles: [{ time: 0, id: 1, center: [0, 0, 0], radius: 9 }] }),
  ellipsoids: cloud("ellipsoids", { formations: [{}], ellipsoids: [{ center: [0, 0, 0], radii: [1, 1, 1] }], plane: {} }),
};

const write = async (page, scene) => {
  await page.locator("#json").fill(JSON.stringify(scene));
  await page.locator("#json").blur();
};
const text = (page) => page.inputValue("#json");

// Uses every control that can be seen, in the page itself; what it did to the document, and whether one step back undoes it.
// skipped: names of controls, and those that are known already, as "group: name".
const useAll = (page, skipped) => page.evaluate((skip) => {
  const json = document.querySelector("#json");
  const nameOf = (one) => (one.getAttribute("aria-label") || one.labels?.[0]?.textContent || one.textContent).trim();
  const tell = (one, ...types) => types.forEach((type) => one.dispatchEvent(new Event(type, { bubbles: true })));
  const values = {
    color: (one) => [one.value === "#808080" ? "#404040" : "#808080"],
    number: (one) => [1, 2, 0.5, 8].map((step) => String(Number(one.value) + step)).concat(["1", "2"]),
    text: (one) => (one.closest(".numbers") ? ["1, 0.25"] : ["1", "2"]),
    range: (one) => [one.min, one.max],
  };
  function use(one) {
    const before = json.value;
    one.focus();
    if (one.tagName === "BUTTON" || one.type === "checkbox") one.click();
    const of = one.tagName === "SELECT" ? [...one.options].map(({ value }) => value) : values[one.type]?.(one) ?? [];
    for (const value of of) {
      if (json.value !== before) break;
      if (one.value === value) continue;
      one.value = value;
      tell(one, "input", "change");
    }
    document.activeElement.blur();
  }
  const done = [];
  for (const one of document.querySelectorAll("#groups :is(button, select, input):not([type=file])")) {
    if (!one.isConnected || !one.offsetParent || one.disabled) continue;
    const name = nameOf(one);
    const key = `${one.closest(".group")?.querySelector("h2").textContent}: ${name}`;
    if (skip.includes(name) || skip.includes(key)) continue;
    const before = json.value;
    use(one);
    const after = json.value;
    let steps = 0;
    while (json.value !== before && steps < 3) {
      document.querySelector("#undo").click();
      steps += 1;
    }
    done.push({ key, changed: after !== before, isJson: (() => { try { return Boolean(JSON.parse(after)); } catch { return false; } })(), back: json.value === before });
  }
  return done;
}, skipped);

const tests = {
  async "has a control for everything, each of which changes the document, and is taken back"() {
    const page = await openQuiet();
    await page.evaluate(() => document.querySelectorAll("#groups details").forEach((one) => { one.open = true; }));
    const used = new Map(); // name -> whether it ever changed the document
    for (const [title, scene] of Object.entries(DOCUMENTS)) {
      await write(page, scene);
      if (title !== "cubes as words") await page.locator("#shape select[multiple]").selectOption({ index: title === "cubes" ? 1 : 0 });
      const known = [...used].filter(([, changed]) => changed).map(([key]) => key);
      for (const { key, changed, isJson, back } of await useAll(page, [...NO_EDITS, ...AFTER_THE_SERVICE, ...known])) {
        used.set(key, changed || used.get(key) === true);
        assert.ok(isJson && back, `${title}, ${key}: ${isJson ? "one step back undoes it" : "a document"}`);
      }
    }
    const idle = [...used].filter(([, changed]) => !changed).map(([key]) => key);
    console.log(`  ${used.size} controls`);
    assert.deepEqual(idle, [], "controls that do nothing");
    assert.ok(used.size > 200, `${used.size} controls`);
    await page.close();
  },

  async "paints cubes, and keeps their textures in files of layouts"() {
    const page = await openQuiet();
    await group(page, "JSON").locator("summary").click();
    await write(page, { cubes: CUBES.map(({ density: _density, ...cube }) => cube) }); // which no layout says
    await page.locator("#shape select[multiple]").selectOption(["/cubes/0", "/cubes/1"]);
    const shape = page.locator("#shape");
    await shape.getByLabel("Texture", { exact: true }).selectOption("puff");
    await shape.getByLabel("Billboards", { exact: true }).fill("12");
    const painted = JSON.parse(await text(page)).cubes;
    assert.deepEqual(painted.map(({ texture, billboards }) => [texture, billboards]), [["puff", 12], ["puff", 12]]);
    await page.locator("#shape select[multiple]").selectOption("/cubes/1");
    await shape.getByLabel("Texture", { exact: true }).selectOption("");
    assert.equal(JSON.parse(await text(page)).cubes[1].texture, undefined);
    const { bytes } = await download(page, () => page.getByRole("button", { name: ".awa", exact: true }).click());
    assert.match(bytes.toString(), /^awa 1\r?\n/);
    const file = path.join(scratch, "painted.awa");
    fs.writeFileSync(file, bytes);
    await write(page, { cubes: [] });
    await page.setInputFiles("#file", file);
    await page.waitForFunction(() => /puff/.test(document.querySelector("#json").value));
    const opened = JSON.parse(await text(page)).cubes;
    assert.deepEqual(opened.map(({ texture, size }) => [texture, size]), [["puff", [2, 2, 2]], [undefined, [1, 2, 3]]]);
    await page.close();
  },

  async "makes keys of a camera that moves"() {
    const page = await openQuiet();
    await group(page, "JSON").locator("summary").click();
    await write(page, { cubes: CUBES, camera: { eye: [3, 2, 20], target: [0, 0, 0], fov: 40 }, sequence: { to: 4, frames: 8 } });
    await group(page, "Time").locator("summary").click();
    const add = group(page, "Time").getByRole("button", { name: "Add the camera as a key" });
    await add.click();
    await page.locator("#stage").focus();
    await page.keyboard.press("ArrowRight");
    await add.click();
    const { camera: [first, second] } = JSON.parse(await text(page)).sequence;
    assert.deepEqual(first, { time: 0, eye: [3, 2, 20], target: [0, 0, 0], fov: 40 });
    assert.equal(second.time, 1);
    assert.notDeepEqual(second.eye, first.eye);
    await group(page, "Time").getByLabel("camera key 2, time").fill("2.5");
    assert.equal(JSON.parse(await text(page)).sequence.camera[1].time, 2.5);
    await page.close();
  },
};

process.exit(await runTests(tests, "/#cumulus") ? 0 : 1);
