// The service's calls, as the page uses them.

import { parseJson } from "./json_text.js";
import { authorization, refusal } from "./token.js";

// An answer of application/problem+json (RFC 9457), or something as near to it as can be had.
export class Problem extends Error {
  constructor(status, body, retryAfterSeconds = null) {
    super(body.detail || body.title || `The service answered ${status}.`);
    this.status = status; // 0: no answer at all
    this.title = body.title ?? "";
    this.pointer = body.pointer ?? null;
    this.retryAfterSeconds = retryAfterSeconds;
  }
}

async function call(path, options = {}) {
  let response;
  try {
    response = await fetch(path, { ...options, headers: { ...options.headers, ...authorization() } });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new Problem(0, { title: "No answer", detail: "The service cannot be reached." }, 2);
  }
  if (response.ok) return response;
  if (response.status === 401) throw new Problem(401, { title: "Unauthorized", detail: refusal() });
  const text = await response.text();
  let body = {};
  try {
    body = JSON.parse(text);
  } catch {
    body = { detail: `The service answered ${response.status} ${response.statusText}.` };
  }
  const wait = Number(response.headers.get("Retry-After"));
  const again = response.status === 429 || response.status === 503;
  throw new Problem(response.status, body, again ? Math.max(1, wait || 1) : null);
}

const post = (path, text, { accept, type = "application/json", signal } = {}) =>
  call(path, { method: "POST", body: text, signal, headers: { "Content-Type": type, Accept: accept } });

// What documents may hold, what calls there are. The largest whole number in it has 64 bits.
export async function contract() {
  return parseJson(await (await call("/openapi.json")).text());
}

// [{ name, title }]
export async function presets() {
  return (await (await call("/v1/presets")).json()).presets;
}

// A picture as a texture of that name.
export async function putTexture(name, file) {
  return (await call(`/v1/textures/${encodeURIComponent(name)}`, { method: "PUT", body: file })).json();
}

export async function presetText(name) {
  return (await call(`/v1/presets/${encodeURIComponent(name)}`)).text();
}

export async function plan(text, options = {}) {
  return (await post("/v1/plan", text, { accept: "application/json", ...options })).json();
}

// text: a scene, or, of another `type`, a file of a layout or of particles.
export async function particles(text, accept, options = {}) {
  return (await post("/v1/particles", text, { accept, ...options })).blob();
}

// The particles with their light: { buffer, exposure }, a PLY and the stops of the picture. The light is linear radiance.
export async function litParticles(text, options = {}) {
  const response = await post("/v1/particles?light=1", text, { accept: "application/x-ply", ...options });
  return { buffer: await response.arrayBuffer(), exposure: Number(response.headers.get("Awan-Exposure")) || 0 };
}

// A map of the scene's sky all around, so many pixels wide and half as high, as a PNG.
export async function sky(text, width) {
  return (await post(`/v1/sky?width=${width}`, withoutLayers(text), { accept: "image/png" })).blob();
}

// A job's place, from the text of what it is.
export async function beginJob(text, options = {}) {
  return (await post("/v1/jobs", text, { accept: "application/json", ...options })).headers.get("Location");
}
export async function job(place, options = {}) {
  return (await call(place, options)).json();
}
export async function jobResult(place, options = {}) {
  return (await call(`${place}/result`, options)).blob();
}
export const dropJob = (place) => call(place, { method: "DELETE" });

// A PNG of every rung's error over its time; takes up to half a minute.
export async function accuracyPlot(text, { dark, signal }) {
  const theme = dark ? "dark" : "light";
  return (await post(`/v1/accuracy?theme=${theme}`, text, { accept: "image/png", signal })).blob();
}

// Layers are for EXR alone; of a document with layers a PNG shows the colours.
export const renderPath = (text, accept, preview = false) => {
  const asked = [accept === "image/png" && text.includes('"layers"') ? "layers=none" : "", preview ? "preview=1" : ""].filter(Boolean);
  return ["/v1/render", asked.join("&")].filter(Boolean).join("?");
};

// The same for what takes no such query. The text stays as it is: seeds are longer than JavaScript's numbers.
export const withoutLayers = (text) => text.replace(/"layers"(\s*):(\s*)"[^"]*"/, '"layers"$1:$2"none"');

// { blob, figures }: the picture and what the answer's headers say about it.
export async function render(text, { accept = "image/png", preview = false, signal } = {}) {
  const sent = performance.now();
  const response = await post(renderPath(text, accept, preview), text, { accept, signal });
  const blob = await response.blob();
  const header = (name) => response.headers.get(name);
  const list = header("Awan-Effects");
  return {
    blob,
    isKept: ["hit", "disk"].includes(header("Awan-Cache")), // nothing was computed
    figures: {
      roundTripMs: performance.now() - sent,
      particles: header("Awan-Particles"),
      rung: header("Awan-Rung"),
      error: header("Awan-Error"), // as measured
      errorForecast: header("Awan-Error-Forecast"), // both as predicted
      timeMs: header("Awan-Time"),
      effects: list === null ? null : list.split(",").map((name) => name.trim()).filter(Boolean),
      timing: serverTiming(header("Server-Timing") ?? ""),
    },
  };
}

// `queue;dur=0.1, draw;dur=12.5` -> [{ name, ms }]
export function serverTiming(text) {
  return text.split(",").map((entry) => {
    const [name, ...parameters] = entry.split(";").map((part) => part.trim());
    const duration = parameters.find((parameter) => parameter.startsWith("dur="));
    return { name, ms: duration ? Number(duration.slice(4)) : 0 };
  }).filter(({ name, ms }) => name && Number.isFinite(ms));
}
