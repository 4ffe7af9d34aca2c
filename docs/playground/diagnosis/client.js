// The diagnosis as the page sees it: a worker for one request, begun anew where MuJoCo dies of the model.

import { keep } from "../page/fetch.js";

export const SIZE = 7.2e6; // bytes, about, of all that is loaded before the first diagnosis
const LIMIT = 60_000; // ms without a sign of life
const SILENT = `MuJoCo gave no answer for ${LIMIT / 1000} s`;
const DEATHS = 5;
const ROOM = "A page has less room than a terminal, for nested bodies above all: try `clinic diagnose` there.";
const LAUNCHER = "diagnosis-launcher.js";
const FILES = {
  worker: "diagnosis-worker.js",
  mujoco: "mujoco.wasm.gz",
  script: "../diagnosis/pyodide.asm.mjs.gz",
  python: "../diagnosis/pyodide.asm.wasm.gz",
  library: "../diagnosis/python_stdlib.zip",
  rules: "../diagnosis/clinic.zip",
};

/**
 * @typedef {Record<keyof typeof FILES, string>} Parts what a worker is made of, by address
 *
 * @typedef {object} Edit
 * @property {string} file
 * @property {number} line
 * @property {string} element
 * @property {string} action
 * @property {string} attribute
 * @property {string} value
 *
 * @typedef {object} Finding as `clinic diagnose --format json` prints it
 * @property {string} rule
 * @property {string} title
 * @property {"cause" | "hint"} level
 * @property {string[]} elements
 * @property {string} file
 * @property {number | null} line
 * @property {string} attribute
 * @property {string} now
 * @property {string} value
 * @property {Edit[]} edit
 * @property {string} probe
 * @property {string} unit
 * @property {number | null} before
 * @property {number | null} after
 * @property {string} says
 * @property {string} healthy
 * @property {string} silenced why a comment in the model silences it
 * @property {number | null} keyframe that the runs began from; null for the model's own start
 *
 * @typedef {Record<string, string>} Texts by file
 *
 * @typedef {object} Diagnosis as scripts/clinic/diagnosis/browser.py makes it
 * @property {{engine: string, file: string, causes: Finding[], hints: Finding[], silenced: Finding[], ruled_out: string[],
 *   untried: string[], error: string}} data
 * @property {string} text
 * @property {string} diff
 * @property {Texts} texts the model's and those that it includes
 * @property {Texts} mended the files that all edits together change
 * @property {Texts[]} edited the files that the edit of each finding changes, of causes before hints
 * @property {Record<string, string>} titles of the rules
 *
 * @typedef {object} Request
 * @property {string} text the model
 * @property {string} name what to call it
 * @property {[string, Uint8Array<ArrayBuffer>][]} files what it names, by path from the model's folder
 * @property {boolean} single whether it came alone or with single files, neither in a folder nor in a zip
 * @property {string} symptom the family that the reader sees
 *
 * @typedef {(what: string, share: number) => void} Tell what is being done, and how much of it is done
 */

/** @type {Worker | undefined} what starts the workers; it stays, since a second diagnosis needs no network */
let launcher;

/** A model that cannot be diagnosed, in a sentence. */
export class DiagnosisError extends Error {}

/**
 * Diagnoses a model.
 * @param {URL} base where the playground's files are
 * @param {Request} request
 * @param {Tell} tell
 * @param {AbortSignal} stop
 * @returns {Promise<Diagnosis>}
 * @throws {DiagnosisError}
 */
export async function diagnose(base, request, tell, stop) {
  const parts = await load(base, tell);
  launcher ??= new Worker(new URL(LAUNCHER, base), { type: "module" });
  /** @type {[string, string][]} rules, each with the clinic's own mistake, or nothing where the engine ended */
  const died = [];
  for (;;) {
    stop.throwIfAborted();
    const { made, trying, message, ours } = await ask(launcher, { parts, request, died }, tell, stop);
    if (made) return made;
    if (trying === null) throw new DiagnosisError(`MuJoCo and Python could not be started: ${message}.`);
    const ended = message === SILENT ? SILENT : ours ? message : `MuJoCo ended (${message})`;
    if (!trying) throw new DiagnosisError(`${ended} while it compiled the model. ${ROOM}`);
    if (died.length >= DEATHS) throw new DiagnosisError(`${ended} while ${trying} was tried, as while ${died.map(([rule]) => rule).join(", ")} were. ${ROOM}`);
    died.push([trying, ours ? message : ""]);
  }
}

/**
 * @param {URL} base
 * @param {Tell} tell
 * @returns {Promise<Parts>} addresses in memory
 */
export async function load(base, tell) {
  let sum = 0;
  const arrived = (/** @type {number} */ bytes) => tell("Loading MuJoCo and Python", Math.min(1, (sum += bytes) / SIZE));
  const made = Object.entries(FILES).map(async ([part, file]) => [part, await keep(new URL(file, base).href, arrived)]);
  try {
    return Object.fromEntries(await Promise.all(made));
  } catch (error) {
    throw new DiagnosisError(`What the diagnosis needs could not be loaded: ${/** @type {Error} */ (error).message}.`);
  }
}

/**
 * @param {Worker} launcher
 * @param {{parts: Parts, request: Request, died: [string, string][]}} asked
 * @param {Tell} tell
 * @param {AbortSignal} stop
 * @returns {Promise<{made: Diagnosis | null, trying: string | null, message: string, ours: boolean}>} trying: a rule, "" for the
 *   compiler, null before it is reached; ours: the clinic's own mistake, not the engine's
 */
function ask(launcher, asked, tell, stop) {
  const { port1: worker, port2: given } = new MessageChannel();
  /** @type {string | null} */
  let trying = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  return new Promise((resolve, reject) => {
    const end = (/** @type {Diagnosis | null} */ made, /** @type {string} */ message, ours = false) => {
      clearTimeout(timer);
      worker.postMessage("end");
      resolve({ made, trying, message, ours });
    };
    const watch = () => {
      clearTimeout(timer);
      timer = setTimeout(() => end(null, SILENT), LIMIT);
    };
    stop.addEventListener("abort", () => {
      reject(stop.reason);
      end(null, "");
    });
    worker.onmessage = ({ data }) => {
      watch();
      if (data.type === "made") end(data.made, "");
      else if (data.type === "died") end(null, data.message, data.ours);
      else tell(data.title, data.share);
      trying = data.rule ?? trying;
    };
    watch();
    tell("Starting MuJoCo and Python", 0);
    launcher.postMessage(asked, [given]);
  });
}
