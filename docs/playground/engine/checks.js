// Checks: one number taken from a signal, compared with a bound.

/** @import {Check, Comparison, Take} from "../record/types.js" */

/**
 * A signal's samples: simulated time in s, increasing, and values; NaN where there was nothing to read.
 * @typedef {{time: ArrayLike<number>, value: ArrayLike<number>}} Trace
 *
 * @typedef {{check: Check, measured: number, holds: boolean}} Verdict
 */

/**
 * One number of a trace; NaN when there is no sample to take it from.
 *
 * Samples that are not numbers are skipped, except by `final` and `first`.
 * @param {Trace} trace
 * @param {Take} which
 * @param {[number, number]} [window] only samples with t0 <= time <= t1, in s
 * @returns {number}
 */
export function take(trace, which, window) {
  let samples = Array.from(trace.value, (value, i) => ({ time: trace.time[i], value }));
  if (window) samples = samples.filter(({ time }) => time >= window[0] && time <= window[1]);
  if (which === "final") return samples.at(-1)?.value ?? NaN;
  if (which === "first") return samples.at(0)?.value ?? NaN;
  samples = samples.filter(({ value }) => !Number.isNaN(value));
  if (samples.length === 0) return NaN;
  let [low, high, sum] = [Infinity, -Infinity, 0];
  for (const { value } of samples) {
    low = Math.min(low, value);
    high = Math.max(high, value);
    sum += value;
  }
  switch (which) {
    case "min":
      return low;
    case "max":
      return high;
    case "mean":
      return sum / samples.length;
    case "span":
      return high - low;
    case "onset":
      return samples.find(({ value }) => value !== 0)?.time ?? NaN;
  }
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
  const tolerance = check.within ? ` ± ${show(check.within)}` : " exactly";
  return show(Number(check.equals)) + tolerance;
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
