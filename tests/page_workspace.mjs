// page_workspace.mjs ORIGIN SCRATCH: the workspace over the picture, used with the pointer, with keys and by numbers, in a
// browser that has WebGL. Started by page_test.sh.

import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";

import { STAND_IN, axe, context, group, look, openQuiet, origin, renders, open, runTests, scratch, settled, watchControls } from "./page_browser.mjs";

const kMostKilobytes = 300; // of the whole page, compressed
const kDistance = 20;
const SCENE = {
  cubes: [-4, 0, 4].map((x) => ({ particles: 40, size: [2, 2, 2], center: [x, 0, 0], radius: 1 })),
  sun: { elevation: 40, azimuth: 20 },
  camera: { eye: [0, 0, kDistance], target: [0, 0, 0], fov: 40 },
  image: { width: 160, height: 100 },
  accuracy: { rung: "transport-16" },
};
await context.route("**/v1/presets/cumulus", (route) => route.fulfill({ json: SCENE }));

const json = async (page) => JSON.parse(await page.inputValue("#json"));
const box = (page) => page.locator("#stage").boundingBox();
// Where a point is in the picture: as the service's camera has it, by code of its own.
async function pixel(page, [x, y, z]) {
  const { x: left, y: top, width, height } = await box(page);
  const scale = height / 2 / Math.tan((40 * Math.PI) / 360) / (kDistance - z);
  return [left + width / 2 + x * scale, top + height / 2 - y * scale];
}
const status = (page) => page.locator("#shape [role=status]").textContent();
const clickAt = async (page, point, modifiers = []) => {
  for (const key of modifiers) await page.keyboard.down(key);
  await page.mouse.click(...await pixel(page, point));
  for (const key of modifiers) await page.keyboard.up(key);
};
const drag = async (page, [x0, y0], [x1, y1]) => {
  await page.mouse.move(x0, y0);
  await page.mouse.move(x0 + 1, y0);
  await page.mouse.down();
  for (let i = 1; i <= 6; i += 1) await page.mouse.move(x0 + ((x1 - x0) * i) / 6, y0 + ((y1 - y0) * i) / 6);
  await page.mouse.up();
};
const bar = (page) => page.getByRole("toolbar", { name: "Workspace" });
const press = (page, name) => bar(page).getByRole("button", { name, exact: true }).click();
const near = (a, b, within, what) => a.forEach((x, i) => nearly(x, b[i], within, what));
const nearly = (a, b, within, what) => assert.ok(Math.abs(a - b) <= within, `${what}: ${a}, not ${b}`);
const selected = (page) => page.$$eval("#shape select[multiple] option", (all) => all.filter((one) => one.selected).map((one) => one.value));

let unused = null; // () -> the controls of bar and group that no test has used

