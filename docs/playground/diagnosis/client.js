// The diagnosis as the page sees it: a worker for one request, begun anew where MuJoCo dies of the model.

const LIMIT = 60_000; // ms without a sign of life
const DEATHS = 5;

/**
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
 *
 * @typedef {object} Diagnosis
 * @property {{engine: string, file: string, causes: Finding[], hints: Finding[], ruled_out: string[]}} data
 * @property {string} text
 * @property {string} diff
 * @property {string} error
 * @property {Record<string, string>} fixed
 *
 * @typedef {object} Request
 * @property {string} text
 * @property {string} name
 * @property {[string, Uint8Array<ArrayBuffer>][]} files
 * @property {string} symptom
 */

/** A model that cannot be diagnosed, in a sentence. */
export class DiagnosisError extends Error {}

/**
 * Diagnoses a model.
 * @param {{worker: string, base: string, wasm: string}} source
 * @param {Request} request
 * @param {(what: string) => void} tell
 * @param {AbortSignal} stop
 * @returns {Promise<Diagnosis>}
 * @throws {DiagnosisError}
 */
export async function diagnose(source, request, tell, stop) {
  /** @type {string[]} */
  const died = [];
  for (;;) {
    const { made, trying, message } = await asked(source, { ...request, ignore: died }, tell, stop);
    if (made) {
      made.data.causes.unshift(...died.map((rule) => death(rule, request.name)));
      return made;
    }
    if (!trying || died.length >= DEATHS) throw new DiagnosisError(message);
    died.push(trying);
  }
}

/**
 * @param {{worker: string, base: string, wasm: string}} source
 * @param {Request & {ignore: string[]}} request
 * @param {(what: string) => void} tell
 * @param {AbortSignal} stop
 * @returns {Promise<{made: Diagnosis | null, trying: string, message: string}>}
 */
function asked(source, request, tell, stop) {
  const worker = new Worker(source.worker, { type: "module" });
  let trying = "";
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  return new Promise((resolve, reject) => {
    const end = (/** @type {Diagnosis | null} */ made, /** @type {string} */ message) => {
      clearTimeout(timer);
      worker.terminate();
      resolve({ made, trying, message });
    };
    const watch = () => {
      clearTimeout(timer);
      timer = setTimeout(() => end(null, `no answer within ${LIMIT / 1000} s`), LIMIT);
    };
    stop.addEventListener("abort", () => {
      end(null, "");
      reject(stop.reason);
    });
    worker.onerror = (event) => {
      event.preventDefault();
      end(null, event.message || "the worker could not be started");
    };
    worker.onmessage = ({ data }) => {
      watch();
      if (data.type === "doing") tell(data.what);
      else if (data.type === "trying") tell((trying = data.rule));
      else if (data.type === "made") end(data, "");
      else end(null, data.message);
    };
    watch();
    worker.postMessage({ ...request, base: source.base, wasm: source.wasm });
  });
}

/**
 * @param {string} rule
 * @param {string} file
 * @returns {Finding}
 */
function death(rule, file) {
  const says = `MuJoCo ended, or gave no answer, while ${rule} was tried on this model.`;
  const empty = { elements: [], attribute: "", now: "", value: "", edit: [], probe: "", unit: "", before: null, after: null, healthy: "" };
  return { ...empty, rule: "engine-dies", title: "The engine does not survive the model", file, line: null, says };
}
