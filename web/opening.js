// Files as documents. JSON is opened as it is; what is wrong in it is then shown at its fields. Layouts and tables of
// particles are judged and read by the service, which knows every dialect of them (server/document/README.md).

import * as api from "./api.js";
import { sceneFromLayout } from "./document.js";
import { compactJson, parseJson, prettyJson } from "./json_text.js";

const TYPES = { awn: "text/x-awn", awa: "text/x-awa", ply: "application/x-ply", csv: "text/csv", json: "application/json" };

// By its name, else by how it begins, as the service does.
function kindOf(name, head) {
  const [, ending] = /\.(\w+)$/.exec(name.toLowerCase()) ?? [];
  if (TYPES[ending]) return ending;
  const start = head.replace(/^\uFEFF/, "").trimStart();
  if (start.startsWith("{")) return "json";
  if (/^ply\r?\n/.test(start)) return "ply";
  if (/^awa\s/.test(start)) return "awa";
  return /[a-z]/i.test(start.split(/\r?\n/)[0]) ? "csv" : "awn";
}

// An answer of /v1/particles, which holds the extinction itself, as a document with one cloud.
export function sceneOfParticles({ particles, count: _count, bounds: _bounds, seed: _seed, ...rest }) {
  const white = particles.every(({ color }) => !color || color.every((x) => x === 1));
  const cloud = {
    model: "particles", density: 1,
    positions: particles.map(({ center }) => center),
    radii: particles.map(({ radius }) => radius),
    densities: particles.map(({ density }) => density ?? 1),
    ...(white ? {} : { colors: particles.map(({ color }) => color ?? [1, 1, 1]) }),
  };
  return { ...rest, clouds: [cloud] };
}

// { text, title } of a file. Throws what the service says of it.
export async function documentOf(file) {
  const kind = kindOf(file.name, await file.slice(0, 1024).text());
  const title = file.name.replace(/\.\w+$/, "");
  if (kind === "json") {
    const text = await file.text();
    // Programs write particles as the service answers them.
    if (!/"particles"\s*:\s*\[/.test(text)) return { text, title };
    const scene = parseJson(text);
    const answer = Array.isArray(scene.particles) && scene.cubes === undefined && scene.clouds === undefined;
    return { text: answer ? prettyJson(sceneOfParticles(scene)) + "\n" : text, title };
  }
  if (kind === "awn" || kind === "awa") {
    const text = await file.text();
    await api.plan(text, { type: TYPES[kind] });
    return { text: prettyJson(sceneFromLayout(text)) + "\n", title };
  }
  const answer = await api.particles(file, "application/json", { type: TYPES[kind] });
  return { text: compactJson(sceneOfParticles(JSON.parse(await answer.text()))) + "\n", title };
}
