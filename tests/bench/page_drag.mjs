// page_drag.mjs ORIGIN SCRATCH [PRESET...]: what the page shows during a drag of 30 steps in a second around each preset,
// and how long the first and the last picture take when it is chosen; before that, when the page itself is first painted and
// its first picture is there. Of the service it says how long it worked on the coarse pictures of the drag, in the mean.
// Needs build/node (tests/run.sh) and a server:
//     build/release/awan serve & node tests/bench/page_drag.mjs http://127.0.0.1:8080 /tmp/drag
import { context, origin } from "../page_browser.mjs";

const presets = process.argv.slice(4);
if (!presets.length) presets.push("cumulus", "noon-cumulus", "thunderhead", "sky-of-100");

const page = await context.newPage();
page.setDefaultTimeout(120_000);
await page.addInitScript(() => {
  window.pictures = []; // [time, width] of all that were shown
  addEventListener("DOMContentLoaded", () => {
    const picture = document.querySelector("#picture");
    new MutationObserver(() => window.pictures.push([performance.now(), picture.naturalWidth])).observe(picture, { attributeFilter: ["src"] });
  });
});
// What is refused as too long stays coarse.
const whole = () => page.waitForFunction(() =>
  document.querySelector("#stage").getAttribute("aria-busy") === "false" && ["", "unrefined"].includes(document.querySelector("#left").dataset.picture),
null, { polling: 10 });
const timings = []; // ms of the service, of every picture
page.on("response", async (response) => {
  if (!response.url().includes("/v1/render") || !response.ok()) return;
  const stages = response.headers()["server-timing"] ?? "";
  timings.push(["queue", "generate", "survey", "light", "draw", "measure", "encode"]
    .reduce((sum, name) => sum + Number(new RegExp(`(?:^|, )${name};dur=([0-9.]+)`).exec(stages)?.[1] ?? 0), 0));
});
await page.goto(`${origin}/#congestus`); // none of those below
await whole();

const painted = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0].startTime);
const begin = await page.evaluate(() => [window.pictures[0][0], window.pictures.at(-1)[0]]);
console.log(`the page: first paint ${Math.round(painted)} ms, first picture ${Math.round(begin[0])} ms, last ${Math.round(begin[1])} ms`);
console.log("preset                first ms   whole ms   pictures in a drag of 1 s   ms of the service each");
for (const preset of presets) {
  const begun = await page.evaluate(() => {
    window.pictures.length = 0;
    return performance.now();
  });
  await page.selectOption("#preset", preset);
  await page.waitForFunction((name) => location.hash === `#${name}`, preset);
  await whole();
  const shown = await page.evaluate(() => window.pictures);
  await page.evaluate(() => { window.pictures.length = 0; });
  const box = await page.locator("#stage").boundingBox();
  await page.mouse.move(box.x + 200, box.y + 150);
  await page.mouse.down();
  timings.length = 0;
  const start = Date.now();
  for (let step = 1; step <= 30; step += 1) {
    await page.mouse.move(box.x + 200 + 5 * step, box.y + 150 + step);
    await new Promise((done) => setTimeout(done, Math.max(0, start + (step * 1000) / 30 - Date.now())));
  }
  const inDrag = await page.evaluate(() => window.pictures.length);
  const service = timings.reduce((sum, ms) => sum + ms, 0) / Math.max(1, timings.length);
  await page.mouse.up();
  await whole();
  const since = (time) => String(Math.round(time - begun)).padStart(10);
  console.log(`${preset.padEnd(20)}${since(shown[0][0])} ${since(shown.at(-1)[0])}   ${String(inDrag).padEnd(28)}${Math.round(service)}`);
}
await context.close();
