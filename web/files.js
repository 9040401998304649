// Saving, sharing and opening.

import * as api from "./api.js";
import { createAnimation } from "./animation.js";
import { whyNoLayout } from "./document.js";
import { byId, el } from "./dom.js";
import { documentOf } from "./opening.js";
import { placeName } from "./problems.js";
import { save } from "./saving.js";
import { linkTo } from "./share.js";
import { hasToken } from "./token.js";

// Browsers give pages the clipboard only over https or from localhost; the old way works everywhere.
export async function copy(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const field = el("textarea", { class: "unseen" });
  field.value = text;
  const focused = document.activeElement;
  document.body.append(field);
  field.select();
  const done = document.execCommand("copy");
  field.remove();
  focused?.focus();
  if (!done) throw new Error("The browser does not let the page copy.");
}

// The shell command that makes the picture. A quoted here-document keeps the scene as it is. A token stays out of it, so
// that it can be shown: the shell has it in a variable.
export function curlCommand(text, origin) {
  return [
    `curl -sS --fail-with-body '${origin}${api.renderPath(text, "image/png")}' \\`,
    ...(hasToken() ? ['  -H "Authorization: Bearer $AWAN_TOKEN" \\'] : []),
    "  -H 'Content-Type: application/json' -H 'Accept: image/png' \\",
    "  -o cloud.png --data-binary @- <<'END_OF_SCENE'",
    text.trimEnd(),
    "END_OF_SCENE",
    "",
  ].join("\n");
}

// name() -> stem of file names; picture() -> the whole picture of the document as it stands, or null while there is
// none; failed(problem), note(text) -> the status line.
export function createFiles(store, { name, picture, failed, note }) {
  const why = byId("awn-why");

  const button = (title, action, attributes = {}) => el("button", {
    type: "button", ...attributes,
    onclick: async () => {
      try {
        await action();
      } catch (error) {
        failed(error);
      }
    },
  }, title);
  const rendered = (accept, suffix) => async () => save((await api.render(store.text, { accept })).blob, name() + suffix);
  const listed = (accept, suffix) => async () => save(await api.particles(store.text, accept), name() + suffix);

  const awn = button(".awn", async () => {
    if (!whyNoLayout(store.scene)) await listed("text/x-awn", ".awn")();
    else note(whyNoLayout(store.scene));
  }, { "aria-describedby": "awn-why", title: "The layout as Rekawan wrote it" });

  const animation = createAnimation(store, { save: (blob, suffix) => save(blob, name() + suffix), failed, note });
  why.after(animation.why);
  byId("save-buttons").append(
    button("PNG", async () => {
      const shown = picture();
      if (shown) save(shown, `${name()}.png`);
      else await rendered("image/png", ".png")();
    }, { title: "The picture" }),
    button("EXR", rendered("image/x-exr", ".exr"), { title: "Linear light, premultiplied" }),
    button("JSON", () => save(new Blob([store.text], { type: "application/json" }), name() + ".json"), { title: "This scene document" }),
    awn,
    button(".awa", listed("text/x-awa", ".awa"), { title: "The layout with its textures" }),
    el("span", { class: "together" },
      el("span", { class: "label" }, "Particles"),
      button("JSON", listed("application/json", ".particles.json"), { "aria-label": "Particles as JSON" }),
      button("CSV", listed("text/csv", ".csv"), { "aria-label": "Particles as CSV" }),
      button("PLY", listed("application/x-ply", ".ply"), { "aria-label": "Particles as PLY" })),
    ...animation.elements,
    button("Share", async () => {
      const link = await linkTo(store.text, location.origin + location.pathname);
      await copy(link);
      note(`An address that holds this scene is on the clipboard: ${link.length.toLocaleString("en")} characters.`);
    }, { title: "Copy an address that holds the whole scene" }),
    button("Copy curl", async () => {
      await copy(curlCommand(store.text, location.origin));
      note(hasToken() ? "The command is on the clipboard. It takes the token from the variable AWAN_TOKEN."
        : "The command is on the clipboard.");
    }, { title: "The command that makes this picture" }),
  );

  function refresh() {
    const reason = whyNoLayout(store.scene);
    // Not `disabled`: it stays reachable, so that its explanation can be read.
    awn.setAttribute("aria-disabled", String(reason !== ""));
    why.hidden = reason === "";
    why.textContent = reason;
    animation.refresh();
  }

  async function open(file) {
    try {
      const { text, title } = await documentOf(file);
      store.replaceText(text, { title });
      note(`${file.name} is open.`);
    } catch (error) {
      // A pointer would name a place in the file, not in the document that stays open.
      const place = error.pointer ? `${placeName(error.pointer)}: ` : "";
      failed(new Error(`${file.name}: ${place}${error.message}`));
    }
  }

  const chooser = byId("file");
  byId("open").addEventListener("click", () => chooser.click());
  chooser.addEventListener("change", () => {
    if (chooser.files.length) open(chooser.files[0]);
    chooser.value = ""; // so that the same file can be opened again
  });

  const curtain = byId("drop-here");
  const carriesFile = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  addEventListener("dragover", (event) => {
    if (!carriesFile(event)) return;
    event.preventDefault();
    curtain.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) curtain.hidden = true;
  });
  addEventListener("drop", (event) => {
    if (!carriesFile(event)) return;
    event.preventDefault();
    curtain.hidden = true;
    if (event.dataTransfer.files.length) open(event.dataTransfer.files[0]);
  });
  return { refresh };
}
