// Checks: one number taken from a signal, compared with a bound.

/** @import {Check, Comparison, Take} from "../record/types.js" */

/**
 * A signal's samples: simulated time in s, increasing, and values; NaN where there was nothing to read.
 * @typedef {{time: ArrayLike<number>, value: ArrayLike<number>}} Trace
 *
 * @typedef {{check: Check, measured: number, holds: boolean}} Verdict
 */

/** What is taken of a signal, in words. */
export const TAKES = /** @type {const} */ ({
  final: "at the end",
  first: "after one step",
  min: "lowest",
  max: "highest",
  mean: "mean",
  span: "span",
  onset: "first differs from zero at",
});

/**
 * One number of a trace; NaN when there is no sample to take it from.
 *
 * Samples that are not numbers are skipped, except by `final` and `first`.
 * @param {Trace} trace
 * @param {Take} which
 * @param {[number, number]} [window] only samples with t0 <= time <= t1, in s
 * @returns {number}
 */
export function take({ time, value }, which, window) {
  let [from, to] = [0, value.length - 1];
  if (window) {
    while (from <= to && time[from] < window[0]) from += 1;
    while (to >= from && time[to] > window[1]) to -= 1;
  }
  if (from > to) return NaN;
  if (which === "final") return value[to];
  if (which === "first") return value[from];
  let [low, high, sum, count] = [Infinity, -Infinity, 0, 0];
  for (let i = from; i <= to; i++) {
    const number = value[i];
    if (Number.isNaN(number)) continue;
    if (which === "onset" && number !== 0) return time[i];
    if (number < low) low = number;
    if (number > high) high = number;
    sum += number;
    count += 1;
  }
  if (count === 0 || which === "onset") return NaN;
  return { min: low, max: high, mean: sum / count, span: high - low }[which];
}

/**
 * The check's verdict. A number that could not be measured satisfies no check.
 * @param {Check} check
 * @param {Record<string, Trace>} traces
 * @returns {Verdict}
 */
export function judge(check, traces) {
  const measured = take(traces[check.signal], check.take, check.window);
  return { check, measured, holds: satisfies(check, measured) };
}

/**
 * Whether a measured number satisfies the comparison.
 * @param {Comparison} check
 * @param {number} measured
 */
export function satisfies(check, measured) {
  if (Number.isNaN(measured)) return false;
  if (check.above !== undefined) return measured > check.above;
  if (check.below !== undefined) return measured < check.below;
  if (check.between !== undefined) return check.between[0] <= measured && measured <= check.between[1];
  return Math.abs(measured - Number(check.equals)) <= (check.within ?? 0);
}

/**
 * The comparison in words: `between 0.505 and 0.52`.
 * @param {Comparison} check
 * @param {(value: number) => string} [show]
 */
export function expected(check, show = shown) {
  if (check.above !== undefined) return `above ${show(check.above)}`;
  if (check.below !== undefined) return `below ${show(check.below)}`;
  if (check.between !== undefined) return `between ${show(check.between[0])} and ${show(check.between[1])}`;
  const wanted = show(Number(check.equals));
  return check.within ? `${wanted} ± ${show(check.within)}` : `exactly ${wanted}`;
}

/**
 * A number as Python's format `g` writes it, which the judge's sentences use.
 * @param {number} value
 * @param {number} [digits]
 */
export function general(value, digits = 6) {
  if (!Number.isFinite(value)) return String(value).replace("Infinity", "inf").replace("NaN", "nan");
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const power = Number(exponent);
  if (value === 0 || (power >= -4 && power < digits)) return (Object.is(value, -0) ? "-" : "") + Number(value.toPrecision(digits));
  return `${Number(mantissa)}e${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}

/**
 * A number for readers, to some significant digits.
 * @param {number} value
 * @param {number} [digits]
 */
export function shown(value, digits = 6) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "not measured" : "beyond all bounds";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${Number(mantissa)}e${exponent}`.replace("e+", "e");
  }
  return String(Number(value.toPrecision(digits)));
}
