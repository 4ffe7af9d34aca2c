// What drawing needs of a model once: shapes, textures, materials, lights, names.

import { nameOf } from "./signals.js";

/** @import {MainModule, MjModel, MjvScene} from "@mujoco/mujoco" */

const MAX_SIDE = 200; // of a height field, in drawn points

/**
 * @typedef {{vertices: Float32Array, faces: Int32Array}} Shape
 * @typedef {{width: number, height: number, rgba: Uint8Array<ArrayBuffer>}} Texture
 * @typedef {{texture: number, repeat: number[]}} Material
 * @typedef {{pos: number[], dir: number[], ambient: number[], diffuse: number[], cutoff: number, exponent: number,
 *   directional: boolean, head: boolean}} Light
 *
 * @typedef {object} Assets
 * @property {Shape[]} meshes
 * @property {(Shape | null)[]} hulls of the meshes
 * @property {Shape[]} fields height fields
 * @property {(Texture | null)[]} textures null for cube maps
 * @property {Texture | null} sky the skybox, six faces in a column
 * @property {Material[]} materials
 * @property {Light[]} lights
 * @property {string[]} cameras
 * @property {{id: number, name: string}[]} movable bodies that can be pulled
 * @property {{id: number, name: string, range: number[]}[]} actuators that have a name; the range of one without limits is 0 0
 * @property {{centre: number[], extent: number}} size of the model
 * @property {{near: number, far: number}} map in extents
 * @property {number} timestep in s
 * @property {number} fovy of the free camera, in degrees
 */

/**
 * Reads them from a compiled model.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {MjvScene} scene of the model, up to date
 * @returns {Assets}
 */
export function assets(mujoco, model, scene) {
  const name = (/** @type {{value: number}} */ kind, /** @type {number} */ id) => nameOf(mujoco, model, kind.value, id);
  const { mjOBJ_ACTUATOR, mjOBJ_BODY, mjOBJ_CAMERA } = mujoco.mjtObj;
  const textures = range(model.ntex).map((i) => texture(model, i));
  const sky = range(model.ntex).find((i) => model.tex_type[i] === mujoco.mjtTexture.mjTEXTURE_SKYBOX.value);
  const { map, global } = model.vis;
  return {
    meshes: range(model.nmesh).map((i) => mesh(model, i)),
    hulls: range(model.nmesh).map((i) => hull(model, i)),
    fields: range(model.nhfield).map((i) => field(model, i)),
    textures: textures.map((made, i) => (model.tex_type[i] === mujoco.mjtTexture.mjTEXTURE_2D.value ? made : null)),
    sky: sky === undefined ? null : textures[sky],
    materials: range(model.nmat).map((i) => material(mujoco, model, i)),
    lights: lights(mujoco, scene),
    cameras: range(model.ncam).map((i) => name(mjOBJ_CAMERA, i) || `camera ${i}`),
    movable: range(model.nbody)
      .filter((id) => model.body_weldid[id] !== 0)
      .map((id) => ({ id, name: name(mjOBJ_BODY, id) || `body ${id}` })),
    actuators: range(model.nu)
      .map((id) => ({ id, name: name(mjOBJ_ACTUATOR, id), range: Array.from(part(model.actuator_ctrlrange, id, 2)) }))
      .filter(({ name }) => name !== ""),
    size: { centre: Array.from(model.stat.center), extent: model.stat.extent },
    timestep: model.opt.timestep,
    map: { near: map.znear, far: map.zfar },
    fovy: global.fovy,
  };
}

/**
 * @param {MjModel} model
 * @param {number} i
 * @returns {Shape}
 */
function mesh(model, i) {
  return {
    vertices: Float32Array.from(part(model.mesh_vert, 0, 3 * model.mesh_vertnum[i], 3 * model.mesh_vertadr[i])),
    faces: Int32Array.from(part(model.mesh_face, 0, 3 * model.mesh_facenum[i], 3 * model.mesh_faceadr[i])),
  };
}

