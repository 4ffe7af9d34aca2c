// What is to be drawn, packed for the way from the worker to the page.

/** @import {MjData, MjModel, MjvScene} from "@mujoco/mujoco" */

/** The numbers of a packed geom, in this order; see `pack`. */
export const GEOM = {
  TYPE: 0,
  DATA: 1,
  MATERIAL: 2,
  UNIFORM: 3,
  SIZE: 4,
  POS: 7,
  MAT: 10,
  RGBA: 19,
  LENGTH: 23,
};

/**
 * The scene's geoms, GEOM.LENGTH numbers each.
 * @param {MjvScene} scene
 */
export function pack(scene) {
  const geoms = scene.geoms; // a copy, as is every geom taken from it
  const packed = new Float32Array(scene.ngeom * GEOM.LENGTH);
  for (let i = 0; i < scene.ngeom; i++) {
    const geom = /** @type {any} */ (geoms.get(i));
    const at = i * GEOM.LENGTH;
    packed[at + GEOM.TYPE] = geom.type;
    packed[at + GEOM.DATA] = geom.dataid;
    packed[at + GEOM.MATERIAL] = geom.matid;
    packed[at + GEOM.UNIFORM] = geom.texuniform;
    packed.set(geom.size, at + GEOM.SIZE);
    packed.set(geom.pos, at + GEOM.POS);
    packed.set(geom.mat, at + GEOM.MAT);
    packed.set(geom.rgba, at + GEOM.RGBA);
    geom.delete();
  }
  geoms.delete();
  return packed;
}

/**
 * Where a camera of the model is.
 * @param {MjModel} model
 * @param {MjData} data
 * @param {number} camera
 */
export function cameraPose(model, data, camera) {
  return {
    pos: Array.from(data.cam_xpos.slice(3 * camera, 3 * camera + 3)),
    mat: Array.from(data.cam_xmat.slice(9 * camera, 9 * camera + 9)),
    fovy: model.cam_fovy[camera],
  };
}
