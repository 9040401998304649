// Of page.mjs: clouds of every model, looks, and time.

import assert from "node:assert/strict";

import { choose, group, look, origin, renders, settled } from "./page_browser.mjs";
import { defaultsTests } from "./page_defaults.mjs";

const sent = () => renders.at(-1).scene;

// Small: this is about the controls.
async function begin(page, scene) {
  const json = group(page, "JSON");
  if (!(await json.evaluate((details) => details.open))) await json.locator("summary").click();
  await page.waitForFunction(() => document.querySelector("#json").value !== "");
  const before = JSON.parse(await page.locator("#json").inputValue());
  await page.locator("#json").fill(JSON.stringify(scene(before)));
  await json.locator("summary").click();
  await settled(page);
}
const SMALL = { image: { width: 120, height: 80 }, accuracy: { rung: "transport-16" } };

// What a model is called, where one of its fields is, and another value of it.
const MODELS = {
  automaton: { title: "Cellular automaton", section: "Wet air", field: "Vapour, number", member: "humidity", value: 0.4 },
  spheres: { title: "Hierarchy of spheres", field: "Levels, number", member: "levels", value: 3 },
  implicit: { title: "Implicit functions", field: "Blend p3, number", member: "blend", value: 0.9 },
  ellipsoids: { title: "Textured ellipsoids", section: "Texture", field: "Softness, number", member: "texture/offset", value: 1.5 },
};
const titles = Object.values(MODELS).map(({ title }) => title);
const model = (page) => group(page, "Cloud").getByLabel("Model", { exact: true });
async function unfold(panel, title) { // those that a document has something of are
  const section = panel.locator("details.section").filter({ has: panel.page().getByRole("heading", { name: title, exact: true }) });
  if (!(await section.evaluate((details) => details.open))) await section.locator("summary").click();
}

async function takesUp(page, name) {
  const { title, section: folded, field, member, value } = MODELS[name];
  const panel = group(page, title);
  if (folded) await unfold(panel, folded);
  const before = await look(page);
  assert.ok(before.variance > 20, `${name}: a blank picture, variance ${before.variance}`);
  await panel.getByLabel(field).first().fill(String(value));
  await settled(page);
  assert.equal(await page.textContent("#alert"), "", name);
  const own = member.split("/").reduce((object, part) => object[part], sent().clouds[0][name]);
  assert.equal(own, value);
  assert.notEqual((await look(page)).hash, before.hash, `${name}: ${member} changes the picture`);
}

