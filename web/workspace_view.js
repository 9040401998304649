// What is drawn over the picture: grid, axes, items as wires, the gizmo, the sun on its dome, particles as sprites. The
// only script with three.js, in a bundle of its own, which is loaded when the first picture is there. It holds nothing:
// plain values come in, and what is done with the pointer goes out.

import {
  BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, GridHelper, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  MeshBasicMaterial, Object3D, PerspectiveCamera, Quaternion, Scene, SphereGeometry, Vector3, WebGLRenderer,
} from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import { applied, transposed } from "./rotation.js";
import { createSprites } from "./workspace_sprites.js";

const kRing = 40; // pieces of a ring
const kPlainWires = 30; // items; more are drawn fainter, but never fainter than this
const kFaintest = 0.03;
const COLOURS = {
  plain: new Color(0x2f7fd6), selected: new Color(0xf0a020), active: new Color(0xff1f1f), // the active cube is red, as in Rekawan
};
const AXES = [[0xd84040, [1, 0, 0]], [0x3f9f3f, [0, 1, 0]], [0x3f6fe0, [0, 0, 1]]];

// Ends of the lines of a box and of an ellipsoid within -1..1.
const BOX = [];
for (const axis of [0, 1, 2]) {
  for (const [u, v] of [[-1, -1], [-1, 1], [1, 1], [1, -1]]) {
    for (const end of [-1, 1]) {
      const point = [0, 0, 0];
      [point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]] = [end, u, v];
      BOX.push(point);
    }
  }
}
const BALL = [];
for (const axis of [0, 1, 2]) {
  for (let i = 0; i < 2 * kRing; i += 1) {
    const angle = (2 * Math.PI * Math.ceil(i / 2)) / kRing;
    const point = [0, 0, 0];
    [point[(axis + 1) % 3], point[(axis + 2) % 3]] = [Math.cos(angle), Math.sin(angle)];
    BALL.push(point);
  }
}

const radians = (degrees) => (degrees * Math.PI) / 180;

function put({ center, half, axes }, [x, y, z], to, at) {
  const [a, b, c] = [x * half[0], y * half[1], z * half[2]];
  for (let axis = 0; axis < 3; axis += 1) to[at + axis] = center[axis] + axes[axis][0] * a + axes[axis][1] * b + axes[axis][2] * c;
}
const matrixOf = (quaternion) => {
  const e = new Matrix4().makeRotationFromQuaternion(quaternion).elements;
  return [0, 1, 2].map((row) => [e[row], e[4 + row], e[8 + row]]);
};
const quaternionOf = ([x, y, z]) => new Quaternion().setFromRotationMatrix(new Matrix4().set(...x, 0, ...y, 0, ...z, 0, 0, 0, 0, 1));

// All items as one set of lines.
function createWires() {
  const lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true, transparent: true, depthTest: false }));
  lines.frustumCulled = false;
  return {
    object: lines,
    show(items) {
      const points = items.reduce((sum, { round }) => sum + (round ? BALL : BOX).length, 0);
      const [positions, colours] = [new Float32Array(3 * points), new Float32Array(4 * points)];
      let at = 0;
      // Many wires hide the cloud: the more there are, the fainter those that are not selected.
      const faint = Math.max(kFaintest, Math.min(1, kPlainWires / items.length));
      for (const item of items) {
        const colour = item.active ? COLOURS.active : item.selected ? COLOURS.selected : COLOURS.plain;
        for (const point of item.round ? BALL : BOX) {
          put(item, point, positions, 3 * at);
          colour.toArray(colours, 4 * at);
          colours[4 * at + 3] = item.active || item.selected ? 1 : faint;
          at += 1;
        }
      }
      lines.geometry.dispose();
      lines.geometry = new BufferGeometry();
      lines.geometry.setAttribute("position", new BufferAttribute(positions, 3).setUsage(DynamicDrawUsage));
      lines.geometry.setAttribute("color", new BufferAttribute(colours, 4).setUsage(DynamicDrawUsage));
    },
  };
}

function createAxes() {
  const positions = [], colours = [];
  for (const [hex, end] of AXES) {
    positions.push(0, 0, 0, ...end);
    const { r, g, b } = new Color(hex);
    colours.push(r, g, b, r, g, b);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute("color", new BufferAttribute(new Float32Array(colours), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true, depthTest: false }));
}

