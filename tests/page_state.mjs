// page_state.mjs ORIGIN SCRATCH: what the page keeps and never loses: drafts, undo across a reload, shared addresses,
// files that are opened and saved. Started by page_test.sh.

import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";

import { cell, choose, context, download, faults, group, look, open, openQuiet, origin, particles, renders, runTests, scratch, settled } from "./page_browser.mjs";

const elevation = (page) => group(page, "Sun").getByLabel("Elevation, °");
const noteSays = (page, text) => page.waitForFunction((t) => document.querySelector("#note").textContent.includes(t), text);
const button = (page, name) => page.getByRole("button", { name, exact: true });
// What is written into the database comes after what is seen.
const kept = (page) => page.waitForTimeout(500);

const tests = {
  async "says that it cannot fly where nothing can be drawn"(page) {
    await button(page, "Fly").click();
    await noteSays(page, "Flying needs WebGL");
    assert.equal(await page.$eval("#stage", (stage) => stage.classList.contains("flying")), false);
  },

  async "keeps undo across a reload"(page) {
    await choose(page, "cumulus");
    for (const degrees of ["11", "12", "13"]) {
      await elevation(page).fill(degrees);
      await page.waitForTimeout(1100); // closer together they are one step
    }
    await settled(page);
    await kept(page);
    await page.reload();
    await settled(page);
    assert.equal(await elevation(page).inputValue(), "13");
    await button(page, "Undo").click();
    assert.equal(await elevation(page).inputValue(), "12");
    await button(page, "Undo").click();
    await button(page, "Undo").click();
    assert.equal(await page.inputValue("#preset"), "cumulus", "undone to the preset, it is the preset again");
    await kept(page);
    await page.reload();
    await settled(page);
    for (let i = 0; i < 3; i += 1) await button(page, "Redo").click();
    assert.equal(await elevation(page).inputValue(), "13");
    assert.equal(await button(page, "Redo").isDisabled(), true);
  },

  async "erases nothing when a preset is chosen"(page) {
    await page.selectOption("#preset", "stratus");
    await noteSays(page, "is kept");
    await settled(page);
    await kept(page);
    await button(page, "Drafts").click();
    const entry = page.locator(".drafts .draft").first();
    await entry.waitFor();
    assert.match(await entry.textContent(), /Cumulus, table 4.4.*23 cubes/);
    await entry.click();
    await settled(page);
    assert.equal(await elevation(page).inputValue(), "13");
    assert.equal(await page.inputValue("#preset"), "");
    await button(page, "Undo").click(); // and the way back
    await settled(page);
    assert.equal(await page.inputValue("#preset"), "stratus");
    await button(page, "Redo").click();
    await settled(page);
  },

  async "opens the last draft in a new tab, forgets one that is dropped, and takes it back"(page) {
    const other = await context.newPage();
    await other.goto(origin);
    await settled(other);
    assert.equal(await elevation(other).inputValue(), "13");
    await button(other, "Drafts").click();
    await other.locator(".drafts .delete").first().waitFor();
    const names = () => other.$$eval(".drafts li:has(.delete) strong", (all) => all.map((one) => one.textContent));
    const left = (n) => other.waitForFunction((count) => document.querySelectorAll(".drafts .delete").length === count, n);
    const before = await names();
    const forget = async () => {
      await other.locator(".drafts .delete").first().click();
      await left(before.length - 1);
    };
    await forget();
    await other.getByRole("button", { name: /^Take it back/ }).click();
    await left(before.length);
    assert.deepEqual(await names(), before);
    assert.equal(await other.getByRole("button", { name: /^Take it back/ }).count(), 0);
    await forget();
    await button(other, "Close").click();
    await button(other, "Drafts").click();
    await left(before.length - 1);
    assert.equal(await other.getByRole("button", { name: /^Take it back/ }).count(), 0, "for as long as the list is open");
    await other.close();
    await page.bringToFront();
  },

  async "shares a scene by its address alone"(page) {
    await elevation(page).fill("17");
    await settled(page);
    await button(page, "Share").click();
    await noteSays(page, "on the clipboard");
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(link, /#s=[\w-]+$/);
    assert.ok(link.length < 2000, `${link.length} characters`);
    const { hash } = await look(page);
    const other = await context.newPage();
    await other.goto(link);
    await settled(other);
    assert.equal(await elevation(other).inputValue(), "17");
    assert.equal((await look(other)).hash, hash);
    await other.goto("about:blank");
    await other.goto(link.slice(0, -30));
    await noteSays(other, "cut off");
    assert.ok((await other.inputValue("#preset")) !== "", "something is there all the same");
    await other.close();
    await page.bringToFront();
  },

  async "opens particles by button and by drop, and says what is wrong with bad ones"(page) {
    await choose(page, "cumulus");
    const csv = path.join(scratch, "cloud.csv");
    fs.writeFileSync(csv, "x,y,z,radius,density\n0,0,0,1,0.5\n1,0,0,1,1\n2,0.5,0,1.5,1\n");
    await page.setInputFiles("#file", csv);
    await page.waitForFunction(() => document.querySelector("#particles").textContent === "3");
    await settled(page);
    const sent = renders.at(-1).scene.clouds[0];
    assert.deepEqual([sent.model, sent.positions[2], sent.radii], ["particles", [2, 0.5, 0], [1, 1, 1.5]]);
    assert.ok(Math.abs(sent.densities[1] - 2 * sent.densities[0]) < 1e-6);
    const { bytes: ply } = await download(page, () => button(page, "Particles as PLY").click());
    const { hash } = await look(page);
    await choose(page, "cumulus");
    await page.evaluate((letters) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(atob(letters), (c) => c.charCodeAt(0))], "dropped.ply"));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    }, ply.toString("base64"));
    await page.waitForFunction(() => document.querySelector("#particles").textContent === "3");
    await settled(page);
    assert.equal((await look(page)).hash, hash, "saved and opened again, they make the same picture");
    fs.writeFileSync(csv, "x,y,z,radius\n0,0,zero,1\n");
    await page.setInputFiles("#file", csv);
    await page.waitForFunction(() => /cloud\.csv: .*line 2/.test(document.querySelector("#alert").textContent));
    assert.equal(await particles(page), 3, "the document stays");
  },

  async "saves the picture that is on the screen without rendering it again"(page) {
    await choose(page, "cumulus");
    const before = renders.length;
    const { bytes } = await download(page, () => page.locator("#files").getByRole("button", { name: "PNG", exact: true }).click());
    assert.equal(bytes.subarray(1, 4).toString(), "PNG");
    assert.equal(renders.length, before);
  },

  async "saves an animation with its progress, and says why not where there is none"(page) {
    await button(page, "Animation").click({ force: true }); // it is reachable, to say why it does nothing
    await noteSays(page, "needs a sequence");
    const small = path.join(scratch, "moving.json");
    fs.writeFileSync(small, JSON.stringify({
      clouds: [{ cubes: [{ particles: 20, size: [2, 1, 2], center: [0, 0, 0], radius: 1 }], velocity: [3, 0, 0] }],
      camera: { eye: [0, 0, 12], target: [0, 0, 0] }, image: { width: 32, height: 20 }, accuracy: { rung: "transport-16" }, sequence: { from: 0, to: 1, frames: 3 },
    }));
    await page.setInputFiles("#file", small);
    await noteSays(page, "moving.json is open");
    await settled(page);
    const { name, bytes } = await download(page, () => button(page, "Animation").click());
    assert.equal(name, "moving.webp");
    assert.equal(bytes.subarray(0, 4).toString() + bytes.subarray(8, 12).toString(), "RIFFWEBP");
    assert.ok(bytes.includes("ANMF"), "it has frames");
  },

  async "keeps a table of 10,000 cubes light, with one stop of Tab and every figure whole"(page) {
    const cubes = Array.from({ length: 10_000 }, (_unused, i) => ({
      particles: 1, size: [1, 1.23456789, 100000.5], center: [-6.12438e-7, i, -0.900001], radius: 0.5 }));
    const large = path.join(scratch, "large.json");
    fs.writeFileSync(large, JSON.stringify({ cubes }));
    const other = await openQuiet();
    await other.setInputFiles("#file", large);
    await other.waitForFunction(() => document.querySelector(".table-summary").textContent.startsWith("10,000 cubes"));
    const there = () => other.locator("tbody tr[data-index]").count();
    assert.ok((await there()) < 80, `${await there()} rows`);
    const cut = await other.$$eval(".layout tbody input", (inputs) =>
      inputs.filter((input) => input.scrollWidth > input.clientWidth).map((input) => input.value));
    assert.deepEqual(cut, [], "figures that are cut off");
    assert.equal(await cell(other, 0, "center/0").inputValue(), "-6.12e-7");
    assert.equal(await other.$$eval(".layout [tabindex='0']", (stops) => stops.length), 1);

    const active = () => other.evaluate(() => document.activeElement.dataset.pointer ?? document.activeElement.className);
    await cell(other, 2, "particles").focus();
    await other.keyboard.press("ArrowRight");
    assert.equal(await active(), "/cubes/2/size/0");
    await other.keyboard.press("Control+End");
    assert.equal(await active(), "/cubes/9999/size/0");
    assert.ok((await there()) < 80, `${await there()} rows`);
    await other.keyboard.press("PageUp");
    assert.equal(await active(), "/cubes/9989/size/0");
    await other.keyboard.type("7"); // from here on, arrows are the field's own
    await other.keyboard.press("ArrowLeft");
    assert.equal(await active(), "/cubes/9989/size/0");
    await other.keyboard.press("Enter");
    assert.equal(await active(), "/cubes/9990/size/0");
    await other.keyboard.press("End");
    assert.equal(await active(), "delete");
    await other.keyboard.press("Tab");
    assert.equal(await other.evaluate(() => document.activeElement.closest("table")), null);
    await other.keyboard.press("Shift+Tab");
    assert.equal(await active(), "delete");
    await other.keyboard.press("Enter");
    await other.waitForFunction(() => document.querySelector(".table-summary").textContent.startsWith("9,999 cubes"));
    assert.equal(await active(), "delete");
    // What can be done with a row is in sight however narrow the table is.
    for (const width of [1440, 390]) {
      await other.setViewportSize({ width, height: 844 });
      const [button, box] = await other.evaluate(() => [document.activeElement, document.activeElement.closest(".table-scroll")]
        .map((e) => e.getBoundingClientRect().toJSON()));
      assert.ok(button.right <= box.right && button.left >= box.left, `${width}: ${JSON.stringify([button, box])}`);
    }
    await other.close();
    await page.bringToFront();
  },

  // Whatever is done, undo goes back to every state, and redo forward again: 60 random steps.
  async "undoes and redoes any edits"(page) {
    await choose(page, "cumulus");
    await page.evaluate(() => { window.fetch = () => new Promise(() => {}); }); // this is about the document alone
    const wrong = await page.evaluate(async () => {
      const { createStore } = await import("./document.js");
      let seed = 12345;
      const random = (n) => {
        seed = (Math.imul(seed, 1103515245) + 12345) & 0x7fffffff;
        return (seed >> 8) % n;
      };
      for (let round = 0; round < 50; round += 1) {
        const store = createStore();
        store.replaceText('{"cubes": []}', { preset: "p", title: "p" });
        store.forgetHistory();
        const states = [store.text];
        let now = 0;
        for (let step = 0; step < 60; step += 1) {
          const what = random(6);
          if (what === 0 && now > 0) { store.undo(); now -= 1; }
          else if (what === 1 && now < states.length - 1) { store.redo(); now += 1; }
          else {
            const before = store.text;
            const value = random(1000) + step * 1000;
            if (what === 2) store.update((scene) => ({ ...scene, cubes: [...(scene.cubes ?? []), { particles: value }] }));
            else if (what === 3) store.replaceText(`{"seed": ${value}}`, { title: "t" });
            else if (what === 4) store.bringBack(structuredClone(store.history(1000)));
            else store.set(`/sun/f${step}`, value);
            if (store.text !== before) {
              states.splice(now + 1, Infinity, store.text);
              now += 1;
            }
          }
          if (store.text !== states[now]) return `round ${round}, step ${step}: ${store.text} is not ${states[now]}`;
          if (store.canUndo !== now > 0 || store.canRedo !== now < states.length - 1) return `round ${round}, step ${step}: ends`;
        }
      }
      return "";
    });
    assert.equal(wrong, "");
    await page.reload();
    await settled(page);
  },

  async "says that the service is gone, and goes on when it is back"(page) {
    await choose(page, "cumulus");
    await context.setOffline(true);
    await elevation(page).fill("31");
    await page.waitForFunction(() => /cannot be reached/.test(document.querySelector("#alert").textContent));
    // A state between two keys may fail first; the last one fails, too.
    await page.waitForFunction(() => document.querySelector("#mark").textContent === "of an earlier state");
    await context.setOffline(false);
    await settled(page);
    await page.waitForFunction(() => document.querySelector("#alert").textContent === "");
    assert.equal(renders.at(-1).scene.sun.elevation, 31);
    faults.splice(0, Infinity, ...faults.filter((fault) => !/ERR_INTERNET_DISCONNECTED/.test(fault)));
  },
};

process.exit(await runTests(tests, "/#cumulus") ? 0 : 1);
