// Opens the edit of the first cause of the diagnosis in the JSON file named first, as the page's playground does; prints the
// record's file, the position at the start and the bodies' masses without and with the edit as JSON.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { readersRecord } from "../../docs/playground/diagnosis/try.js";
import { compile, encoded } from "../../docs/playground/engine/compile.js";
import { start } from "../../docs/playground/engine/simulate.js";
import { applyEdits } from "../../docs/playground/engine/variant.js";

const { name, made } = JSON.parse(readFileSync(process.argv[2], "utf8"));
const mujoco = await loadMujoco({ print: () => {}, printErr: () => {} });
const files = /** @type {[string, Uint8Array<ArrayBuffer>][]} */ (encoded(Object.entries(made.texts)));
const record = readersRecord({ text: made.texts[name], name, files, single: false, symptom: "" }, made, 0);
const [before, after] = [record.text, applyEdits(record.text, record.fixes[0].edits)].map((text) => {
  const model = compile(mujoco, record.main ?? text, [...files, ...encoded([[record.name, text]])]);
  return { qpos: [...start(mujoco, model, record.run).qpos], mass: [...model.body_mass] };
});
console.log(JSON.stringify({ name: record.name, text: record.text, before, after }));
