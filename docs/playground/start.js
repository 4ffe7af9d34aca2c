// The first thing fetched after the click: starts the engine while the rest is on its way.

import { Engine } from "./engine/client.js";
import { fromFragment } from "./page/link.js";
import { stylesheet } from "./page/stylesheet.js";
import "uplot/dist/uPlot.min.css";
import "../stylesheets/playground.css";

/** @import {Linked} from "./page/link.js" */
/** @import {CaseRecord} from "./record/types.js" */

/**
 * Fills the playground's place.
 * @param {HTMLElement} root with `data-case`, the address of the case's `playground.json`
 * @param {URL} base where the playground's files are
 */
export async function mount(root, base) {
  void import("./playground.js");
  const response = await fetch(new URL(root.dataset.case ?? "", location.href));
  if (!response.ok) throw new Error(`${root.dataset.case}: ${response.status}`);
  await open(root, base, await response.json(), await fromFragment(location.hash));
}

/**
 * Opens the playground of a record.
 * @param {HTMLElement} root
 * @param {URL} base where the playground's files are
 * @param {CaseRecord} record
 * @param {Linked | null} linked what came with a link
 */
export async function open(root, base, record, linked) {
  const address = (/** @type {string} */ name) => String(new URL(name, base));
  const rest = Promise.all([import("./playground.js"), stylesheet(new URL("start.css", base))]);
  const source = { worker: address("worker.js"), wasm: address("mujoco.wasm.gz"), schema: address("mjcf.json"), record };
  const engine = new Engine(source);
  if (linked === null) engine.renew();
  try {
    const [{ Playground, Beside }] = await rest;
    const playground = new Playground(root, record, engine, linked);
    if (record.files) new Beside(playground.player, new Engine(source));
    return playground;
  } catch (error) {
    engine.end();
    throw error;
  }
}
