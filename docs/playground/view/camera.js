// The reader's camera: the model's own until the view is turned, then free.

import { PerspectiveCamera, Quaternion, Vector3 } from "three";

/** @import {Assets} from "../engine/assets.js" */

const UP = new Vector3(0, 0, 1);
const POLE = 0.985; // how straight up or down the free view may look, as |z| of its direction

/** A camera that follows the model's until the reader turns it. */
export class ReaderCamera extends PerspectiveCamera {
  constructor() {
    super();
    this.up.copy(UP);
    this.target = new Vector3();
    this.free = false;
  }

  /**
   * Takes over the model's size and cameras.
   * @param {Assets} assets
   */
  load(assets) {
    const { extent, centre } = assets.size;
    this.centre = new Vector3(...centre);
    this.extent = extent;
    this.near = Math.max(1e-4, assets.map.near * extent * 0.5);
    this.far = Math.max(assets.map.far * extent, 10 * extent);
    this.fovy = assets.fovy;
    this.setFieldOfView(this.free || assets.cameras.length === 0 ? assets.fovy : this.fov);
    if (assets.cameras.length === 0) this.overview();
  }

  /** Looks at the whole model from the front and above. */
  overview() {
    const { centre = new Vector3(), extent = 1 } = this;
    this.free = true;
    this.target.copy(centre);
    this.position.copy(centre).add(new Vector3(0, -1.3, 0.75).multiplyScalar(extent));
    this.lookAt(centre);
    this.setFieldOfView(this.fovy ?? 45);
  }

  /**
   * Looks through a camera of the model, unless the reader has taken over.
   * @param {{pos: number[], mat: number[], fovy: number} | null} pose
   */
  follow(pose) {
    if (!pose || this.free) return;
    this.position.fromArray(pose.pos);
    const m = this.matrix.elements;
    for (let k = 0; k < 3; k++) [m[k], m[k + 4], m[k + 8]] = pose.mat.slice(3 * k, 3 * k + 3);
    this.quaternion.setFromRotationMatrix(this.matrix);
    this.setFieldOfView(pose.fovy);
    const ahead = this.ahead();
    const { centre = new Vector3(), extent = 1 } = this;
    const distance = centre.clone().sub(this.position).dot(ahead);
    this.target.copy(this.position).addScaledVector(ahead, Math.max(distance, 0.1 * extent));
  }

  /**
   * Turns about the target.
   * @param {number} right in rad
   * @param {number} up in rad
   */
  orbit(right, up) {
    this.free = true;
    const { target } = this;
    const side = new Vector3(1, 0, 0).applyQuaternion(this.quaternion);
    const turn = new Quaternion().setFromAxisAngle(UP, -right);
    const tilt = new Quaternion().setFromAxisAngle(side, -up);
    const tilted = this.ahead().applyQuaternion(tilt);
    if (Math.abs(tilted.z) < POLE || Math.abs(tilted.z) < Math.abs(this.ahead().z)) turn.multiply(tilt);
    this.position.sub(target).applyQuaternion(turn).add(target);
    this.quaternion.premultiply(turn);
  }

  /**
   * Moves towards the target, or away from it.
   * @param {number} factor of the distance: below 1 is nearer
   */
  approach(factor) {
    this.free = true;
    this.position.sub(this.target).multiplyScalar(factor).add(this.target);
  }

  /**
   * A point beside another, as seen.
   * @param {number[]} point
   * @param {number} right in m
   * @param {number} up in m
   */
  beside(point, right, up) {
    const [x, y] = [new Vector3(), new Vector3()];
    this.matrixWorld.extractBasis(x, y, new Vector3());
    return new Vector3(...point).addScaledVector(x, right).addScaledVector(y, up).toArray();
  }

  /** @param {number} fov in degrees, vertical */
  setFieldOfView(fov) {
    this.fov = fov;
    this.updateProjectionMatrix();
  }

  /** The direction of view, in the world. */
  ahead() {
    return new Vector3(0, 0, -1).applyQuaternion(this.quaternion);
  }
}
