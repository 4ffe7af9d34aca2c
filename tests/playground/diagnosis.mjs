// Diagnoses the models in the JSON file named first, texts by name, with the site's files in the folder named second;
// prints what the page would show, by name, as JSON.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { loadPyodide } from "pyodide";
import { diagnoseIn } from "../../docs/playground/diagnosis/python.js";

const [models, folder] = process.argv.slice(2);
const mujoco = await loadMujoco({ print: () => {}, printErr: () => {} });
const python = await loadPyodide({ stdLibURL: `${folder}/python_stdlib.zip` });
const zip = readFileSync(`${folder}/clinic.zip`);
const rules = zip.buffer.slice(zip.byteOffset, zip.byteOffset + zip.length);
/** @type {Record<string, object>} */
const found = {};
for (const [name, text] of Object.entries(JSON.parse(readFileSync(models, "utf8")))) {
  found[name] = JSON.parse(diagnoseIn(python, mujoco, rules, { text, name: "model.xml", files: [], single: true, symptom: "" }, [], () => {})).data;
}
console.log(JSON.stringify(found));
