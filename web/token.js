// The token of a server that wants one (awan serve --token-file): asked for where a call was refused for it, kept for
// this tab, shown with every call after.

import { byId } from "./dom.js";

const KEY = "awan.token";
let token = "";
try {
  token = sessionStorage.getItem(KEY) ?? "";
} catch {
  // No permission: it is kept until the page is left.
}

export const hasToken = () => token !== "";

// The headers of a call.
export const authorization = () => (token ? { Authorization: `Bearer ${token}` } : {});

// What went wrong, for people.
export const refusal = () => (token ? "The server does not take this token." : "This server wants its token.");

// Characters that a header can carry.
const isPlain = (text) => /^[\x21-\x7e]+$/.test(text);

// given(): a token has been given. ask() shows the field, done() puts it away.
export function createTokenField(given) {
  const form = byId("token");
  const field = byId("token-field");
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const text = field.value.trim();
    field.setCustomValidity(isPlain(text) ? "" : "A token is printable ASCII characters without blanks.");
    if (!form.reportValidity()) return;
    token = text;
    try {
      sessionStorage.setItem(KEY, token);
    } catch {
      // As above.
    }
    given();
  });
  field.addEventListener("input", () => field.setCustomValidity(""));
  return {
    ask() {
      if (!form.hidden) return;
      form.hidden = false;
      field.focus();
    },
    done() {
      form.hidden = true;
      field.value = "";
    },
  };
}
