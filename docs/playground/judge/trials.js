// Trials: a text judged in every situation of its record, for a repair that holds in one alone is luck.

import { write } from "../engine/signals.js";

/** @import {MainModule, MjModel} from "@mujoco/mujoco" */
/** @import {CaseRecord, Trial} from "../record/types.js" */
/** @import {Nudge} from "../engine/simulate.js" */

/**
 * The record as it is in a trial: driven, for so long and judged as the trial says.
 * @param {CaseRecord} record
 * @param {Trial} trial
 * @returns {CaseRecord}
 */
export function inTrial(record, { ctrl, duration, checks }) {
  const run = { ...record.run, ctrl: { ...record.run.ctrl, ...ctrl }, duration: duration ?? record.run.duration };
  return { ...record, run, checks: { ...record.checks, ...checks } };
}

/**
 * Changes the model as a trial does, and gives what changes the start.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {Trial} trial
 * @returns {Nudge}
 * @throws {SignalError} if the model lacks what the trial changes
 */
export function prepare(mujoco, model, { set, start }) {
  if (set.length > 0) {
    const data = new mujoco.MjData(model);
    try {
      for (const number of set) write(number, number.value, mujoco, model, data);
      mujoco.mj_setConst(model, data);
    } finally {
      data.delete();
    }
  }
  return (data) => {
    for (const number of start) write(number, number.value, mujoco, model, data);
  };
}
