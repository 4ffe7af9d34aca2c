// Whether a model is well: its run, judged by the record's checks.

import { judge } from "../engine/checks.js";
import { measure } from "../engine/measure.js";

/** @import {MainModule, MjModel} from "@mujoco/mujoco" */
/** @import {Verdict} from "../engine/checks.js" */
/** @import {CaseRecord} from "../record/types.js" */

/**
 * What `Check my fix` finds.
 * @typedef {object} Judgement
 * @property {Verdict[]} broken
 * @property {Verdict[]} fixed
 * @property {Record<string, number>} warnings what MuJoCo raised during the run
 * @property {boolean} well every `fixed` check holds, some `broken` check does not, and MuJoCo raised no warning
 * @property {number} steps of the run
 */

/**
 * Runs a model and judges it by the record's checks; yields now and then, so that the caller can do other work, or stop.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {CaseRecord} record
 * @returns {Generator<undefined, Judgement>}
 */
export function* judgeModel(mujoco, model, record) {
  const { broken, fixed } = record.checks;
  const wanted = new Set([...broken, ...fixed].map((check) => check.signal));
  const { run, traces } = yield* measure(mujoco, model, record, wanted);
  const verdicts = { broken: broken.map((check) => judge(check, traces)), fixed: fixed.map((check) => judge(check, traces)) };
  const repaired = verdicts.fixed.every(({ holds }) => holds) && !verdicts.broken.every(({ holds }) => holds);
  const { warnings, steps } = run;
  return { ...verdicts, warnings, steps, well: repaired && Object.keys(warnings).length === 0 };
}
