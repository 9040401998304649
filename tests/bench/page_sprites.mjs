// page_sprites.mjs ORIGIN SCRATCH [PARTICLES...]: frames a second of particles as sprites, in a flight around them of four
// seconds over a window of 1440 x 900; the processor time that all of the browser spends on one; and after how long their light
// is there. Needs build/node (tests/run.sh) and a server, and WebGL: without a GPU it is Chromium's own software renderer,
// which is said.
//     build/release/awan serve & AWAN_PAGE_GL=1 node tests/bench/page_sprites.mjs http://127.0.0.1:8080 /tmp/sprites
import fs from "node:fs";

import { context, origin, scratch } from "../page_browser.mjs";

const counts = process.argv.slice(4).map(Number);
if (!counts.length) counts.push(10_000, 50_000);
const kSeconds = 4;

// Milliseconds of processor time that the browser has had: the process that was given the profile, and its children.
function processorMs() {
  const processes = fs.readdirSync("/proc").filter((name) => /^\d+$/.test(name)).flatMap((id) => {
    try {
      const stat = fs.readFileSync(`/proc/${id}/stat`, "latin1");
      const fields = stat.slice(stat.lastIndexOf(")") + 2).split(" ");
      return [{ id, parent: fields[1], ms: 10 * (Number(fields[11]) + Number(fields[12])), command: fs.readFileSync(`/proc/${id}/cmdline`, "latin1") }];
    } catch {
      return []; // it has ended
    }
  });
  const own = new Set(processes.filter(({ command }) => command.includes(`--user-data-dir=${scratch}`)).map(({ id }) => id));
  for (let before = -1; before !== own.size;) {
    before = own.size;
    for (const { id, parent } of processes) if (own.has(parent)) own.add(id);
  }
  return processes.filter(({ id }) => own.has(id)).reduce((sum, { ms }) => sum + ms, 0);
}

const page = await context.newPage();
page.setDefaultTimeout(120_000);
await page.setViewportSize({ width: 1440, height: 900 });
const sceneOf = (particles) => ({
  cubes: [-3, 0, 3].map((x) => ({ particles: Math.round(particles / 3), size: [4, 2.5, 4], center: [x, 0, 0], radius: 12 / Math.cbrt(particles) })),
  fill: "uniform", detail: "none", accuracy: { rung: "transport-16" }, image: { width: 480, height: 300 },
});
let scene = null;
await page.route("**/v1/presets/cumulus", (route) => route.fulfill({ json: scene }));

console.log("particles   frames a second, median (90% above)   processor time a frame   light of the service after");
for (const particles of counts) {
  scene = sceneOf(particles);
  await page.goto(`${origin}/?${particles}#cumulus`);
  await page.waitForFunction(() => document.querySelector("#stage").getAttribute("aria-busy") === "false" && document.querySelector("#picture").naturalWidth > 0);
  const seen = Date.now();
  await page.getByRole("button", { name: "Fly", exact: true }).click();
  await page.locator("#flight-bar").waitFor();
  await page.getByRole("button", { name: "Around", exact: true }).click();
  await page.waitForFunction(() => document.querySelector("#stage").dataset.light === "service");
  const lit = Date.now() - seen;
  await page.locator("#stage").focus();
  await page.keyboard.down("d");
  await page.waitForSelector("#stage.sprites");
  const before = processorMs();
  const gaps = await page.evaluate((seconds) => new Promise((done) => {
    const times = [];
    const step = (now) => {
      times.push(now);
      if (now - times[0] < 1000 * seconds) requestAnimationFrame(step);
      else done(times.slice(1).map((time, i) => time - times[i]).sort((a, b) => a - b));
    };
    requestAnimationFrame(step);
  }), kSeconds);
  const each = (processorMs() - before) / gaps.length;
  await page.keyboard.up("d");
  const rate = (share) => (1000 / gaps[Math.floor(share * (gaps.length - 1))]).toFixed(1);
  console.log(`${String(particles).padEnd(12)}${rate(0.5)} (${rate(0.9)})`.padEnd(50) + `${each.toFixed(1)} ms`.padEnd(25) + `${lit} ms`);
}
console.log(await page.evaluate(() => {
  const gl = document.createElement("canvas").getContext("webgl2");
  return gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL);
}));
await context.close();
