// Runs every variant of the cases in the playground files named as arguments, and judges the texts that they hold
// besides; prints what was measured and said as JSON.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { judge, take } from "../../docs/playground/engine/checks.js";
import { measure } from "../../docs/playground/engine/measure.js";
import { newer } from "../../docs/playground/engine/mjcf.js";
import { finish } from "../../docs/playground/engine/simulate.js";
import { applyEdits } from "../../docs/playground/engine/variant.js";
import { judgeText } from "../../docs/playground/judge/judgement.js";

/** @import {Check, CaseRecord} from "../../docs/playground/record/types.js" */

const TAKES = /** @type {const} */ (["final", "first", "min", "max", "mean", "span", "onset"]);
const mujoco = await loadMujoco();
const plain = (/** @type {number} */ value) => (Number.isFinite(value) ? value : null);

/**
 * @param {CaseRecord} record
 * @param {string} text
 */
function judged(record, text) {
  try {
    const { changes, situations, repaired } = finish(judgeText(mujoco, text, record));
    return { changes, failed: situations.flatMap(({ failed }) => failed), repaired };
  } catch (error) {
    if (!(error instanceof Error) || error instanceof WebAssembly.RuntimeError) throw error;
    return { error: error.message, newer: newer(error.message, mujoco.mj_versionString()), repaired: false };
  }
}

/**
 * @param {CaseRecord} record
 * @param {string} text
 */
function measured(record, text) {
  const model = mujoco.MjModel.from_xml_string(text);
  const { traces, run } = finish(measure(mujoco, model, record, new Set(Object.keys(record.signals))));
  model.delete();
  const read = Object.keys(record.signals).filter((name) => !("measure" in record.signals[name]));
  const values = read.map((name) => [name, TAKES.map((which) => plain(take(traces[name], which)))]);
  const verdicts = (/** @type {Check[]} */ checks) =>
    checks.map((check) => judge(check, traces)).map(({ measured, holds }) => ({ measured: plain(measured), holds }));
  const { broken, fixed } = record.checks;
  return { broken: verdicts(broken), fixed: verdicts(fixed), values: Object.fromEntries(values), warnings: run.warnings };
}

/** @type {Record<string, Record<string, object>>} */
const found = {};
for (const file of process.argv.slice(2)) {
  const record = JSON.parse(readFileSync(file, "utf8"));
  found[record.case] = {};
  for (const { id, edits } of [{ id: "broken", edits: [] }, ...record.fixes, ...record.refuted]) {
    const text = applyEdits(record.text, edits);
    const judgement = judged(record, text);
    found[record.case][id] = judgement.newer ? judgement : { ...judgement, ...measured(record, text) };
  }
  for (const [name, text] of Object.entries(record.repairs ?? {})) found[record.case][name] = judged(record, text);
}
console.log(JSON.stringify({ engine: mujoco.mj_versionString(), cases: found }));
