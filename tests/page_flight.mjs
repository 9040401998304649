// page_flight.mjs ORIGIN SCRATCH: flying around a cloud and through it: how the eye moves and what a path is, as plain
// figures; and a flight in a browser that has WebGL, with keys, pointer and buttons. Started by page_test.sh.

import assert from "node:assert/strict";

import { axe, context, download, group, look, patience, renders, runTests, settled, watchControls } from "./page_browser.mjs";
import { forwardOf, moved, poseOf, targetOf, turnedBy } from "../web/flight_motion.js";
import { denser, gainOf, sparser } from "../web/workspace_particles.js";
import { colourOf, stripOf } from "../web/workspace_sky.js";
import { lengthOf, pathOf, textOf, thinned, viewAt } from "../web/flight_path.js";

const near = (a, b, within, what) => {
  const all = [a].flat();
  all.forEach((x, i) => assert.ok(Math.abs(x - [b].flat()[i]) <= within, `${what}: ${all}, not ${b}`));
};
const apart = (a, b) => Math.hypot(...a.map((x, axis) => x - b[axis]));

// --- as plain figures ---

const CLOUD = { center: [1, 2, 3], radius: 5 };
const go = (pose, words, seconds, how = {}) => moved(pose, new Set(words), seconds, { way: "through", speed: 2, cloud: CLOUD, ...how });

function moves() {
  const start = poseOf([1, 2, 23], CLOUD.center);
  near(forwardOf(start), [0, 0, -1], 1e-12, "it looks at the cloud");
  near(targetOf(start, CLOUD), CLOUD.center, 1e-9, "its target");
  const ahead = go(start, ["forward"], 2);
  near(ahead.eye, [1, 2, 23 - 2 * 0.4 * CLOUD.radius], 1e-9, "forward, at the second speed");
  near(go(ahead, ["back"], 2).eye, start.eye, 1e-9, "and back");
  near(go(start, ["right"], 1).eye[0] - 1, 0.4 * CLOUD.radius, 1e-9, "right");
  assert.ok(apart(go(start, ["forward"], 1, { speed: 3 }).eye, start.eye) > apart(go(start, ["forward"], 1, { speed: 1 }).eye, start.eye));
  assert.deepEqual(go(start, ["forward", "back", "left", "right"], 1), start, "opposites are nothing");
  assert.ok(forwardOf(go(start, ["turnRight"], 1))[0] > 0.5, "to the right is to where right is");
  assert.ok(forwardOf(go(start, ["lookUp"], 1))[1] > 0.5);
  assert.ok(go(start, ["lookUp"], 60).pitch < 90, "never over the top");
  assert.ok(go(start, ["forward"], 20).eye[2] < CLOUD.center[2], "through the cloud");

  const round = go(start, ["right", "lookUp"], 1, { way: "around" });
  near(apart(round.eye, CLOUD.center), 20, 1e-9, "around, it stays as far");
  assert.ok(round.eye[0] > 1 && round.eye[1] > 2, "to the right and up");
  near(targetOf(round, CLOUD), CLOUD.center, 1e-9, "and looks at the middle");
  assert.ok(apart(go(start, ["forward"], 100, { way: "around" }).eye, CLOUD.center) >= CLOUD.radius, "never into the cloud");
  near(apart(go(poseOf([1, 2, 4], CLOUD.center), ["forward"], 9, { way: "around" }).eye, CLOUD.center), 1, 1e-9, "inside, it stays where it is");

  const how = { cloud: CLOUD, fov: 40, height: 400 };
  assert.ok(forwardOf(turnedBy(start, 100, 0, { ...how, way: "through" }))[0] < 0, "what is under the pointer goes with it");
  assert.ok(forwardOf(turnedBy(start, 0, 100, { ...how, way: "through" }))[1] > 0);
  assert.ok(turnedBy(start, 100, 0, { ...how, way: "around" }).eye[0] < 1);
  assert.ok(turnedBy(start, 0, 100, { ...how, way: "around" }).eye[1] > 2);
}

