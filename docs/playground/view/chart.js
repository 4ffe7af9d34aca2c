// A signal over time, drawn while the model runs: the reader's run, the broken one beside it, and what the checks ask.

import uPlot from "uplot";
import { shown, TAKES } from "../engine/checks.js";
import { bounds, inWords } from "./bounds.js";
import { nearest, Samples } from "./samples.js";
import { reach, ticks } from "./ticks.js";

/** @import {CaseRecord, Check} from "../record/types.js" */
/** @import {Bound} from "./bounds.js" */
/** @import {Trace} from "./samples.js" */

const HEIGHT = { roomy: 150, tight: 110 }; // CSS pixels
const TIGHT = 260; // CSS pixels: so narrow a chart gets small axes

/** What the reader's run and the other one are called. @param {CaseRecord} record @returns {[string, string]} */
export const runs = ({ files }) => (files ? ["with the edit", "as it was"] : ["yours", "broken"]);

/** Samples of all signals, and the plot of one. */
export class Chart {
  /**
   * @param {{plot: HTMLElement, newest: HTMLOutputElement, asked: HTMLElement}} places of the plot, of what it says, and of what the checks ask
   * @param {CaseRecord} record
   * @param {string} first the signal shown
   */
  constructor(places, record, first) {
    this.places = places;
    this.record = record;
    this.name = first;
    this.mine = new Samples(Object.keys(record.signals));
    /** @type {Trace} the broken run as the record has it; of a reader's own model, as it is sampled beside */
    this.broken = { time: [], values: {} };
    this.compared = true;
    /** @type {number | null} the time under the pointer, in s */
    this.pointed = null;
    this.stale = true;
    this.resized = new ResizeObserver(() => this.resize());
    this.resized.observe(places.plot);
    this.tell();
  }

  /** Forgets the reader's run. */
  clear() {
    this.mine.clear();
    this.stale = true;
  }

  /** @param {Trace} samples */
  add(samples) {
    this.mine.add(samples);
    if (samples.time.length > 0) this.stale = true;
  }

  /** @param {Trace} trace the broken run */
  refer(trace) {
    this.broken = trace;
    this.restyle();
  }

  /** @param {boolean} compared whether the broken run is drawn as well */
  compare(compared) {
    this.compared = compared;
    this.restyle();
  }

  /** @param {string} name */
  show(name) {
    this.name = name;
    this.restyle();
    this.tell();
  }

  /** What a repair's checks ask of the signal shown. @returns {Check[]} */
  get checks() {
    return this.record.checks.fixed.filter(({ signal }) => signal === this.name);
  }

  /** @returns {Bound[]} */
  get bounds() {
    return bounds(this.checks, this.record.run.duration);
  }

  get unit() {
    return this.record.signals[this.name].unit;
  }

  /** Draws what has been added since the last time. */
  draw() {
    this.say();
    if (!this.stale && this.plot) return;
    this.stale = false;
    const data = this.data();
    if (this.plot) this.plot.setData(data);
    else this.plot = new uPlot(this.options(), data, this.places.plot);
  }

  /** Both runs on one axis of time: what one was not sampled at is left out, what is not a number is a gap. */
  data() {
    const plain = (/** @type {Trace} */ { time, values }) => /** @type {uPlot.AlignedData} */ ([time, (values[this.name] ?? time.map(() => NaN)).map((value) => (Number.isFinite(value) ? value : null))]);
    const broken = this.compared ? this.broken : { time: [], values: {} };
    return uPlot.join([plain(this.mine), plain(broken)]);
  }

  /** The newest numbers, or those under the pointer. */
  say() {
    const { newest } = this.places;
    const number = (/** @type {number | undefined} */ value) => (value === undefined ? "nothing" : `${shown(value, 4)} ${Number.isNaN(value) ? "" : this.unit}`.trim());
    const { time, values } = this.mine;
    if (this.pointed === null) {
      newest.value = time.length > 0 ? number(values[this.name].at(-1)) : "";
      return;
    }
    const inside = this.pointed <= (time.at(-1) ?? 0);
    const [yours, other] = runs(this.record);
    const mine = inside ? [`${yours} ${number(nearest(this.mine, this.name, this.pointed))}`] : [];
    const broken = this.compared && this.pointed <= (this.broken.time.at(-1) ?? 0) ? [`${other} ${number(nearest(this.broken, this.name, this.pointed))}`] : [];
    newest.value = `at ${shown(this.pointed, 3)} s: ${[...mine, ...broken].join(", ") || "nothing"}`;
  }

