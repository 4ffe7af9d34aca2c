// Whether a text repairs a case: judged by the checks in the record's run and in every trial, if the task is the same.

import { expected, general, judge } from "../engine/checks.js";
import { measure } from "../engine/measure.js";
import { SignalError } from "../engine/signals.js";
import { RunError, STEPS_A_TURN } from "../engine/simulate.js";
import { changes } from "./task.js";
import { inTrial, prepare } from "./trials.js";

/** @import {MainModule, MjModel} from "@mujoco/mujoco" */
/** @import {Verdict} from "../engine/checks.js" */
/** @import {CaseRecord, Trial} from "../record/types.js" */

/**
 * What was seen in the record's run or in a trial.
 * @typedef {object} Situation
 * @property {string} title of the trial; empty for the record's run
 * @property {Verdict[]} fixed
 * @property {string[]} warnings that MuJoCo raised
 * @property {string[]} failed what does not hold, a sentence each
 *
 * How far a judgement is.
 * @typedef {{where: string, share: number}} Progress what is being done, in words, and how much of all is done, 0 to 1
 *
 * What `Check my fix` finds.
 * @typedef {object} Judgement
 * @property {string[]} changes what was changed of the task, a sentence each
 * @property {Situation[]} situations the record's run, then every trial
 * @property {boolean} repaired nothing was changed of the task, and nothing failed
 */

/**
 * Judges a text. It yields now and then, so that the caller can do other work, or stop; first when the text has compiled.
 * @param {MainModule} mujoco
 * @param {string} text
 * @param {CaseRecord} record
 * @returns {Generator<Progress, Judgement>}
 * @throws {Error} before the first yield with MuJoCo's message, if the text does not compile
 * @throws {RunError | SignalError} if it cannot be run, though the task is the same
 */
export function* judgeText(mujoco, text, record) {
  const model = mujoco.MjModel.from_xml_string(text);
  /** @type {string[]} */
  let changed = [];
  /** @type {Situation[]} */
  const situations = [];
  const all = 1 + record.trials.length;
  const progress = (/** @type {number} */ share) => ({ where: "the case's own run", share: share / all });
  try {
    yield progress(0);
    const broken = mujoco.MjModel.from_xml_string(record.text);
    try {
      changed = changes(mujoco, broken, model, record.task.may);
    } finally {
      broken.delete();
    }
    try {
      situations.push(yield* told(situation(mujoco, model, record, null), turns(model, record, null), progress));
    } catch (error) {
      if (changed.length === 0 || !cannotRun(error)) throw error;
    }
  } finally {
    model.delete();
  }
  for (const [k, trial] of record.trials.entries()) {
    const where = `the trial '${trial.title}' (${k + 1} of ${record.trials.length})`;
    const inTrials = (/** @type {number} */ share) => ({ where, share: (1 + k + share) / all });
    yield inTrials(0);
    const other = mujoco.MjModel.from_xml_string(text);
    try {
      situations.push(yield* told(situation(mujoco, other, record, trial), turns(other, record, trial), inTrials));
    } catch (error) {
      if (!cannotRun(error)) throw error;
      const failed = [`In the trial '${trial.title}' it cannot be run: ${error.message}.`];
      situations.push({ title: trial.title, fixed: [], warnings: [], failed });
    } finally {
      other.delete();
    }
  }
  const repaired = changed.length === 0 && situations.every(({ failed }) => failed.length === 0);
  return { changes: changed, situations, repaired };
}

/**
 * Work that tells how far it is.
 * @template T
 * @param {Generator<undefined, T>} work
 * @param {number} length how often it will yield, about
 * @param {(share: number) => Progress} progress
 * @returns {Generator<Progress, T>}
 */
function* told(work, length, progress) {
  try {
    for (let done = 1; ; done++) {
      const turn = work.next();
      if (turn.done) return turn.value;
      yield progress(Math.min(done / length, 1));
    }
  } finally {
    work.return(/** @type {any} */ (undefined)); // frees what it holds, if it was stopped
  }
}

/**
 * How often the measurements of a situation yield, about.
 * @param {MjModel} model
 * @param {CaseRecord} record
 * @param {Trial | null} trial
 */
function turns({ opt }, record, trial) {
  const here = trial ? inTrial(record, trial) : record;
  const wanted = new Set([...here.checks.broken, ...here.checks.fixed].map(({ signal }) => signal));
  const again = [...wanted].map((name) => record.signals[name]).reduce((sum, signal) => sum + ("count" in signal ? signal.count : 0), 0);
  return Math.max(1, ((1 + again) * here.run.duration) / (STEPS_A_TURN * opt.timestep));
}

/** @param {unknown} error @returns {error is RunError | SignalError} */
function cannotRun(error) {
  return error instanceof RunError || error instanceof SignalError;
}

/**
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {CaseRecord} record
 * @param {Trial | null} trial
 * @returns {Generator<undefined, Situation>}
 */
function* situation(mujoco, model, record, trial) {
  const here = trial ? inTrial(record, trial) : record;
  const { broken, fixed } = here.checks;
  const wanted = new Set([...broken, ...fixed].map((check) => check.signal));
  const nudge = trial ? prepare(mujoco, model, trial) : undefined;
  const { run, traces } = yield* measure(mujoco, model, here, wanted, nudge);
  const verdicts = fixed.map((check) => judge(check, traces));
  const warnings = Object.keys(run.warnings);
  const where = trial ? `In the trial '${trial.title}': ` : "";
  const told = warnings.map((name) => `MuJoCo warns of ${name}.`);
  for (const verdict of verdicts) if (!verdict.holds) told.push(missed(record, verdict));
  return { title: trial?.title ?? "", fixed: verdicts, warnings, failed: told.map((said) => where + said) };
}

/**
 * A check that does not hold, in a sentence.
 * @param {Pick<CaseRecord, "signals">} record
 * @param {Verdict} verdict
 */
export function missed(record, { check, measured }) {
  const { label, unit: its } = record.signals[check.signal];
  const unit = check.take === "onset" ? "s" : its;
  const span = check.window ? `, ${general(check.window[0])} to ${general(check.window[1])} s` : "";
  const seen = Number.isNaN(measured) ? "cannot be measured" : `is ${general(measured, 4)} ${unit}`.trimEnd();
  const bound = expected(check, (value) => `${general(value)} ${unit}`.trimEnd());
  return `${label} (${check.take}${span}) ${seen}; expected ${bound}.`;
}