function paths() {
  const keys = Array.from({ length: 201 }, (_none, i) => {
    const time = 5 + i / 20;
    return { time, eye: [10 * Math.sin(time), time, 10 * Math.cos(time)], target: [0, time / 2, 0], fov: 40 };
  });
  const few = thinned(keys, 0.05);
  assert.ok(few.length > 4 && few.length < 80, `${few.length} keys`);
  for (const kind of ["linear", "smooth"]) {
    const path = pathOf(kind, few);
    near(lengthOf(path), 10, 1e-9, "its length");
    const read = JSON.parse(textOf(path));
    assert.deepEqual(read, path, "the file says it all");
    assert.deepEqual(Object.keys(read), ["from", "to", "frames", "interpolation", "clouds", "camera"]);
    assert.deepEqual([read.from, read.to, read.frames], [0, 10, 121]);
    assert.deepEqual(Object.keys(read.camera[0]), ["time", "eye", "target", "fov"]);
    for (const key of path.camera) assert.deepEqual(viewAt(path, key.time).eye, key.eye, `${kind}: at its keys`);
    for (const { time, eye } of keys) near(viewAt(path, time - 5).eye, eye, 0.06, `${kind} at ${time}`);
    assert.deepEqual(viewAt(path, -1).eye, path.camera[0].eye);
    assert.deepEqual(viewAt(path, 99).eye, path.camera.at(-1).eye);
  }
  const later = pathOf("smooth", few, 7);
  assert.deepEqual([later.from, later.to, later.camera[0].time], [7, 17, 7], "of clouds at another second");
  // Smooth: no corner at a key, however uneven the keys; along a line, evenly, where it is even from key to key; and rest is rest.
  const uneven = pathOf("smooth", [0, 1, 1.5, 4, 5].map((time) => ({ time, eye: [time ** 2, 0, 0], target: [0, 0, 0], fov: 40 + time })));
  const speed = (time, step) => (viewAt(uneven, time + step).eye[0] - viewAt(uneven, time).eye[0]) / step;
  for (const { time } of uneven.camera.slice(1, -1)) near(speed(time, 1e-5), speed(time, -1e-5), 1e-3, `speed at ${time}`);
  const even = pathOf("smooth", [0, 1, 2, 3, 4].map((time) => ({ time, eye: [3 * time, 0, 0], target: [0, 0, 0], fov: 40 })));
  for (const time of [0.3, 1.2, 2, 3.9]) near(viewAt(even, time).eye, [3 * time, 0, 0], 1e-9, `evenly at ${time}`);
  const resting = pathOf("smooth", [0, 1, 1, 5].map((x, time) => ({ time, eye: [x, 0, 0], target: [0, 0, 0], fov: 40 })));
  near(viewAt(resting, 1.5).eye, [1, 0, 0], 1e-12, "at rest");
}

function particles() {
  const count = 1000;
  const list = (width, f) => Float32Array.from({ length: width * count }, (_none, i) => f(i));
  const set = { count, places: list(3, (i) => i), radii: list(1, () => 2), densities: list(1, (i) => 1 + (i % 2)), covers: list(1, () => 0.5) };
  const massOf = ({ radii, densities }) => radii.reduce((sum, r, i) => sum + densities[i] * r ** 3, 0);
  const few = sparser(set, 300);
  assert.equal(few.count, 250);
  near(massOf(few) / massOf(set), 1, 0.35, "mass stays, but for which of them are left");
  assert.deepEqual([...few.places.slice(3, 6)], [12, 13, 14], "every fourth");
  assert.equal(sparser(set, count), set);
  const thick = denser(set, 2);
  near(massOf(thick) / massOf(set), 2, 1e-6, "twice the matter");
  assert.ok(thick.covers[0] > 1 - Math.exp(-Math.sqrt(2 * Math.PI)) - 1e-6);

  // Brightness is compared where sprites cover a pixel, upside down as they come.
  const [width, height] = [4, 8];
  const sprites = new Uint8Array(4 * width * height), picture = new Uint8Array(4 * width * height);
  for (let y = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      const isCloud = y < 4; // the upper half of the picture
      picture.set(isCloud ? [150, 120, 90, 255] : [10, 20, 200, 255], 4 * (y * width + x));
      if (isCloud) sprites.set([100, 100, 100, 255], 4 * ((height - 1 - y) * width + x));
    }
  }
  near(gainOf(sprites, picture, width, height), [1.5, 1.2, 0.9], 1e-9, "brighter and redder");
  assert.equal(gainOf(new Uint8Array(4 * width * height), picture, width, height), null, "without a cloud nothing is known");
}
function skies() {
  // A map whose red is the row, and whose green the column: heading 0 is its middle, 90 a quarter from the left.
  const [width, height] = [8, 180];
  const data = new Uint8Array(4 * width * height);
  for (let y = 0; y < height; y += 1) for (let x = 0; x < width; x += 1) data.set([y, x, 7, 255], 4 * (y * width + x));
  const map = { width, height, data };
  assert.deepEqual(colourOf(map, 0.5, 0), [89, 4, 7]);
  assert.deepEqual(colourOf(map, 60.5, 90), [29, 2, 7]);
  assert.deepEqual(colourOf(map, -90, -90), [179, 6, 7]);
  assert.deepEqual([colourOf(map, 90, 179), colourOf(map, 90, 181), colourOf(map, 90, -541)].map(([, x]) => x), [0, 7, 0], "all around");
  // A picture of 90 degrees ends 45 above and below the horizon; colours stand from above to below.
  const strip = stripOf(map, 0, 90);
  for (let i = 1; i < strip.length; i += 1) assert.ok(strip[i].at > strip[i - 1].at);
  const level = (strip.findLast(({ at }) => at < 0.64).at + strip.find(({ at }) => at > 0.64).at) / 2;
  near(level, 0.64, 1e-9, "the horizon");
  const fast = stripOf(map, 0, 20);
  near((0.64 - fast[3].at) / (0.64 - strip[3].at), 1 / Math.tan((10 * Math.PI) / 180), 1e-9, "a longer lens spreads it");
}

