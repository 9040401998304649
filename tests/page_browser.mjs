// What page.mjs uses: Debian's Chromium, a watch on everything that goes wrong in it, and ways to look
// at the page as it stands.

import assert from "node:assert/strict";
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

export const [origin, scratch] = process.argv.slice(2);
const root = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const needs = createRequire(path.join(root, "build/node/package.json"));
const { chromium } = needs("playwright-core");
export const axe = fs.readFileSync(needs.resolve("axe-core/axe.min.js"), "utf8");

// Without WebGL, as on many machines; AWAN_PAGE_GL=1: with that of a program.
const drawing = process.env.AWAN_PAGE_GL ? ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]
  : ["--disable-gpu", "--disable-3d-apis"];
// The page's modules are served as two bundles; a test that looks into one of the others gets it as it lies in web/.
const BUNDLES = ["start.js", "workspace_view.js"];
const MODULES = new Set(fs.readdirSync(path.join(root, "web")).filter((name) => name.endsWith(".js") && !BUNDLES.includes(name)));

// A browser with a profile of its own.
export async function launch(profile, options = {}) {
  const browser = await chromium.launchPersistentContext(path.join(scratch, profile), {
    executablePath: "/usr/bin/chromium",
    headless: true,
    acceptDownloads: true,
    downloadsPath: scratch,
    viewport: { width: 1440, height: 900 },
    args: ["--no-sandbox", ...drawing, "--disable-quic", "--no-first-run",
      "--disable-background-networking", "--disable-component-update", "--disable-sync"],
    ...options,
  });
  await browser.route((url) => MODULES.has(url.pathname.slice(1)), (route) =>
    route.fulfill({ path: path.join(root, "web", new URL(route.request().url()).pathname), contentType: "text/javascript" }));
  return browser;
}
export const context = await launch("profile");
export const patience = process.env.AWAN_SANITIZED ? 10 : 1; // a program with sanitizers is slow
context.setDefaultTimeout(patience * 15_000);
await context.grantPermissions(["clipboard-read", "clipboard-write"], { origin });

// --- what is watched all the time ---

export const faults = []; // console errors, exceptions, violations of the content security policy
export const renders = []; // { scene, state: "flying" | "done" | "cancelled" } of every POST /v1/render

function watch(page) {
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => {
    if (message.type() !== "error" && message.type() !== "warning") return;
    if (/status of 4(00|22)/.test(message.text())) return; // asked for below, and shown at the field
    faults.push(message.text());
  });
  const isRender = (request) => new URL(request.url()).pathname === "/v1/render";
  page.on("request", (request) => {
    if (!isRender(request)) return;
    renders.push({ request, scene: JSON.parse(request.postData()), state: "flying" });
  });
  const landed = (state) => (request) => {
    const render = renders.find((r) => r.request === request);
    if (render) render.state = state;
  };
  page.on("requestfinished", landed("done"));
  page.on("requestfailed", landed("cancelled"));
}

// The presets are made to be looked at, and take up to half a minute each on a busy machine: smaller, and less exact, they are
// enough for the page. "cumulus" stays as it is.
async function quicken(page) {
  await page.route(/\/v1\/presets\/(?!cumulus$)[^/]+$/, async (route) => {
    const response = await route.fetch();
    const json = await response.json();
    const { width = 800, height = 600 } = json.image ?? {};
    const scale = Math.min(1, 240 / width);
    json.image = { ...json.image, width: Math.round(scale * width), height: Math.round(scale * height) };
    if ((json.look ?? "physical") === "physical") json.accuracy = { rung: "transport-16" };
    delete json.sequence; // each of its pictures is planned by three others
    for (const cloud of json.clouds ?? []) {
      if (["implicit", "ellipsoids"].includes(cloud.model)) cloud[cloud.model].resolution = 32;
      if (cloud.ellipsoids?.plane) cloud.ellipsoids.plane.resolution = 64;
      if (cloud.model === "spheres") cloud.spheres.levels = Math.min(4, cloud.spheres.levels ?? 6);
    }
    await route.fulfill({ response, json });
  });
}

// asWithGpu: the page does not find out that a program draws for it.
export async function open(where = "/", { asWithGpu = false } = {}) {
  const page = await context.newPage();
  watch(page);
  await quicken(page);
  if (asWithGpu) {
    await page.addInitScript(() => {
      const { getExtension } = WebGL2RenderingContext.prototype;
      WebGL2RenderingContext.prototype.getExtension = function (name) {
        return name === "WEBGL_debug_renderer_info" ? null : getExtension.call(this, name);
      };
    });
  }
  await page.addInitScript(() => {
    addEventListener("securitypolicyviolation", (event) =>
      console.error(`policy: ${event.violatedDirective} ${event.blockedURI}`));
    // Counted in the page: the browser's own reports come in any order.
    const flights = { now: 0, most: 0 };
    window.flights = flights;
    const { fetch } = window;
    window.fetch = async (url, options) => {
      if (!/^\/v1\/render\b/.test(url)) return fetch(url, options);
      flights.now += 1;
      flights.most = Math.max(flights.most, flights.now);
      try {
        const { status, headers, body } = await fetch(url, options);
        return new Response(await new Response(body).blob(), { status, headers });
      } finally {
        flights.now -= 1;
      }
    };
  });
  await page.goto(origin + where);
  await settled(page);
  return page;
}

