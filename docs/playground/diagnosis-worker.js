// The diagnosis in a worker: Python's own rules, in Pyodide, on MuJoCo's WebAssembly build. It answers one request.

import loadMujoco from "@mujoco/mujoco";
import { loadPyodide } from "pyodide";
import { info } from "pyodide/pyodide-lock.json";
import { DiagnosisEngine } from "./diagnosis/engine.js";
import { fetchBytes } from "./page/fetch.js";

/** @import {Parts, Request} from "./diagnosis/client.js" */

const FOLDER = "/model/of/a/reader/in/some/folders"; // so deep that `../..` stays inside
const PYTHON = "memory:/python/"; // where Pyodide believes its files to be
const QUIET = { locateFile: (/** @type {string} */ name) => name, print: () => {}, printErr: () => {} };
const SCRIPT = `
from pyodide.ffi import to_js
from clinic.diagnosis.browser import BrowserEngine, diagnose
lambda js, text, name, read, tell, symptom, died: diagnose(BrowserEngine(js, to_js), text, name, read, tell, symptom, list(died))
`;

self.onmessage = async ({ data }) => {
  try {
    postMessage({ type: "made", made: JSON.parse(await diagnosed(data.parts, data.request, data.died)) });
  } catch (error) {
    postMessage({ type: "died", message: (error instanceof Error ? error.message : String(error)).trim().split("\n").at(-1) });
  }
};

/**
 * @param {Parts} parts
 * @param {Request} request
 * @param {string[]} died rules of which the engine died before
 * @returns {Promise<string>}
 */
async function diagnosed(parts, { text, name, files, symptom }, died) {
  const [python, mujoco] = await Promise.all([
    startPython(parts),
    fetchBytes(parts.mujoco).then((wasmBinary) => loadMujoco({ ...QUIET, wasmBinary })),
  ]);
  python.FS.mkdirTree(FOLDER);
  python.FS.chdir(FOLDER);
  const decoder = new TextDecoder();
  const texts = new Map(files.filter(([path]) => /\.(xml|mjcf|urdf)$/i.test(path)).map(([path, bytes]) => [path, decoder.decode(bytes)]));
  for (const [path] of files) touch(python.FS, path); // for the rule that looks for a missing file by its name
  const read = (/** @type {string} */ path) => texts.get(path.replace(/^\.\//, ""));
  const tell = (/** @type {string} */ rule, /** @type {string} */ title, /** @type {number} */ share) =>
    postMessage({ type: "trying", rule, title, share });
  const run = python.runPython(SCRIPT);
  tell("", "Compiling the model", 0);
  return run(new DiagnosisEngine(mujoco, files), text, name, read, tell, symptom, died);
}

/** @param {Parts} parts */
async function startPython(parts) {
  const plain = self.fetch;
  self.fetch = async (what, how) => {
    if (String(what) !== `${PYTHON}pyodide.asm.wasm`) return plain(what, how);
    return new Response(await fetchBytes(parts.python), { headers: { "Content-Type": "application/wasm" } });
  };
  const script = URL.createObjectURL(new Blob([await fetchBytes(parts.script)], { type: "text/javascript" }));
  const { default: createPyodideModule } = await import(/* @vite-ignore */ script);
  const lockFileContents = JSON.stringify({ info, packages: {} });
  const python = await loadPyodide(
    /** @type {any} */ ({ indexURL: PYTHON, stdLibURL: parts.library, lockFileContents, createPyodideModule }),
  );
  python.unpackArchive(await fetchBytes(parts.rules), "zip", { extractDir: "/lib/clinic-rules" });
  python.runPython("import sys; sys.path.insert(0, '/lib/clinic-rules')");
  return python;
}

/**
 * An empty file of this name.
 * @param {any} FS
 * @param {string} path
 */
function touch(FS, path) {
  const written = path.split("/").map(encodeURIComponent).join("/");
  const whole = decodeURIComponent(new URL(written, `file://${FOLDER}/`).pathname);
  FS.mkdirTree(whole.slice(0, whole.lastIndexOf("/")));
  FS.writeFile(whole, "");
}
