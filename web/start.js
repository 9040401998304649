// Builds the page, or says why there is none: without the service's word on what a document may hold (schema.js) it has
// no controls to offer.

import { byId } from "./dom.js";

try {
  await import("./page.js");
} catch (error) {
  byId("alert").textContent = `The page cannot be built: ${error.message} Reload it to try again.`;
}
