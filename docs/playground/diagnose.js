// Diagnose your model: fetched when a reader gives one.

import { DiagnosisError, diagnose } from "./diagnosis/client.js";
import { FilesError, last, models, readFiles, seenFrom, textOf } from "./diagnosis/files.js";
import { report } from "./diagnosis/report.js";
import { readersRecord } from "./diagnosis/try.js";
import { button, choice, el } from "./page/elements.js";

/** @import {CaseRecord} from "./record/types.js" */

/** What is under way ends when another model is given. */
let under = new AbortController();

/**
 * Diagnoses what was given, and shows it.
 * @param {HTMLElement} place emptied and filled
 * @param {URL} base where the playground's files are
 * @param {string} rules the address of the rules' pages, as the page has it
 * @param {string} symptom the family that the reader sees; empty for none
 * @param {Iterable<FileSystemEntry | File>} given
 */
export async function start(place, base, rules, symptom, given) {
  under.abort(null);
  const mine = (under = new AbortController());
  try {
    const names = [...given].map(({ name }) => name);
    const files = await readFiles(given);
    const single = !names.some((name) => /\.zip$/i.test(name)) && ![...files.keys()].some((path) => path.includes("/"));
    const found = models(files);
    if (mine.signal.aborted) return;
    if (found.length === 0) throw new FilesError("There is no MJCF or URDF file among these: expected one that ends in .xml, .mjcf or .urdf.");
    await examine(place, { base, rules: new URL(rules, location.href).href, symptom, files, single, found }, found[0]);
  } catch (error) {
    if (!mine.signal.aborted) place.replaceChildren(complaint(said(error)));
  }
}

/**
 * @param {HTMLElement} place
 * @param {{base: URL, rules: string, symptom: string, files: Map<string, Uint8Array<ArrayBuffer>>, single: boolean, found: string[]}} all
 * @param {string} path of the model
 */
async function examine(place, all, path) {
  leave();
  leave = () => {};
  under.abort(null);
  const { signal } = (under = new AbortController());
  const [own, name] = [under, last(path)];
  const again = (/** @type {string} */ other) => void examine(place, all, other);
  const others = all.found.length > 1 ? [choice("Model", all.found.map((each) => [each, each]), path, again).whole] : [];
  const status = el("p", { role: "status" });
  const bar = el("progress", { max: "1", "aria-label": "Progress" });
  const stop = button("Stop", () => own.abort(new DiagnosisError("Stopped.")), { class: "md-button" });
  const tell = (/** @type {string} */ what, /** @type {number} */ share) => {
    if (share > 0) bar.value = share;
    else bar.removeAttribute("value");
    status.textContent = share > 0 ? `${what} (${Math.round(100 * share)} %)` : what;
  };
  const show = (/** @type {HTMLElement} */ made) => place.replaceChildren(...others, made);
  const shown = el("div", { class: "dg-progress" }, status, bar, stop);
  tell("Starting", 0);
  show(shown);
  shown.scrollIntoView({ block: "nearest" });
  try {
    const request = { text: textOf(all.files, path), name, files: seenFrom(all.files, path), single: all.single, symptom: all.symptom };
    const made = await diagnose(all.base, request, tell, signal);
    show(report(made, request, all.rules, (place, index) => void tryEdit(place, all.base, readersRecord(request, made, index))));
  } catch (error) {
    if (signal.reason !== null) show(complaint(`${name}: ${said(error)}`)); // null: another model took the place
  }
}

/** Takes away the playground of the edit that was tried last. */
let leave = () => {};

/**
 * Opens the model with the edit of a finding in the playground.
 * @param {HTMLElement} place
 * @param {URL} base
 * @param {CaseRecord} record
 */
async function tryEdit(place, base, record) {
  leave();
  leave = () => {};
  try {
    /** @type {typeof import("./start.js")} */
    const { open } = await import(/* @vite-ignore */ new URL("start.js", base).href);
    const playground = await open(place, base, record, null);
    leave = () => playground.leave();
    playground.draft.showRemedy("edit");
    place.scrollIntoView({ block: "nearest" });
  } catch (error) {
    console.error(error);
    place.replaceChildren(complaint("The playground cannot be opened: it needs WebGL and, the first time, the network."));
  }
}

/** @param {string} text */
function complaint(text) {
  return el("p", { class: "dg-error", role: "alert" }, text);
}

/** @param {unknown} error */
function said(error) {
  if (error instanceof FilesError || error instanceof DiagnosisError) return error.message;
  console.error(error);
  return `it cannot be read: ${error instanceof Error ? error.message : error}`;
}
