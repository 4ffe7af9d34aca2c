// The numbers that a script prints, as scripts/clinic/engine/script.py reads them.

import { evaluate, names, parse } from "../record/expression.js";

/** @import {Trace} from "../engine/checks.js" */
/** @import {Signal} from "../record/types.js" */

const PRINTED = /^\s*([a-z](?:[a-z0-9 _,()-]*[a-z0-9_,()-])?)\s*=\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(?![\w.])/;
const PATH = /^printed\((.*)\)$/;
const NOTHING = { time: [], value: [] };

/**
 * The numbers of the lines `name = value`, by name; a name printed twice gives two samples, whose time is their position.
 * @param {string} output
 * @returns {Record<string, Trace>}
 */
export function printedNumbers(output) {
  /** @type {Record<string, {time: number[], value: number[]}>} */
  const made = {};
  for (const line of output.split("\n")) {
    const [, name, value] = PRINTED.exec(line) ?? [];
    if (!name) continue;
    made[name] ??= { time: [], value: [] };
    made[name].time.push(made[name].value.length);
    made[name].value.push(Number(value));
  }
  return made;
}

/**
 * Every signal of a code case, from what its script printed; an empty trace where it printed nothing.
 * @param {Record<string, Signal>} signals
 * @param {string} output
 * @returns {Record<string, Trace>}
 */
export function measureOutput(signals, output) {
  const printed = printedNumbers(output);
  /** @type {Record<string, Trace>} */
  const made = {};
  for (const [name, signal] of Object.entries(signals)) if ("path" in signal) made[name] = printed[PATH.exec(signal.path)?.[1] ?? ""] ?? NOTHING;
  for (const [name, signal] of Object.entries(signals)) if ("expr" in signal) made[name] = computed(signal.expr, made);
  return made;
}

/**
 * @param {string} expr
 * @param {Record<string, Trace>} traces
 * @returns {Trace}
 */
function computed(expr, traces) {
  const tree = parse(expr);
  const read = [...names(tree)].map((name) => traces[name]);
  const [first] = read;
  if (!first || read.some(({ value }) => value.length !== first.value.length)) return NOTHING;
  return { time: first.time, value: Array.from(first.value, (_, i) => evaluate(tree, (name) => traces[name].value[i])) };
}
