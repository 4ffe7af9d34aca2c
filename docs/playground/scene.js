// Draws what MuJoCo's own visualisation lists (mjvScene) with three.js: one instanced mesh for each shape and material.

import * as THREE from "three";
import { Eye } from "./camera.js";
import { GEOM } from "./live.js";
import { Pace } from "./pace.js";
import { arrow, shapes } from "./shapes.js";
import { dataTexture, Lights, sky } from "./surface.js";

/** @import {Assets} from "./assets.js" */
/** @import {Frame} from "./live.js" */

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
 * @typedef {{mesh: THREE.InstancedMesh, count: number}} Bucket
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
    this.pace = new Pace(Math.min(devicePixelRatio, MAX_RATIO));
    this.renderer.setPixelRatio(this.pace.ratio);
    this.renderer.setClearColor(new THREE.Color(0.2, 0.25, 0.3));
    this.root = new THREE.Scene();
    this.eye = new Eye();
    /** @type {Map<string, Bucket>} */
    this.buckets = new Map();
    /** @type {Map<string, THREE.BufferGeometry>} */
    this.shapes = new Map();
    /** @type {(THREE.Texture | null)[]} */
    this.textures = [];
    this.lights = new Lights();
    this.draws = 0;
  }

  /**
   * Takes over what a newly compiled model brings.
   * @param {Assets} assets
   */
  load(assets) {
    this.clear();
    this.assets = assets;
    this.shapes = shapes(assets);
    this.textures = assets.textures.map((made) => made && dataTexture(made));
    if (assets.sky) this.root.add(sky(assets.sky));
    this.lights.load(assets.lights);
    this.eye.fit(assets);
  }

  /**
   * Draws a frame.
   * @param {Frame} frame
   */
  draw(frame) {
    this.eye.follow(frame.camera);
    for (const bucket of this.buckets.values()) bucket.count = 0;
    for (let at = 0; at < frame.geoms.length; at += GEOM.LENGTH) this.place(frame.geoms.subarray(at, at + GEOM.LENGTH));
    for (const { mesh, count } of this.buckets.values()) {
      mesh.count = count;
      mesh.visible = count > 0;
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
    const ratio = this.pace.drawn(performance.now());
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio); // which empties the canvas
    this.render();
  }

  /** Draws again what was drawn last, from where the eye is now. */
  render() {
    const canvas = this.renderer.domElement;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0 || height === 0) return;
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
    const { camera } = this.eye;
    if (camera.aspect !== width / height) {
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
    }
    this.lights.face(this.eye.ahead());
    this.renderer.render(this.root, camera);
    this.draws += 1;
  }

  /**
   * A ray into the scene, in the world.
   * @param {number} x from -1, left, to 1
   * @param {number} y from -1, the bottom, to 1
   */
  ray(x, y) {
    const { camera } = this.eye;
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
    const ahead = this.eye.ahead();
    const depth = new THREE.Vector3(...like).sub(this.eye.camera.position).dot(ahead);
    const along = depth / new THREE.Vector3(...direction).dot(ahead);
    return origin.map((start, k) => start + along * direction[k]);
  }

  /** @param {Float32Array} geom */
  place(geom) {
    const [x, y, z] = geom.subarray(GEOM.SIZE, GEOM.SIZE + 3);
    const type = geom[GEOM.TYPE];
    const put = (/** @type {string} */ shape, /** @type {number[]} */ scale, /** @type {number} */ lift = 0) =>
      this.put(shape, geom, scale, lift);
    switch (type) {
      case TYPE.PLANE:
        return put("plane", [x || FAR, y || FAR, 1]);
      case TYPE.SPHERE:
        return put("sphere", [x, x, x]);
      case TYPE.ELLIPSOID:
        return put("sphere", [x, y, z]);
      case TYPE.CAPSULE:
        put("tube", [x, x, z]);
        put("cap", [x, x, x], z);
        return put("cap", [x, -x, -x], -z);
      case TYPE.CYLINDER:
        return put("cylinder", [x, y, z]);
      case TYPE.BOX:
        return put("box", [x, y, z]);
      case TYPE.LINEBOX:
        return put("box", [x, y, z]);
      case TYPE.MESH:
      case TYPE.SDF:
        return put(`${geom[GEOM.DATA] & 1 ? "hull" : "mesh"}-${geom[GEOM.DATA] >> 1}`, [1, 1, 1]);
      case TYPE.HFIELD:
        return put(`field-${geom[GEOM.DATA]}`, [1, 1, 1]);
      case TYPE.ARROW:
      case TYPE.ARROW1:
        return arrow(x, z, type === TYPE.ARROW).forEach(({ shape, scale, lift }) => put(shape, scale, lift));
      case TYPE.ARROW2:
        put("cylinder", [x, x, z / 2 - x]);
        put("cone", [x, x, x / 2], (z - x) / 2);
        return put("cone", [x, -x, -x / 2], (x - z) / 2);
      case TYPE.LINE:
        return put("tube", [0.0015 * this.extent, 0.0015 * this.extent, z / 2], z / 2);
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
  put(shape, geom, scale, lift) {
    const geometry = this.shapes.get(shape);
    if (!geometry) return;
    const [r, g, b, a] = geom.subarray(GEOM.RGBA, GEOM.RGBA + 4);
    const bucket = this.bucket(shape, geometry, geom, a, scale);
    const m = geom.subarray(GEOM.MAT, GEOM.MAT + 9);
    const p = geom.subarray(GEOM.POS, GEOM.POS + 3);
    const [sx, sy, sz] = scale;
    matrix.set(
      m[0] * sx, m[1] * sy, m[2] * sz, p[0] + m[2] * lift,
      m[3] * sx, m[4] * sy, m[5] * sz, p[1] + m[5] * lift,
      m[6] * sx, m[7] * sy, m[8] * sz, p[2] + m[8] * lift,
      0, 0, 0, 1,
    ); // prettier-ignore
    bucket.mesh.setMatrixAt(bucket.count, matrix);
    bucket.mesh.setColorAt(bucket.count, tint.setRGB(r, g, b));
    bucket.count += 1;
  }

  /**
   * The bucket with room for one more instance.
   * @param {string} shape
   * @param {THREE.BufferGeometry} geometry
   * @param {Float32Array} geom
   * @param {number} alpha
   * @param {number[]} scale
   * @returns {Bucket}
   */
  bucket(shape, geometry, geom, alpha, scale) {
    const opacity = Math.round(alpha * 20) / 20;
    const { map, repeat } = this.texture(shape === "plane" ? geom[GEOM.MATERIAL] : -1, Boolean(geom[GEOM.UNIFORM]), scale);
    const key = `${shape} ${opacity} ${map ? `${geom[GEOM.MATERIAL]} ${repeat}` : ""}`;
    const found = this.buckets.get(key);
    if (found && found.count < found.mesh.instanceMatrix.count) return found;
    const material = found?.mesh.material ?? this.lights.surface({ opacity, twoSided: twoSided(shape), map, repeat });
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
    const bucket = { mesh, count: found?.count ?? 0 };
    this.root.add(mesh);
    this.buckets.set(key, bucket);
    return bucket;
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
    for (const { mesh } of this.buckets.values()) mesh.dispose();
    this.root.traverse((part) => {
      if (part instanceof THREE.Mesh) part.material.dispose();
      if (part instanceof THREE.Mesh) part.geometry.dispose();
    });
    for (const geometry of this.shapes.values()) geometry.dispose();
    for (const texture of this.textures) texture?.dispose();
    this.buckets.clear();
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
