// Draws what MuJoCo's own visualisation lists (mjvScene) with three.js: one instanced mesh for each shape and material.

import * as THREE from "three";
import { GEOM } from "../engine/pack.js";
import { ReaderCamera } from "./camera.js";
import { arrow, geometries } from "./geometries.js";
import { dataTexture, Lights, sky } from "./lighting.js";
import { Resolution } from "./resolution.js";

/** @import {Assets} from "../engine/assets.js" */
/** @import {Frame} from "../engine/interactive.js" */

/** Numbers of mjtGeom. */
const TYPE = {
  PLANE: 0, HFIELD: 1, SPHERE: 2, CAPSULE: 3, ELLIPSOID: 4, CYLINDER: 5, BOX: 6, MESH: 7, SDF: 8,
  ARROW: 100, ARROW1: 101, ARROW2: 102, LINE: 103, LINEBOX: 104, TRIANGLE: 108,
}; // prettier-ignore
const FAR = 100; // half the side of an infinite plane, in m
const MAX_RATIO = 1.5; // pixels a CSS pixel
const SOFTWARE = /swiftshader|llvmpipe|software|basic render/i;

/**
 * Instances of one shape in one material.
 * @typedef {{mesh: THREE.InstancedMesh, count: number}} Batch
 */

/** A canvas with the scene. */
export class Scene {
  /**
   * @param {HTMLCanvasElement} canvas
   * @throws {Error} if there is no WebGL
   */
  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !drawsInSoftware(), powerPreference: "low-power" });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace; // colours go out as they came in
    this.resolution = new Resolution(Math.min(devicePixelRatio, MAX_RATIO));
    this.renderer.setPixelRatio(this.resolution.ratio);
    this.renderer.setClearColor(new THREE.Color(0.2, 0.25, 0.3));
    this.root = new THREE.Scene();
    this.camera = new ReaderCamera();
    /** @type {Map<string, Batch>} */
    this.batches = new Map();
    /** @type {Map<string, THREE.BufferGeometry>} */
    this.geometries = new Map();
    /** @type {(THREE.Texture | null)[]} */
    this.textures = [];
    this.lights = new Lights();
    this.draws = 0;
    this.rendered = () => {};
  }

  /**
   * Takes over what a newly compiled model brings.
   * @param {Assets} assets
   */
  load(assets) {
    this.clear();
    this.assets = assets;
    this.geometries = geometries(assets);
    this.textures = assets.textures.map((made) => made && dataTexture(made));
    if (assets.sky) this.root.add(sky(assets.sky));
    this.lights.load(assets.lights);
    this.camera.load(assets);
  }

  /**
   * Draws a frame.
   * @param {Frame} frame
   */
  draw(frame) {
    this.camera.follow(frame.camera);
    for (const batch of this.batches.values()) batch.count = 0;
    for (let at = 0; at < frame.geoms.length; at += GEOM.LENGTH) this.addGeom(frame.geoms.subarray(at, at + GEOM.LENGTH));
    for (const { mesh, count } of this.batches.values()) {
      mesh.count = count;
      mesh.visible = count > 0;
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
    const ratio = this.resolution.frameDrawn(performance.now());
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio); // which empties the canvas
    this.render();
  }

  /** Draws again what was drawn last, from where the camera is now. */
  render() {
    const canvas = this.renderer.domElement;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0 || height === 0) return;
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
    const { camera } = this;
    if (camera.aspect !== width / height) {
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
    }
    this.lights.aimHeadlight(this.camera.ahead());
    this.renderer.render(this.root, camera);
    this.draws += 1;
    this.rendered();
  }

  /**
   * A ray into the scene, in the world.
   * @param {number} x from -1, left, to 1
   * @param {number} y from -1, the bottom, to 1
   */
  ray(x, y) {
    const { camera } = this;
    camera.updateMatrixWorld();
    const direction = new THREE.Vector3(x, y, 0.5).unproject(camera).sub(camera.position).normalize();
    return { origin: camera.position.toArray(), direction: direction.toArray() };
  }

  /**
   * The point under the pointer, as far away as another point of the world.
   * @param {number} x
   * @param {number} y
   * @param {number[]} like
   */
  pointAt(x, y, like) {
    const { origin, direction } = this.ray(x, y);
    const ahead = this.camera.ahead();
    const depth = new THREE.Vector3(...like).sub(this.camera.position).dot(ahead);
    const along = depth / new THREE.Vector3(...direction).dot(ahead);
    return origin.map((start, k) => start + along * direction[k]);
  }

  /** @param {Float32Array} geom */
  addGeom(geom) {
    const [x, y, z] = geom.subarray(GEOM.SIZE, GEOM.SIZE + 3);
    const type = geom[GEOM.TYPE];
    const add = (/** @type {string} */ shape, /** @type {number[]} */ scale, /** @type {number} */ lift = 0) =>
      this.addInstance(shape, geom, scale, lift);
    switch (type) {
      case TYPE.PLANE:
        return add("plane", [x || FAR, y || FAR, 1]);
      case TYPE.SPHERE:
        return add("sphere", [x, x, x]);
      case TYPE.ELLIPSOID:
        return add("sphere", [x, y, z]);
      case TYPE.CAPSULE:
        add("tube", [x, x, z]);
        add("cap", [x, x, x], z);
        return add("cap", [x, -x, -x], -z);
      case TYPE.CYLINDER:
        return add("cylinder", [x, y, z]);
      case TYPE.BOX:
        return add("box", [x, y, z]);
      case TYPE.LINEBOX:
        return add("box", [x, y, z]);
      case TYPE.MESH:
      case TYPE.SDF:
        return add(`${geom[GEOM.DATA] & 1 ? "hull" : "mesh"}-${geom[GEOM.DATA] >> 1}`, [1, 1, 1]);
      case TYPE.HFIELD:
        return add(`field-${geom[GEOM.DATA]}`, [1, 1, 1]);
      case TYPE.ARROW:
      case TYPE.ARROW1:
        return arrow(x, z, type === TYPE.ARROW).forEach(({ shape, scale, lift }) => add(shape, scale, lift));
      case TYPE.ARROW2:
        add("cylinder", [x, x, z / 2 - x]);
        add("cone", [x, x, x / 2], (z - x) / 2);
        return add("cone", [x, -x, -x / 2], (x - z) / 2);
      case TYPE.LINE:
        return add("tube", [0.0015 * this.extent, 0.0015 * this.extent, z / 2], z / 2);
    }
  }

  get extent() {
    return this.assets?.size.extent ?? 1;
  }

  /**
   * Adds one instance.
   * @param {string} shape
   * @param {Float32Array} geom
   * @param {number[]} scale
   * @param {number} lift along the geom's z axis, in m
   */
  addInstance(shape, geom, scale, lift) {
    const geometry = this.geometries.get(shape);
    if (!geometry) return;
    const [r, g, b, a] = geom.subarray(GEOM.RGBA, GEOM.RGBA + 4);
    const batch = this.batch(shape, geometry, geom, a, scale);
    const m = geom.subarray(GEOM.MAT, GEOM.MAT + 9);
    const p = geom.subarray(GEOM.POS, GEOM.POS + 3);
    const [sx, sy, sz] = scale;
    matrix.set(
      m[0] * sx, m[1] * sy, m[2] * sz, p[0] + m[2] * lift,
      m[3] * sx, m[4] * sy, m[5] * sz, p[1] + m[5] * lift,
      m[6] * sx, m[7] * sy, m[8] * sz, p[2] + m[8] * lift,
      0, 0, 0, 1,
    ); // prettier-ignore
    batch.mesh.setMatrixAt(batch.count, matrix);
    batch.mesh.setColorAt(batch.count, tint.setRGB(r, g, b));
    batch.count += 1;
  }

  /**
   * The batch with room for one more instance.
   * @param {string} shape
   * @param {THREE.BufferGeometry} geometry
   * @param {Float32Array} geom
   * @param {number} alpha
   * @param {number[]} scale
   * @returns {Batch}
   */
  batch(shape, geometry, geom, alpha, scale) {
    const opacity = Math.round(alpha * 20) / 20;
    const { map, repeat } = this.texture(shape === "plane" ? geom[GEOM.MATERIAL] : -1, Boolean(geom[GEOM.UNIFORM]), scale);
    const key = `${shape} ${opacity} ${map ? `${geom[GEOM.MATERIAL]} ${repeat}` : ""}`;
    const found = this.batches.get(key);
    if (found && found.count < found.mesh.instanceMatrix.count) return found;
    const material = found?.mesh.material ?? this.lights.material({ opacity, twoSided: twoSided(shape), map, repeat });
    const mesh = new THREE.InstancedMesh(geometry, material, found ? 2 * found.count : 4);
    mesh.frustumCulled = false;
    mesh.renderOrder = opacity < 1 ? 2 : 0;
    if (found) {
      for (let i = 0; i < found.count; i++) {
        found.mesh.getMatrixAt(i, matrix);
        found.mesh.getColorAt(i, tint);
        mesh.setMatrixAt(i, matrix);
        mesh.setColorAt(i, tint);
      }
      this.root.remove(found.mesh);
      found.mesh.dispose();
    }
    const batch = { mesh, count: found?.count ?? 0 };
    this.root.add(mesh);
    this.batches.set(key, batch);
    return batch;
  }

  /**
   * @param {number} id of the material
   * @param {boolean} uniform whether the texture repeats by the metre rather than by the object
   * @param {number[]} scale half sides of the plane, in m
   * @returns {{map: THREE.Texture | null, repeat: [number, number]}}
   */
  texture(id, uniform, scale) {
    const material = this.assets?.materials[id];
    const map = (material && this.textures[material.texture]) ?? null;
    const [u, v] = material?.repeat ?? [1, 1];
    return { map, repeat: [u * (uniform ? scale[0] : 1), v * (uniform ? scale[1] : 1)] };
  }

  clear() {
    for (const { mesh } of this.batches.values()) mesh.dispose();
    this.root.traverse((part) => {
      if (part instanceof THREE.Mesh) part.material.dispose();
      if (part instanceof THREE.Mesh) part.geometry.dispose();
    });
    for (const geometry of this.geometries.values()) geometry.dispose();
    for (const texture of this.textures) texture?.dispose();
    this.batches.clear();
    this.root.clear();
  }

  /** Frees everything, the graphics context included. */
  dispose() {
    this.clear();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}

const matrix = new THREE.Matrix4();
const tint = new THREE.Color();

/** @param {string} shape */
function twoSided(shape) {
  return shape === "cap" || shape === "tube" || /^(mesh|field)/.test(shape);
}

/** Whether this machine has no graphics card to smooth edges with. */
function drawsInSoftware() {
  const context = document.createElement("canvas").getContext("webgl2");
  const info = context?.getExtension("WEBGL_debug_renderer_info");
  const name = context && info ? String(context.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return SOFTWARE.test(name);
}
