// page_deadline.mjs ORIGIN SCRATCH: the page of a server with little time, and of one that cannot be reached: what fails is
// said, what is on the screen is not passed off for another thing, and the page goes on by itself. Started by page_test.sh
// with a deadline of a few seconds.

import assert from "node:assert/strict";

import { context, faults, group, look, open, patience, runTests, settled } from "./page_browser.mjs";

const elevation = (page) => group(page, "Sun").getByLabel("Elevation, °");
const how = (page) => page.getAttribute("#left", "data-picture");
const alerts = (page, pattern) => page.waitForFunction(({ source }) =>
  new RegExp(source).test(document.querySelector("#alert").textContent), { source: pattern.source }, { timeout: patience * 15_000 });
// What the browser itself writes about these answers is no fault of the page.
const forgive = (pattern) => {
  for (let i = faults.length - 1; i >= 0; i -= 1) if (pattern.test(faults[i])) faults.splice(i, 1);
};
const SCENE = {
  cubes: [{ particles: 200, size: [6, 2, 4], center: [0, 0, 0], radius: 1.5 }],
  sun: { elevation: 40 }, image: { width: 160, height: 100 }, accuracy: { rung: "transport-16" },
};
await context.route("**/v1/presets/cumulus", (route) => route.fulfill({ json: SCENE }));

const tests = {
  async "says what a picture that takes too long could be, and keeps the last"(page) {
    const json = group(page, "JSON");
    await json.locator("summary").click();
    const before = await look(page);
    await page.locator("#json").fill(JSON.stringify({ ...SCENE, image: { width: 3200, height: 2000 }, accuracy: { rung: "truth" } }));
    await alerts(page, /ask for a smaller picture/);
    await page.waitForFunction(() => document.querySelector("#stage").getAttribute("aria-busy") === "false");
    assert.match(await page.textContent("#alert"), /time/);
    // A coarse picture of it may have come before; it is not said to be being refined.
    const shown = await how(page);
    assert.ok(["earlier", "unrefined"].includes(shown), shown);
    if (shown === "earlier") assert.equal((await look(page)).hash, before.hash);
    assert.notEqual(await page.textContent("#mark"), "");
    forgive(/status of 504/);
    await page.click("#undo");
    await settled(page);
    assert.equal(await page.textContent("#alert"), "");
    assert.equal(await page.textContent("#mark"), "");
    assert.equal((await look(page)).hash, before.hash);
  },

  async "says that the service cannot be reached, lets work go on, and catches up by itself"(page) {
    const before = await look(page);
    await context.setOffline(true);
    await elevation(page).fill("20");
    await alerts(page, /cannot be reached/);
    assert.equal(await how(page), "earlier");
    assert.equal((await look(page)).hash, before.hash);
    await elevation(page).fill("25");
    assert.equal(JSON.parse(await page.inputValue("#json")).sun.elevation, 25);
    await page.waitForTimeout(2500); // it has tried again, and failed
    assert.equal(await how(page), "earlier");
    await context.setOffline(false);
    await page.waitForFunction(() => document.querySelector("#left").dataset.picture === "" && document.querySelector("#alert").textContent === "",
      null, { timeout: patience * 15_000 });
    await settled(page);
    assert.notEqual((await look(page)).hash, before.hash, "the picture is of the last edit");
    forgive(/ERR_INTERNET_DISCONNECTED/);
  },

  async "measures nothing that it cannot, and says so in the page"(page) {
    await page.click("#undo");
    await settled(page);
    await context.setOffline(true);
    const panel = group(page, "Accuracy");
    await panel.evaluate((details) => { details.open = true; });
    await page.getByRole("button", { name: "What does accuracy cost?" }).click();
    await alerts(page, /cannot be reached/);
    assert.equal(await page.$eval("#sweep", (dialog) => dialog.open), false);
    await context.setOffline(false);
    forgive(/ERR_INTERNET_DISCONNECTED/);
    await elevation(page).fill("41");
    await settled(page);
    assert.equal(await page.textContent("#alert"), "");
  },
};

process.exit(await runTests(tests, "/#cumulus") ? 0 : 1);
