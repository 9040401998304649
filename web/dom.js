// Building elements without markup in strings: data can never become markup, and the page's
// content security policy (no inline scripts, no inline styles) holds by construction.

// el("button", { type: "button", class: "x", "aria-label": "…", onclick: f }, "text", child)
export function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== undefined && child !== null));
  return element;
}

let last = 0;
// An id that no other element of the page has; labels and messages need one.
export function freshId(stem) {
  last += 1;
  return `${stem}-${last}`;
}

export const byId = (id) => document.getElementById(id);

// A number as people write it: no float noise, no trailing zeros, at most `digits` significant.
export function plain(value, digits = 7) {
  if (typeof value === "bigint") return String(value);
  return typeof value === "number" ? String(Number(value.toPrecision(digits))) : "";
}

// The same with as many digits, `digits` at most, as fit in so many characters: a figure that is cut off is another one.
export function fitting(value, digits, characters) {
  let text = plain(value, digits);
  for (let fewer = digits - 1; text.length > characters && fewer > 0; fewer -= 1) text = plain(value, fewer);
  return text;
}
