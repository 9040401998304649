// page_pictures.mjs ORIGIN SCRATCH [light] [dark] [film]: README's pictures of the page, into web/presets/pictures/: page-light.webp, page-dark.webp
// and page.webp, in which someone turns the cloud, moves a part of it and the sun. Needs build/node (tests/run.sh), WebGL and
// a server:
//     build/release/awan serve --deadline 300 & AWAN_PAGE_GL=1 node tests/bench/page_pictures.mjs http://127.0.0.1:8080 /tmp/pictures
import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { context, origin } from "../page_browser.mjs";

const pictures = path.join(path.dirname(fileURLToPath(import.meta.url)), "../../web/presets/pictures");
const kFrameMs = 90;
const kWide = 1200, kHigh = 750;

// --- WebP: still pictures put into one file (RIFF container specification, "Animation") ---

function chunk(name, body) {
  const head = Buffer.alloc(8);
  head.write(name, 0, "latin1");
  head.writeUInt32LE(body.length, 4);
  return Buffer.concat([head, body, Buffer.alloc(body.length % 2)]);
}
// The chunks of a still picture that hold its pixels.
function pixelsOf(webp) {
  const parts = [];
  for (let at = 12; at + 8 <= webp.length;) {
    const length = webp.readUInt32LE(at + 4);
    if (["VP8 ", "VP8L", "ALPH"].includes(webp.toString("latin1", at, at + 4))) parts.push(webp.subarray(at, at + 8 + length + (length % 2)));
    at += 8 + length + (length % 2);
  }
  return Buffer.concat(parts);
}
const three = (value) => Buffer.from([value & 255, (value >> 8) & 255, (value >> 16) & 255]);
// frames: [{ webp, ms }], all of one size.
function animated(frames, width, height) {
  const size = Buffer.concat([three(width - 1), three(height - 1)]);
  const body = Buffer.concat([
    Buffer.from("WEBP"),
    chunk("VP8X", Buffer.concat([Buffer.from([2, 0, 0, 0]), size])),
    chunk("ANIM", Buffer.from([255, 255, 255, 255, 0, 0])),
    ...frames.map(({ webp, ms }) => chunk("ANMF", Buffer.concat([three(0), three(0), size, three(ms), Buffer.from([2]), pixelsOf(webp)]))),
  ]);
  const head = Buffer.alloc(8);
  head.write("RIFF", 0, "latin1");
  head.writeUInt32LE(body.length, 4);
  return Buffer.concat([head, body]);
}

// --- the page ---

async function openPage(preset, colorScheme) {
  const page = await context.newPage();
  page.setDefaultTimeout(300_000);
  await page.setViewportSize({ width: kWide, height: kHigh });
  await page.emulateMedia({ colorScheme });
  await page.goto(`${origin}/#${preset}`);
  await page.waitForFunction(() => document.querySelector('[data-mode="translate"]')?.offsetParent != null);
  await whole(page);
  return { page, session: await context.newCDPSession(page) };
}
const whole = (page) => page.waitForFunction(() =>
  document.querySelector("#stage").getAttribute("aria-busy") === "false" && document.querySelector("#left").dataset.picture === "");
async function shot({ session }, quality, clip) {
  const { data } = await session.send("Page.captureScreenshot", { format: "webp", quality, ...(clip ? { clip } : {}) });
  return Buffer.from(data, "base64");
}
const pick = (page, id) => page.locator("#shape select[multiple]").selectOption(id);

async function still(preset, colorScheme, file, prepare) {
  const one = await openPage(preset, colorScheme);
  await prepare(one.page);
  await whole(one.page);
  await one.page.waitForTimeout(800); // the last note has gone, and so have the sprites
  fs.writeFileSync(path.join(pictures, file), await shot(one, 82));
  await one.page.close();
}

// Where something can be taken hold of, on the screen: the gizmo's top, and the sun.
async function handles(page, stage) {
  const found = [];
  for (let y = stage.y + 14; y < stage.y + 0.75 * stage.height; y += 14) {
    for (let x = stage.x + stage.width / 4; x < stage.x + 0.85 * stage.width; x += 14) {
      await page.mouse.move(x, y);
      if (await page.$eval("#stage", (one) => one.classList.contains("takes"))) found.push([x, y]);
    }
  }
  const middle = [0, 1].map((axis) => found.map((point) => point[axis]).sort((a, b) => a - b)[found.length >> 1]);
  const near = ([x, y]) => Math.hypot(x - middle[0], y - middle[1]) < 110;
  const gizmo = found.filter(near);
  const arrow = gizmo.filter(([x]) => Math.abs(x - middle[0]) < 20);
  return { arrow: (arrow.length ? arrow : gizmo).at(0), sun: found.filter((point) => !near(point)).at(0) };
}

async function film() {
  const one = await openPage("congestus", "light");
  const { page } = one;
  await pick(page, "/cubes/2");
  await whole(page);
  await page.waitForFunction(() => document.querySelector("#stage").dataset.light === "service");
  const { x, y, width, height } = await page.locator("#left").boundingBox();
  const clip = { x, y: 0, width: Math.floor(width / 2) * 2, height: Math.min(kHigh, Math.floor((y + height) / 2) * 2), scale: 0.5 };
  const frames = [];
  const take = async (ms = kFrameMs) => { frames.push({ webp: await shot(one, 50, clip), ms }); };
  const stage = await page.locator("#stage").boundingBox();
  const drag = async (from, to, steps) => {
    await page.mouse.move(...from);
    await page.waitForTimeout(150); // what is under the pointer is known a frame later
    await page.mouse.down();
    for (let i = 1; i <= steps; i += 1) {
      await page.mouse.move(from[0] + ((to[0] - from[0]) * i) / steps, from[1] + ((to[1] - from[1]) * i) / steps);
      await page.waitForTimeout(60);
      await take();
    }
    await page.mouse.up();
    await whole(page);
    await page.waitForTimeout(400);
    await take(900);
  };
  await take(900);
  const { arrow, sun } = await handles(page, stage);
  await drag(arrow, [arrow[0], arrow[1] - 70], 8);
  if (sun) await drag(sun, [sun[0] + (sun[0] < stage.x + stage.width / 2 ? 160 : -160), sun[1] + 10], 9);
  const corner = [stage.x + 0.06 * stage.width, stage.y + 0.2 * stage.height];
  await drag(corner, [corner[0] + 110, corner[1] + 10], 10); // the camera
  fs.writeFileSync(path.join(pictures, "page.webp"), animated(frames, Math.round(clip.width * clip.scale), Math.round(clip.height * clip.scale)));
  await page.close();
}

const MAKE = {
  light: () => still("cumulus", "light", "page-light.webp", (page) => pick(page, "/cubes/3")),
  dark: () => still("silver-lining", "dark", "page-dark.webp", (page) => page.getByRole("button", { name: "Fly", exact: true }).click()),
  film,
};
const wanted = process.argv.slice(4);
for (const [name, make] of Object.entries(MAKE)) if (!wanted.length || wanted.includes(name)) await make();
for (const file of fs.readdirSync(pictures).filter((one) => /^page.*\.webp$/.test(one))) {
  console.log(`${file}: ${(fs.statSync(path.join(pictures, file)).size / 1000).toFixed(0)} kB`);
}
await context.close();
