// Particles as Gaussian sprites, an instance each, drawn far to near. What a sprite covers is what its Gaussian hides
// along the ray through its middle, 1 - exp(-density s sqrt(2 pi)) with s half its radius, and falls off from there.

import {
  BufferAttribute, CustomBlending, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, OneFactor, OneMinusSrcAlphaFactor, ShaderMaterial, Vector3,
} from "three";

const VERTEX = `
attribute vec3 place;
attribute float radius;
attribute float cover;
attribute vec3 light;
varying vec2 at;
varying float covers;
varying vec3 lit;
void main() {
  at = position.xy * 1.5;
  covers = cover;
  lit = light;
  vec4 eye = modelViewMatrix * vec4(place, 1.0);
  eye.xy += position.xy * 1.5 * radius;
  gl_Position = projectionMatrix * eye;
}`;
const FRAGMENT = `
uniform float opacity;
uniform vec3 gain;
varying vec2 at;
varying float covers;
varying vec3 lit;
void main() {
  float depth = -log(max(1e-4, 1.0 - covers)) * exp(-2.0 * dot(at, at));
  float alpha = (1.0 - exp(-depth)) * opacity;
  if (alpha < 0.003) discard;
  gl_FragColor = vec4(min(lit * gain, 1.0) * alpha, alpha);
}`;

export function createSprites() {
  const material = new ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthTest: false, depthWrite: false,
    uniforms: { opacity: { value: 0 }, gain: { value: new Vector3(1, 1, 1) } },
    blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor, premultipliedAlpha: true,
  });
  const mesh = new Mesh(new InstancedBufferGeometry(), material);
  mesh.frustumCulled = false;
  mesh.visible = false;
  mesh.renderOrder = -1;
  let set = null;
  let light = null;
  let sortedFrom = null;

  function fill(order) {
    const { count, places, radii, covers } = set;
    const geometry = mesh.geometry;
    const [place, radius, cover, lit] = ["place", "radius", "cover", "light"].map((name) => geometry.attributes[name].array);
    for (let to = 0; to < count; to += 1) {
      const from = order[to];
      for (let axis = 0; axis < 3; axis += 1) {
        place[3 * to + axis] = places[3 * from + axis];
        lit[3 * to + axis] = light[3 * from + axis];
      }
      radius[to] = radii[from];
      cover[to] = covers[from];
    }
    for (const name of ["place", "radius", "cover", "light"]) geometry.attributes[name].needsUpdate = true;
  }
  // Far to near along the way the camera looks, by buckets: a sort of 50,000 in a frame.
  function sort(forward) {
    const { count, places } = set;
    const depths = new Float32Array(count);
    let [least, most] = [Infinity, -Infinity];
    for (let i = 0; i < count; i += 1) {
      const depth = places[3 * i] * forward.x + places[3 * i + 1] * forward.y + places[3 * i + 2] * forward.z;
      depths[i] = depth;
      if (depth < least) least = depth;
      if (depth > most) most = depth;
    }
    const kBuckets = 4096;
    const scale = (kBuckets - 1) / Math.max(1e-9, most - least);
    const starts = new Uint32Array(kBuckets + 1);
    const bucket = new Uint16Array(count);
    for (let i = 0; i < count; i += 1) {
      bucket[i] = kBuckets - 1 - Math.floor((depths[i] - least) * scale);
      starts[bucket[i] + 1] += 1;
    }
    for (let i = 0; i < kBuckets; i += 1) starts[i + 1] += starts[i];
    const order = new Uint32Array(count);
    for (let i = 0; i < count; i += 1) order[starts[bucket[i]]++] = i;
    fill(order);
  }
  const forward = { x: 0, y: 0, z: 0 };
  mesh.onBeforeRender = (_renderer, _scene, camera) => {
    if (!set) return;
    const e = camera.matrixWorld.elements;
    [forward.x, forward.y, forward.z] = [-e[8], -e[9], -e[10]];
    const same = sortedFrom && forward.x * sortedFrom.x + forward.y * sortedFrom.y + forward.z * sortedFrom.z > 0.9998;
    if (same) return;
    sort(forward);
    sortedFrom = { ...forward };
  };

  return {
    object: mesh,
    // set: { count, places, radii, covers }; lit: three a particle.
    show(next, lit) {
      [set, light, sortedFrom] = [next, lit, null];
      mesh.geometry.dispose();
      const geometry = new InstancedBufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
      geometry.setIndex([0, 1, 2, 0, 2, 3]);
      geometry.setAttribute("place", new InstancedBufferAttribute(new Float32Array(3 * set.count), 3));
      geometry.setAttribute("radius", new InstancedBufferAttribute(new Float32Array(set.count), 1));
      geometry.setAttribute("cover", new InstancedBufferAttribute(new Float32Array(set.count), 1));
      geometry.setAttribute("light", new InstancedBufferAttribute(new Float32Array(3 * set.count), 3));
      geometry.instanceCount = set.count;
      mesh.geometry = geometry;
    },
    get opacity() { return material.uniforms.opacity.value; },
    setOpacity(value) { material.uniforms.opacity.value = value; },
    // [red, green, blue]: times the light that they were shown with.
    gain(value) { material.uniforms.gain.value.set(...value); },
  };
}
