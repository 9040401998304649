// Particles as Gaussian sprites, drawn far to near. What a sprite covers is what its Gaussian hides
// along the ray through its middle, 1 - exp(-density s sqrt(2 pi)) with s half its radius, and falls off from there.
// They are smooth, and thousands lie one over the other at every pixel: so they may be drawn to a smaller picture of their
// own, which is laid over the screen as one. Four vertices each, which stay as they are; what is sorted is their order of
// drawing. As instances they would have to be sorted themselves, and renderers without a GPU take them one by one: 10,000 in
// 250 ms instead of 17 (SwiftShader, tests/bench/page_sprites.mjs).

import {
  BufferAttribute, BufferGeometry, CustomBlending, DynamicDrawUsage, LinearFilter, Mesh, OneFactor, OneMinusSrcAlphaFactor, PlaneGeometry, Scene,
  ShaderMaterial, Vector2, Vector3, WebGLRenderTarget,
} from "three";

const VERTEX = `
attribute vec4 place; // and the radius
attribute vec4 light; // and what it covers
varying vec2 at;
varying float depth;
varying vec3 lit;
void main() {
  float middle = -log(max(1e-4, 1.0 - light.w));
  // As far out as its depth is over .003.
  float reach = min(1.5, sqrt(0.5 * log(max(middle / 0.003, 1.0))));
  int corner = gl_VertexID & 3;
  at = reach * vec2(corner == 1 || corner == 2 ? 1.0 : -1.0, corner >= 2 ? 1.0 : -1.0);
  depth = middle;
  lit = light.rgb;
  vec4 eye = modelViewMatrix * vec4(place.xyz, 1.0);
  eye.xy += at * place.w;
  gl_Position = projectionMatrix * eye;
}`;
const FRAGMENT = `
uniform vec3 gain;
varying vec2 at;
varying float depth;
varying vec3 lit;
void main() {
  float alpha = 1.0 - exp(-depth * exp(-2.0 * dot(at, at)));
  if (alpha < 0.003) discard;
  gl_FragColor = vec4(min(lit * gain, 1.0) * alpha, alpha);
}`;
// The smaller picture, over the whole screen.
const LAYER_VERTEX = `
varying vec2 at;
void main() {
  at = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const LAYER_FRAGMENT = `
uniform sampler2D sprites;
uniform float opacity;
varying vec2 at;
void main() {
  gl_FragColor = texture2D(sprites, at) * opacity;
}`;
const OVER = {
  transparent: true, depthTest: false, depthWrite: false, premultipliedAlpha: true,
  blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor,
};

export function createSprites() {
  const material = new ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: FRAGMENT, ...OVER, uniforms: { gain: { value: new Vector3(1, 1, 1) } },
  });
  const mesh = new Mesh(new BufferGeometry(), material);
  mesh.frustumCulled = false;
  const alone = new Scene();
  alone.add(mesh);
  const target = new WebGLRenderTarget(1, 1, { depthBuffer: false, minFilter: LinearFilter, magFilter: LinearFilter });
  const size = new Vector2();
  const layer = new Mesh(new PlaneGeometry(2, 2), new ShaderMaterial({
    vertexShader: LAYER_VERTEX, fragmentShader: LAYER_FRAGMENT, ...OVER, uniforms: { sprites: { value: target.texture }, opacity: { value: 0 } },
  }));
  layer.frustumCulled = false;
  layer.visible = false;
  layer.renderOrder = -1;
  let set = null;
  let sortedFrom = null;

  function drawIn(order) {
    const { index } = mesh.geometry;
    const { array } = index;
    for (let i = 0, to = 0; i < order.length; i += 1, to += 6) {
      const first = 4 * order[i];
      array[to] = array[to + 3] = first;
      array[to + 1] = first + 1;
      array[to + 2] = array[to + 4] = first + 2;
      array[to + 5] = first + 3;
    }
    index.needsUpdate = true;
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
    drawIn(order);
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

  function drawTo(to, renderer, camera) {
    renderer.setRenderTarget(to);
    renderer.render(alone, camera);
  }

  return {
    object: layer, // of the scene that is drawn to the screen
    // Before that scene is: the sprites, with so many of the screen's pixels along a side.
    draw(renderer, camera, share) {
      if (!layer.visible) return;
      renderer.getDrawingBufferSize(size).multiplyScalar(share).ceil().max({ x: 1, y: 1 });
      target.setSize(size.x, size.y);
      drawTo(target, renderer, camera);
      renderer.setRenderTarget(null);
    },
    // Them alone, in their own light: RGBA bytes, premultiplied, the lowest row first.
    seen(renderer, camera, width, height) {
      const small = new WebGLRenderTarget(width, height, { depthBuffer: false });
      const gain = material.uniforms.gain.value.clone();
      material.uniforms.gain.value.set(1, 1, 1);
      drawTo(small, renderer, camera);
      const bytes = new Uint8Array(4 * width * height);
      renderer.readRenderTargetPixels(small, 0, 0, width, height, bytes);
      renderer.setRenderTarget(null);
      small.dispose();
      material.uniforms.gain.value.copy(gain);
      return bytes;
    },
    // set: { count, places, radii, covers }; lit: three a particle.
    show(next, lit) {
      [set, sortedFrom] = [next, null];
      mesh.geometry.dispose();
      const geometry = new BufferGeometry();
      const [place, light] = [new Float32Array(16 * set.count), new Float32Array(16 * set.count)];
      for (let vertex = 0; vertex < 4 * set.count; vertex += 1) {
        const i = vertex >> 2;
        place.set([set.places[3 * i], set.places[3 * i + 1], set.places[3 * i + 2], set.radii[i]], 4 * vertex);
        light.set([lit[3 * i], lit[3 * i + 1], lit[3 * i + 2], set.covers[i]], 4 * vertex);
      }
      geometry.setAttribute("place", new BufferAttribute(place, 4));
      geometry.setAttribute("light", new BufferAttribute(light, 4));
      geometry.setIndex(new BufferAttribute(new Uint32Array(6 * set.count), 1).setUsage(DynamicDrawUsage));
      mesh.geometry = geometry;
    },
    // 0: nothing of them is drawn.
    setOpacity(value) {
      layer.visible = value > 0;
      layer.material.uniforms.opacity.value = value;
    },
    // [red, green, blue]: times the light that they were shown with.
    gain(value) { material.uniforms.gain.value.set(...value); },
  };
}
