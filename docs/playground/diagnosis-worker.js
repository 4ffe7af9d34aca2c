// The diagnosis in a worker: Python's own rules, in Pyodide, on MuJoCo's WebAssembly build. It answers one request.

import loadMujoco from "@mujoco/mujoco";
import { DiagnosisEngine } from "./diagnosis/engine.js";
import { fetchBytes } from "./page/fetch.js";

/**
 * @typedef {object} Request
 * @property {string} base where the files of the diagnosis are
 * @property {string} wasm the address of MuJoCo's module
 * @property {string} text the model
 * @property {string} name what to call it
 * @property {[string, Uint8Array<ArrayBuffer>][]} files what it names, by path from the model's folder
 * @property {string} symptom
 * @property {string[]} ignore rules not to try
 */

const PYTHON = `
import json, os
from pyodide.ffi import to_js
from clinic.diagnosis.browser import BrowserEngine
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.source import read_texts

def diagnose(js, text, name, read, symptom, ignore, tell):
    texts = read_texts(text, name, read)
    found = examine(BrowserEngine(js, to_js), texts, symptom=symptom, ignore=list(ignore), tell=tell)
    return json.dumps({"data": found.data(), "text": found.text(), "fixed": dict(found.fixed), "diff": found.diff(), "error": found.error})
`;

self.onmessage = async ({ data }) => {
  const request = /** @type {Request} */ (data);
  try {
    postMessage({ type: "made", ...JSON.parse(await diagnosed(request)) });
  } catch (error) {
    postMessage({ type: "died", message: error instanceof Error ? error.message : String(error) });
  }
};

/** @param {Request} request */
async function diagnosed({ base, wasm, text, name, files, symptom, ignore }) {
  postMessage({ type: "doing", what: "loading MuJoCo and Python" });
  const address = (/** @type {string} */ file) => new URL(file, base).href;
  const { loadPyodide } = await import(/* @vite-ignore */ address("pyodide.mjs"));
  const [python, mujoco, rules] = await Promise.all([
    loadPyodide({ indexURL: base }),
    fetchBytes(wasm).then((wasmBinary) => loadMujoco({ wasmBinary, print: () => {}, printErr: () => {} })),
    fetchBytes(address("clinic.zip")),
  ]);
  python.unpackArchive(rules, "zip", { extractDir: "/lib/clinic-rules" });
  python.runPython("import sys; sys.path.insert(0, '/lib/clinic-rules')");
  python.FS.mkdirTree("/model/folder");
  python.FS.chdir("/model/folder");
  const decoder = new TextDecoder();
  const texts = new Map(files.filter(([path]) => /\.(xml|mjcf|urdf)$/i.test(path)).map(([path, bytes]) => [path, decoder.decode(bytes)]));
  for (const [path] of files) touch(python.FS, path); // for the rule that looks for a missing file by its name
  python.runPython(PYTHON);
  const engine = new DiagnosisEngine(mujoco, new Map(files));
  const run = python.globals.get("diagnose");
  const tell = (/** @type {string} */ what) => postMessage({ type: "trying", rule: what });
  return run(engine, text, name, (/** @type {string} */ path) => texts.get(path.replace(/^\.\//, "")), symptom, ignore, tell);
}

/**
 * An empty file of this name.
 * @param {any} FS
 * @param {string} path
 */
function touch(FS, path) {
  const whole = new URL(path, "file:///model/folder/").pathname;
  const decoded = decodeURIComponent(whole);
  FS.mkdirTree(decoded.slice(0, decoded.lastIndexOf("/")) || "/");
  FS.writeFile(decoded, "");
}
