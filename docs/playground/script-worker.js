// A script of a reader, or a case's instrument, in a worker: it finds MuJoCo and the case's files, and no network.

import loadMujoco from "@mujoco/mujoco";
import { fetchBytes } from "./page/fetch.js";

/** @import {Instrument} from "./script/types.js" */

const OUTPUT = 256_000; // characters
const IMPORT = /^([ \t]*import\s*(?:[\w$\s{},*]+\sfrom\s*)?)(["'])([^"'\n]+)\2/gm;
const ELSEWHERE = /\bimport\b|\bfrom\s*["']/; // where an import may hide
const NO_IMPORT = "the word import is for lines of its own here: import() is not to be had";
const NETWORK = ["fetch", "XMLHttpRequest", "WebSocket", "WebSocketStream", "EventSource", "WebTransport", "importScripts", "Worker", "SharedWorker", "BroadcastChannel", "FontFace", "fonts", "caches", "indexedDB", "eval"];
const QUIET = { locateFile: (/** @type {string} */ name) => name, print: () => {}, printErr: () => {} };
/** @type {Record<string, string>} what a text may import */
const MODULES = {
  "@mujoco/mujoco": "export default globalThis.clinicEngine;",
  "node:fs": "export const readFileSync = globalThis.clinicFile;",
};

/** @type {string[]} */
const printed = [];
/** @type {Instrument | null} */
let instrument = null;
let address = "";

self.onmessage = async ({ data }) => {
  try {
    postMessage(data.text === undefined ? used(data) : await begun(data));
  } catch (error) {
    postMessage({ failed: said(error), line: lineOf(error) });
  }
};

/** @param {{wasm: string, text: string, files: Record<string, string>, kind: "script" | "instrument"}} request */
async function begun({ wasm, text, files, kind }) {
  const wasmBinary = await fetchBytes(wasm);
  Object.assign(globalThis, {
    clinicEngine: () => loadMujoco({ ...QUIET, wasmBinary }),
    clinicFile: (/** @type {string} */ name) => {
      if (!(name in files)) throw new Error(`no such file: ${name}; there are ${Object.keys(files).join(", ")}`);
      return files[name];
    },
  });
  console.log = (...words) => void printed.push(words.map(word).join(" "));
  const modules = Object.fromEntries(Object.entries(MODULES).map(([name, code]) => [name, inMemory(code)]));
  const code = text.replace(IMPORT, (_, before, quote, name) => {
    if (!(name in modules)) throw new Error(`${name} cannot be imported here: only ${Object.keys(modules).join(" and ")}`);
    return `${before}${quote}${modules[name]}${quote}`;
  });
  if (ELSEWHERE.test(text.replace(IMPORT, ""))) throw new Error(NO_IMPORT);
  withoutNetwork();
  address = inMemory(code);
  const made = await import(/* @vite-ignore */ address);
  if (kind === "script") return { printed: printed.join("\n").slice(0, OUTPUT) };
  instrument = new made.default(await /** @type {any} */ (globalThis).clinicEngine(), files);
  return { about: made.about, controls: made.controls, rows: instrument?.read() };
}

/** @param {{use: string, value: number}} request */
function used({ use, value }) {
  instrument?.use(use, value);
  return { rows: instrument?.read() };
}

/** Takes away what could reach the network, and the ways to make code of a text in which an import may stand. */
function withoutNetwork() {
  const checked = (/** @type {any[]} */ texts) => {
    if (texts.some((text) => ELSEWHERE.test(String(text)))) throw new Error(NO_IMPORT);
    return texts;
  };
  const made = new Proxy(Function, { // which the engine needs
    apply: (of, self, texts) => Reflect.apply(of, self, checked(texts)),
    construct: (of, texts, as) => Reflect.construct(of, checked(texts), as),
  });
  globalThis.Function = Function.prototype.constructor = made;
  for (const each of [async () => {}, function* () {}, async function* () {}]) Object.defineProperty(Object.getPrototypeOf(each), "constructor", { value: undefined });
  for (const name of ["setTimeout", "setInterval"]) {
    const plain = /** @type {any} */ (globalThis)[name];
    Object.defineProperty(globalThis, name, { value: (/** @type {unknown} */ act, /** @type {any[]} */ ...rest) => typeof act === "function" && plain(act, ...rest) });
  }
  for (const name of NETWORK) {
    for (let owner = globalThis; owner; owner = Object.getPrototypeOf(owner)) Reflect.deleteProperty(owner, name);
    Object.defineProperty(globalThis, name, { value: undefined });
  }
}

/** @param {string} code */
function inMemory(code) {
  return URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
}

/** @param {unknown} value as a console writes it, about */
function word(value) {
  if (typeof value === "string") return value;
  if (ArrayBuffer.isView(value)) return `[ ${Array.from(/** @type {any} */ (value)).join(", ")} ]`;
  return typeof value === "object" && value ? (JSON.stringify(value) ?? String(value)) : String(value);
}

/** @param {unknown} error */
function said(error) {
  return error instanceof Error ? `${error.name === "Error" ? "" : `${error.name}: `}${error.message}` : String(error);
}

/** @param {unknown} error @returns {number | null} the line of the text that it came from */
function lineOf(error) {
  const [, line] = (error instanceof Error && error.stack?.split(`${address}:`)) || [];
  return address && line ? Number.parseInt(line) : null;
}
