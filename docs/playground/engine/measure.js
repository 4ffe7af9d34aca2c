// All signals of a model: read from runs, computed from each other, or measured over many runs.

import { evaluate, names, parse } from "../record/expression.js";
import { judge } from "./checks.js";
import { requireId } from "./signals.js";
import { simulate, start } from "./simulate.js";

/** @import {MainModule, MjModel} from "@mujoco/mujoco" */
/** @import {PathSignal, CaseRecord, RowSignal, Signal, StartsSignal} from "../record/types.js" */
/** @import {Trace} from "./checks.js" */
/** @import {Nudge, Run} from "./simulate.js" */

/** The image that `image_row` looks at, in rays: as wide for its height as the site's images. */
const [COLUMNS, ROWS] = [160, 120];

/**
 * Simulates the model and measures the wanted signals.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {CaseRecord} record
 * @param {Set<string>} wanted
 * @param {Nudge} [nudge] applied to the start
 * @returns {Generator<undefined, {run: Run, traces: Record<string, Trace>}>}
 */
export function* measure(mujoco, model, record, wanted, nudge) {
  const run = yield* simulate(mujoco, model, record.run, pathSignals(record, wanted), nudge);
  const traces = { ...run.traces };
  for (const name of wanted) {
    const signal = record.signals[name];
    if ("expr" in signal) traces[name] = computed(signal.expr, run.traces);
    if ("measure" in signal) {
      const value =
        signal.measure === "image_row"
          ? imageRow(mujoco, model, record, signal)
          : yield* fractionOfStarts(mujoco, model, record, signal);
      traces[name] = { time: [0], value: [value] };
    }
  }
  return { run, traces };
}

/**
 * The path signals that the wanted signals need.
 * @param {CaseRecord} record
 * @param {Iterable<string>} wanted
 * @returns {Record<string, PathSignal>}
 */
export function pathSignals(record, wanted) {
  const needed = new Set(wanted);
  for (const name of wanted) {
    const signal = record.signals[name];
    if ("expr" in signal) names(parse(signal.expr)).forEach((read) => needed.add(read));
  }
  /** @param {[string, Signal]} entry @returns {entry is [string, PathSignal]} */
  const isPath = (entry) => needed.has(entry[0]) && "path" in entry[1];
  return Object.fromEntries(Object.entries(record.signals).filter(isPath));
}

/**
 * An expression signal, sample by sample.
 * @param {string} expr
 * @param {Record<string, Trace>} traces
 * @returns {Trace}
 */
function computed(expr, traces) {
  const tree = parse(expr);
  const { time } = traces[[...names(tree)][0]];
  return { time, value: Float64Array.from(time, (_, i) => evaluate(tree, (name) => traces[name].value[i])) };
}

/**
 * The share of evenly spaced start positions from which `signal.holds` holds, 0 to 1.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {CaseRecord} record
 * @param {StartsSignal} signal
 * @returns {Generator<undefined, number>}
 */
function* fractionOfStarts(mujoco, model, record, signal) {
  const address = model.jnt_qposadr[requireId(mujoco, model, "joint", signal.joint)] + signal.index;
  const paths = pathSignals(record, [signal.holds.signal]);
  const [from, to] = signal.offset;
  let held = 0;
  for (let k = 0; k < signal.count; k++) {
    const offset = k === signal.count - 1 ? to : k * ((to - from) / (signal.count - 1)) + from;
    /** @type {Nudge} */
    const nudge = (data) => {
      data.qpos[address] += offset;
    };
    const { traces } = yield* simulate(mujoco, model, record.run, paths, nudge);
    held += Number(judge(signal.holds, traces).holds);
  }
  return held / signal.count;
}

/**
 * The mean row of a geom's visible part in a camera's image at the start of the run: 0 the top edge, 1 the bottom; NaN
 * when none is visible.
 *
 * Python counts the pixels of a rendered image. Here a ray is cast through the middle of each of 160 x 120 pixels, so
 * that no graphics card is needed: the two agree to about the height of a pixel.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {CaseRecord} record
 * @param {RowSignal} signal
 */
function imageRow(mujoco, model, record, signal) {
  const camera = requireId(mujoco, model, "camera", signal.camera);
  const geom = requireId(mujoco, model, "geom", signal.geom);
  const data = start(mujoco, model, record.run);
  const hits = new mujoco.IntBuffer(COLUMNS);
  const distances = new mujoco.DoubleBuffer(COLUMNS);
  mujoco.mj_forward(model, data);
  const eye = Array.from(data.cam_xpos.slice(3 * camera, 3 * camera + 3));
  const axes = Array.from(data.cam_xmat.slice(9 * camera, 9 * camera + 9));
  const high = Math.tan((model.cam_fovy[camera] * Math.PI) / 360);
  let [sum, count] = [0, 0];
  for (let row = 0; row < ROWS; row++) {
    const y = high * (1 - (2 * (row + 0.5)) / ROWS);
    const rays = [];
    for (let column = 0; column < COLUMNS; column++) {
      const x = ((high * COLUMNS) / ROWS) * ((2 * (column + 0.5)) / COLUMNS - 1);
      const ray = [0, 1, 2].map((k) => axes[3 * k] * x + axes[3 * k + 1] * y - axes[3 * k + 2]);
      const length = Math.hypot(...ray);
      rays.push(...ray.map((part) => part / length));
    }
    const groups = [1, 1, 1, 0, 0, 0];
    mujoco.mj_multiRay(model, data, eye, rays, groups, true, -1, hits, distances, null, COLUMNS, 1e10);
    for (const hit of hits.GetView()) {
      if (hit !== geom) continue;
      sum += row;
      count += 1;
    }
  }
  for (const used of [hits, distances, data]) used.delete();
  return count > 0 ? (sum / count + 0.5) / ROWS : NaN;
}
