// The first thing fetched after the click: starts the engine while the rest is on its way.

import { Engine } from "./engine/client.js";
import { fromFragment } from "./page/link.js";
import "uplot/dist/uPlot.min.css";
import "../stylesheets/playground.css";

/** @import {CaseRecord} from "./record/types.js" */

/**
 * Fills the playground's place.
 * @param {HTMLElement} root with `data-case`, the address of the case's `playground.json`
 * @param {URL} base where the playground's files are
 * @returns {Promise<() => void>} takes everything away again
 */
export async function mount(root, base) {
  const rest = import("./playground.js");
  const style = stylesheet(new URL("start.css", base));
  const response = await fetch(new URL(root.dataset.case ?? "", location.href));
  if (!response.ok) throw new Error(`${root.dataset.case}: ${response.status}`);
  const record = /** @type {CaseRecord} */ (await response.json());
  const linked = await fromFragment(location.hash);
  const address = (/** @type {string} */ name) => String(new URL(name, base));
  const engine = new Engine({ worker: address("worker.js"), wasm: address("mujoco.wasm.gz"), record });
  if (linked === null) engine.renew();
  try {
    const [{ Playground }] = await Promise.all([rest, style]);
    const playground = new Playground(root, record, engine, linked);
    return () => playground.leave();
  } catch (error) {
    engine.end();
    throw error;
  }
}

/** @param {URL} address */
function stylesheet(address) {
  const href = String(address);
  if ([...document.styleSheets].some((sheet) => sheet.href === href)) return;
  const link = document.createElement("link");
  return new Promise((resolve, reject) => {
    Object.assign(link, { rel: "stylesheet", href, onload: resolve, onerror: reject });
    document.head.append(link);
  });
}
