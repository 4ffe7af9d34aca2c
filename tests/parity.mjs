// Runs every variant of the cases in the playground files named as arguments; prints what was measured as JSON.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { examine, finish } from "../docs/playground/measure.js";
import { applyEdits } from "../docs/playground/variant.js";

const mujoco = await loadMujoco();
/** @type {Record<string, Record<string, object>>} */
const found = {};
for (const file of process.argv.slice(2)) {
  const record = JSON.parse(readFileSync(file, "utf8"));
  const remedies = [{ id: "broken", edits: [] }, ...record.fixes, ...record.refuted];
  found[record.case] = {};
  for (const { id, edits } of remedies) {
    const model = mujoco.MjModel.from_xml_string(applyEdits(record.text, edits));
    const { broken, fixed, warnings, well } = finish(examine(mujoco, model, record));
    model.delete();
    const plain = (/** @type {import("../docs/playground/checks.js").Verdict[]} */ verdicts) =>
      verdicts.map(({ measured, holds }) => ({ measured: Number.isFinite(measured) ? measured : null, holds }));
    found[record.case][id] = { broken: plain(broken), fixed: plain(fixed), warnings, well };
  }
}
console.log(JSON.stringify({ engine: mujoco.mj_versionString(), cases: found }));
