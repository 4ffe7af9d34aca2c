// A simulation that the reader watches: stepped in time with the screen, sampled, pulled, and packed for drawing.

import { evaluate, parse } from "../record/expression.js";
import { compile, encoded } from "./compile.js";
import { pathSignals } from "./measure.js";
import { cameraPose, pack } from "./pack.js";
import { bind, nameOf } from "./signals.js";
import { controls, raised, start, step } from "./simulate.js";

/** @import {MainModule, MjData, MjModel, MjvCamera, MjvOption, MjvPerturb, MjvScene} from "@mujoco/mujoco" */
/** @import {CaseRecord} from "../record/types.js" */
/** @import {Drive} from "./simulate.js" */

const MAX_GEOMS = 2000;
const SAMPLES_A_FRAME = 20;
const STEPPING = 12; // ms a frame

/** The overlays, each with the flag of MuJoCo's visualisation that draws it. */
export const OVERLAYS = /** @type {const} */ ({
  contact_points: "mjVIS_CONTACTPOINT",
  contact_forces: "mjVIS_CONTACTFORCE",
  joint_axes: "mjVIS_JOINT",
  body_frames: "",
  centre_of_mass: "mjVIS_COM",
  inertia: "mjVIS_INERTIA",
  convex_hulls: "mjVIS_CONVEXHULL",
  transparent: "mjVIS_TRANSPARENT",
  actuators: "mjVIS_ACTUATOR",
  cameras: "mjVIS_CAMERA",
});

/**
 * What a frame shows.
 * @typedef {object} Frame
 * @property {Float32Array} geoms packed, GEOM.LENGTH numbers each
 * @property {{pos: number[], mat: number[], fovy: number} | null} camera of the model, null for the free one
 * @property {number} time simulated, in s, counted by steps
 * @property {number} steps made since the start
 * @property {boolean} late whether the engine could not keep up with the speed asked for
 * @property {{name: string, text: string}[]} warnings
 * @property {{time: number[], values: Record<string, number[]>}} samples since the last frame
 * @property {number[]} ctrl the control of every actuator
 */

/** A compiled model with its data and everything that draws it. */
export class InteractiveSimulation {
  /**
   * @param {MainModule} mujoco
   * @param {string} xml
   * @param {CaseRecord} record
   * @throws {Error} with MuJoCo's message, if the XML does not compile
   */
  constructor(mujoco, xml, record) {
    this.mujoco = mujoco;
    this.record = record;
    /** @type {MjModel} */
    this.model = record.files
      ? compile(mujoco, record.main ?? xml, [...record.files, ...encoded([[record.name, xml]])])
      : mujoco.MjModel.from_xml_string(xml);
    /** @type {MjvScene} */
    this.scene = new mujoco.MjvScene(this.model, MAX_GEOMS);
    /** @type {MjvOption} */
    this.option = new mujoco.MjvOption();
    /** @type {MjvCamera} */
    this.camera = new mujoco.MjvCamera();
    /** @type {MjvPerturb} */
    this.perturb = new mujoco.MjvPerturb();
    mujoco.mjv_defaultFreeCamera(this.model, this.camera);
    /** @type {string[]} what of the record's run and signals the model lacks */
    this.missing = [];
    this.steps = 0;
    this.debt = 0;
    /** @type {MjData} */
    this.data = new mujoco.MjData(this.model);
    /** @type {Drive} */
    this.drive = [];
    /** @type {Record<string, number>} controls that the reader holds, by the actuator's name */
    this.taken = {};
    /** @type {{name: string, read: () => number}[]} */
    this.signals = [];
    /** @type {{delete: () => void}[]} what the signals' readers hold */
    this.held = [];
    this.restart();
  }

  /** Puts the model back to the start of the record's run. */
  restart() {
    const { mujoco, model, record } = this;
    this.free();
    this.missing = [];
    this.steps = 0;
    this.debt = 0;
    this.data = this.attempt(() => start(mujoco, model, record.run)) ?? new mujoco.MjData(model);
    this.control(this.taken);
    this.signals = this.readers();
    this.release();
    mujoco.mj_forward(model, this.data);
    this.update([]);
  }

  /**
   * Moves on by whole steps, and by `seconds` of simulated time as far as a frame's time allows.
   * @param {number} seconds
   * @param {number} steps
   * @returns {Pick<Frame, "late" | "samples">}
   */
  advance(seconds, steps) {
    const { mujoco, model, data } = this;
    const timestep = model.opt.timestep;
    this.debt += timestep > 0 ? seconds : 0;
    const wanted = steps + (timestep > 0 ? Math.floor(this.debt / timestep + 1e-9) : 0);
    const stride = Math.ceil(wanted / SAMPLES_A_FRAME);
    /** @type {Frame["samples"]} */
    const samples = { time: [], values: Object.fromEntries(this.signals.map(({ name }) => [name, []])) };
    const deadline = performance.now() + STEPPING;
    let made = 0;
    while (made < wanted && (made < Math.max(steps, 1) || performance.now() < deadline)) {
      if (this.perturb.active) {
        data.xfrc_applied.fill(0);
        mujoco.mjv_applyPerturbForce(model, data, this.perturb);
      }
      step(mujoco, model, data, this.drive, this.steps);
      this.steps += 1;
      made += 1;
      if (this.steps % stride === 0 || made === wanted) {
        samples.time.push(this.steps * timestep);
        for (const { name, read } of this.signals) samples.values[name].push(read());
      }
    }
    const late = made < wanted;
    this.debt = late ? 0 : Math.max(0, this.debt - (made - steps) * timestep);
    return { late, samples };
  }

