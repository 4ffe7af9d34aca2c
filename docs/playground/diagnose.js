// Diagnose your model: fetched when a reader gives one.

import { DiagnosisError, diagnose } from "./diagnosis/client.js";
import { FilesError, models, readFiles, seenFrom } from "./diagnosis/files.js";
import { report } from "./diagnosis/report.js";
import { button, choice, el } from "./page/elements.js";

/** @import {Diagnosis} from "./diagnosis/client.js" */

/**
 * Diagnoses what was given, and shows it.
 * @param {HTMLElement} place emptied and filled
 * @param {URL} base where the playground's files are
 * @param {string} rules the address of the rules' pages
 * @param {FileSystemEntry[] | FileList} given
 */
export async function start(place, base, rules, given) {
  const address = (/** @type {string} */ name) => new URL(name, base).href;
  const source = { worker: address("diagnosis-worker.js"), wasm: address("mujoco.wasm.gz"), base: address("../diagnosis/") };
  const status = el("p", { class: "dg-status", role: "status" }, "reading");
  place.replaceChildren(status);
  try {
    const files = await readFiles(given);
    const found = models(files);
    if (found.length === 0) throw new FilesError("there is no MJCF or URDF file among these: expected one that ends in .xml, .mjcf or .urdf");
    const run = (/** @type {string} */ path) => examine(place, source, rules, files, path, found);
    await run(found[0]);
  } catch (error) {
    place.replaceChildren(el("p", { class: "dg-error", role: "alert" }, said(error)));
  }
}

/**
 * @param {HTMLElement} place
 * @param {{worker: string, base: string, wasm: string}} source
 * @param {string} rules
 * @param {Map<string, Uint8Array<ArrayBuffer>>} files
 * @param {string} path
 * @param {string[]} all
 */
async function examine(place, source, rules, files, path, all) {
  const stop = new AbortController();
  const name = path.slice(path.lastIndexOf("/") + 1);
  const status = el("p", { class: "dg-status", role: "status" }, "starting");
  const again = (/** @type {string} */ other) => {
    stop.abort(new DiagnosisError("stopped"));
    void examine(place, source, rules, files, other, all);
  };
  const others = all.length > 1 ? [choice("Model", all.map((each) => [each, each]), path, again).whole] : [];
  place.replaceChildren(...others, status, button("Stop", () => stop.abort(new DiagnosisError("stopped")), { class: "md-button" }));
  try {
    const request = { text: new TextDecoder().decode(files.get(path)), name, files: seenFrom(files, path), symptom: "" };
    /** @type {Diagnosis} */
    const made = await diagnose(source, request, (what) => (status.textContent = what), stop.signal);
    place.replaceChildren(...others, report(made, rules));
  } catch (error) {
    if (stop.signal.aborted && place.firstChild !== (others[0] ?? status)) return; // another model took the place
    place.replaceChildren(...others, el("p", { class: "dg-error", role: "alert" }, `${name}: ${said(error)}`));
  }
}

/** @param {unknown} error */
function said(error) {
  if (error instanceof FilesError || error instanceof DiagnosisError) return error.message || "it cannot be diagnosed";
  console.error(error);
  return "it cannot be read";
}
