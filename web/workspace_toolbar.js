// The buttons under the picture. Each has its key, which works while the picture has the focus.

import { el } from "./dom.js";

const MODES = [["translate", "Move", "W"], ["rotate", "Turn", "E"], ["scale", "Scale", "R"]];
const STEPS = [[0, "no snap"], [0.1, "snap 0.1"], [0.5, "snap 0.5"], [1, "snap 1"], [5, "snap 5"]];
const VIEWS = [[1, "Front"], [3, "Right"], [7, "Top"]];

export function createToolbar({ actions, setMode, toggleBox, setStep, toggle, fly }) {
  const button = (text, key, title, action, attributes = {}) => el("button", {
    type: "button", title: key ? `${title} (${key})` : title, "aria-keyshortcuts": key ? key.replace("⇧", "Shift+") : undefined, onclick: action, ...attributes,
  }, text);
  const shown = button("Workspace", "", "Grid, axes and wires over the picture", toggle, { id: "workspace-on", "aria-pressed": "false" });
  const modes = MODES.map(([mode, title, key]) => button(title, key, `${title} what is selected`, () => setMode(mode), { "data-mode": mode, "aria-pressed": "false" }));
  const box = button("Box", "B", "Select what lies in a box; or drag with Shift", toggleBox, { "aria-pressed": "false" });
  const snap = el("select", { "aria-label": "Snap", onchange: () => setStep(Number(snap.value)) },
    ...STEPS.map(([value, text]) => el("option", { value }, text)));
  const together = (label, ...children) => el("span", { class: "buttons", role: "group", "aria-label": label }, ...children);
  const onPicture = [
    together("Tools", ...modes, box, snap),
    together("Views", button("Frame", "F", "Look at what is selected", actions.frame),
      ...VIEWS.map(([key, title]) => button(title, String(key), `From the ${title.toLowerCase()}`, () => actions.look(key)))),
  ];
  const flight = button("Fly", "", "Fly around the cloud and through it", fly);
  const duplicate = button("Duplicate", "⇧D", "Twins of what is selected", actions.duplicate);
  const remove = button("Delete", "Delete", "Delete what is selected", actions.remove);
  const edits = together("Shapes", button("Add", "N", "Another cube or shape in this cloud", actions.add), duplicate, remove,
    button("Delete all", "", "Everything but light, sky and camera; Undo brings it back", actions.removeAll, { "aria-label": "Delete all shapes" }),
    button("New", "", "A scene of one cube; Undo brings the other back", actions.fresh, { "aria-label": "New scene" }));
  const why = el("span", { class: "why", hidden: true }, "No WebGL here: the list and the numbers do it.");
  const element = el("div", { id: "workspace-bar", role: "toolbar", "aria-label": "Workspace" }, shown, flight, ...onPicture, edits, why);

  return {
    element,
    refresh({ state, mode, boxTool, step, count, flying }) {
      element.hidden = flying;
      const on = state === "on";
      shown.hidden = state === "none";
      shown.setAttribute("aria-pressed", String(on));
      onPicture.forEach((part) => { part.hidden = !on; });
      why.hidden = state !== "none";
      modes.forEach((one) => one.setAttribute("aria-pressed", String(one.dataset.mode === mode)));
      box.setAttribute("aria-pressed", String(boxTool));
      snap.value = String(step);
      for (const one of [duplicate, remove]) one.setAttribute("aria-disabled", String(count === 0));
    },
  };
}