const tests = {
  async "comes after the first picture, and the page is light"(page) {
    await page.waitForFunction(() => document.querySelector('[data-mode="translate"]')?.offsetParent != null);
    const { bytes, view, picture } = await page.evaluate(() => {
      const all = [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")];
      const page = all.filter(({ name }) => !name.startsWith("blob:") && !/\/v1\//.test(name));
      return {
        bytes: page.reduce((sum, { encodedBodySize }) => sum + encodedBodySize, 0),
        view: all.find(({ name }) => name.endsWith("/workspace_view.js")).startTime,
        picture: all.find(({ name }) => /\/v1\/render\b/.test(name)).responseEnd,
      };
    });
    console.log(`  ${(bytes / 1000).toFixed(0)} kB on the wire`);
    assert.ok(bytes < 1000 * kMostKilobytes, `${bytes} bytes`);
    assert.ok(view >= picture, "three.js is asked for when the first picture is there");
    unused = await watchControls(page, "#workspace-bar, #shape");
    await group(page, "JSON").locator("summary").click();
  },

  async "selects by click, shift-click, box and keys"(page) {
    await clickAt(page, [0, 0, 1]);
    assert.deepEqual(await selected(page), ["/cubes/1"]);
    await clickAt(page, [4, 0, 1], ["Shift"]);
    assert.deepEqual(await selected(page), ["/cubes/1", "/cubes/2"]);
    assert.match(await status(page), /2 selected; cube 3/);
    await clickAt(page, [0, 5, 0]);
    assert.deepEqual(await selected(page), []);
    await page.keyboard.down("Shift");
    await drag(page, await pixel(page, [-6, 3, 0]), await pixel(page, [1.5, -3, 0]));
    await page.keyboard.up("Shift");
    assert.deepEqual(await selected(page), ["/cubes/0", "/cubes/1"]);
    await press(page, "Box");
    await drag(page, await pixel(page, [2, 3, 0]), await pixel(page, [6, -3, 0]));
    assert.deepEqual(await selected(page), ["/cubes/2"]);
    await press(page, "Box");
    await page.locator("#stage").focus();
    await page.keyboard.press("a");
    assert.equal((await selected(page)).length, 3);
    await page.keyboard.press("Escape");
    assert.deepEqual(await selected(page), []);
    assert.deepEqual(await json(page), SCENE, "selecting changes nothing");
  },

  async "moves a cube by the gizmo, the picture follows, and it is one step of undo"(page) {
    await settled(page);
    const before = await look(page);
    await clickAt(page, [0, 0, 1]);
    const arrow = await pixel(page, [0.045 * kDistance, 0, 0]);
    const [far] = await pixel(page, [0.045 * kDistance + 1.5, 0, 0]);
    const sent = renders.length;
    await drag(page, arrow, [far, arrow[1]]);
    await settled(page);
    const moved = (await json(page)).cubes;
    nearly(moved[1].center[0], 1.5, 0.2, "x");
    assert.deepEqual(moved[1].center.slice(1), [0, 0], "along its axis only");
    assert.deepEqual([moved[0], moved[2]], [SCENE.cubes[0], SCENE.cubes[2]]);
    assert.ok(renders.length > sent);
    assert.notEqual((await look(page)).hash, before.hash);
    await page.keyboard.press("Control+z");
    await settled(page);
    assert.deepEqual(await json(page), SCENE);
    assert.equal((await look(page)).hash, before.hash);
    await page.keyboard.press("Control+Shift+z");
    assert.deepEqual((await json(page)).cubes, moved);
    await page.keyboard.press("Control+z");
  },

  async "scales and turns by the gizmo, and snaps"(page) {
    await clickAt(page, [0, 0, 1]);
    await page.keyboard.press("r");
    const grip = await pixel(page, [0.045 * kDistance, 0, 0]);
    await drag(page, grip, [grip[0] + 80, grip[1]]);
    const [width, height] = (await json(page)).cubes[1].size;
    assert.ok(width > 2.2, `${width} wide`);
    assert.equal(height, 2);
    await page.keyboard.press("Control+z");
    await page.keyboard.press("w");
    await page.getByLabel("Snap").selectOption("1");
    const arrow = await pixel(page, [0.045 * kDistance, 0, 0]);
    await drag(page, arrow, [(await pixel(page, [0.045 * kDistance + 1.9, 0, 0]))[0], arrow[1]]);
    assert.equal((await json(page)).cubes[1].center[0] % 1, 0, "on the grid");
    await page.getByLabel("Snap").selectOption("0");
    await page.locator("#stage").focus();
    await page.keyboard.press("Control+z");
    assert.deepEqual(await json(page), SCENE);
    await page.keyboard.press("e");
    assert.equal(await bar(page).getByRole("button", { name: "Turn", exact: true }).getAttribute("aria-pressed"), "true");
    // The cloud, not the cube: a document's boxes stand along their cloud's axes. The ring is seen from its edge.
    const ring = await pixel(page, [0, 0, 0]);
    await drag(page, ring, [ring[0] + 60, ring[1]]);
    await settled(page);
    const { clouds, cubes } = await json(page);
    assert.equal(cubes, undefined);
    assert.ok(Math.abs(clouds[0].rotate_y) > 3, `turned by ${clouds[0].rotate_y}`);
    assert.deepEqual(clouds[0].cubes, SCENE.cubes);
    near(clouds[0].translate ?? [0, 0, 0], [0, 0, 0], 1e-6, "about its middle");
    await page.keyboard.press("Control+z");
    assert.deepEqual(await json(page), SCENE);
    for (const name of ["Turn", "Scale", "Move"]) await press(page, name);
    await page.locator("#stage").focus();
  },

  async "takes fingers for its gizmo, its cubes and the camera"() {
    const page = await openQuiet();
    await page.waitForFunction(() => document.querySelector('[data-mode="translate"]')?.offsetParent != null);
    await group(page, "JSON").locator("summary").click();
    const session = await context.newCDPSession(page);
    const send = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const swipe = async ([x0, y0], [x1, y1]) => {
      await send("touchStart", [[x0, y0]]);
      for (let i = 1; i <= 8; i += 1) await send("touchMove", [[x0 + ((x1 - x0) * i) / 8, y0 + ((y1 - y0) * i) / 8]]);
      await send("touchEnd", []);
    };
    const cube = await pixel(page, [0, 0, 1]);
    await swipe(cube, cube);
    assert.deepEqual(await selected(page), ["/cubes/1"], "a tap selects");
    const arrow = await pixel(page, [0.045 * kDistance, 0, 0]);
    await swipe(arrow, [arrow[0] + 60, arrow[1]]);
    const moved = await json(page);
    assert.ok(moved.cubes[1].center[0] > 0.5, `moved to ${moved.cubes[1].center}`);
    assert.deepEqual(moved.camera, SCENE.camera, "the gizmo has the finger");
    const corner = await pixel(page, [-7, 4, 0]);
    await swipe(corner, [corner[0] + 80, corner[1]]);
    assert.notDeepEqual((await json(page)).camera, SCENE.camera, "elsewhere, it turns the camera");
    assert.deepEqual((await json(page)).cubes, moved.cubes);
    await page.close();
  },

  async "fits a phone: its bar has two rows, and axe-core objects to nothing"(page) {
    await page.setViewportSize({ width: 390, height: 844 });
    const rows = async (selector) => (await page.$$eval(`${selector} :is(button, select)`, (all) => [...new Set(all.filter((one) => one.offsetParent).map((one) => {
      const { top, height } = one.getBoundingClientRect();
      return Math.round((top + height / 2) / 8);
    }))])).length;
    assert.ok(await rows("#workspace-bar") <= 2);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await page.evaluate(axe);
    const clean = async (state) => {
      const wrong = await page.evaluate(async () => (await window.axe.run(document, { resultTypes: ["violations"] })).violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`));
      assert.deepEqual(wrong, [], state);
    };
    await clean("a phone");
    await press(page, "Fly");
    await page.locator("#flight-bar").waitFor();
    assert.ok(await rows("#flight-bar") <= 2);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    await clean("a phone, flying");
    await page.keyboard.press("Escape");
    await page.setViewportSize({ width: 1440, height: 900 });
    await settled(page);
    await page.evaluate(() => scrollTo(0, 0));
  },

  async "adds, duplicates, deletes, deletes all and begins anew, each with a way back"(page) {
    const count = async () => (await json(page)).cubes.length;
    await clickAt(page, [0, 0, 1]);
    await page.keyboard.press("Shift+D");
    assert.equal(await count(), 4);
    assert.deepEqual(await selected(page), ["/cubes/3"]);
    await page.keyboard.press("Delete");
    assert.equal(await count(), 3);
    for (const [name, left] of [["Add", 4], ["Duplicate", 5], ["Delete", 4]]) {
      await press(page, name);
      assert.equal(await count(), left, name);
    }
    await press(page, "Delete all shapes");
    assert.equal(await count(), 0);
    await press(page, "New scene");
    assert.equal(await count(), 1);
    for (const left of [0, 4, 5, 4, 3]) {
      await page.click("#undo");
      assert.equal(await count(), left);
    }
    while (JSON.stringify(await json(page)) !== JSON.stringify(SCENE)) await page.click("#undo");
  },

  async "takes numbers, for one axis and for all"(page) {
    await clickAt(page, [0, 0, 1]);
    const shape = page.locator("#shape");
    await shape.getByLabel("Place, y").fill("2");
    await shape.getByLabel("Place, z").fill("1");
    await shape.getByLabel("Place, z").fill("0");
    await shape.getByLabel("Lengths, z").fill("3");
    assert.deepEqual((await json(page)).cubes[1], { particles: 40, size: [2, 2, 3], center: [0, 2, 0], radius: 1 });
    await shape.getByLabel("Factor").fill("2");
    await shape.getByRole("button", { name: "Scale all axes" }).click();
    assert.deepEqual((await json(page)).cubes[1], { particles: 40, size: [4, 4, 6], center: [0, 2, 0], radius: 2 });
    await shape.getByLabel("Texture", { exact: true }).selectOption("puff");
    await shape.getByLabel("Billboards", { exact: true }).fill("5");
    assert.deepEqual((await json(page)).cubes[1], { particles: 40, size: [4, 4, 6], center: [0, 2, 0], radius: 2, texture: "puff", billboards: 5 });
    while (JSON.stringify(await json(page)) !== JSON.stringify(SCENE)) await page.click("#undo");
  },

  async "looks from the front, the right and the top, and at what is selected"(page) {
    await clickAt(page, [4, 0, 1]);
    const eyes = [];
    for (const key of ["1", "3", "7", "f"]) {
      await page.keyboard.press(key);
      eyes.push((await json(page)).camera);
    }
    assert.deepEqual(eyes[0].eye, [0, 0, kDistance]);
    assert.deepEqual(eyes[1].eye, [kDistance, 0, 0]);
    assert.ok(eyes[2].eye[1] > 0.99 * kDistance);
    assert.deepEqual(eyes[3].target, [4, 0, 0]);
    for (const [name, from] of [["Front", [0, 0, 1]], ["Right", [1, 0, 0]], ["Top", [0, 1, 0]], ["Frame", null]]) {
      await press(page, name);
      const { eye, target } = (await json(page)).camera;
      const away = eye.map((x, axis) => x - target[axis]);
      nearly(Math.hypot(...away), Math.hypot(...eyes[3].eye.map((x, axis) => x - eyes[3].target[axis])), 0.01, name);
      if (from) near(away.map((x) => x / Math.hypot(...away)), from, 0.02, name);
    }
    while ((await json(page)).camera.eye[2] !== kDistance) await page.click("#undo");
    assert.deepEqual(await json(page), SCENE);
  },

  async "moves the sun on its dome"(page) {
    await settled(page);
    const { x: left, y: top, width, height } = await box(page);
    let sun = null;
    for (let y = 20; y < height && !sun; y += 18) {
      for (let x = width / 3; x < width && !sun; x += 18) {
        await page.mouse.move(left + x, top + y);
        if (await page.$eval("#stage", (stage) => stage.classList.contains("takes") && !document.querySelector("#stage.dragging"))) sun = [left + x, top + y];
      }
    }
    assert.ok(sun, "the sun is in the picture");
    await drag(page, sun, [sun[0] + 60, sun[1] + 20]);
    const moved = (await json(page)).sun;
    assert.notDeepEqual(moved, SCENE.sun);
    assert.ok(moved.elevation >= 0 && moved.elevation <= 90);
    assert.deepEqual((await json(page)).camera, SCENE.camera, "the camera stays");
    await page.click("#undo");
    assert.deepEqual(await json(page), SCENE);
  },

  // On a page of its own: where a computer draws too slowly, the next drags are without.
  async "shows particles while something moves, and the picture when it rests"() {
    const page = await open("/#cumulus", { asWithGpu: true });
    await page.waitForFunction(() => document.querySelector('[data-mode="translate"]')?.offsetParent != null);
    await page.waitForFunction(() => document.querySelector("#stage").dataset.light === "service");
    await page.waitForFunction(() => /^linear-gradient/.test(document.querySelector("#stage").style.getPropertyValue("--sky")));
    const { x, y } = await box(page);
    await page.mouse.move(x + 30, y + 30);
    await page.mouse.down();
    for (let i = 0; i < 60 && !(await page.$("#stage.sprites")); i += 1) {
      await page.mouse.move(x + 30 + 2 * i, y + 30);
      await page.waitForTimeout(20);
    }
    assert.ok(await page.$("#stage.sprites"), "sprites during the drag");
    assert.equal(await page.$eval("#stage", (stage) => stage.dataset.light), "service", "in the light that the service said");
    await page.mouse.up();
    await settled(page);
    await page.waitForFunction(() => !document.querySelector("#stage.sprites"));
    await page.close();
  },

  async "selects in the outline and in the table by keyboard"(page) {
    await page.locator("#shape select[multiple]").focus();
    await page.keyboard.press("Home");
    assert.deepEqual(await selected(page), ["/clouds/0"]);
    await page.keyboard.press("ArrowDown");
    assert.deepEqual(await selected(page), ["/cubes/0"]);
    await page.locator('tbody input[data-pointer="/cubes/2/size/0"]').focus();
    assert.deepEqual(await selected(page), ["/cubes/2"]);
  },

  async "starts shapes, strews twins, makes them thin and thick, and takes in files"(page) {
    await settled(page);
    await page.route("**/v1/render*", (route) => route.fulfill({ contentType: "image/png", body: STAND_IN })); // what they look like is not at issue
    const shape = page.locator("#shape");
    const depth = async () => {
      const answer = await fetch(`${origin}/v1/plan`, { method: "POST", headers: { "Content-Type": "application/json" }, body: await page.inputValue("#json") });
      return (await answer.json()).survey.optical_depth.zenith;
    };
    for (const starter of ["tower", "field", "sheet", "wisp"]) {
      await shape.getByLabel("Start with").selectOption(starter);
      await shape.getByRole("button", { name: "New", exact: true }).click();
      assert.ok(await depth() > 0.1, starter); // the service takes it
    }
    await shape.getByLabel("Start with").selectOption("tower");
    await shape.getByRole("button", { name: "Add", exact: true }).click();
    assert.equal((await json(page)).clouds.length, 2);
    for (const [name, wanted] of [["Thin", 1], ["Medium", 6], ["Thick", 30]]) {
      await shape.getByRole("button", { name, exact: true }).click();
      await page.waitForFunction((text) => document.querySelector("#note").textContent.includes(text), `optical depth of ${wanted} `);
      nearly(await depth() / wanted, 1, 0.05, name);
    }
    await page.locator("#shape select[multiple]").selectOption("/clouds/1");
    await shape.getByLabel("Scatter twins").fill("3");
    await shape.getByLabel("within").fill("6");
    await shape.getByRole("button", { name: "Scatter" }).click();
    assert.equal((await json(page)).clouds.length, 5);
    const awn = path.join(scratch, "one.awn"), document = path.join(scratch, "two.json");
    fs.writeFileSync(awn, "10\n1\n10, 2, 2, 2, 0, 9, 0, 1\n");
    fs.writeFileSync(document, JSON.stringify({ density: 0.5, clouds: [{ model: "spheres", spheres: { levels: 2 }, translate: [0, 20, 0] }, SCENE].map((one) => (one === SCENE ? { model: "cubes", cubes: SCENE.cubes } : one)) }));
    for (const [file, many] of [[awn, 6], [document, 8]]) {
      const [chooser] = await Promise.all([page.waitForEvent("filechooser"), shape.getByRole("button", { name: "Insert a file…" }).click()]);
      await chooser.setFiles(file);
      await page.waitForFunction((count) => JSON.parse(document.querySelector("#json").value).clouds.length === count, many);
    }
    assert.equal((await json(page)).clouds[6].density, 0.5, "what the file says for all holds for each");
    fs.writeFileSync(document, "{");
    await shape.getByLabel("File to insert").setInputFiles(document);
    await page.waitForSelector("#alert:not(:empty)");
    while (JSON.stringify(await json(page)) !== JSON.stringify(SCENE)) await page.click("#undo");
    await settled(page);
  },

  async "takes hold of primitives, ellipsoids and whole clouds"(page) {
    const text = page.locator("#json");
    const shape = page.locator("#shape");
    await text.fill(JSON.stringify({ ...SCENE, cubes: undefined, clouds: [
      { model: "implicit", implicit: { resolution: 32, primitives: [{ shape: "sphere", center: [-3, 0, 0], radius: 2 }] } },
      { model: "ellipsoids", ellipsoids: { resolution: 32, ellipsoids: [{ center: [3, 0, 0], radii: [2, 1, 2] }] }, translate: [0, 0, 1] },
      { model: "spheres", spheres: { levels: 2, size: [4, 4, 4] }, translate: [0, 3, 0] },
    ] }));
    await text.blur();
    await clickAt(page, [-3, 0, 0]);
    assert.deepEqual(await selected(page), ["/clouds/0/implicit/primitives/0"]);
    await shape.getByLabel("Place, x").fill("-4");
    await shape.getByLabel("Lengths, x").fill("8");
    const [primitive] = (await json(page)).clouds[0].implicit.primitives;
    nearly(primitive.center[0], -4, 1e-6, "x");
    await clickAt(page, [3, 0, 1]);
    await shape.getByLabel("Lengths, y").fill("3");
    assert.deepEqual((await json(page)).clouds[1].ellipsoids.ellipsoids[0], { center: [3, 0, 0], radii: [2, 1.5, 2] });
    await clickAt(page, [0, 3, 0]);
    assert.deepEqual(await selected(page), ["/clouds/2"]);
    await shape.getByLabel("Place, y").fill("4");
    assert.deepEqual((await json(page)).clouds[2].translate, [0, 4, 0]);
    await page.locator("#stage").focus();
    await page.keyboard.press("Delete");
    assert.equal((await json(page)).clouds.length, 2);
    assert.equal(await page.textContent("#alert"), "");
  },

  async "finds the angles of every rotation, in every order of the axes"(page) {
    const worst = await page.evaluate(async () => {
      const { anglesOf, ofAngles } = await import("/rotation.js");
      const orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
      let [state, found] = [7, 0];
      const next = () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return 360 * (state / 2 ** 32) - 180;
      };
      for (const order of orders) {
        for (let i = 0; i < 60; i += 1) {
          const given = i % 3 ? [next(), next(), next()] : [next(), next(), next()].map((degrees) => 90 * Math.round(degrees / 90)); // two axes in one
          const [one, other] = [ofAngles(given, order), ofAngles(anglesOf(ofAngles(given, order), order), order)];
          found = Math.max(found, ...one.flatMap((row, r) => row.map((x, c) => Math.abs(x - other[r][c]))));
        }
      }
      return found;
    });
    assert.ok(worst < 1e-9, `${worst} apart`);
  },

  async "turns ellipsoids and primitives about each of their axes, by the gizmo and by numbers"(page) {
    const text = page.locator("#json");
    const shape = page.locator("#shape");
    // What the contract says of the angles, by code of its own: a direction of the shape's, in the scene.
    const swung = (v, axis, degrees) => {
      const [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
      const [c, s] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
      const next = [...v];
      [next[a], next[b]] = [c * v[a] - s * v[b], s * v[a] + c * v[b]];
      return next;
    };
    const kHalf = 180; // the cloud's own turn
    const ways = {
      ellipsoids: {
        list: "ellipsoids/ellipsoids", of: (scene) => scene.clouds[0].ellipsoids.ellipsoids[0],
        axis: (part, v) => swung(swung(swung(swung(v, 2, part.rotate_z ?? 0), 0, part.rotate_x ?? 0), 1, part.rotate_y ?? 0), 1, kHalf),
        cloud: { resolution: 32, ellipsoids: [{ center: [-3, 0, 0], radii: [2.4, 1, 0.6], rotate_z: 25 }] },
      },
      implicit: {
        list: "implicit/primitives", of: (scene) => scene.clouds[0].implicit.primitives[0],
        axis: (part, v) => swung([0, 1, 2].reduce((now, axis) => swung(now, axis, (part.rotate ?? [0, 0, 0])[axis]), v), 1, kHalf),
        cloud: { resolution: 32, primitives: [{ shape: "ellipsoid", center: [-3, 0, 0], radius: 2, radii: [1.2, 0.5, 0.3], rotate: [0, 0, 25] }] },
      },
    };
    const X = [1, 0, 0], Z = [0, 0, 1];
    const kRing = 0.0692 * kDistance; // the gizmo's, as three.js draws it
    for (const [model, { list, of, axis, cloud }] of Object.entries(ways)) {
      await text.fill(JSON.stringify({ ...SCENE, cubes: undefined, clouds: [{ model, [model]: cloud, rotate_y: kHalf }] }));
      await text.blur();
      await clickAt(page, [3, 0, 0]);
      assert.deepEqual(await selected(page), [`/clouds/0/${list}/0`]);
      const before = of(await json(page));
      await page.locator("#stage").focus();
      await page.keyboard.press("e");
      const at = 3 + kRing * Math.SQRT1_2;
      await drag(page, await pixel(page, [at, kRing * Math.SQRT1_2, 0]), await pixel(page, [at - 1, kRing * Math.SQRT1_2 + 1, 0]));
      const turned = of(await json(page));
      near(axis(turned, Z), axis(before, Z), 1e-4, `${model}: about its z axis`);
      const cosine = axis(turned, X).reduce((sum, x, i) => sum + x * axis(before, X)[i], 0);
      assert.ok(cosine < 0.98, `${model}: turned, by ${cosine}`);
      near(turned.center, before.center, 1e-5, `${model}: about its middle`);
      assert.deepEqual([turned.radii, turned.radius], [before.radii, before.radius]);
      assert.equal((await json(page)).clouds[0].rotate_y, kHalf, "the cloud stays");
      await page.keyboard.press("Control+z");
      assert.deepEqual(of(await json(page)), before);
      for (const [i, degrees] of [[0, 40], [1, -30], [2, 10]]) await shape.getByLabel(`Turned, °, ${"xyz"[i]}`, { exact: true }).fill(String(degrees));
      const said = of(await json(page));
      assert.deepEqual(model === "implicit" ? said.rotate : [said.rotate_x, said.rotate_y, said.rotate_z], [40, -30, 10]);
      await page.locator("#stage").focus();
      await page.keyboard.press("w");
    }
    await text.fill(JSON.stringify(SCENE));
    await text.blur();
    await clickAt(page, [0, 0, 1]);
    assert.equal(await shape.getByLabel("Turned, °, y", { exact: true }).isVisible(), false, "a cube stands along its cloud's axes");
    await page.locator("#shape select[multiple]").selectOption("/clouds/0");
    await shape.getByLabel("Turned, °, y", { exact: true }).fill("30");
    assert.equal((await json(page)).clouds[0].rotate_y, 30);
    assert.equal(await shape.getByLabel("Turned, °, x", { exact: true }).isDisabled(), true);
    assert.equal(await page.textContent("#alert"), "");
  },

  async "has wires along the axes that a shape has"(page) {
    const found = await page.evaluate(async () => {
      const { itemsOf } = await import("/workspace_items.js");
      const scene = { clouds: [
        { model: "ellipsoids", rotate_y: 90, ellipsoids: { ellipsoids: [{ center: [1, 2, 3], radii: [4, 1, 1], rotate_z: 90 }], formations: [{ heading: 40 }] } },
        { model: "implicit", implicit: { primitives: [{ shape: "cylinder", radius: 1, points: [[0, 0, -3], [0, 0, 3]], rotate: [90, 0, 0], keys: [{ time: 1, center: [0, 0, 0], rotate: [0, 90, 0] }] },
          { shape: "sphere", radius: 1, rotate: [9, 9, 9] }] } },
      ] };
      return itemsOf(scene).map(({ label, half, axes, angles, whole }) => [label, whole ? [] : half.map((h, i) => axes.map((row) => Math.round(1e6 * row[i] * h) / 1e6 + 0)), angles]);
    });
    assert.deepEqual(found, [
      ["cloud 1: ellipsoids", [], [null, 90, null]],
      ["ellipsoid 1", [[0, 4, 0], [0, 0, 1], [1, 0, 0]], [0, 0, 90]],
      ["formation 1", [[0, 0, -3], [0, 2, 0], [3, 0, 0]], [null, 40, null]],
      ["cloud 2: implicit functions", [], [null, 0, null]],
      ["primitive 1", [[1, 0, 0], [0, 0, 1], [0, -4, 0]], [90, 0, 0]],
      ["primitive 2", [[1, 0, 0], [0, 1, 0], [0, 0, 1]], null],
      ["primitive 1, key 1", [[0, 0, -1], [0, 1, 0], [4, 0, 0]], [0, 90, 0]],
    ]);
  },

  async "lists the clouds of a sky, and the parts of the one at hand"(page) {
    const text = page.locator("#json");
    const scene = { ...SCENE, cubes: undefined, clouds: Array.from({ length: 60 }, (_unused, i) => ({
      model: "cubes", translate: [3 * (i % 10), 0, 3 * Math.floor(i / 10)], cubes: Array.from({ length: 10 }, () => SCENE.cubes[1]),
    })) };
    await text.fill(JSON.stringify(scene));
    await text.blur();
    const outline = page.locator("#shape select[multiple]");
    const lines = () => outline.locator("option").evaluateAll((all) => all.map((one) => one.value));
    await outline.selectOption("/clouds/58");
    const all = await lines();
    assert.equal(all.length, 70);
    assert.deepEqual(all.slice(57, 61), ["/clouds/57", "/clouds/58", "/clouds/58/cubes/0", "/clouds/58/cubes/1"]);
    assert.match(await page.textContent("#shape"), /590 more/);
    await outline.focus();
    await page.keyboard.press("ArrowDown");
    assert.deepEqual(await selected(page), ["/clouds/58/cubes/0"]);
    for (let i = 0; i < 10; i += 1) await page.keyboard.press("ArrowDown");
    assert.deepEqual(await selected(page), ["/clouds/59"], "by keyboard, past the end of its parts");
    assert.equal((await lines())[60], "/clouds/59/cubes/0");
    await text.fill(JSON.stringify(SCENE));
    await text.blur();
  },

  async "takes hold of parcels, which are in cells, and of keys"(page) {
    const text = page.locator("#json");
    const shape = page.locator("#shape");
    await text.fill(JSON.stringify({ ...SCENE, cubes: undefined, clouds: [
      { model: "automaton", translate: [-4, 0, 0], scale: 2, automaton: { cells: [16, 8, 16], cell: 0.25, ellipsoids: [{ center: [8, 4, 8], radii: [4, 2, 4] }] } },
      { model: "implicit", translate: [3, 0, 0], implicit: { resolution: 32, primitives: [
        { shape: "sphere", radius: 1, keys: [{ time: 0, center: [0, 0, 0] }, { time: 1, center: [0, 3, 0], radius: 2 }] }] } },
    ] }));
    await text.blur();
    await clickAt(page, [-4, 2, 0]); // its middle: half a unit a cell, from the middle of the grid's floor
    assert.deepEqual(await selected(page), ["/clouds/0/automaton/ellipsoids/0"]);
    assert.equal(await shape.getByLabel("Lengths, x").inputValue(), "4");
    await shape.getByLabel("Place, y").fill("3");
    await shape.getByLabel("Lengths, z").fill("2");
    assert.deepEqual((await json(page)).clouds[0].automaton.ellipsoids, [{ center: [8, 6, 8], radii: [4, 2, 2] }]);
    await clickAt(page, [3, 3, 0]);
    assert.deepEqual(await selected(page), ["/clouds/1/implicit/primitives/0/keys/1"]);
    await shape.getByLabel("Place, x").fill("4");
    const { keys } = (await json(page)).clouds[1].implicit.primitives[0];
    assert.deepEqual(keys, [{ time: 0, center: [0, 0, 0] }, { time: 1, center: [1, 3, 0], radius: 2 }]);
    await page.locator("#stage").focus();
    await page.keyboard.press("Delete");
    assert.equal((await json(page)).clouds[1].implicit.primitives[0].keys.length, 1);
    assert.equal(await page.textContent("#alert"), "");
  },

  async "can be put away and comes back"(page) {
    await press(page, "Workspace");
    assert.equal(await page.locator("#workspace").isVisible(), false);
    await press(page, "Workspace");
    assert.equal(await page.locator("#workspace").isVisible(), true);
  },

  async "has no control that these tests have not used"() {
    assert.deepEqual(await unused(), []);
  },
};

process.exit(await runTests(tests, "/#cumulus") ? 0 : 1);