export const modelTests = {
  async "shows the controls of each model, and keeps what was typed"(page) {
    await choose(page, "cumulus");
    await begin(page, ({ cubes, density, camera }) => ({ cubes, density, camera, ...SMALL }));
    const cubes = await look(page);
    for (const [name, { title }] of Object.entries(MODELS)) {
      await model(page).selectOption(name);
      await settled(page);
      const shown = [];
      for (const one of [...titles, "Layout"]) if (await group(page, one).isVisible()) shown.push(one);
      assert.deepEqual(shown, [title]);
      assert.equal(sent().clouds.length, 1);
      assert.equal(sent().camera, undefined, "the camera was of the other model's size");
      await takesUp(page, name);
    }
    await model(page).selectOption("spheres");
    await settled(page);
    assert.deepEqual(sent().clouds, [{ model: "spheres", spheres: { levels: 3 } }]);
    await model(page).selectOption("cubes");
    await settled(page);
    assert.equal((await look(page)).hash, cubes.hash, "cubes, camera and density are as they were");
  },

  ...defaultsTests,

  async "shows what is wrong with a model at its field, and edits lists"(page) {
    await model(page).selectOption("spheres");
    await settled(page);
    const levels = group(page, MODELS.spheres.title).getByLabel("Levels, number");
    await levels.fill("11");
    await page.waitForSelector("#alert:not(:empty)");
    assert.equal(await levels.getAttribute("aria-invalid"), "true");
    await levels.fill("2");
    await settled(page);
    await group(page, MODELS.spheres.title).getByLabel("Size, y").fill("-5");
    await page.waitForFunction(() => /size y/.test(document.querySelector("#alert").textContent));
    await group(page, MODELS.spheres.title).locator('.vector[data-pointer="/clouds/0/spheres/size"] .problem').waitFor();
    await group(page, MODELS.spheres.title).getByLabel("Size, y").fill("300");
    await settled(page);

    await model(page).selectOption("implicit");
    await settled(page);
    const panel = group(page, MODELS.implicit.title);
    await unfold(panel, "Shapes");
    const before = await look(page);
    await panel.getByRole("button", { name: "Edit the preset’s shapes" }).click();
    await settled(page);
    assert.equal((await look(page)).hash, before.hash, "the page knows the preset as the service does");
    assert.equal(await panel.locator("tbody tr").count(), 9);
    await panel.getByLabel("primitive 7, radius", { exact: true }).fill("-1");
    await page.waitForFunction(() => /primitive 7, radius/.test(document.querySelector("#alert").textContent));
    await panel.getByRole("button", { name: "Delete primitive 7" }).click();
    await settled(page);
    assert.notEqual((await look(page)).hash, before.hash);
    assert.equal(sent().clouds[0].implicit.primitives.length, 8);
    for (const shape of ["segment", "cylinder", "ellipsoid", "sphere"]) {
      await panel.getByLabel("primitive 2, shape", { exact: true }).selectOption(shape);
      await settled(page);
      assert.equal(await page.textContent("#alert"), "", shape);
    }
    await model(page).selectOption("ellipsoids");
    await group(page, MODELS.ellipsoids.title).getByRole("button", { name: "Add a formation" }).click();
    await group(page, MODELS.ellipsoids.title).getByLabel("Ellipsoids, number").fill("5");
    await settled(page);
    assert.deepEqual(sent().clouds[0].ellipsoids.formations, [{ kind: "combined", count: 5 }]);
  },

  async "draws looks, which have no error"(page) {
    const choice = group(page, "Cloud").getByLabel("Look");
    for (const [name, its] of [["spheres", "ostroushko"], ["ellipsoids", "gardner"], ["automaton", "upchurch"]]) {
      await model(page).selectOption(name);
      await settled(page);
      const { hash } = await look(page);
      await choice.selectOption(its);
      await settled(page);
      assert.equal(await page.textContent("#alert"), "");
      assert.notEqual((await look(page)).hash, hash);
      assert.equal(await page.textContent("#rung"), "look");
      assert.equal(await page.textContent("#error"), "–");
      assert.equal(await group(page, "Accuracy").isVisible(), false);
    }
    await choice.selectOption("physical");
    await settled(page);
    assert.deepEqual([sent().look, sent().accuracy], [undefined, SMALL.accuracy]);
    await model(page).selectOption("cubes");
    await settled(page);
    assert.equal(await choice.isVisible(), false);
  },

  async "moves clouds by a slider, plays, and stops"(page) {
    assert.equal(await page.isVisible("#time-bar"), false, "nothing moves");
    await unfold(group(page, "Cloud"), "Place and motion");
    await group(page, "Cloud").getByLabel("Velocity, x").fill("2");
    await page.waitForSelector("#time-bar");
    await group(page, "Time").locator("summary").click();
    await group(page, "Time").getByLabel("A sequence of frames").check();
    await group(page, "Time").getByLabel("To, s").fill("4");
    await settled(page);
    assert.deepEqual(sent().sequence, { from: 0, to: 4, frames: 100 });
    const first = await look(page);
    const slider = page.locator("#time-bar").getByLabel("Time", { exact: true });
    await slider.focus();
    await page.keyboard.press("End");
    await settled(page);
    assert.equal(sent().time, 4);
    assert.notEqual((await look(page)).hash, first.hash);

    const from = renders.length;
    const seen = new Set();
    await page.locator("#stage").focus();
    await page.keyboard.press(" ");
    for (const end = Date.now() + 20_000; seen.size < 4 && Date.now() < end;) {
      seen.add((await look(page)).hash);
      await page.waitForTimeout(60);
    }
    assert.ok(seen.size >= 4, `${seen.size} different pictures`);
    const until = renders.length; // then it is drawn at rest: half, where the whole takes long, and whole
    await page.getByRole("button", { name: "Pause" }).click();
    await settled(page);
    const played = renders.slice(from, until).map(({ scene }) => scene);
    assert.ok(played.length >= 3);
    assert.ok(played.every(({ image, sequence }) => image.width < SMALL.image.width && sequence === undefined));
    assert.equal(new Set(played.map(({ camera }) => JSON.stringify(camera))).size, 1, "the camera rests");
    assert.ok(played.every(({ time }) => time >= 0 && time <= 4));
    assert.equal(await page.evaluate(() => window.flights.most), 1, "one request at a time");
    assert.equal((await look(page)).width, SMALL.image.width, "a full picture at the end");
    const rest = renders.length;
    await page.waitForTimeout(400);
    assert.equal(renders.length, rest, "it has stopped");
    await group(page, "Time").getByLabel("Frames", { exact: true }).fill("0");
    await page.waitForSelector('[data-pointer="/sequence/frames"] .problem');
    await page.goto(`${origin}/#cumulus`);
    await page.reload();
    await settled(page);
  },
};
