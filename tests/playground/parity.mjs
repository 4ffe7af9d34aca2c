// Runs every variant of the cases in the playground files named as arguments; prints what was measured as JSON.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { take } from "../../docs/playground/engine/checks.js";
import { measure } from "../../docs/playground/engine/measure.js";
import { finish } from "../../docs/playground/engine/simulate.js";
import { applyEdits } from "../../docs/playground/engine/variant.js";
import { judgeModel } from "../../docs/playground/judge/judgement.js";

const TAKES = /** @type {const} */ (["final", "first", "min", "max", "mean", "span", "onset"]);
const mujoco = await loadMujoco();
const plain = (/** @type {number} */ value) => (Number.isFinite(value) ? value : null);
/** @type {Record<string, Record<string, object>>} */
const found = {};
for (const file of process.argv.slice(2)) {
  const record = JSON.parse(readFileSync(file, "utf8"));
  const remedies = [{ id: "broken", edits: [] }, ...record.fixes, ...record.refuted];
  found[record.case] = {};
  for (const { id, edits } of remedies) {
    let model;
    try {
      model = mujoco.MjModel.from_xml_string(applyEdits(record.text, edits));
    } catch {
      continue; // it needs a newer engine
    }
    const { broken, fixed, warnings, well } = finish(judgeModel(mujoco, model, record));
    const read = Object.keys(record.signals).filter((name) => !("measure" in record.signals[name]));
    const { traces } = finish(measure(mujoco, model, record, new Set(read)));
    model.delete();
    const values = read.map((name) => [name, TAKES.map((which) => plain(take(traces[name], which)))]);
    const judged = (/** @type {import("../../docs/playground/engine/checks.js").Verdict[]} */ verdicts) =>
      verdicts.map(({ measured, holds }) => ({ measured: plain(measured), holds }));
    found[record.case][id] = { broken: judged(broken), fixed: judged(fixed), values: Object.fromEntries(values), warnings, well };
  }
}
console.log(JSON.stringify({ engine: mujoco.mj_versionString(), cases: found }));