// A page for its controls alone: the pictures are a stand-in, or never come; `contract`: whether the service says what
// a document may hold.
export const STAND_IN = Buffer.from(
  "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==", "base64");
export async function openQuiet({ pictures = true, contract = true } = {}) {
  const page = await context.newPage();
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.route("**/v1/render*", (route) => (pictures ? route.fulfill({ contentType: "image/png", body: STAND_IN }) : undefined));
  await page.route("**/v1/plan", (route) => route.fulfill({ json: {} }));
  if (!contract) await page.route("**/openapi.json", (route) => route.fulfill({ status: 503, body: "" }));
  await page.goto(`${origin}/#cumulus`);
  if (contract) await page.waitForFunction(() => document.querySelector("#preset").value === "cumulus");
  return page;
}

// The full picture of the document as it stands is on the screen.
export async function settled(page) {
  await page.waitForFunction(() =>
    document.querySelector("#stage").getAttribute("aria-busy") === "false" &&
    document.querySelector("#picture").naturalWidth > 0, null, { polling: 30, timeout: patience * 40_000 }); // on a busy machine
}

// Size, mean, variance and a hash of the pixels on the screen, or of a PNG given as base64.
export const look = (page, base64 = null) => page.evaluate(async (png) => {
  let image = document.querySelector("#picture");
  if (png) {
    image = new Image();
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
  }
  const { naturalWidth: width, naturalHeight: height } = image;
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  const pen = canvas.getContext("2d");
  pen.drawImage(image, 0, 0);
  const { data } = pen.getImageData(0, 0, width, height);
  let [sum, squares, hash] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    sum += data[i + 1];
    squares += data[i + 1] ** 2;
    hash = (Math.imul(hash, 31) + data[i] + 256 * data[i + 1] + 65536 * data[i + 2]) | 0;
  }
  const mean = sum / (width * height);
  return { width, height, mean, variance: squares / (width * height) - mean ** 2, hash };
}, base64);

export async function choose(page, preset) {
  // The address names the preset at hand: where it does already, nothing would show when it has been chosen again.
  if (!(await page.evaluate((name) => location.hash === `#${name}`, preset))) {
    await page.selectOption("#preset", preset);
    await page.waitForFunction((name) => location.hash === `#${name}`, preset);
  }
  await settled(page);
}
export const particles = async (page) => Number((await page.textContent("#particles")).replace(/\D/g, ""));
export const group = (page, title) => page.locator("details.group").filter({ has: page.getByRole("heading", { name: title, exact: true }) });
export const cell = (page, row, member) => page.locator(`tbody input[data-pointer$="/cubes/${row}/${member}"]`);

export async function download(page, click) {
  const [file] = await Promise.all([page.waitForEvent("download"), click()]);
  return { name: file.suggestedFilename(), bytes: fs.readFileSync(await file.path()) };
}

// The buttons and choices within `selector` that nobody has used since; by what they are called, or by their key.
export async function watchControls(page, selector) {
  await page.evaluate((within) => {
    window.usedControls = new Set();
    const used = (event) => {
      const control = event.target.closest?.("button, select, input");
      if (control?.closest(within)) window.usedControls.add(control);
    };
    for (const type of ["click", "change", "input", "pointerdown"]) document.addEventListener(type, used, { capture: true });
  }, selector);
  return () => page.evaluate((within) => [...document.querySelectorAll(within)].flatMap((part) => [...part.querySelectorAll("button, select, input")])
    .filter((control) => !window.usedControls.has(control))
    .map((control) => control.getAttribute("aria-label") || control.labels?.[0]?.textContent || control.textContent), selector);
}

// Runs tests by name, one after the other on one page at `address`, up to the first that fails. True when all passed.
export async function runTests(tests, address) {
  try {
    const page = await open(address);
    for (const [name, test] of Object.entries(tests)) {
      const begun = Date.now();
      try {
        await test(page);
        assert.deepEqual(faults, [], "errors of the browser");
      } catch (error) {
        await page.screenshot({ path: path.join(scratch, "fault.png") }).catch(() => {});
        console.error(`page_test: ${name}: ${error.stack}\n  faults: ${JSON.stringify(faults)}`);
        return false;
      }
      console.log(`ok ${name} (${Date.now() - begun} ms)`);
    }
    return true;
  } finally {
    await context.close();
  }
}
