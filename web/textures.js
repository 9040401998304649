// What clouds are painted with, and what of them is shown.

import * as api from "./api.js";
import { numberField, select } from "./controls.js";
import { at, cloudsOf, modelOf } from "./document.js";
import { el } from "./dom.js";
import { fieldAt } from "./schema.js";

// A name as the service takes it, from that of a file.
const nameOf = (file) => file.name.replace(/\.[^.]*$/, "").replace(/[^A-Za-z0-9._-]+/g, "-").replace(/^[^A-Za-z0-9]+/, "").slice(0, 64) || "texture";

// One of Awan's own, or whatever name the document has.
export function textureChoice(store, { label, pointer, none }) {
  const choice = select(store, {
    label, pointer, none,
    choices: fieldAt(pointer()).examples.map((name) => [name, name]),
    get: () => at(store.scene, pointer()), set: (name) => store.set(pointer(), name || undefined),
  });
  const list = choice.element.querySelector("select");
  return {
    element: choice.element,
    refresh() {
      const name = at(store.scene, pointer());
      if (typeof name === "string" && ![...list.options].some(({ value }) => value === name)) list.append(el("option", { value: name }, name));
      choice.refresh();
    },
  };
}

const texture = (store) => textureChoice(store, { label: "Texture of all", pointer: () => "/texture", none: "none: particles" });

// A button that sends a picture to the service, which has it by name from then on; use(name) puts it into the scene.
// pointer: the place that errors are of.
export function pictureButton({ text, label, pointer, use }) {
  const input = el("input", { type: "file", accept: "image/*,.exr,.tif,.tiff", hidden: true, "aria-label": label });
  const button = el("button", { type: "button", onclick: () => input.click() }, text);
  input.addEventListener("change", async () => {
    const [file] = input.files;
    input.value = "";
    if (!file) return;
    try {
      const { name } = await api.putTexture(nameOf(file), file);
      use(name);
    } catch ({ message }) {
      button.dispatchEvent(new CustomEvent("wrongnumber", { bubbles: true, detail: { pointer, message } }));
    }
  });
  return el("div", {}, button, input);
}

const upload = (store) => pictureButton({
  text: "A texture of your own…", label: "Texture to use", pointer: "/texture", use: (name) => store.set("/texture", name),
});

export function texturePanel(store) {
  const hasCubes = () => cloudsOf(store.scene).some(({ cloud }) => modelOf(cloud) === "cubes");
  const billboards = numberField(store, {
    label: "Billboards per box", pointer: () => "/billboards", optional: true, placeholder: "as particles",
    get: () => at(store.scene, "/billboards"),
  });
  const fields = [
    texture(store),
    {
      element: billboards.element,
      refresh() {
        billboards.element.hidden = !hasCubes();
        billboards.refresh();
      },
    },
    select(store, {
      label: "Display", pointer: () => "/display",
      titles: {
        lit: "lit: clouds in light", cubes: "cubes", quads: "quads: textures on the cubes", billboards: "billboards",
        bounding_boxes: "bounding boxes", show_texture: "show texture: each cube’s", ellipsoids: "ellipsoids of automata, their grids",
      },
    }),
  ];
  return { title: "Textures and display", pointer: "/texture", fields, tail: [upload(store)] };
}
