// page_sprites.mjs ORIGIN SCRATCH [PARTICLES...]: frames a second of particles as sprites, in a flight around them of four
// seconds over a window of 1440 x 900; what the page's own script takes of one, and the processor time that all of the browser
// spends on it; and after how long their light is there. Needs build/node (tests/run.sh) and a server, and WebGL: without a GPU
// it is Chromium's own software renderer, which is said. Then the page draws 5,000 of them at most; the second row of each
// count is with all of them, as where there is a GPU: frames say nothing then, the script's time is what it would be.
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
await page.addInitScript(() => {
  if (/all/.test(location.search)) { // the page does not find out that a program draws for it
    const { getExtension } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.getExtension = function (name) {
      return name === "WEBGL_debug_renderer_info" ? null : getExtension.call(this, name);
    };
  }
  window.scripts = new Map(); // ms of all that was asked to run before a frame, by the frame's time
  const { requestAnimationFrame: ask } = window;
  window.requestAnimationFrame = (run) => ask((now) => {
    const begun = performance.now();
    run(now);
    window.scripts.set(now, (window.scripts.get(now) ?? 0) + performance.now() - begun);
  });
});
const sceneOf = (particles) => ({
  cubes: [-3, 0, 3].map((x) => ({ particles: Math.round(particles / 3), size: [4, 2.5, 4], center: [x, 0, 0], radius: 12 / Math.cbrt(particles) })),
  fill: "uniform", detail: "none", accuracy: { rung: "transport-16" }, image: { width: 480, height: 300 },
});
let scene = null;
await page.route("**/v1/presets/cumulus", (route) => route.fulfill({ json: scene }));

console.log("particles     frames a second, median (90% above)   script a frame, median (90% below)   processor time a frame   light of the service after");
for (const [particles, how] of counts.flatMap((count) => [[count, ""], [count, "all"]])) {
  scene = sceneOf(particles);
  await page.goto(`${origin}/?${particles}${how}#cumulus`);
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
  const [gaps, scripts] = await page.evaluate((seconds) => new Promise((done) => {
    const times = [];
    window.scripts.clear();
    const step = (now) => {
      times.push(now);
      if (now - times[0] < 1000 * seconds) requestAnimationFrame(step);
      else done([times.slice(1).map((time, i) => time - times[i]), [...window.scripts.values()]].map((all) => all.sort((a, b) => a - b)));
    };
    requestAnimationFrame(step);
  }), kSeconds);
  const each = (processorMs() - before) / gaps.length;
  await page.keyboard.up("d");
  const script = (share) => scripts[Math.floor(share * (scripts.length - 1))].toFixed(1);
  const rate = (share) => (1000 / gaps[Math.floor(share * (gaps.length - 1))]).toFixed(1);
  console.log(`${particles} ${how}`.padEnd(14) + `${rate(0.5)} (${rate(0.9)})`.padEnd(38) + `${script(0.5)} ms (${script(0.9)} ms)`.padEnd(38) + `${each.toFixed(1)} ms`.padEnd(25) + `${lit} ms`);
}
await page.goto(`${origin}/?asked#cumulus`); // what draws, where that is not hidden
console.log(await page.evaluate(() => {
  const gl = document.createElement("canvas").getContext("webgl2");
  return gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info").UNMASKED_RENDERER_WEBGL);
}));
await context.close();
