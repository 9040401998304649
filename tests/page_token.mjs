// page_token.mjs ORIGIN SCRATCH TOKEN: the page of a server that wants a token. Started by page_test.sh.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

import { context, download, group, look, origin, scratch, settled } from "./page_browser.mjs";

const token = process.argv[4];
const page = await context.newPage();
const faults = [];
page.on("pageerror", (error) => faults.push(String(error)));
page.on("console", (message) => {
  if (message.type() === "error" && !/status of 401/.test(message.text())) faults.push(message.text());
});
const shown = []; // the Authorization of every call
page.on("request", (request) => {
  assert.equal(new URL(request.url()).origin === origin || request.url().startsWith("blob:"), true, request.url());
  if (new URL(request.url()).pathname.startsWith("/v1/")) shown.push(request.headers().authorization ?? "");
});

const field = page.getByLabel("The server's token");
const give = async (text) => {
  await field.fill(text);
  await field.press("Enter");
};
const alerts = (text) => page.waitForFunction((t) => document.querySelector("#alert").textContent === t, text);

let failed = null;
try {
  // The page comes, and says what it lacks.
  await page.goto(`${origin}/#cumulus`);
  await field.waitFor();
  await alerts("This server wants its token.");
  assert.equal(await field.evaluate((input) => input === document.activeElement), true);
  assert.deepEqual([...new Set(shown)], [""]);

  // What cannot be one is said at the field and not sent; what is none is refused by the server.
  const before = shown.length;
  await give("grüße euch");
  assert.equal(await field.evaluate((input) => input.validity.valid), false);
  assert.equal(shown.length, before);
  await give("0123456789abcdee");
  await alerts("The server does not take this token.");
  assert.ok(await field.isVisible());

  await give(token);
  await settled(page);
  assert.ok((await look(page)).variance > 50, "a picture");
  assert.equal(await page.textContent("#alert"), "");
  assert.equal(await field.isVisible(), false);
  assert.equal(await page.inputValue("#preset"), "cumulus");
  assert.equal(shown.at(-1), `Bearer ${token}`);
  assert.equal(await page.evaluate(() => JSON.stringify({ ...localStorage }).includes("0123456789")), false);
  assert.equal(await page.evaluate(() => location.href.includes("0123456789")), false);

  // Everything else on the page shows it too.
  const csv = await download(page, () => page.getByRole("button", { name: "Particles as CSV" }).click());
  assert.equal(csv.bytes.toString().trim().split(/\r?\n/).length, 616);
  await page.click("#plan summary");
  await page.waitForSelector("#plan-body tbody tr");
  await page.getByRole("button", { name: "Copy curl" }).click();
  await page.waitForFunction(() => document.querySelector("#note").textContent.includes("AWAN_TOKEN"));
  const command = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(command.includes(token), false, "a command can be shown to others");
  execFileSync("bash", ["-c", command], { cwd: scratch, env: { ...process.env, AWAN_TOKEN: token } });
  assert.equal(fs.readFileSync(path.join(scratch, "cloud.png")).subarray(1, 4).toString(), "PNG");

  // It is kept for the tab, and asked for again where it is not taken any more.
  await page.reload();
  await settled(page);
  assert.equal(await field.isVisible(), false);
  await page.evaluate(() => sessionStorage.setItem("awan.token", "0123456789abcdee"));
  await page.reload();
  await alerts("The server does not take this token.");
  await give(token);
  await settled(page);

  // A token that changes while the page is open: the document stays.
  await page.route("**/v1/render*", (route) => route.fulfill({ status: 401, json: { title: "Unauthorized" } }), { times: 1 });
  const elevation = group(page, "Sun").getByLabel("Elevation, °");
  await elevation.fill("12");
  await field.waitFor();
  await give(token);
  await settled(page);
  assert.equal(await elevation.inputValue(), "12");
  assert.equal(await page.textContent("#alert"), "");
  assert.deepEqual(faults, [], "errors of the browser");
  console.log("ok asks for the token of a server that wants one");
} catch (error) {
  failed = error;
  console.error(`page_test: token: ${error.stack}\n  faults: ${JSON.stringify(faults)}`);
} finally {
  await context.close();
}
process.exit(failed ? 1 : 0);