/**
 * The convex hull, which MuJoCo keeps as: number of vertices, of faces, an edge address and an id a vertex, the edges,
 * and three vertex ids a face.
 * @param {MjModel} model
 * @param {number} i
 * @returns {Shape | null}
 */
function hull(model, i) {
  const at = model.mesh_graphadr[i];
  if (at < 0) return null;
  const [vertices, faces] = [model.mesh_graph[at], model.mesh_graph[at + 1]];
  const edges = vertices + 3 * faces;
  return { vertices: mesh(model, i).vertices, faces: Int32Array.from(part(model.mesh_graph, 0, 3 * faces, at + 2 + 2 * vertices + edges)) };
}

/**
 * @param {MjModel} model
 * @param {number} i
 * @returns {Shape}
 */
function field(model, i) {
  const [rows, columns, at] = [model.hfield_nrow[i], model.hfield_ncol[i], model.hfield_adr[i]];
  const [x, y, z] = part(model.hfield_size, i, 4);
  const [high, wide] = [Math.min(rows, MAX_SIDE), Math.min(columns, MAX_SIDE)];
  const vertices = new Float32Array(3 * high * wide);
  /** @type {number[]} */
  const faces = [];
  for (let r = 0; r < high; r++) {
    for (let c = 0; c < wide; c++) {
      const [row, column] = [Math.round((r * (rows - 1)) / (high - 1)), Math.round((c * (columns - 1)) / (wide - 1))];
      const height = z * model.hfield_data[at + row * columns + column];
      vertices.set([x * ((2 * column) / (columns - 1) - 1), y * ((2 * row) / (rows - 1) - 1), height], 3 * (r * wide + c));
      const corner = r * wide + c;
      if (r + 1 < high && c + 1 < wide) faces.push(corner, corner + 1, corner + wide, corner + 1, corner + wide + 1, corner + wide);
    }
  }
  return { vertices, faces: Int32Array.from(faces) };
}

/**
 * @param {MjModel} model
 * @param {number} i
 * @returns {Texture}
 */
function texture(model, i) {
  const [width, height, channels] = [model.tex_width[i], model.tex_height[i], model.tex_nchannel[i]];
  const data = model.tex_data.subarray(Number(model.tex_adr[i]));
  const rgba = new Uint8Array(4 * width * height).fill(255);
  for (let p = 0; p < width * height; p++) {
    for (let k = 0; k < channels; k++) rgba[4 * p + k] = data[channels * p + k];
  }
  return { width, height, rgba };
}

/**
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {number} i
 * @returns {Material}
 */
function material(mujoco, model, i) {
  const roles = mujoco.mjtTextureRole.mjNTEXROLE.value;
  const colour = model.mat_texid[roles * i + mujoco.mjtTextureRole.mjTEXROLE_RGB.value];
  return { texture: colour, repeat: part(model.mat_texrepeat, i, 2) };
}

/**
 * @param {MainModule} mujoco
 * @param {MjvScene} scene
 * @returns {Light[]}
 */
function lights(mujoco, scene) {
  const all = scene.lights; // a copy, as is every light taken from it
  const made = range(scene.nlight).map((i) => {
    const light = /** @type {any} */ (all.get(i));
    const [pos, dir, ambient, diffuse] = [light.pos, light.dir, light.ambient, light.diffuse].map((numbers) => Array.from(numbers));
    const directional = light.type === mujoco.mjtLightType.mjLIGHT_DIRECTIONAL.value;
    const { cutoff, exponent } = light;
    const head = Boolean(light.headlight);
    light.delete();
    return { pos, dir, ambient, diffuse, cutoff, exponent, directional, head };
  });
  all.delete();
  return made;
}

/**
 * @param {ArrayLike<number> & {slice: (from: number, to: number) => ArrayLike<number>}} array
 * @param {number} i
 * @param {number} length
 * @param {number} [from]
 * @returns {number[]}
 */
function part(array, i, length, from = 0) {
  return Array.from(array.slice(from + i * length, from + (i + 1) * length));
}

/** @param {number} n */
function range(n) {
  return Array.from({ length: n }, (_, i) => i);
}
