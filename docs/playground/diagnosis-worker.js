// The diagnosis in a worker: Python's own rules, in Pyodide, on MuJoCo's WebAssembly build. It answers one request.

import loadMujoco from "@mujoco/mujoco";
import { loadPyodide } from "pyodide";
import { info } from "pyodide/pyodide-lock.json";
import { diagnoseIn } from "./diagnosis/python.js";
import { fetchBytes } from "./page/fetch.js";

/** @import {Parts} from "./diagnosis/client.js" */

const PYTHON = "memory:/python/"; // where Pyodide believes its files to be
const QUIET = { locateFile: (/** @type {string} */ name) => name, print: () => {}, printErr: () => {} };

self.onmessage = async ({ data: { parts, request, died } }) => {
  const tell = (/** @type {string} */ rule, /** @type {string} */ title, /** @type {number} */ share) =>
    postMessage({ type: "trying", rule, title, share });
  try {
    const [python, mujoco, rules] = await Promise.all([
      startPython(parts),
      fetchBytes(parts.mujoco).then((wasmBinary) => loadMujoco({ ...QUIET, wasmBinary })),
      fetchBytes(parts.rules),
    ]);
    postMessage({ type: "made", made: JSON.parse(diagnoseIn(python, mujoco, rules, request, died, tell)) });
  } catch (error) {
    const said = (error instanceof Error ? error.message : String(error)).trim().split("\n").at(-1) ?? "";
    const engines = said.replace(/^pyodide\.ffi\.JsException: /, "");
    const ours = error instanceof Error && error.name === "PythonError" && engines === said && !/^(Memory|Recursion)Error/.test(said); // the clinic's own mistake
    postMessage({ type: "died", message: engines, ours });
  }
};

/** @param {Parts} parts */
async function startPython(parts) {
  const plain = self.fetch;
  self.fetch = async (what, how) => {
    if (String(what) !== `${PYTHON}pyodide.asm.wasm`) return plain(what, how);
    return new Response(await fetchBytes(parts.python), { headers: { "Content-Type": "application/wasm" } });
  };
  const script = URL.createObjectURL(new Blob([await fetchBytes(parts.script)], { type: "text/javascript" }));
  const { default: createPyodideModule } = await import(/* @vite-ignore */ script);
  const settings = { indexURL: PYTHON, stdLibURL: parts.library, lockFileContents: JSON.stringify({ info, packages: {} }), createPyodideModule };
  return loadPyodide(/** @type {any} */ (settings));
}