  /**
   * Lists what is to be drawn now.
   * @param {string[]} overlays
   */
  update(overlays) {
    const { mujoco, model, data, option } = this;
    for (const [name, flag] of Object.entries(OVERLAYS)) {
      if (flag) option.flags[mujoco.mjtVisFlag[flag].value] = Number(overlays.includes(name));
    }
    const { mjFRAME_BODY, mjFRAME_NONE } = mujoco.mjtFrame;
    option.frame = (overlays.includes("body_frames") ? mjFRAME_BODY : mjFRAME_NONE).value;
    const all = mujoco.mjtCatBit.mjCAT_ALL.value;
    mujoco.mjv_updateScene(model, data, option, this.perturb, this.camera, all, this.scene);
  }

  /**
   * What is to be drawn now.
   * @param {string[]} overlays
   * @param {number} camera the model's camera to look through, or -1
   * @param {Pick<Frame, "late" | "samples">} moved
   * @returns {Frame}
   */
  frame(overlays, camera, moved) {
    const { mujoco, model, data } = this;
    this.update(overlays);
    return {
      ...moved,
      geoms: pack(this.scene),
      camera: camera < 0 ? null : cameraPose(model, data, camera),
      time: this.steps * model.opt.timestep,
      steps: this.steps,
      ctrl: Array.from(data.ctrl),
      warnings: raised(mujoco, data).map(({ name, id, info }) => ({ name, text: mujoco.mju_warningText(id, info) })),
    };
  }

  /**
   * Takes hold of the body that a ray meets first.
   * @param {number[]} origin
   * @param {number[]} direction
   * @returns {{name: string, point: number[]} | null} the body and the point in the world, or null
   */
  grab(origin, direction) {
    const { mujoco, model, data } = this;
    const hit = new mujoco.IntBuffer(1);
    const length = mujoco.mj_ray(model, data, origin, direction, [1, 1, 1, 0, 0, 0], true, -1, hit, null);
    const geom = hit.GetView()[0];
    hit.delete();
    const body = geom < 0 ? 0 : model.geom_bodyid[geom];
    if (body === 0 || model.body_weldid[body] === 0) return null;
    return this.hold(body, origin.map((x, k) => x + length * direction[k]));
  }

  /**
   * Takes hold of a body at a point of the world, its centre of mass if none is given.
   * @param {number} body
   * @param {number[]} [at]
   */
  hold(body, at) {
    const { mujoco, model, data, perturb } = this;
    const point = at ?? Array.from(data.xipos.slice(3 * body, 3 * body + 3));
    const [pos, mat] = [data.xpos.slice(3 * body, 3 * body + 3), data.xmat.slice(9 * body, 9 * body + 9)];
    const offset = point.map((x, k) => x - pos[k]);
    perturb.select = body;
    for (let k = 0; k < 3; k++) perturb.localpos[k] = mat[k] * offset[0] + mat[k + 3] * offset[1] + mat[k + 6] * offset[2];
    mujoco.mjv_initPerturb(model, data, this.scene, perturb);
    perturb.active = mujoco.mjtPertBit.mjPERT_TRANSLATE.value;
    this.drag(point);
    return { name: nameOf(mujoco, model, mujoco.mjtObj.mjOBJ_BODY.value, body) || `body ${body}`, point };
  }

  /**
   * Pulls what is held towards a point of the world.
   * @param {number[]} point
   */
  drag(point) {
    point.forEach((x, k) => (this.perturb.refselpos[k] = x));
  }

  /** Lets go. */
  release() {
    this.perturb.active = 0;
    this.perturb.select = 0;
    this.data.xfrc_applied.fill(0);
  }

  /**
   * Holds actuators at controls of the reader's; the others are driven as the record says.
   * @param {Record<string, number>} wanted by the actuator's name
   */
  control(wanted) {
    this.taken = wanted;
    const { mujoco, model, record } = this;
    const type = mujoco.mjtObj.mjOBJ_ACTUATOR.value;
    const given = Object.entries(wanted).map(([name, value]) => ({ id: mujoco.mj_name2id(model, type, name), value }));
    const taken = given.filter(({ id }) => id >= 0);
    const driven = this.attempt(() => controls(mujoco, model, record.run)) ?? [];
    this.drive = [...driven, ...taken.map(({ id, value }) => ({ id, at: () => value }))];
    for (const { id, value } of taken) this.data.ctrl[id] = value;
  }

  /** Frees everything. */
  delete() {
    this.free();
    for (const part of [this.perturb, this.camera, this.option, this.scene, this.model]) part.delete();
  }

  free() {
    for (const handle of [...this.held.splice(0), this.data]) handle.delete();
  }

  /** Readers of the record's signals that one run gives, as far as the model has what they name. */
  readers() {
    const { mujoco, model, data, record } = this;
    /** @type {{name: string, read: () => number}[]} */
    const made = [];
    for (const [name, signal] of Object.entries(record.signals)) {
      if ("measure" in signal) continue;
      const paths = Object.entries(pathSignals(record, [name]));
      const bound = this.attempt(() => new Map(paths.map(([key, path]) => [key, bind(path, mujoco, model, data, this.held)])));
      if (!bound) continue;
      const tree = "expr" in signal ? parse(signal.expr) : null;
      const value = (/** @type {string} */ key) => bound.get(key)?.() ?? NaN;
      made.push({ name, read: tree ? () => evaluate(tree, value) : () => value(name) });
    }
    return made;
  }

  /**
   * @template T
   * @param {() => T} work
   * @returns {T | null} null, with the reason noted, if it failed
   */
  attempt(work) {
    try {
      return work();
    } catch (error) {
      const said = error instanceof Error ? error.message : String(error);
      if (!this.missing.includes(said)) this.missing.push(said);
      return null;
    }
  }
}
