// What the checks ask of a signal, as shapes in its chart and in words.

import { expected, shown } from "../engine/checks.js";

/** @import {Check} from "../record/types.js" */

const INSTANT = 0.04; // of the run, as wide as a bound at its end or its start is drawn

/**
 * Where a check allows the signal to be: from `low` to `high` while `from` <= time <= `to`. Where it need only get as far
 * once, `once` is true: one side is infinite, the other is what has to be crossed.
 * @typedef {{from: number, to: number, low: number, high: number, once: boolean}} Bound times in s, values in the signal's unit
 */

/**
 * The bounds of the checks that can be drawn: those of a value, not of a span or of when something happens.
 * @param {Check[]} checks of one signal
 * @param {number} duration of the run, in s
 * @returns {Bound[]}
 */
export function bounds(checks, duration) {
  return checks.flatMap((check) => shapes(check, duration)).filter(({ low, high }) => Number.isFinite(low) || Number.isFinite(high));
}

/**
 * @param {Check} check
 * @param {number} duration
 * @returns {Bound[]}
 */
function shapes(check, duration) {
  const [low, high] = limits(check);
  const [from, to] = check.window ?? [0, duration];
  const width = INSTANT * duration;
  const [above, below] = [{ from, to, low, high: Infinity }, { from, to, low: -Infinity, high }];
  switch (check.take) {
    case "final":
      return [{ from: Math.max(to - width, 0), to, low, high, once: false }];
    case "first":
      return [{ from, to: from + width, low, high, once: false }];
    case "mean":
      return [{ from, to, low, high, once: false }];
    case "min":
      return [{ ...above, once: false }, { ...below, once: true }];
    case "max":
      return [{ ...below, once: false }, { ...above, once: true }];
    default:
      return [];
  }
}

/**
 * What the checks ask, in words; empty without any.
 * @param {Check[]} checks of one signal
 * @param {string} unit
 * @param {Record<Check["take"], string>} takes how each is called
 */
export function inWords(checks, unit, takes) {
  return checks
    .map((check) => {
      const span = check.window ? `, ${shown(check.window[0])} to ${shown(check.window[1])} s` : "";
      return `${takes[check.take]}${span}: ${expected(check)} ${check.take === "onset" ? "s" : unit}`.trim();
    })
    .join("; ");
}

/**
 * @param {Check} check
 * @returns {[number, number]}
 */
function limits({ above, below, between, equals, within = 0 }) {
  if (above !== undefined) return [above, Infinity];
  if (below !== undefined) return [-Infinity, below];
  if (between !== undefined) return between;
  return [Number(equals) - within, Number(equals) + within];
}
