// The list of drafts: what was worked on last, to be opened again.

import { byId, el } from "./dom.js";
import { prettyJson } from "./json_text.js";
import { cloudsOf, modelOf } from "./document.js";

const count = (n, one) => `${n.toLocaleString("en")} ${one}${n === 1 ? "" : "s"}`;

// What is in it, in a few words.
function contents(scene) {
  const clouds = cloudsOf(scene);
  if (clouds.length !== 1) return count(clouds.length, "cloud");
  const [{ cloud }] = clouds;
  const model = modelOf(cloud);
  if (model === "cubes") return count(Array.isArray(cloud.cubes) ? cloud.cubes.length : 0, "cube");
  if (model === "particles") return count(Array.isArray(cloud.positions) ? cloud.positions.length : 0, "particle");
  return String(model);
}

function ago(time) {
  const minutes = Math.round((Date.now() - time) / 60_000);
  const said = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
  if (minutes < 60) return said.format(-minutes, "minute");
  if (minutes < 24 * 60) return said.format(-Math.round(minutes / 60), "hour");
  return said.format(-Math.round(minutes / 60 / 24), "day");
}

// keeping: where they are (keeping.js). open(text, { title, work }): takes one up again. note(text): the status line.
export function createDrafts(store, keeping, { open, note, failed }) {
  const list = el("ul", { class: "drafts" });
  const none = el("p", { class: "why" }, "There are none yet: whatever you change is kept here by itself, the last ten pieces of work.");
  const dialog = el("dialog", { id: "drafts", "aria-labelledby": "drafts-title" },
    el("div", { class: "sweep-head" }, el("h2", { id: "drafts-title" }, "Drafts"),
      el("button", { type: "button", onclick: () => dialog.close() }, "Close")),
    none, list);
  document.body.append(dialog);

  let forgotten = []; // while the list is open, each can be had back
  function lost(draft) {
    const back = el("button", {
      type: "button", class: "draft", onclick: async () => {
        try {
          await keeping.restore(draft);
          forgotten = forgotten.filter((one) => one !== draft);
          await fill();
          list.querySelector(".draft").focus();
        } catch (error) {
          failed(error);
        }
      },
    }, el("strong", {}, "Take it back"), el("span", { class: "why" }, `${draft.title || "Without a name"}, forgotten`));
    return el("li", {}, back);
  }
  function entry(draft) {
    const { id, title, time, scene, written } = draft;
    const name = title || "Without a name";
    const current = id === store.work.id;
    const take = el("button", {
      type: "button", class: "draft", "aria-current": current ? "true" : undefined,
      onclick: () => {
        dialog.close();
        if (!current) open(written ?? prettyJson(scene) + "\n", { title, work: { id, title } });
      },
    }, el("strong", {}, name), el("span", { class: "why" }, `${contents(scene)}, ${current ? "open now" : ago(time)}`));
    const drop = el("button", {
      type: "button", class: "delete", "aria-label": `Forget ${name}`, title: "Forget it",
      onclick: async () => {
        try {
          await keeping.forget(id);
          forgotten.push(draft);
          await fill();
          (list.querySelector(".draft") ?? dialog.querySelector("button")).focus();
        } catch (error) {
          failed(error);
        }
      },
    }, "×");
    return el("li", {}, take, drop);
  }
  async function fill() {
    const drafts = await keeping.drafts();
    none.hidden = drafts.length + forgotten.length > 0;
    list.replaceChildren(...drafts.map(entry), ...forgotten.map(lost));
  }
  byId("open-drafts").addEventListener("click", async () => {
    await keeping.save();
    forgotten = [];
    await fill();
    dialog.showModal();
  });
  // A draft that was on the page when something else was opened.
  return {
    kept(title) { note(`${title || "What you had"} is kept: Undo, or Drafts.`); },
  };
}
