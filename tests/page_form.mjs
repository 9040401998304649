// page_form.mjs ORIGIN SCRATCH: the page where no script runs. Started by page_test.sh.

import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";

import { context as usual, launch, origin, scratch } from "./page_browser.mjs";

await usual.close();
const context = await launch("profile-plain", { javaScriptEnabled: false });
let failed = null;
try {
  const page = await context.newPage();
  const faults = [];
  page.on("console", (message) => {
    const icon = message.location().url.endsWith("/favicon.ico"); // of a picture that is looked at by itself
    if (message.type() === "error" && !icon && !/status of 422/.test(message.text())) faults.push(message.text());
  });
  const form = async () => {
    await page.goto(origin);
    assert.equal(await page.locator("#stage").isVisible(), false, "what only scripts fill is not there");
    await page.getByLabel("Width").fill("64");
    await page.getByLabel("Height").fill("40");
    await page.getByLabel("Error allowed").fill("0.5");
  };
  const send = async () => {
    const [response] = await Promise.all([page.waitForResponse("**/v1/render"), page.getByRole("button", { name: "Render" }).click()]);
    return response;
  };

  // As it is, by keyboard alone: the picture.
  await form();
  await page.keyboard.press("Tab");
  await page.getByLabel("Layout").focus();
  await page.getByLabel("Elevation").fill("12");
  const picture = await send();
  assert.equal(picture.status(), 200);
  assert.equal(picture.headers()["content-type"], "image/png");
  assert.match(picture.request().headers()["content-type"], /multipart\/form-data/);

  // A file takes the place of the text.
  const file = path.join(scratch, "one.csv");
  fs.writeFileSync(file, "x,y,z,radius\n0,0,0,1\n");
  await form();
  await page.getByLabel("Or a file").setInputFiles(file);
  assert.equal((await send()).headers()["awan-particles"], "1");

  // What is wrong is said in words, as a page of its own.
  await form();
  await page.getByLabel("Elevation").fill("<b>high");
  const wrong = await send();
  assert.equal(wrong.status(), 422);
  assert.equal(await page.locator("h1").textContent(), "Unprocessable Content");
  assert.match(await page.locator("dl").textContent(), /\/sun\/elevation/);
  assert.equal(await page.locator("b").count(), 0);
  await page.getByRole("link", { name: "the page" }).click();
  await page.getByLabel("Layout").waitFor();
  assert.deepEqual(faults, [], "errors of the browser");
  for (const [width, scheme] of [[1440, "light"], [390, "dark"]]) {
    await page.setViewportSize({ width, height: 844 });
    await page.emulateMedia({ colorScheme: scheme });
    fs.writeFileSync(path.join(scratch, `form-${width}-${scheme}.png`), await page.screenshot({ fullPage: true }));
  }
  console.log("ok is a form where no script runs");
} catch (error) {
  failed = error;
  console.error(`page_test: form: ${error.stack}`);
} finally {
  await context.close();
}
process.exit(failed ? 1 : 0);
