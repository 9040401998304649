// page.mjs ORIGIN SCRATCH: uses the page as people do, and stops at the first thing that is not as it
// should be. Started by page_test.sh.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

import {
  cell, choose, download, group, look, open, origin, particles, patience, renders, runTests, scratch, settled,
} from "./page_browser.mjs";
import { modelTests } from "./page_models.mjs";

// In order; each leaves the page usable for the next.
const tests = {
  async "shows a picture of the first preset"(page) {
    const names = await page.$$eval("#preset option", (options) => options.map((o) => o.value).filter(Boolean));
    assert.ok(names.length >= 5, `presets: ${names}`);
    for (const name of ["cumulus", "humilis-field", "stratus", "congestus", "creature"]) assert.ok(names.includes(name), name);
    const { width, height, variance } = await look(page);
    assert.ok(width > 0 && height > 0);
    assert.ok(variance > 50, `a blank picture: variance ${variance}`);
    const count = await particles(page);
    assert.ok(count >= 500 && count <= 20_000, `${count} particles`);
    assert.match(await page.textContent("#rung"), /\w/);
    assert.match(await page.textContent("#effects"), /self shadow/);
    assert.match(await page.textContent("#timing"), /light .* ms/);
    // What a person cares for first; figures for those who ask.
    assert.match(await page.textContent("#in-short"), /^[\d,]+ particles, (made in [\d.]+ m?s|kept from before), about [\d.]+ % from the truth$/);
    assert.equal(await page.isVisible("#rung"), false);
    await page.click("#engineering summary");
    assert.equal(await page.isVisible("#rung"), true);
    await page.click("#engineering summary");
    await choose(page, "cumulus"); // 615 particles in 23 cubes; what follows counts them
    assert.equal(await particles(page), 615);
    await group(page, "Picture").locator("summary").click();
    await group(page, "Picture").getByLabel("Size", { exact: true }).selectOption("640 × 360"); // quicker
    await settled(page);
    assert.equal((await look(page)).width, 640);
  },

  async "tells why effects run"(page) {
    await page.click("#plan summary");
    const rows = await page.locator("#plan-body tbody tr").count();
    assert.ok(rows >= 5, `${rows} effects`);
    assert.match(await page.locator('#plan-body tr[data-pointer="/effects/self_shadow"] .reason').textContent(), /\d/);
    await page.click("#plan summary");
  },

  async "draws anew when a slider is moved by keyboard"(page) {
    const before = await look(page);
    await group(page, "Sun").getByLabel("Elevation", { exact: true }).focus();
    for (let i = 0; i < 20; i += 1) await page.keyboard.press("ArrowLeft");
    await settled(page);
    const after = await look(page);
    assert.equal(after.width, before.width, "full size again once the slider rests");
    assert.notEqual(after.hash, before.hash);
    await page.click("#undo");
    await settled(page);
    assert.equal((await look(page)).hash, before.hash, "undone in one step, to the same pixels");
  },

  async "ends with the last state of fast moves, one request at a time"(page) {
    const from = renders.length;
    await group(page, "Sun").getByLabel("Azimuth", { exact: true }).evaluate(async (slider) => {
      for (let azimuth = 0; azimuth <= 240; azimuth += 4) {
        slider.value = String(azimuth);
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        await new Promise((done) => setTimeout(done, 12));
      }
      slider.dispatchEvent(new Event("change", { bubbles: true }));
    });
    await settled(page);
    const sent = renders.slice(from);
    const last = sent[sent.length - 1];
    assert.equal(last.scene.sun.azimuth, 240);
    assert.equal(last.state, "done");
    assert.ok(sent.length < 60, `${sent.length} requests for 61 moves`);
    assert.equal(await page.evaluate(() => window.flights.most), 1);
    assert.ok(sent.some(({ scene }) => scene.image.width < last.scene.image.width), "small pictures on the way");
    const answer = await fetch(`${origin}/v1/render`, {
      method: "POST", body: JSON.stringify(last.scene), headers: { "Content-Type": "application/json", Accept: "image/png" },
    });
    const truth = Buffer.from(await answer.arrayBuffer()).toString("base64");
    assert.equal((await look(page)).hash, (await look(page, truth)).hash, "what is shown is the last state");
  },

  // A drag shows pictures on the way, none of which is cancelled for another; how many in a second is printed.
  async "shows pictures all along a drag, coarse ones first, and the whole one at its end"(page) {
    const before = await look(page);
    const from = renders.length;
    const box = await page.locator("#stage").boundingBox();
    await page.mouse.move(box.x + 100, box.y + 200);
    await page.mouse.down();
    const shown = page.evaluate(async () => {
      const picture = document.querySelector("#picture");
      const sizes = [];
      const watch = new MutationObserver(() => sizes.push(picture.naturalWidth));
      watch.observe(picture, { attributeFilter: ["src"] });
      await new Promise((done) => addEventListener("pointerup", done, { once: true }));
      watch.disconnect();
      return sizes;
    });
    const begun = Date.now();
    for (let step = 1; step <= 30 || !renders.slice(from).some(({ state }) => state === "done"); step += 1) {
      await page.mouse.move(box.x + 100 + 4 * step, box.y + 200);
      await page.waitForTimeout(33);
    }
    const took = Date.now() - begun;
    await page.mouse.up();
    const sizes = await shown;
    console.log(`  ${sizes.length} pictures in a drag of ${took} ms`);
    assert.ok(sizes.length >= 1, "nothing was shown during the drag");
    await settled(page);
    const coarse = renders.slice(from).filter(({ scene }) => scene.image.width < before.width);
    assert.deepEqual(coarse.filter(({ state }) => state !== "done"), [], "no coarse picture is cancelled");
    const quick = coarse.filter(({ request }) => request.url().endsWith("/v1/render?preview=1"));
    assert.ok(quick.length >= 1, "what is looked at in passing is asked for as such");
    for (const { scene } of quick) {
      const { accuracy, detail, image } = scene;
      assert.ok(accuracy.time_ms === 400 || ["transport-16", "harris"].includes(accuracy.rung), JSON.stringify(accuracy));
      assert.ok(accuracy.rung !== "harris" || detail === "none", "what has a glow has no lumps");
      assert.ok(image.width <= before.width / 2);
    }
    const after = await look(page);
    assert.equal(after.width, before.width);
    assert.notEqual(after.hash, before.hash);
    assert.equal(await page.textContent("#mark"), "");
    await page.click("#undo");
    await settled(page);
  },

  // Whatever the service says of the latest state, what is on the screen says which state it is of.
  async "marks a picture that is of an earlier state"(page) {
    await page.route("**/v1/render*", (route) => route.fulfill({
      status: 400, contentType: "application/problem+json", body: JSON.stringify({ title: "late", detail: "The deadline is over." }) }));
    const elevation = group(page, "Sun").getByLabel("Elevation, °");
    const old = await elevation.inputValue();
    await elevation.fill("44");
    await page.waitForFunction(() => document.querySelector("#mark").textContent === "of an earlier state");
    assert.match(await page.textContent("#alert"), /deadline/);
    await page.unroute("**/v1/render*");
    await elevation.fill(old);
    await settled(page);
    assert.equal(await page.textContent("#mark"), "");
  },

  async "sets daylight, ground, haze and detail, and takes them back"(page) {
    const sent = () => renders[renders.length - 1].scene;
    const sun = group(page, "Sun"), sky = group(page, "Sky");
    const automatic = sun.getByLabel("Colour from its elevation"), model = sky.getByLabel("Model");
    const { hash } = await look(page);
    assert.equal(await model.inputValue(), "physical");
    assert.equal(await automatic.isChecked(), true);
    assert.equal(await sun.getByLabel("Colour", { exact: true }).isVisible(), false);
    assert.equal(await sky.getByLabel("Zenith").isVisible(), false);
    assert.equal(await sky.getByLabel("Intensity, number").inputValue(), "1");
    await sky.getByLabel("Turbidity, number").fill("5");
    await settled(page);
    assert.deepEqual(sent().sky, { turbidity: 5 });
    assert.notEqual((await look(page)).hash, hash);
    await model.selectOption("gradient");
    await automatic.uncheck();

    const switches = [];
    for (const [title, box, field, value] of [
      ["Ground", "A level ground", "Level, number", -9],
      ["Haze", "Hazy air", "Extinction, number", 0.02],
      ["Detail", "Finer structure", "Amount, number", 0.25],
    ]) {
      await group(page, title).locator("summary").click();
      switches.push(group(page, title).getByLabel(box));
      await switches[switches.length - 1].check();
      await group(page, title).getByLabel(field).fill(String(value));
    }
    await group(page, "Ground").getByLabel("Hills on it").check();
    await group(page, "Ground").getByLabel("Hills’ height, number").fill("4");
    await settled(page);
    const { ground, haze, detail, sky: gradient, sun: light } = sent();
    assert.deepEqual(gradient, { model: "gradient", turbidity: 5 }, "in the same air");
    assert.deepEqual(light.color, [1, 1, 1]);
    assert.deepEqual([ground.height, haze.extinction, detail.amount], [-9, 0.02, 0.25]);
    assert.equal(ground.terrain.height, 4);
    assert.ok(haze.scale_height > 0);
    for (const box of switches) await box.uncheck();
    for (const title of ["Ground", "Haze", "Detail"]) await group(page, title).locator("summary").click();
    await settled(page);
    assert.deepEqual([sent().ground, sent().haze, sent().detail], [undefined, undefined, "none"]);
    await model.selectOption("physical");
    await automatic.check();
    await settled(page);
    assert.equal(await page.textContent("#alert"), "");
  },

  async "adds, duplicates and deletes cubes"(page) {
    const before = await particles(page);
    await page.getByRole("button", { name: "Add a cube" }).click();
    await settled(page);
    assert.equal(await particles(page), before + 50);
    await page.getByRole("button", { name: "Duplicate cube 1", exact: true }).click();
    await settled(page);
    assert.equal(await particles(page), before + 250);
    await page.getByRole("button", { name: "Delete cube 1", exact: true }).click();
    await page.getByRole("button", { name: "Delete cube 24", exact: true }).click();
    await settled(page);
    assert.equal(await particles(page), before);
  },

  async "shows an error at the field that it names, and keeps the picture"(page) {
    const before = await look(page);
    const field = cell(page, 3, "size/1");
    const good = await field.inputValue();
    await field.fill("-1");
    await page.waitForSelector("#alert:not(:empty)");
    assert.match(await page.textContent("#alert"), /cube 4, size y/);
    assert.equal(await field.getAttribute("aria-invalid"), "true");
    // At once: the page's own words give place to the service's.
    const message = await field.evaluate((input) => document.getElementById(input.getAttribute("aria-describedby")).textContent);
    assert.ok(message.length > 10, message);
    assert.equal((await look(page)).hash, before.hash);
    await page.getByRole("button", { name: "Go to the field" }).click();
    assert.equal(await field.evaluate((input) => input === document.activeElement), true);
    await field.fill(good);
    await page.waitForSelector("#alert:empty", { state: "attached" });
    assert.equal(await field.getAttribute("aria-invalid"), null);

    const elevation = group(page, "Sun").getByLabel("Elevation, °");
    await elevation.fill("200");
    await page.waitForSelector('[data-pointer="/sun/elevation"] .problem');
    await elevation.fill("");
    assert.equal(await elevation.evaluate((input) => input.validity.valid), false, "half a number is said to be one");
    await elevation.fill("35");
    await settled(page);
    assert.equal(await page.textContent("#alert"), "");
  },

  async "keeps the text of the document and the controls in step"(page) {
    await group(page, "JSON").locator("summary").click();
    const text = page.locator("#json");
    await page.waitForFunction(() => document.querySelector("#json").value !== "");
    const scene = JSON.parse(await text.inputValue());
    assert.equal(scene.sun.elevation, 35);
    scene.sun.elevation = 50;
    scene.seed = 7;
    await text.fill(JSON.stringify(scene).replace('"seed":7', '"seed":18446744073709551615'));
    await settled(page);
    assert.equal(await group(page, "Sun").getByLabel("Elevation, °").inputValue(), "50");
    assert.equal(await group(page, "Matter").getByLabel("Seed").inputValue(), "18446744073709551615");
    await group(page, "Matter").getByLabel("Forward g", { exact: true }).press("ArrowLeft");
    assert.match(await text.inputValue(), /"seed": 18446744073709551615/, "64 bits survive an edit elsewhere");
    await text.fill('{ "cubes": [ ');
    await page.waitForSelector("#alert:not(:empty)");
    await text.fill('{ "cubes": [], "clods": 1 }');
    await page.waitForFunction(() => document.querySelector("#alert").textContent.includes("clods"));
    await page.click("#undo");
    await settled(page);
    await group(page, "JSON").locator("summary").click();
  },

  async "orbits by dragging and zooms by wheel"(page) {
    const before = await look(page);
    const box = await page.locator("#stage").boundingBox();
    await page.mouse.move(box.x + 300, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 380, box.y + 220, { steps: 5 });
    await page.mouse.up();
    await settled(page);
    const turned = await look(page);
    assert.notEqual(turned.hash, before.hash);
    const distance = group(page, "Camera").getByLabel("Distance, number");
    const far = Number(await distance.inputValue());
    await page.mouse.wheel(0, -200); // returns before the page has seen it
    await page.waitForFunction(([input, before]) => Number(input.value) < before, [await distance.elementHandle(), far]);
    await settled(page);
    assert.notEqual((await look(page)).hash, turned.hash);
    assert.equal(await group(page, "Camera").getByLabel("Automatic", { exact: false }).isChecked(), false);
  },

  async "saves pictures, the scene, the layout and the particles"(page) {
    const save = (name) => download(page, () => page.locator("#files").getByRole("button", { name, exact: true }).click());
    const png = await save("PNG");
    assert.equal(png.bytes.subarray(1, 4).toString(), "PNG");
    assert.match(png.name, /\.png$/);
    assert.equal((await save("EXR")).bytes.readUInt32LE(0), 20000630);
    const scene = JSON.parse((await save("JSON")).bytes);
    assert.equal(scene.cubes.length, 23);
    const awn = (await save(".awn")).bytes.toString().trim().split(/\r?\n/);
    assert.deepEqual(awn.slice(0, 2), ["615", "23"]);
    assert.equal(awn.length, 25);
    assert.equal(JSON.parse((await save("Particles as JSON")).bytes).count, 615);
    assert.equal((await save("Particles as CSV")).bytes.toString().trim().split(/\r?\n/).length, 616);
    assert.equal((await save("Particles as PLY")).bytes.subarray(0, 4).toString(), "ply\n");

    await page.getByRole("button", { name: "Copy curl" }).click();
    await page.waitForSelector("#note:not(:empty)");
    const command = await page.evaluate(() => navigator.clipboard.readText());
    execFileSync("bash", ["-c", command], { cwd: scratch });
    const copy = fs.readFileSync(path.join(scratch, "cloud.png"));
    assert.deepEqual(copy, png.bytes, "the copied command makes the same file");
  },

  async "opens layouts, and says what is wrong with bad ones"(page) {
    const layout = path.join(scratch, "two.awn");
    fs.writeFileSync(layout, "30\n2\n10, 1, 1, 1, 0, 0, 0, 1\n20, 2, 1, 2, 3 0, 0, 1.5\n");
    await page.setInputFiles("#file", layout);
    await page.waitForFunction(() => document.querySelector("#particles").textContent === "30");
    await settled(page);
    assert.equal(await cell(page, 1, "radius").inputValue(), "1.5");
    fs.writeFileSync(layout, "31\n2\n10, 1, 1, 1, 0, 0, 0, 1\n20, 2, 1, 2, 3 0, 0, 1.5\n");
    await page.setInputFiles("#file", layout);
    await page.waitForFunction(() => /31/.test(document.querySelector("#alert").textContent));
    assert.equal(await cell(page, 1, "radius").inputValue(), "1.5", "the document stays");
    await page.reload();
    await settled(page);
    assert.equal(await particles(page), 30, "the draft is open again");
  },

  async "shows every preset, and explains why some are no single layout"(page) {
    const names = await page.$$eval("#preset option", (options) => options.map((o) => o.value).filter(Boolean));
    for (const name of names) {
      await choose(page, name);
      const { variance } = await look(page);
      assert.ok(variance > 50, `${name}: variance ${variance}`);
      assert.equal(await page.textContent("#alert"), "", name);
    }
    await choose(page, "humilis-field");
    assert.equal(await page.getByRole("button", { name: ".awn" }).getAttribute("aria-disabled"), "true");
    assert.match(await page.textContent("#awn-why"), /several clouds/);
    await page.locator(".cloud-line select").selectOption("1");
    assert.ok(await page.getByLabel("Turn, °", { exact: true }).isVisible());
  },

  async "chooses accuracy by error, by time and by name, and shows what it costs"(page) {
    await choose(page, "cumulus");
    const panel = group(page, "Accuracy");
    if (!(await panel.evaluate((details) => details.open))) await panel.locator("summary").click();
    const shown = () => panel.locator(".field").evaluateAll((fields) => fields.filter((f) => !f.hidden).map((f) => f.dataset.pointer));
    assert.deepEqual(await shown(), ["/accuracy", "/accuracy/error"]);
    await page.waitForFunction(() => /predicted: error .* %, time/.test(document.querySelector("#predicted").textContent));
    assert.match(await page.textContent("#expected"), /^Expected: about [\d.]+ % from the truth, in [\d.]+ m?s\.$/);
    assert.equal(await page.isVisible("#predicted"), false);
    const scene = async (change) => { // small: this is about the controls
      const json = group(page, "JSON");
      if (!(await json.evaluate((details) => details.open))) await json.locator("summary").click();
      await page.waitForFunction(() => document.querySelector("#json").value !== "");
      await page.locator("#json").fill(JSON.stringify(change(JSON.parse(await page.locator("#json").inputValue()))));
      await json.locator("summary").click();
      await settled(page);
    };
    await scene((document) => ({ ...document, image: { width: 64, height: 48 } }));
    await panel.getByLabel("Chosen by").selectOption("time_ms");
    await panel.getByLabel("Time, ms").fill("5000");
    await settled(page);
    assert.deepEqual(await shown(), ["/accuracy", "/accuracy/time_ms"]);
    assert.deepEqual(renders.at(-1).scene.accuracy, { time_ms: 5000 });
    await panel.getByLabel("Chosen by").selectOption("rung");
    await panel.getByLabel("Rung").selectOption("additive");
    await settled(page);
    assert.deepEqual(renders.at(-1).scene.accuracy, { rung: "additive" });
    assert.equal(await page.textContent("#rung"), "additive");
    assert.match(await page.textContent("#error"), /%/);
    assert.match(await page.textContent("#time"), /ms of .* m?s/);

    // Begun, cancelled, begun anew: only the last comes.
    const calls = []; // of jobs
    page.on("request", (request) => { if (/\/v1\/jobs/.test(request.url())) calls.push(request.method()); });
    const button = page.getByRole("button", { name: "What does accuracy cost?" });
    await button.click();
    await page.waitForSelector('#sweep[open][aria-busy="true"]');
    assert.match(await page.textContent("#sweep-busy"), /truth/);
    await page.getByRole("button", { name: "Cancel" }).click();
    await page.waitForSelector("#sweep:not([open])", { state: "attached" });
    assert.equal(await page.textContent("#alert"), "", "to cancel is no error");
    for (let i = 0; i < 50 && calls.at(-1) !== "DELETE"; i += 1) await page.waitForTimeout(100);
    assert.equal(calls.at(-1), "DELETE", "the service is told");
    const ticks = () => page.$$eval(".ladder .measured", (all) => all.length);
    assert.equal(await ticks(), 0);
    await scene((document) => ({ ...document, image: { width: 16, height: 12 } }));
    await button.click();
    await page.waitForSelector('#sweep[aria-busy="false"]', { timeout: patience * 120_000 });
    const points = page.locator(".accuracy-plot .point");
    assert.ok(await points.count() >= 4, "a point for every rung");
    // A point is where its figures are, and chooses its rung.
    const places = await points.evaluateAll((all) => all.map((one) => {
      const { left, top, width } = one.getBoundingClientRect();
      return { name: one.getAttribute("aria-label"), x: left + width / 2, y: top };
    }));
    const figures = places.map(({ name }) => Number(/: ([\d.e+]+) %/.exec(name)[1]));
    places.forEach((a, i) => places.forEach((b, k) => {
      if (figures[i] > 1.2 * figures[k]) assert.ok(a.y < b.y, `${a.name} is above ${b.name}`);
      if (i < k) assert.ok(a.x <= b.x + 0.01, `${a.name} is left of ${b.name}`);
    }));
    await points.filter({ hasText: "transport-16" }).click();
    assert.equal(await points.filter({ hasText: "transport-16" }).getAttribute("aria-pressed"), "true");
    await page.getByRole("button", { name: "With the picture of every rung" }).click();
    await page.waitForFunction(() => document.querySelector("#sweep-plot").naturalWidth === 1120, null, { timeout: patience * 60_000 });
    await page.waitForSelector('#sweep[aria-busy="false"]');
    await page.keyboard.press("Escape");
    await page.waitForSelector("#sweep:not([open])", { state: "attached" });
    await settled(page);
    assert.deepEqual(renders.at(-1).scene.accuracy, { rung: "transport-16" });
    // What was measured stands at the track, as long as the document is the same but for its accuracy.
    assert.ok(await ticks() >= 8);
    assert.match(await page.getAttribute(".ladder input", "aria-valuetext"), /^transport-16: measured /);
    await scene((document) => ({ ...document, seed: 99 }));
    assert.equal(await ticks(), 0);
    await page.click("#undo");
    await settled(page);
    assert.ok(await ticks() >= 8, "and again, when it is");
    await button.click(); // it is known
    await page.waitForSelector('#sweep[open][aria-busy="false"]');
    assert.ok(await points.count() >= 4);
    await page.getByRole("button", { name: "Close", exact: true }).click();
    await choose(page, "cumulus");
  },

  ...modelTests,

  async "works by keyboard alone"(page) {
    await page.goto(`${origin}/#cumulus`);
    await page.reload();
    await settled(page);
    const active = (script) => page.evaluate(`(${script})(document.activeElement)`);
    const tabTo = async (what, script, limit = 60) => {
      for (let i = 0; i < limit; i += 1) {
        await page.keyboard.press("Tab");
        const outline = await active("(e) => getComputedStyle(e).outlineStyle");
        assert.notEqual(outline, "none", `no visible focus at ${await active("(e) => e.outerHTML.slice(0, 120)")}`);
        if (await active(script)) return;
      }
      assert.fail(`Tab does not reach ${what}`);
    };
    await tabTo("the presets", '(e) => e.id === "preset"');
    await page.keyboard.press("ArrowUp");
    await page.waitForFunction(() => location.hash !== "#cumulus");
    await settled(page);
    await page.keyboard.press("ArrowDown");
    await page.waitForFunction(() => location.hash === "#cumulus");
    await settled(page);
    const start = await look(page);
    await tabTo("the picture", '(e) => e.id === "stage"');
    await page.keyboard.press("ArrowRight");
    await settled(page);
    const turned = await look(page);
    assert.notEqual(turned.hash, start.hash);
    await tabTo("a button that saves", '(e) => e.parentElement.id === "save-buttons"');
    const { bytes } = await download(page, () => page.keyboard.press("Enter"));
    assert.ok(bytes.length > 0);
    await tabTo("a slider", '(e) => e.type === "range"');
    await page.keyboard.press("End");
    await settled(page);
    assert.notEqual((await look(page)).hash, turned.hash);
    await tabTo("the button that adds", '(e) => e.textContent === "Add a cube"');
    await page.keyboard.press("Enter");
    await settled(page);
    assert.equal(await particles(page), 665);
    assert.equal(await active("(e) => e.dataset.pointer"), "/cubes/23/particles", "the new row has the focus");
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("Shift+Enter"); // up the column
    assert.equal(await active("(e) => e.dataset.pointer"), "/cubes/22/particles");
    await settled(page);
    assert.equal(await particles(page), 666);
    await page.keyboard.press("End"); // of the row: the table is one stop
    assert.equal(await active("(e) => e.className"), "delete");
    await page.keyboard.press("Enter");
    await settled(page);
    assert.equal(await particles(page), 656);
  },

  async "fits phones and dark rooms"(page) {
    const background = () => page.evaluate(() =>
      getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).reduce((sum, x) => sum + Number(x), 0) / 3);
    await page.emulateMedia({ colorScheme: "light" });
    assert.ok((await background()) > 180);
    await page.emulateMedia({ colorScheme: "dark" });
    assert.ok((await background()) < 70);
    for (const [width, height] of [[390, 844], [844, 390], [3840, 2160]]) {
      await page.setViewportSize({ width, height });
      const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(over <= 0, `${width} wide: ${over} pixels too wide`);
    }
    await page.setViewportSize({ width: 390, height: 844 });
    assert.ok((await page.screenshot()).length > 10_000);
  },
};

const start = Date.now();
const passed = await runTests(tests);
console.log(`${passed ? "passed" : "failed"} in ${((Date.now() - start) / 1000).toFixed(1)} s`);
process.exit(passed ? 0 : 1);
