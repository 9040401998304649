// page_drag.mjs ORIGIN SCRATCH [PRESET...]: what the page shows during a drag of 30 steps in a second around each preset,
// and how long the first and the whole picture take when it is chosen. Needs build/node (tests/run.sh) and a server:
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
const whole = () => page.waitForFunction(() =>
  document.querySelector("#stage").getAttribute("aria-busy") === "false" && document.querySelector("#left").dataset.picture === "", null, { polling: 10 });
await page.goto(`${origin}/#congestus`); // none of those below
await whole();

console.log("preset                first ms   whole ms   pictures in a drag of 1 s");
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
  const start = Date.now();
  for (let step = 1; step <= 30; step += 1) {
    await page.mouse.move(box.x + 200 + 5 * step, box.y + 150 + step);
    await new Promise((done) => setTimeout(done, Math.max(0, start + (step * 1000) / 30 - Date.now())));
  }
  const inDrag = await page.evaluate(() => window.pictures.length);
  await page.mouse.up();
  await whole();
  const since = (time) => String(Math.round(time - begun)).padStart(10);
  console.log(`${preset.padEnd(20)}${since(shown[0][0])} ${since(shown.at(-1)[0])}   ${inDrag}`);
}
await context.close();
