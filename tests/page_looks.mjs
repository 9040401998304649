// page_looks.mjs ORIGIN SCRATCH: the page as it is seen and heard in every state, light and dark, on a phone and enlarged:
// nothing that axe-core objects to, nothing that moves while it loads, nothing too wide; and its weight. Started by
// page_test.sh. Its screenshots stay in $AWAN_SCREENSHOTS, where that is a folder.

import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";

import { axe, context, faults, group, open, openQuiet, origin, settled } from "./page_browser.mjs";

const kMostBytes = 300 * 1024; // of the page as it travels, packed; with the contract, without presets and pictures
const kMostShift = 0.1; // what web.dev calls good

const shots = process.env.AWAN_SCREENSHOTS ?? "";
async function shot(page, name) {
  const bytes = await page.screenshot();
  assert.ok(bytes.length > 10_000, `${name} is blank`);
  if (shots) fs.writeFileSync(path.join(shots, `${name}.png`), bytes);
}
async function clean(page, state) {
  if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(axe); // past the page's policy, not through it
  const wrong = await page.evaluate(async () => {
    const { violations } = await window.axe.run(document, { resultTypes: ["violations"] });
    return violations.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 160)).join(" | ")}`);
  });
  assert.deepEqual(wrong, [], state);
}

let failed = null;
try {
  // --- weight, and what moves while it loads ---
  {
    const page = await context.newPage();
    const sizes = [];
    page.on("requestfinished", async (request) => {
      const where = new URL(request.url());
      if (where.origin === origin && !where.pathname.startsWith("/v1/")) sizes.push(request.sizes());
    });
    await page.addInitScript(() => {
      window.shift = [];
      new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) {
          if (!entry.hadRecentInput) window.shift.push([entry.value, entry.sources.map(({ node }) => node?.id || node?.className || node?.nodeName).join(" ")]);
        }
      }).observe({ type: "layout-shift", buffered: true });
    });
    await page.goto(`${origin}/#cumulus`);
    await settled(page);
    await page.waitForTimeout(500);
    const bytes = (await Promise.all(sizes)).reduce((sum, { responseBodySize }) => sum + responseBodySize, 0);
    const shift = await page.evaluate(() => window.shift);
    const moved = shift.reduce((sum, [value]) => sum + value, 0);
    console.log(`  ${Math.round(bytes / 1024)} KB in ${sizes.length} requests, layout shift ${moved.toFixed(3)}`);
    assert.ok(bytes > 10_000 && bytes <= kMostBytes, `${bytes} bytes`);
    assert.ok(moved < kMostShift, JSON.stringify(shift.filter(([value]) => value > 0.01)));
    await page.close();
    console.log("ok is light, and keeps still while it loads");
  }

  // --- axe-core and screenshots ---
  const page = await open("/#cumulus");
  // A measurement as the service gives it, at once; the first look at the job finds it half done.
  let looks = 0;
  await page.route("**/v1/jobs", (route) => route.fulfill({ status: 202, headers: { Location: "/v1/jobs/1" }, json: {} }));
  await page.route("**/v1/jobs/1", (route) => {
    looks += 1;
    return route.fulfill({ json: { id: "1", state: looks % 8 ? "running" : "done", progress: (looks % 8) / 8 } });
  });
  await page.route("**/v1/jobs/1/result", (route) => route.fulfill({ json: {
    rungs: [["harris", 30, 0.9], ["additive", 34, 7.5], ["single", 60, 0.93], ["transport-16", 41, 0.028], ["transport-24", 43, 0.013],
      ["transport-48", 42, 0.0076], ["transport-32", 70, 0.012]].map(([rung, ms, error]) => ({ rung, time_ms: ms, error })),
    left_out: [{ rung: "transport-64", reason: "it was not done in the 2 s that were left" }],
  } }));
  for (const scheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme: scheme, reducedMotion: "reduce" });
    await page.setViewportSize({ width: 1440, height: 900 });
    await shot(page, `page-${scheme}`);
    await clean(page, `the page, ${scheme}`);
    await page.evaluate(() => document.querySelectorAll("details").forEach((one) => { one.open = true; }));
    await clean(page, `everything unfolded, ${scheme}`);
    await page.getByRole("button", { name: "Drafts", exact: true }).click();
    await page.waitForSelector("#drafts[open]");
    await shot(page, `drafts-${scheme}`);
    await clean(page, `the drafts, ${scheme}`);
    await page.keyboard.press("Escape");
    await page.getByRole("button", { name: "What does accuracy cost?" }).click();
    await page.waitForSelector("#sweep[open] progress:not([hidden])");
    await clean(page, `accuracy being measured, ${scheme}`);
    await page.waitForSelector('#sweep[aria-busy="false"]');
    await shot(page, `accuracy-${scheme}`);
    await clean(page, `what accuracy costs, ${scheme}`);
    await page.setViewportSize({ width: 390, height: 844 });
    await shot(page, `accuracy-phone-${scheme}`);
    await clean(page, `what accuracy costs, on a phone, ${scheme}`);
    await page.setViewportSize({ width: 1440, height: 900 });
    // Names of points hide no other.
    const over = await page.$$eval(".accuracy-plot .point span", (all) => {
      const boxes = all.map((one) => one.getBoundingClientRect());
      return boxes.flatMap((a, i) => boxes.slice(0, i).filter((b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)).length;
    });
    assert.equal(over, 0, "names over names");
    await page.keyboard.press("Escape");
    await group(page, "Sun").getByLabel("Elevation, °").fill("200");
    await page.waitForSelector("#alert:not(:empty)");
    await clean(page, `a problem, ${scheme}`);
    await page.click("#undo");
    await settled(page);
    await page.reload();
    await settled(page);
    for (const [width, height, name] of [[390, 844, "phone"], [720, 450, "enlarged"]]) {
      await page.setViewportSize({ width, height });
      const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(over <= 0, `${name}: ${over} pixels too wide`);
      await shot(page, `${name}-${scheme}`);
      await clean(page, `${name}, ${scheme}`);
    }
  }
  await page.close();
  console.log("ok has nothing that axe-core objects to, in any state");

  // --- fingers ---
  {
    const touch = await openQuiet();
    await touch.setViewportSize({ width: 390, height: 844 });
    await touch.waitForFunction(() => document.querySelector("#picture").naturalWidth > 0);
    const session = await context.newCDPSession(touch);
    const send = (type, points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const value = (label) => group(touch, "Camera").getByLabel(label).inputValue();
    await group(touch, "Camera").evaluate((details) => { details.open = true; });
    await touch.evaluate(() => scrollTo(0, 0));
    const box = await touch.locator("#stage").boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    const before = [await value("Azimuth, °"), await value("Elevation, °"), Number(await value("Distance, number"))];
    await send("touchStart", [[x, y]]);
    for (let step = 1; step <= 8; step += 1) await send("touchMove", [[x, y - 12 * step]]);
    await send("touchEnd", []);
    assert.equal(await value("Elevation, °"), before[1], "a swipe down the page tilts nothing");
    await touch.evaluate(() => scrollTo(0, 0));
    await send("touchStart", [[x, y]]);
    for (let step = 1; step <= 8; step += 1) await send("touchMove", [[x + 12 * step, y]]);
    await send("touchEnd", []);
    assert.notEqual(await value("Azimuth, °"), before[0], "a swipe across orbits");
    const azimuth = await value("Azimuth, °");
    await send("touchStart", [[x - 30, y], [x + 30, y]]);
    for (let step = 1; step <= 8; step += 1) await send("touchMove", [[x - 30 - 6 * step, y], [x + 30 + 6 * step, y]]);
    await send("touchEnd", []);
    assert.ok(Number(await value("Distance, number")) < 0.6 * before[2], "two fingers go nearer");
    assert.ok(Math.abs(Number(await value("Azimuth, °")) - Number(azimuth)) < 2.5, "and orbit nothing");
    assert.equal(await touch.evaluate(() => visualViewport.scale), 1, "the page is not enlarged");
    await touch.close();
    console.log("ok takes one finger and two");
  }
  assert.deepEqual(faults, [], "errors of the browser");
} catch (error) {
  failed = error;
  console.error(`page_test: looks: ${error.stack}\n  faults: ${JSON.stringify(faults)}`);
} finally {
  await context.close();
}
process.exit(failed ? 1 : 0);
