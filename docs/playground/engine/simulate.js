// A run: a model stepped for a fixed number of steps, its signals read after every step.

import { bind, requireId, warningStat } from "./signals.js";

/** @import {MainModule, MjData, MjModel} from "@mujoco/mujoco" */
/** @import {PathSignal, RunSpec} from "../record/types.js" */
/** @import {Trace} from "./checks.js" */

export const MAX_STEPS = 2_000_000;
export const STEPS_A_TURN = 100;
const STEPS_A_LOOK = 10; // at MuJoCo's warnings: a counter stays until another warning resets the state

/** A run that cannot start. */
export class RunError extends Error {}

/**
 * @typedef {object} Run
 * @property {number} timestep in s
 * @property {number} steps
 * @property {Record<string, Trace>} traces every path signal, sampled after each step
 * @property {Record<string, number>} warnings the largest count that each MuJoCo warning reached
 *
 * @typedef {{id: number, at: (moment: number) => number}[]} Drive the control of each driven actuator by time in s
 *
 * @typedef {(data: MjData) => void} Nudge
 */

/**
 * Steps the model for `spec.duration` and reads every path after each step.
 *
 * The loop is bounded by steps, never by `data.time`, which an automatic reset turns back. It yields now and then, so
 * that the caller can do other work, or stop.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {RunSpec} spec
 * @param {Record<string, PathSignal>} paths
 * @param {Nudge} [nudge] applied to the start
 * @returns {Generator<undefined, Run>}
 * @throws {RunError | SignalError} if the run cannot start or a path cannot be bound
 */
export function* simulate(mujoco, model, spec, paths, nudge) {
  const timestep = model.opt.timestep;
  const steps = stepCount(model, spec);
  const data = start(mujoco, model, spec);
  /** @type {{delete: () => void}[]} */
  const held = [data];
  try {
    nudge?.(data);
    const names = Object.keys(paths);
    const readers = names.map((name) => bind(paths[name], mujoco, model, data, held));
    const drive = controls(mujoco, model, spec);
    const time = Float64Array.from({ length: steps }, (_, i) => (i + 1) * timestep);
    const values = readers.map(() => new Float64Array(steps));
    /** @type {Record<string, number>} */
    const warnings = {};
    for (let i = 0; i < steps; i++) {
      step(mujoco, model, data, drive, i);
      for (let k = 0; k < readers.length; k++) values[k][i] = readers[k]();
      if (i % STEPS_A_LOOK === 0 || i === steps - 1) {
        for (const { name, number } of raised(mujoco, data)) warnings[name] = Math.max(warnings[name] ?? 0, number);
      }
      if ((i + 1) % STEPS_A_TURN === 0) yield;
    }
    const traces = Object.fromEntries(names.map((name, k) => [name, { time, value: values[k] }]));
    return { timestep, steps, traces, warnings };
  } finally {
    for (const handle of held.reverse()) handle.delete();
  }
}

/**
 * The data at the run's start: keyframe, then named positions and velocities. The caller frees it.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {RunSpec} spec
 * @returns {MjData}
 */
export function start(mujoco, model, spec) {
  const named = spec.keyframe ?? -1;
  const keyframe = typeof named === "number" ? named : requireId(mujoco, model, "key", named);
  const joint = (/** @type {string} */ name) => requireId(mujoco, model, "joint", name);
  [...Object.keys(spec.qpos), ...Object.keys(spec.qvel)].forEach(joint);
  const data = new mujoco.MjData(model);
  if (keyframe >= 0) mujoco.mj_resetDataKeyframe(model, data, keyframe);
  for (const [name, value] of Object.entries(spec.qpos)) data.qpos[model.jnt_qposadr[joint(name)]] = value;
  for (const [name, value] of Object.entries(spec.qvel)) data.qvel[model.jnt_dofadr[joint(name)]] = value;
  return data;
}

/**
 * Makes step `i`, counted from 0, with the controls of time i * timestep.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {MjData} data
 * @param {Drive} drive
 * @param {number} i
 */
export function step(mujoco, model, data, drive, i) {
  if (drive.length > 0) {
    const moment = i * model.opt.timestep;
    for (const { id, at } of drive) data.ctrl[id] = at(moment);
  }
  mujoco.mj_step(model, data);
}

/**
 * How many steps the run takes; Python's rounding, halves to even.
 * @param {MjModel} model
 * @param {RunSpec} spec
 * @throws {RunError} if that is none, or more than MAX_STEPS
 */
export function stepCount(model, spec) {
  const timestep = model.opt.timestep;
  const exact = timestep > 0 ? spec.duration / timestep : 0;
  const steps = exact % 1 === 0.5 ? 2 * Math.round(exact / 2) : Math.round(exact);
  if (!(steps >= 1 && steps <= MAX_STEPS)) {
    const asked = timestep > 0 ? `${spec.duration} s at a timestep of ${timestep} s` : `a timestep of ${timestep} s`;
    throw new RunError(`${asked}: a run must take 1 to ${MAX_STEPS.toLocaleString("en")} steps`);
  }
  return steps;
}

/**
 * The controls of every driven actuator.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {RunSpec} spec
 * @returns {Drive}
 */
export function controls(mujoco, model, spec) {
  return Object.entries(spec.ctrl).map(([name, value]) => {
    const points = typeof value === "number" ? [[0, value]] : value;
    return { id: requireId(mujoco, model, "actuator", name), at: (moment) => interpolate(points, moment) };
  });
}

/**
 * MuJoCo's warnings whose counters are not zero.
 * @param {MainModule} mujoco
 * @param {MjData} data
 * @returns {{name: string, number: number, info: number, id: number}[]}
 */
export function raised(mujoco, data) {
  return warningNames(mujoco)
    .map(({ name, id }) => {
      const { number, lastinfo } = warningStat(data, id);
      return { name, id, number, info: lastinfo };
    })
    .filter(({ number }) => number > 0);
}

/** @type {{name: string, id: number}[]} */
let known = [];

/** @param {MainModule} mujoco */
function warningNames(mujoco) {
  if (known.length === 0) {
    known = Object.entries(mujoco.mjtWarning)
      .filter(([key]) => key.startsWith("mjWARN_"))
      .map(([key, kind]) => ({ name: key.slice("mjWARN_".length), id: kind.value }));
  }
  return known;
}

/**
 * Linear between the points, constant outside.
 * @param {number[][]} points [time, value], times increasing
 * @param {number} moment
 */
function interpolate(points, moment) {
  const next = points.findIndex(([time]) => time > moment);
  if (next === 0) return points[0][1];
  if (next < 0) return points[points.length - 1][1];
  const [[t0, v0], [t1, v1]] = [points[next - 1], points[next]];
  return ((v1 - v0) / (t1 - t0)) * (moment - t0) + v0;
}

/**
 * Runs a generator to its end at once.
 * @template T
 * @param {Generator<unknown, T>} work
 * @returns {T}
 */
export function finish(work) {
  for (;;) {
    const turn = work.next();
    if (turn.done) return turn.value;
  }
}
