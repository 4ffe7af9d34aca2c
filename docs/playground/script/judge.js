// Whether a script repairs a case: run as the record says and in every trial, and judged by what it prints.

import { judge } from "../engine/checks.js";
import { applyEdits } from "../engine/variant.js";
import { missed } from "../judge/judgement.js";
import { measureOutput } from "./printed.js";

/** @import {Judgement, Situation} from "../judge/judgement.js" */
/** @import {ScriptRecord, ScriptTrial} from "./types.js" */

/** @typedef {(text: string, files: Record<string, string>) => Promise<string>} Run gives what a script prints */

/**
 * Judges a script.
 * @param {ScriptRecord} record
 * @param {string} text
 * @param {Run} run
 * @param {(where: string) => void} tell
 * @returns {Promise<Judgement>}
 * @throws {Error} if it cannot be run as the record says
 */
export async function judgeScript(record, text, run, tell) {
  tell("the case's own run");
  const situations = [situation(record, null, await run(text, record.files))];
  for (const [k, trial] of record.trials.entries()) {
    tell(`the trial '${trial.title}' (${k + 1} of ${record.trials.length})`);
    situations.push(await inTrial(record, trial, text, run));
  }
  return { changes: [], situations, repaired: situations.every(({ failed }) => failed.length === 0) };
}

/**
 * @param {ScriptRecord} record
 * @param {ScriptTrial} trial
 * @param {string} text
 * @param {Run} run
 * @returns {Promise<Situation>}
 */
async function inTrial(record, trial, text, run) {
  const { title, file, edits } = trial;
  const missing = file === null ? edits.find(({ find }) => text.split(find).length !== 2) : undefined;
  const stopped = (/** @type {string} */ said) => ({ title, fixed: [], warnings: [], failed: [said] });
  if (missing) return stopped(`The trial '${title}' changes '${missing.find}': leave that in the script, once.`);
  const files = file === null ? record.files : { ...record.files, [file]: applyEdits(record.files[file], edits) };
  try {
    return situation(record, trial, await run(file === null ? applyEdits(text, edits) : text, files));
  } catch (error) {
    return stopped(`In the trial '${title}' it cannot be run: ${/** @type {Error} */ (error).message}.`);
  }
}

/**
 * @param {ScriptRecord} record
 * @param {ScriptTrial | null} trial
 * @param {string} output
 * @returns {Situation}
 */
function situation(record, trial, output) {
  const traces = measureOutput(record.signals, output);
  const fixed = (trial?.checks.fixed ?? record.checks.fixed).map((check) => judge(check, traces));
  const where = trial ? `In the trial '${trial.title}': ` : "";
  const failed = fixed.filter(({ holds }) => !holds).map((verdict) => where + missed(record, verdict));
  return { title: trial?.title ?? "", fixed, warnings: [], failed };
}
