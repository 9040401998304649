// Of page.mjs: the controls show what the service takes where a document is silent. A document that says
// so in words is then the same scene, and the service, which names scenes by their values, answers 304.

import assert from "node:assert/strict";

import { DEFAULTS, withAt } from "../web/document.js";
import { IMPLICIT_PRESETS } from "../web/implicit_presets.js";
import { automaton } from "../web/model_automaton.js";
import { ellipsoids } from "../web/model_ellipsoids.js";
import { implicit } from "../web/model_implicit.js";
import { spheres } from "../web/model_spheres.js";
import { origin } from "./page_browser.mjs";

// Small ones: the first of each pair is made in full.
const SMALL = {
  automaton: { cells: [24, 16, 24] }, spheres: { levels: 2 }, implicit: { resolution: 16 }, ellipsoids: { resolution: 8 },
};

async function askScene(scene, tag) {
  const answer = await fetch(`${origin}/v1/particles`, {
    method: "POST", body: JSON.stringify(scene),
    headers: { "Content-Type": "application/json", Accept: "text/csv", ...(tag ? { "If-None-Match": tag } : {}) },
  });
  const text = await answer.text();
  assert.ok([200, 304].includes(answer.status), `${JSON.stringify(scene)}: ${text}`);
  return answer;
}
const ask = (model, own, tag) => askScene({ clouds: [{ model, [model]: { ...SMALL[model], ...own } }] }, tag);

// What is required beside a default.
const WITH = { ground: {}, haze: { extinction: 0.01, scale_height: 10 }, detail: {}, camera: { eye: [0, 0, 20], target: [0, 0, 0] } };

// around(object): the model's own object with this one in its place.
async function walk(model, specs, around, own, wrong) {
  const tag = (await ask(model, around({}))).headers.get("ETag");
  for (const { kind, member, fields, fresh, columns, standard } of specs) {
    const deeper = (put) => walk(model, fields, (object) => around(withAt({}, `/${member}`, put({ ...fresh, ...object }))), own, wrong);
    if (kind === "section") await walk(model, fields, around, own, wrong);
    else if (kind === "switch") await deeper((object) => object);
    else if (kind === "cards") await deeper((object) => [object]);
    else if (kind === "table") {
      const bare = columns.filter((column) => fresh[column.member.split("/")[0]] === undefined && column.standard !== undefined);
      const of = (object) => around(withAt({}, `/${member}`, [{ ...fresh, ...object }]));
      const its = (await ask(model, of({}))).headers.get("ETag");
      for (const column of bare) {
        const [name, axis] = column.member.split("/");
        const value = axis === undefined ? column.standard : [0, 1, 2].map(() => column.standard);
        if ((await ask(model, of({ [name]: value }), its)).status !== 304) wrong.push(`${model}, ${member}/${column.member}`);
      }
    } else if (standard !== undefined && SMALL[model][member] === undefined && own[member] === undefined) {
      const value = typeof standard === "function" ? standard(own) : standard;
      if (value === undefined) continue;
      if ((await ask(model, around(withAt({}, `/${member}`, value)), tag)).status !== 304) wrong.push(`${model}, ${member}: not ${JSON.stringify(value)}`);
    }
  }
}

export const defaultsTests = {
  async "shows what the service takes where a document is silent"() {
    const wrong = [];
    for (const [pointer, value] of Object.entries(DEFAULTS)) {
      const [, name] = pointer.split("/");
      const scene = { cubes: [], ...(WITH[name] ? { [name]: WITH[name] } : {}) };
      const tag = (await askScene(scene)).headers.get("ETag");
      if ((await askScene(withAt(scene, pointer, value), tag)).status !== 304) wrong.push(`${pointer}: not ${JSON.stringify(value)}`);
    }
    for (const { name, fields } of [automaton, ellipsoids]) await walk(name, fields, (object) => object, {}, wrong);
    for (const kind of ["cumulus", "cirrus"]) await walk("spheres", spheres.fields, (object) => ({ kind, ...object }), { kind }, wrong);
    for (const preset of Object.keys(IMPLICIT_PRESETS)) {
      await walk("implicit", implicit.fields, (object) => ({ preset, ...object }), { preset }, wrong);
      const tag = (await ask("implicit", { preset })).headers.get("ETag");
      if ((await ask("implicit", { preset, ...IMPLICIT_PRESETS[preset] }, tag)).status !== 304) wrong.push(`implicit_presets.js, ${preset}`);
    }
    assert.deepEqual(wrong, []);
  },
};