// --- in the browser ---

const kDistance = 20;
const SCENE = {
  cubes: [-4, 0, 4].map((x) => ({ particles: 40, size: [2, 2, 2], center: [x, 0, 0], radius: 1 })),
  density: 0.5,
  sun: { elevation: 40, azimuth: 20 },
  camera: { eye: [0, 0, kDistance], target: [0, 0, 0], fov: 40 },
  image: { width: 160, height: 100 },
  accuracy: { rung: "transport-16" },
};
await context.route("**/v1/presets/cumulus", (route) => route.fulfill({ json: SCENE }));
// The sky behind the particles is refused once: the page asks again.
let skiesAsked = 0;
await context.route("**/v1/sky*", (route) => (skiesAsked++ === 0 ? route.fulfill({ status: 422, json: {} }) : route.continue()));

const json = async (page) => JSON.parse(await page.inputValue("#json"));
const bar = (page) => page.getByRole("toolbar", { name: "Flight" });
const button = (page, name) => bar(page).getByRole("button", { name, exact: true });
const isFlying = (page) => page.$eval("#stage", (stage) => stage.classList.contains("flying"));
const takeOff = async (page) => {
  await page.getByRole("toolbar", { name: "Workspace" }).getByRole("button", { name: "Fly" }).click();
  await bar(page).waitFor();
};
// The eye is at rest, and the document has its camera.
const rested = async (page, before) => {
  await page.waitForFunction((text) => JSON.stringify(JSON.parse(document.querySelector("#json").value).camera) !== text, JSON.stringify(before));
  await settled(page);
  return (await json(page)).camera;
};
const hold = async (page, key, ms) => {
  await page.keyboard.down(key);
  await page.waitForTimeout(ms);
  await page.keyboard.up(key);
};

let unused = null; // () -> the controls of the bar that no test has used

