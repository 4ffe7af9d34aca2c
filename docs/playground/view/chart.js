// A signal over time, drawn while the model runs.

import uPlot from "uplot";
import { shown } from "../engine/checks.js";

/** @import {Signal} from "../record/types.js" */

const MAX_SAMPLES = 4000; // kept a signal; then every second one is dropped

/** Samples of all signals, and the plot of one. */
export class Chart {
  /**
   * @param {HTMLElement} parent
   * @param {Record<string, Signal>} signals
   * @param {string} first the signal shown
   */
  constructor(parent, signals, first) {
    this.parent = parent;
    this.signals = signals;
    this.name = first;
    /** @type {number[]} */
    this.time = [];
    /** @type {Record<string, number[]>} */
    this.values = {};
    this.stride = 1;
    this.skipped = 0;
    this.stale = true;
    this.resized = new ResizeObserver(() => this.plot?.setSize(this.size()));
    this.resized.observe(parent);
    this.clear();
  }

  /** Forgets all samples. */
  clear() {
    this.time = [];
    this.values = Object.fromEntries(Object.keys(this.signals).map((name) => [name, []]));
    this.stride = 1;
    this.skipped = 0;
    this.stale = true;
  }

  /** @param {{time: number[], values: Record<string, number[]>}} samples */
  add({ time, values }) {
    for (let i = 0; i < time.length; i++) {
      this.skipped += 1;
      if (this.skipped % this.stride !== 0) continue;
      this.time.push(time[i]);
      for (const [name, kept] of Object.entries(this.values)) kept.push(values[name]?.[i] ?? NaN);
      this.stale = true;
    }
    if (this.time.length <= MAX_SAMPLES) return;
    const half = (/** @type {number[]} */ numbers) => numbers.filter((_, i) => i % 2 === 1);
    this.time = half(this.time);
    for (const name of Object.keys(this.values)) this.values[name] = half(this.values[name]);
    this.stride *= 2;
  }

  /** @param {string} name */
  show(name) {
    this.name = name;
    this.dispose();
    this.draw();
  }

  /** The newest number of the signal shown, with its unit. */
  get newest() {
    const value = this.values[this.name].at(-1);
    return value === undefined ? "" : `${shown(value, 4)} ${Number.isNaN(value) ? "" : this.signals[this.name].unit}`.trim();
  }

  /** Draws what has been added since the last time. */
  draw() {
    if (!this.stale && this.plot) return;
    this.stale = false;
    const values = this.values[this.name].map((value) => (Number.isFinite(value) ? value : null));
    const data = /** @type {uPlot.AlignedData} */ ([this.time, values]);
    if (this.plot) this.plot.setData(data);
    else this.plot = new uPlot(this.options(), data, this.parent);
  }

  size() {
    return { width: Math.max(this.parent.clientWidth, 100), height: 150 };
  }

  /** @returns {uPlot.Options} */
  options() {
    const { label, unit } = this.signals[this.name];
    const style = getComputedStyle(this.parent);
    const ink = style.color;
    const grid = style.getPropertyValue("--md-default-fg-color--lightest");
    const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 } };
    return {
      ...this.size(),
      legend: { show: false },
      cursor: { show: false },
      scales: { x: { time: false } },
      axes: [
        { ...axis, size: 34, values: (_, ticks) => ticks.map((tick) => `${shown(tick)} s`) },
        { ...axis, size: 62, values: (_, ticks) => ticks.map((tick) => shown(tick, 4)) },
      ],
      series: [{}, { label: unit ? `${label} in ${unit}` : label, stroke: style.getPropertyValue("--md-accent-fg-color"), width: 2 }],
    };
  }

  /** Draws anew, for instance in other colours. */
  restyle() {
    this.dispose();
    this.draw();
  }

  dispose() {
    this.plot?.destroy();
    this.plot = undefined;
    this.stale = true;
  }

  /** Removes the chart. */
  destroy() {
    this.resized.disconnect();
    this.dispose();
  }
}