  /** Says what the checks ask of the signal. */
  tell() {
    const said = inWords(this.checks, this.unit, TAKES);
    this.places.asked.textContent = said && `The check asks, ${said}.`;
  }

  size() {
    const width = Math.max(this.places.plot.clientWidth, 100);
    return { width, height: width < TIGHT ? HEIGHT.tight : HEIGHT.roomy };
  }

  resize() {
    if (this.plot && this.plot.width < TIGHT !== this.size().width < TIGHT) this.restyle();
    else this.plot?.setSize(this.size());
  }

  /** @returns {uPlot.Options} */
  options() {
    const size = this.size();
    const tight = size.width < TIGHT;
    const style = getComputedStyle(this.places.plot);
    const colour = (/** @type {string} */ name) => style.getPropertyValue(name);
    const grid = { stroke: colour("--md-default-fg-color--lightest"), width: 1 };
    const axis = { stroke: style.color, grid, ticks: { ...grid, size: tight ? 3 : 8 }, font: `${tight ? 10 : 12}px ${style.fontFamily}`, gap: tight ? 2 : 5 };
    const asked = this.bounds.flatMap(({ low, high }) => [low, high]);
    return {
      ...size,
      padding: [8, tight ? 14 : 18, 0, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
      scales: {
        x: { time: false, range: (_, from, to) => [Math.min(from ?? 0, 0), Math.max(to ?? 0, this.record.checks.fixed.length > 0 && this.compared ? this.record.run.duration : 0, 1e-3)] },
        y: { range: (_, from, to) => reach([...(from === null ? [] : [from, to]), ...asked]) },
      },
      axes: [
        { ...axis, size: tight ? 20 : 30, space: tight ? 34 : 60, values: (_, splits) => ticks(splits).map((text, i, all) => (i === all.length - 1 ? `${text} s` : text)) },
        { ...axis, size: tight ? 38 : 62, space: tight ? 22 : 30, values: (_, splits) => ticks(splits) },
      ],
      series: [
        {},
        { stroke: colour("--md-accent-fg-color"), width: 2, points: { show: false } },
        { stroke: colour("--pg-broken"), width: 2, dash: [6, 4], points: { show: false } },
      ],
      hooks: {
        drawAxes: [(plot) => this.drawBounds(plot, colour("--pg-bound"))],
        setCursor: [(plot) => this.point(plot)],
      },
    };
  }

  /** @param {uPlot} plot */
  point(plot) {
    const left = plot.cursor.left ?? -1;
    this.pointed = left < 0 ? null : plot.posToVal(left, "x");
    this.say();
  }

  /**
   * Paints where the checks allow the signal to be.
   * @param {uPlot} plot
   * @param {string} colour
   */
  drawBounds(plot, colour) {
    const { ctx } = plot;
    const { left, top, width, height } = plot.bbox;
    const x = (/** @type {number} */ time) => plot.valToPos(time, "x", true);
    const y = (/** @type {number} */ value, /** @type {number} */ beyond) => (Number.isFinite(value) ? plot.valToPos(value, "y", true) : beyond);
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.fillStyle = ctx.strokeStyle = colour;
    ctx.lineWidth = 1.5 * devicePixelRatio;
    for (const { from, to, low, high, once } of this.bounds) {
      const [x0, x1, y0, y1] = [x(from), x(to), y(high, top), y(low, top + height)];
      ctx.globalAlpha = 0.18;
      if (!once) ctx.fillRect(x0, y0, x1 - x0, Math.max(y1 - y0, ctx.lineWidth));
      ctx.globalAlpha = 1;
      ctx.setLineDash(once ? [2 * ctx.lineWidth, 2 * ctx.lineWidth] : []);
      for (const [value, at] of [[low, y1], [high, y0]]) {
        if (!Number.isFinite(value)) continue;
        ctx.beginPath();
        ctx.moveTo(x0, at);
        ctx.lineTo(x1, at);
        ctx.stroke();
      }
    }
    ctx.restore();
  }

  /** Draws anew, for instance in other colours. */
  restyle() {
    this.plot?.destroy();
    this.plot = undefined;
    this.draw();
  }

  /** Removes the chart. */
  destroy() {
    this.resized.disconnect();
    this.plot?.destroy();
  }
}