const tests = {
  "moves the eye as the keys say": moves,
  "keeps paths, and finds the way between their keys": paths,
  "makes particles fewer, denser and as bright as a picture": particles,
  "finds the colours of the sky": skies,

  async "takes off, moves with particles, and sharpens where it rests"(page) {
    await group(page, "JSON").locator("summary").click();
    await page.waitForFunction(() => document.querySelector('[data-mode="translate"]')?.offsetParent != null);
    const before = await look(page);
    unused = await watchControls(page, "#flight-bar");
    await takeOff(page);
    assert.equal(await page.getByRole("toolbar", { name: "Workspace" }).isVisible(), false);
    assert.equal(await page.evaluate(() => document.activeElement.id), "stage");
    await page.keyboard.down("w");
    await page.waitForSelector("#stage.sprites");
    await page.waitForFunction(() => /^\d+ × \d+ · \d+\.\d s · [\d.]+ frames\/s · 120 particles$/.test(document.querySelector("#flight-figures").textContent));
    await page.keyboard.up("w");
    const { eye, target, fov } = await rested(page, SCENE.camera);
    assert.ok(eye[2] < kDistance, `at ${eye}`);
    near(eye.slice(0, 2), [0, 0], 1e-6, "straight ahead");
    near(target, [0, 0, 0], 0.3, "it still looks at the cloud");
    assert.equal(fov, 40);
    await page.waitForFunction(() => !document.querySelector("#stage.sprites"));
    assert.notEqual((await look(page)).hash, before.hash);
    assert.match(await page.textContent("#flight-figures"), /at rest/);
    await page.waitForFunction(() => /^linear-gradient\(rgb\(/.test(document.querySelector("#stage").style.getPropertyValue("--sky")));
    assert.equal(skiesAsked, 2);
  },

  async "shows nothing to take hold of on the way"(page) {
    const middle = async () => {
      await settled(page);
      await page.waitForFunction(() => !document.querySelector("#stage.sprites") && document.querySelector("#mark").textContent === "");
      await page.waitForTimeout(600); // notes and marks fade
      const { x, y, width, height } = await page.locator("#stage").boundingBox();
      const clip = { x: x + width / 4, y: y + height / 4, width: width / 2, height: height / 2 };
      return (await look(page, (await page.screenshot({ clip })).toString("base64"))).hash;
    };
    const outline = page.locator("#shape select[multiple]");
    await outline.selectOption([]);
    const without = await middle();
    await outline.selectOption({ index: 1 });
    assert.equal(await middle(), without);
    await button(page, "Leave").click();
    assert.notEqual(await middle(), without, "it is there again");
    await takeOff(page);
    assert.equal(await middle(), without);
    await outline.selectOption([]);
    await page.locator("#stage").focus();
  },

  async "turns, looks, changes speed and goes around, by keys, pointer and wheel"(page) {
    let { camera } = await json(page);
    await hold(page, "ArrowRight", 200);
    camera = await rested(page, camera);
    assert.ok(camera.target[0] > 0, "the eye turns right");
    await page.keyboard.press("3");
    assert.equal(await button(page, "Fast").getAttribute("aria-pressed"), "true");
    await button(page, "Around").click();
    camera = await rested(page, camera);
    near(camera.target, [0, 0, 0], 0.3, "around, it looks at the middle");
    const distance = apart(camera.eye, camera.target);
    await page.locator("#stage").focus();
    await hold(page, "d", 150);
    camera = await rested(page, camera);
    near(apart(camera.eye, camera.target), distance, 0.01, "as far as before");
    const { x, y, width, height } = await page.locator("#stage").boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 40, y + height / 2 + 30, { steps: 4 });
    await page.mouse.up();
    camera = await rested(page, camera);
    assert.ok(camera.eye[1] > 1, "a drag goes over it");
    await page.mouse.wheel(0, 300);
    camera = await rested(page, camera);
    assert.ok(apart(camera.eye, camera.target) > distance, "the wheel goes away");
    assert.deepEqual((await json(page)).cubes, SCENE.cubes, "nothing of the workspace is done by these keys");
    for (const key of ["Delete", "n", "f", "e"]) await page.keyboard.press(key);
    assert.deepEqual((await json(page)), { ...SCENE, camera }, "nor by its own");
  },

  async "lets whoever writes in a field write"(page) {
    const before = (await json(page)).camera;
    const field = group(page, "Sun").getByLabel("Elevation, °");
    await field.focus();
    for (const key of ["w", "ArrowUp", "3"]) await page.keyboard.press(key);
    await page.waitForTimeout(700);
    await field.fill("40");
    assert.deepEqual((await json(page)).camera, before);
    assert.equal(await isFlying(page), true);
    await page.locator("#stage").focus();
  },

  async "shows the cloud thin and thick, and leaves the document as it is"(page) {
    await settled(page);
    const sent = renders.length;
    await bar(page).getByLabel("Thickness of the cloud").selectOption("thick");
    for (let i = 0; i < 100 * patience && !(renders.at(-1).scene.density > 0.5); i += 1) await page.waitForTimeout(100);
    assert.ok(renders.length > sent && renders.at(-1).scene.density > 0.5, "the picture is of a thicker cloud");
    await settled(page);
    assert.equal((await json(page)).density, 0.5);
    await bar(page).getByLabel("Thickness of the cloud").selectOption("");
    for (let i = 0; i < 100 * patience && renders.at(-1).scene.density !== 0.5; i += 1) await page.waitForTimeout(100);
    await settled(page);
    const { camera } = await json(page);
    await bar(page).getByLabel("Thickness of the cloud").focus();
    await hold(page, "w", 200); // as it is chosen, one flies on
    await rested(page, camera);
    assert.equal(await bar(page).getByLabel("Thickness of the cloud").inputValue(), "");
  },

  async "records a path, saves it and flies it again"(page) {
    let { camera } = await json(page);
    await button(page, "Through").click();
    await button(page, "Medium speed").click();
    assert.equal(await button(page, "Replay").getAttribute("aria-disabled"), "true");
    await button(page, "Record").click();
    await page.locator("#stage").focus();
    await hold(page, "w", 500);
    await hold(page, "ArrowLeft", 400);
    await button(page, "Stop recording").click();
    camera = await rested(page, camera);
    await bar(page).getByLabel("Between the keys of a path").selectOption("linear");
    const { name, bytes } = await download(page, () => button(page, "Save the path").click());
    assert.match(name, /\.path\.json$/);
    const path = JSON.parse(bytes);
    assert.equal(path.interpolation, "linear");
    assert.ok(path.camera.length >= 2 && path.camera[0].time === 0 && path.camera.at(-1).time > 0.7, JSON.stringify(path));
    near(path.camera.at(-1).eye, camera.eye, 0.2, "it ends where the flight does");
    for (const reducedMotion of ["reduce", "no-preference"]) { // in steps of a second, and evenly
      await page.emulateMedia({ reducedMotion });
      await button(page, "Replay").click();
      await button(page, "Stop").waitFor();
      await button(page, "Replay").waitFor({ timeout: patience * 30_000 });
    }
    // Its last key, unless the eye came to rest there before.
    await page.waitForFunction((end) => {
      const { eye } = JSON.parse(document.querySelector("#json").value).camera;
      return eye.every((x, axis) => Math.abs(x - end[axis]) < 1e-3);
    }, path.camera.at(-1).eye);
    await settled(page);
  },

  async "has nothing that axe-core objects to"(page) {
    await page.evaluate(axe);
    for (const colorScheme of ["dark", "light"]) {
      await page.emulateMedia({ colorScheme });
      const wrong = await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ["violations"] })).violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`));
      assert.deepEqual(wrong, [], colorScheme);
    }
  },

  async "leaves by Escape, and all of it is one step back"(page) {
    await button(page, "Leave").click();
    assert.equal(await isFlying(page), false);
    await takeOff(page);
    await page.keyboard.press("Escape");
    assert.equal(await isFlying(page), false);
    assert.equal(await page.evaluate(() => document.activeElement.id), "stage");
    assert.equal(await page.getByRole("toolbar", { name: "Workspace" }).isVisible(), true);
    while (JSON.stringify(await json(page)) !== JSON.stringify(SCENE)) await page.click("#undo");
    await takeOff(page);
    await hold(page, "w", 200);
    const there = await rested(page, SCENE.camera);
    await hold(page, "a", 200);
    await page.keyboard.press("Escape"); // before it has come to rest
    const after = await json(page);
    assert.notDeepEqual(after.camera, there);
    await settled(page);
    await page.waitForFunction(() => !document.querySelector("#stage.sprites"));
    await page.keyboard.press("Control+z");
    assert.deepEqual(await json(page), SCENE);
    await page.keyboard.press("Control+Shift+z");
    assert.deepEqual(await json(page), after);
    await page.keyboard.press("Control+z");
  },

  async "ends where another document is opened, and leaves that as it is"(page) {
    await settled(page);
    await page.route("**/v1/presets/stratus", (route) => route.fulfill({ json: { ...SCENE, seed: 2 } }));
    await takeOff(page);
    await page.keyboard.down("w");
    await page.waitForTimeout(100);
    await page.locator("#preset").selectOption("stratus");
    await page.waitForFunction(() => location.hash === "#stratus" && !document.querySelector("#stage.flying"));
    await page.keyboard.up("w");
    assert.equal(await page.inputValue("#preset"), "stratus", "unchanged");
    await settled(page);
    await page.click("#undo");
    await settled(page);
    assert.deepEqual(await json(page), SCENE);
  },

  async "moves by buttons, for fingers"(page) {
    await takeOff(page);
    for (const name of ["Left", "Forward", "Back", "Right"]) {
      const before = (await json(page)).camera;
      await page.evaluate((label) => {
        const one = document.querySelector(`#flight-bar [aria-label="${label}"]`);
        one.setPointerCapture = () => {};
        one.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true, pointerId: 1 }));
        setTimeout(() => one.dispatchEvent(new PointerEvent("pointerup", { bubbles: true, pointerId: 1 })), 150);
      }, name);
      await rested(page, before);
    }
    for (const name of ["Slow", "Fast"]) await button(page, name).click();
    assert.deepEqual(await unused(), [], "every control has been used");
    await page.keyboard.press("Escape");
    while (JSON.stringify(await json(page)) !== JSON.stringify(SCENE)) await page.click("#undo");
    await settled(page);
  },
};

process.exit(await runTests(tests, "/#cumulus") ? 0 : 1);
