// The rules of scripts/clinic/diagnosis in Pyodide, and what they are asked.

import { DiagnosisEngine } from "./engine.js";

/** @import {MainModule} from "@mujoco/mujoco" */
/** @import {PyodideAPI} from "pyodide" */
/** @import {Request} from "./client.js" */

const FOLDER = "/model/of/a/reader/in/some/folders"; // so deep that `../..` stays inside
const SCRIPT = `
from pyodide.ffi import to_js
from clinic.diagnosis.browser import BrowserEngine, diagnose
lambda js, text, name, read, tell, symptom, died: diagnose(BrowserEngine(js, to_js), text, name, read, tell, symptom, dict(died.to_py()))
`;

/**
 * Diagnoses a model.
 * @param {PyodideAPI} python
 * @param {MainModule} mujoco
 * @param {ArrayBuffer} rules zipped
 * @param {Request} request
 * @param {[string, string][]} died rules that failed before, each with the clinic's own mistake, or nothing where the engine ended
 * @param {(rule: string, title: string, share: number) => void} tell
 * @returns {string} a `Diagnosis` as JSON
 */
export function diagnoseIn(python, mujoco, rules, { text, name, files, symptom }, died, tell) {
  python.unpackArchive(rules, "zip", { extractDir: "/lib/clinic-rules" });
  python.runPython("import sys; sys.path.insert(0, '/lib/clinic-rules')");
  python.FS.mkdirTree(FOLDER);
  python.FS.chdir(FOLDER);
  for (const [path, bytes] of files) place(python.FS, path, bytes); // for the rules that look for files, and at their first bytes
  const decoder = new TextDecoder();
  const texts = new Map(files.filter(([path]) => /\.(xml|mjcf|urdf)$/i.test(path)).map(([path, bytes]) => [path, decoder.decode(bytes)]));
  const read = (/** @type {string} */ path) => texts.get(path.replace(/^\.\//, ""));
  const run = python.runPython(SCRIPT);
  tell("", "Compiling the model", 0);
  const engine = new DiagnosisEngine(mujoco, files);
  try {
    return run(engine, text, name, read, tell, symptom, died);
  } finally {
    engine.end();
  }
}

/**
 * A file of this name; its bytes are not copied.
 * @param {any} FS
 * @param {string} path
 * @param {Uint8Array} bytes
 */
function place(FS, path, bytes) {
  const written = path.split("/").map(encodeURIComponent).join("/");
  const whole = decodeURIComponent(new URL(written, `file://${FOLDER}/`).pathname);
  FS.mkdirTree(whole.slice(0, whole.lastIndexOf("/")));
  FS.writeFile(whole, bytes, { canOwn: true });
}
