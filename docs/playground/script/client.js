// A worker in which a script or an instrument runs on the engine: without a network, and ended when it takes too long.

import { keep } from "../page/fetch.js";

const LIMIT = 20_000; // ms without an answer
const LATE = `It is still running after ${LIMIT / 1000} s, and was ended: bound its loops by steps.`;

/** @typedef {{worker: URL, wasm: string}} Parts the worker's address, which is the site's: one from memory has the page's policy */

/** A script that did not end well, in a sentence. */
export class ScriptError extends Error {
  /**
   * @param {string} message
   * @param {number | null} [line] of the script
   */
  constructor(message, line = null) {
    super(message);
    this.line = line;
  }
}

/**
 * What every worker is made of.
 * @param {URL} base where the playground's files are
 * @returns {Promise<Parts>}
 */
export async function load(base) {
  const wasm = await keep(new URL("mujoco.wasm.gz", base).href, () => {});
  return { worker: new URL("script-worker.js", base), wasm };
}

/** One text, running in a worker of its own. */
export class Running {
  /**
   * @param {Parts} parts
   * @param {string} text
   * @param {Record<string, string>} files that it reads, by name
   * @param {"script" | "instrument"} kind
   */
  constructor(parts, text, files, kind) {
    this.worker = new Worker(parts.worker, { type: "module" });
    /** @type {{done: (answer: any) => void, failed: (error: Error) => void} | null} */
    this.asked = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    this.worker.onmessage = ({ data }) => this.answer(data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.answer({ failed: event.message || "the worker could not be started", line: null });
    };
    this.begun = this.ask({ wasm: parts.wasm, text, files, kind });
  }

  /**
   * Asks, and gives the answer.
   * @param {object} message
   * @returns {Promise<any>}
   * @throws {ScriptError}
   */
  ask(message) {
    return new Promise((done, failed) => {
      this.asked = { done, failed };
      this.timer = setTimeout(() => this.end(LATE), LIMIT);
      this.worker.postMessage(message);
    });
  }

  /** @param {{failed?: string, line?: number | null}} answer */
  answer(answer) {
    clearTimeout(this.timer);
    if (answer.failed === undefined) this.asked?.done(answer);
    else this.asked?.failed(new ScriptError(answer.failed, answer.line));
  }

  /** Ends the worker. @param {string} [message] why, for who still waits */
  end(message = "It was stopped.") {
    clearTimeout(this.timer);
    this.worker.terminate();
    this.asked?.failed(new ScriptError(message));
  }
}

/**
 * Runs a script to its end.
 * @param {Parts} parts
 * @param {string} text
 * @param {Record<string, string>} files
 * @param {AbortSignal} stop
 * @returns {Promise<string>} what it printed
 * @throws {ScriptError}
 */
export async function run(parts, text, files, stop) {
  const running = new Running(parts, text, files, "script");
  const ended = () => running.end();
  stop.addEventListener("abort", ended);
  try {
    return (await running.begun).printed;
  } finally {
    stop.removeEventListener("abort", ended);
    running.worker.terminate();
  }
}