// The part of the dome above the horizon, and the sun on it.
function createDome() {
  const group = new Group();
  const line = new LineBasicMaterial({ color: 0xd9a400, transparent: true, opacity: 0.45 });
  const points = [];
  const ring = (radius, height) => {
    for (let i = 0; i < 2 * kRing; i += 1) {
      const angle = (2 * Math.PI * Math.ceil(i / 2)) / kRing;
      points.push(radius * Math.sin(angle), height, radius * Math.cos(angle));
    }
  };
  for (const elevation of [0, 30, 60]) ring(Math.cos(radians(elevation)), Math.sin(radians(elevation)));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  const sun = new Mesh(new SphereGeometry(1, 20, 14), new MeshBasicMaterial({ color: 0xffc400 }));
  const rim = new Mesh(new SphereGeometry(1.25, 20, 14), new MeshBasicMaterial({ color: 0x6b5000, side: 1 }));
  sun.add(rim);
  const beamGeometry = new BufferGeometry();
  beamGeometry.setAttribute("position", new BufferAttribute(new Float32Array(6), 3));
  const beam = new LineSegments(beamGeometry, line);
  group.add(new LineSegments(geometry, line), sun, beam);
  return { group, sun, beam };
}

// Whether the browser draws on the processor, for want of a GPU.
function drawsInSoftware(gl) {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return info !== null && /swiftshader|llvmpipe|software/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

const kSunPixels = 9; // radius of the sun on the screen
const kSunReach = 16; // how near to its middle it is taken hold of

// canvas: to draw on. Throws where the browser has no WebGL. told: { gizmo(change), gizmoEnds(), sun(angles), sunEnds() }
export function createView(canvas, told) {
  const renderer = new WebGLRenderer({ canvas, alpha: true, antialias: true, premultipliedAlpha: true });
  renderer.setClearColor(0, 0);
  const scene = new Scene();
  const camera = new PerspectiveCamera(40, 1, 0.01, 1e5);
  const wires = createWires();
  const axes = createAxes();
  const dome = createDome();
  const sprites = createSprites();
  let grid = null;
  let items = [];
  let detail = 1; // share of the screen's pixels along a side that sprites are drawn with
  const isSoftware = drawsInSoftware(renderer.getContext());
  let flying = false;
  let home = { center: [0, 0, 0], radius: 5 }; // what is looked at: the grid lies under it, the dome stands around it
  const handle = new Object3D();
  const gizmo = new TransformControls(camera, canvas);
  gizmo.setSize(0.8);
  scene.add(sprites.object, wires.object, axes, dome.group, handle, gizmo.getHelper());

  let asked = 0;
  function render() {
    asked = 0;
    sprites.draw(renderer, camera, isWholeSmall() ? 1 : detail);
    renderer.render(scene, camera);
  }
  const draw = () => { asked ||= requestAnimationFrame(render); };
  // In a flight there is nothing but sprites: without a GPU, all of the canvas has as few pixels as these, for every pixel of
  // it is work, and again when the browser puts the page together.
  const isWholeSmall = () => flying && isSoftware;
  function resize() {
    renderer.setPixelRatio(isWholeSmall() ? detail : Math.min(2, window.devicePixelRatio));
    renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
    draw();
  }

  // --- the gizmo ---

  const start = { position: new Vector3(), turn: new Quaternion() };
  gizmo.addEventListener("mouseDown", () => {
    start.position.copy(handle.position);
    start.turn.copy(handle.quaternion);
    handle.scale.set(1, 1, 1);
  });
  gizmo.addEventListener("objectChange", () => {
    told.gizmo({
      move: handle.position.clone().sub(start.position).toArray(), scale: handle.scale.toArray().map((factor) => Math.max(0.01, Math.abs(factor))),
      turn: gizmo.mode === "rotate" ? matrixOf(handle.quaternion.clone().multiply(start.turn.clone().invert())) : null,
      pivot: start.position.toArray(), frame: matrixOf(start.turn),
    });
  });
  gizmo.addEventListener("mouseUp", () => {
    handle.scale.set(1, 1, 1);
    told.gizmoEnds();
  });
  gizmo.addEventListener("change", draw);
  // Whoever moves the gizmo does not turn the camera.
  canvas.addEventListener("pointerdown", (event) => {
    if (gizmo.dragging) event.stopPropagation();
  });

  // --- from the scene to the screen and back ---

  const spot = new Vector3();
  function pixelOf(point) {
    spot.set(...point).project(camera);
    const { clientWidth, clientHeight } = canvas;
    return spot.z > 1 ? null : [((spot.x + 1) * clientWidth) / 2, ((1 - spot.y) * clientHeight) / 2];
  }
  function rayAt(x, y) {
    const { clientWidth, clientHeight } = canvas;
    spot.set((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight, 0.5).unproject(camera);
    return { from: camera.position.toArray(), along: spot.sub(camera.position).normalize().toArray() };
  }
  // How far along the ray an item is met; Infinity where it is not.
  function distanceTo(item, { from, along }) {
    const inward = transposed(item.axes);
    const inside = (vector) => applied(inward, vector).map((value, axis) => value / item.half[axis]);
    const origin = inside(from.map((x, axis) => x - item.center[axis]));
    const direction = inside(along);
    if (item.round) {
      const a = direction.reduce((sum, d) => sum + d * d, 0);
      const b = direction.reduce((sum, d, axis) => sum + d * origin[axis], 0);
      const root = b * b - a * (origin.reduce((sum, o) => sum + o * o, 0) - 1);
      if (root < 0) return Infinity;
      const far = (-b + Math.sqrt(root)) / a;
      return far < 0 ? Infinity : Math.max(0, (-b - Math.sqrt(root)) / a);
    }
    let [near, far] = [0, Infinity];
    for (let axis = 0; axis < 3; axis += 1) {
      const ends = [(-1 - origin[axis]) / direction[axis], (1 - origin[axis]) / direction[axis]].sort((p, q) => p - q);
      near = Math.max(near, ends[0]);
      far = Math.min(far, ends[1]);
    }
    return near <= far ? near : Infinity;
  }

  // --- the sun ---

  let sun = { elevation: 45, azimuth: 0 };
  const sunPlace = () => {
    const [e, a] = [radians(sun.elevation), radians(sun.azimuth)];
    return [Math.cos(e) * Math.sin(a), Math.sin(e), Math.cos(e) * Math.cos(a)];
  };
  function layOut() {
    dome.group.position.set(...home.center);
    dome.group.scale.setScalar(domeRadius());
    dome.sun.position.set(...sunPlace());
    dome.beam.geometry.attributes.position.set(sunPlace(), 3);
    dome.beam.geometry.attributes.position.needsUpdate = true;
    const away = camera.position.distanceTo(dome.sun.getWorldPosition(spot));
    const pixel = (2 * Math.tan(radians(camera.fov) / 2) * away) / (canvas.clientHeight || 1);
    dome.sun.scale.setScalar((kSunPixels * pixel) / domeRadius());
    axes.scale.setScalar(home.radius * 0.6);
    axes.position.set(0, 0, 0);
  }
  const domeRadius = () => 0.55 * home.radius; // within the picture that shows the whole cloud
  // Where the ray meets the dome: on the side of it where the sun is, or at its rim.
  function sunAt(x, y) {
    const { from, along } = rayAt(x, y);
    const origin = from.map((o, axis) => (o - home.center[axis]) / domeRadius());
    const b = origin.reduce((sum, o, axis) => sum + o * along[axis], 0);
    const root = b * b - (origin.reduce((sum, o) => sum + o * o, 0) - 1);
    const depth = root > 0 ? -b - Math.sqrt(root) : -b;
    const behind = root > 0 ? -b + Math.sqrt(root) : -b;
    const place = sunPlace();
    const facing = place.reduce((sum, p, axis) => sum + p * along[axis], 0);
    const where = origin.map((o, axis) => o + (facing > 0 || depth < 0 ? behind : depth) * along[axis]);
    const length = Math.hypot(...where);
    return {
      elevation: Math.max(0, Math.round((Math.asin(Math.min(1, Math.max(-1, where[1] / length))) * 1800) / Math.PI) / 10),
      azimuth: Math.round((((Math.atan2(where[0], where[2]) * 180) / Math.PI + 360) % 360) * 10) / 10,
    };
  }

  return {
    resize,
    camera({ eye, target, up, fov, aspect }) {
      Object.assign(camera, { fov, aspect });
      camera.position.set(...eye);
      camera.up.set(...up);
      camera.lookAt(...target);
      const away = Math.max(1e-3, Math.hypot(...eye.map((e, axis) => e - home.center[axis])));
      [camera.near, camera.far] = [Math.max(away, home.radius) / 2000, 20 * (away + home.radius)];
      camera.updateProjectionMatrix();
      camera.updateMatrixWorld();
      layOut();
      draw();
    },
    // bounds: { min, max } of the clouds; the grid lies under them.
    bounds({ min, max }) {
      const center = min.map((low, axis) => (low + max[axis]) / 2);
      const radius = Math.hypot(...min.map((low, axis) => (max[axis] - low) / 2)) || 1;
      home = { center, radius };
      const cell = 10 ** Math.floor(Math.log10(radius / 2));
      const cells = 2 * Math.ceil((1.5 * radius) / cell / 2);
      if (grid?.userData.cell !== cell || grid.userData.cells !== cells) {
        if (grid) {
          scene.remove(grid);
          grid.dispose();
        }
        grid = new GridHelper(cells * cell, cells, 0x66788a, 0x8fa0b0);
        Object.assign(grid.material, { transparent: true, opacity: 0.6 });
        Object.assign(grid.userData, { cell, cells });
        grid.visible = wires.object.visible;
        scene.add(grid);
      }
      grid.position.set(Math.round(center[0] / cell) * cell, min[1], Math.round(center[2] / cell) * cell);
      layOut();
      draw();
    },
    // Nobody takes hold of anything in a flight.
    flies(yes) {
      for (const one of [wires.object, axes, dome.group, gizmo.getHelper(), ...(grid ? [grid] : [])]) one.visible = !yes;
      flying = yes;
      resize();
    },
    items(list) {
      items = list;
      wires.show(list);
      draw();
    },
    // { mode: "translate" | "rotate" | "scale", center, axes, freely, snap: length or 0 }, or null. axes: a rotation; freely: it
    // may be turned about each of them, not about y only.
    gizmo(spec) {
      if (gizmo.dragging) return;
      if (!spec) {
        gizmo.detach();
        draw();
        return;
      }
      handle.position.set(...spec.center);
      handle.quaternion.copy(quaternionOf(spec.axes));
      handle.scale.set(1, 1, 1);
      gizmo.setMode(spec.mode);
      gizmo.setSpace(spec.mode === "translate" ? "world" : "local");
      gizmo.showX = gizmo.showZ = spec.mode !== "rotate" || spec.freely;
      gizmo.setTranslationSnap(spec.snap || null);
      gizmo.setScaleSnap(spec.snap ? 0.1 : null);
      gizmo.setRotationSnap(spec.snap ? radians(15) : null);
      gizmo.attach(handle);
      draw();
    },
    get holdsGizmo() { return gizmo.dragging || gizmo.axis !== null; },
    sun(angles) {
      sun = angles;
      layOut();
      draw();
    },
    holdsSun(x, y) {
      const pixel = pixelOf(dome.sun.getWorldPosition(new Vector3()).toArray());
      return pixel !== null && Math.hypot(pixel[0] - x, pixel[1] - y) < kSunReach;
    },
    sunAt,
    // The ids of what lies under a point, the nearest first.
    pick(x, y) {
      const ray = rayAt(x, y);
      return items.map((item) => [distanceTo(item, ray), item.id]).filter(([away]) => away < Infinity)
        .sort(([a], [b]) => a - b).map(([, id]) => id);
    },
    within(left, top, right, bottom) {
      return items.filter(({ center }) => {
        const pixel = pixelOf(center);
        return pixel && pixel[0] >= left && pixel[0] <= right && pixel[1] >= top && pixel[1] <= bottom;
      }).map(({ id }) => id);
    },
    particles(set, light) {
      sprites.show(set, light);
      draw();
    },
    spritesSeen: (width, height) => sprites.seen(renderer, camera, width, height),
    spritesGain(value) {
      sprites.gain(value);
      draw();
    },
    isSoftware,
    detail(share) {
      if (share === detail) return;
      detail = share;
      if (isWholeSmall()) resize();
      else draw();
    },
    spritesAt(opacity) {
      sprites.setOpacity(opacity);
      draw();
    },
  };
}
