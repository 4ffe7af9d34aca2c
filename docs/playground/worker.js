// The engine in a worker: compiles, runs and judges models. Every message carries a generation, and so does its answer.

import loadMujoco from "@mujoco/mujoco";
import { assets } from "./engine/assets.js";
import { InteractiveSimulation } from "./engine/interactive.js";
import { lineOf, sentence } from "./engine/errors.js";
import { measure } from "./engine/measure.js";
import { newer } from "./engine/mjcf.js";
import { judgeText } from "./judge/judgement.js";
import { fetchBytes } from "./page/fetch.js";

/** @import {MainModule} from "@mujoco/mujoco" */
/** @import {CaseRecord} from "./record/types.js" */

const TURN = 25; // ms of judging between two looks at the messages
const MAX_STEPS_A_TURN = 1000;
const MAX_SAMPLES = 1000; // of the broken run, a signal

/** @type {Promise<MainModule>} */
let booted;
/** @type {CaseRecord} */
let record;
/** @type {InteractiveSimulation | null} */
let simulation = null;
let failures = 0;
let judging = 0;

/** @type {Record<string, (mujoco: MainModule, message: any) => object | null | Promise<object | null>>} */
const HANDLERS = {
  /** Starts the engine. */
  boot: (mujoco) => ({ type: "booted", version: mujoco.mj_versionString() }),

  /** Compiles a text; the model before it stays if that fails. */
  open: (mujoco, { text }) => {
    try {
      const made = new InteractiveSimulation(mujoco, text, record);
      simulation?.delete();
      simulation = made;
    } catch (error) {
      return refusal(mujoco, error);
    }
    return { type: "opened", assets: assets(mujoco, simulation.model, simulation.scene), missing: simulation.missing };
  },

  reset: () => {
    simulation?.restart();
    return null;
  },

  /** Holds actuators at controls of the reader's, by name; the others are driven as the record says. */
  control: (_, { controls }) => {
    simulation?.control(controls);
    return null;
  },

  /** Runs the broken model as the record says, in turns, for the chart. */
  refer: async (mujoco) => {
    const model = mujoco.MjModel.from_xml_string(record.text);
    const read = Object.keys(record.signals).filter((name) => !("measure" in record.signals[name]));
    const work = measure(mujoco, model, record, new Set(read));
    try {
      const found = await inTurns(work, () => true, () => {});
      const traces = found?.traces ?? {};
      const step = Math.ceil((found?.run.steps ?? 0) / MAX_SAMPLES);
      const thin = (/** @type {ArrayLike<number>} */ all) => Array.from(all).filter((_, i) => (i + 1) % step === 0);
      return { type: "referred", time: thin(traces[read[0]].time), values: Object.fromEntries(read.map((name) => [name, thin(traces[name].value)])) };
    } finally {
      model.delete();
    }
  },

  /** Moves on and gives what is to be drawn. */
  frame: (_, { seconds, steps, overlays, camera }) => {
    if (!simulation) return { type: "frame", frame: null };
    return { type: "frame", frame: simulation.frame(overlays, camera, simulation.advance(seconds, steps)) };
  },

  grab: (_, { origin, direction }) => ({ type: "grabbed", held: simulation?.grab(origin, direction) ?? null }),

  hold: (_, { body }) => ({ type: "grabbed", held: simulation?.hold(body) ?? null }),

  drag: (_, { point }) => {
    simulation?.drag(point);
    return null;
  },

  release: () => {
    simulation?.release();
    return null;
  },

  /** Judges a text with fresh models and fresh data, in turns. */
  check: async (mujoco, { text, generation }) => {
    const id = ++judging;
    const work = judgeText(mujoco, text, record);
    let compiled = false;
    const tell = (/** @type {import("./judge/judgement.js").Progress} */ progress) => {
      compiled = true;
      postMessage({ type: "judging", generation, ...progress });
    };
    try {
      const judgement = await inTurns(work, () => id === judging, tell);
      return judgement ? { type: "judged", judgement } : { type: "stopped" };
    } catch (error) {
      if (!compiled) return { ...refusal(mujoco, error), checking: true };
      if (fatal(error)) throw error;
      return { type: "unjudged", message: said(error) };
    } finally {
      work.return(/** @type {any} */ (undefined));
    }
  },

  /** Ends a judgement that is under way. */
  stop: () => {
    judging += 1;
    return null;
  },
};

self.onmessage = async ({ data: message }) => {
  const { type, generation } = message;
  try {
    if (type === "boot") {
      record = message.record;
      booted = boot(message.wasm);
    }
    const answer = await HANDLERS[type](await booted, message);
    if (answer) postMessage({ ...answer, generation, failures }, { transfer: transfers(answer) });
  } catch (error) {
    postMessage({ type: "dead", generation, message: said(error) });
  }
};

/** @param {string} url of the gzipped module; some servers inflate it on the way */
async function boot(url) {
  return loadMujoco({ wasmBinary: await fetchBytes(url), print: () => {}, printErr: () => {} });
}

/**
 * Does work in turns, between which messages are answered.
 * @template P, T
 * @param {Generator<P | undefined, T>} work
 * @param {() => boolean} wanted asked after each turn
 * @param {(progress: P) => void} tell called with what was yielded first, and with what was yielded last in each turn
 * @returns {Promise<T | null>} null if it is no longer wanted
 */
async function inTurns(work, wanted, tell) {
  for (let turn = 0; ; turn++) {
    const end = performance.now() + TURN;
    /** @type {P | undefined} */
    let last;
    for (let i = 0; i < MAX_STEPS_A_TURN && performance.now() < end; i++) {
      const { done, value } = work.next();
      if (done) return value;
      if (turn === 0 && i === 0 && value) tell(value);
      last = value ?? last;
    }
    if (last) tell(last);
    await new Promise((resolve) => setTimeout(resolve));
    if (!wanted()) return null;
  }
}

/**
 * Why a text does not compile.
 * @param {MainModule} mujoco
 * @param {unknown} error
 */
function refusal(mujoco, error) {
  failures += 1;
  if (fatal(error)) throw error;
  const message = error instanceof Error ? error.message : "";
  return { type: "refused", message: sentence(message), line: lineOf(message), newer: newer(message, mujoco.mj_versionString()) };
}

/** Whether the module cannot be trusted any longer. @param {unknown} error */
function fatal(error) {
  return error instanceof WebAssembly.RuntimeError || error instanceof RangeError || /Aborted|stack/.test(error instanceof Error ? error.message : "");
}

/** @param {unknown} error */
function said(error) {
  return sentence(error instanceof Error ? error.message : "");
}

/** @param {any} answer */
function transfers(answer) {
  return answer.frame ? [answer.frame.geoms.buffer] : [];
}
