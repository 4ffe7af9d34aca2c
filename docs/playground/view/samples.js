// The numbers of all signals over time, thinned out when they become too many.

const MAX_SAMPLES = 4000; // kept a signal; then every second one is dropped

/** @typedef {{time: number[], values: Record<string, number[]>}} Trace times in s, values by signal */

/** What has been seen of a run so far. */
export class Samples {
  /** @param {string[]} names of the signals */
  constructor(names) {
    this.names = names;
    /** @type {number[]} */
    this.time = [];
    /** @type {Record<string, number[]>} */
    this.values = {};
    this.stride = 1;
    this.skipped = 0;
    this.clear();
  }

  /** Forgets all. */
  clear() {
    this.time = [];
    this.values = Object.fromEntries(this.names.map((name) => [name, []]));
    this.stride = 1;
    this.skipped = 0;
  }

  /** @param {Trace} samples */
  add({ time, values }) {
    if (time[0] < (this.time.at(-1) ?? 0)) this.clear(); // what came last was still of the run before
    for (let i = 0; i < time.length; i++) {
      this.skipped += 1;
      if (this.skipped % this.stride !== 0) continue;
      this.time.push(time[i]);
      for (const name of this.names) this.values[name].push(values[name]?.[i] ?? NaN);
    }
    if (this.time.length <= MAX_SAMPLES) return;
    const half = (/** @type {number[]} */ numbers) => numbers.filter((_, i) => i % 2 === 1);
    this.time = half(this.time);
    for (const name of this.names) this.values[name] = half(this.values[name]);
    this.stride *= 2;
  }
}

/**
 * The number of a signal that was sampled nearest to a time; undefined if none was.
 * @param {Trace} trace
 * @param {string} name
 * @param {number} moment in s
 */
export function nearest({ time, values }, name, moment) {
  let [low, high] = [0, time.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time[middle] < moment) low = middle + 1;
    else high = middle;
  }
  const before = low > 0 && moment - time[low - 1] < time[low] - moment ? low - 1 : low;
  return values[name]?.[before];
}
