// Fetched after the click on a code case's page: its script to edit and run, its instrument, or both.

import { fromFragment } from "./page/link.js";
import { stylesheet } from "./page/stylesheet.js";
import { Bench } from "./script/bench.js";
import { load } from "./script/client.js";
import { InstrumentPanel } from "./script/instrument.js";
import "../stylesheets/playground.css";

/** @import {ScriptRecord} from "./script/types.js" */

/**
 * Fills the playground's place.
 * @param {HTMLElement} root with `data-case`, the address of the case's `playground.json`
 * @param {URL} base where the playground's files are
 */
export async function mount(root, base) {
  const address = new URL(root.dataset.case ?? "", location.href);
  const [parts, response, linked] = await Promise.all([load(base), fetch(address), fromFragment(location.hash), stylesheet(new URL("script.css", base))]);
  if (!response.ok) throw new Error(`${address.pathname}: ${response.status}`);
  /** @type {ScriptRecord} */
  const record = await response.json();
  const edits = record.language === "javascript";
  root.replaceChildren(...(edits ? [] : [...root.children].filter((child) => !child.matches("p, button")))); // a script that stays
  if (edits) new Bench(root, record, parts, linked);
  if (record.instrument !== null) new InstrumentPanel(root, record, parts);
}
