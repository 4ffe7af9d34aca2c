// The engine in a worker: compiles, runs and judges models. Every message carries a generation, and so does its answer.

import loadMujoco from "@mujoco/mujoco";
import { assets } from "./engine/assets.js";
import { InteractiveSimulation } from "./engine/interactive.js";
import { newer } from "./engine/mjcf.js";
import { judgeText } from "./judge/judgement.js";
import { fetchBytes } from "./page/fetch.js";

/** @import {MainModule} from "@mujoco/mujoco" */
/** @import {CaseRecord} from "./record/types.js" */

const TURN = 25; // ms of judging between two looks at the messages
const MAX_STEPS_A_TURN = 1000;

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
    let where = ""; // nowhere until the text has compiled
    try {
      for (let turn = 1; ; turn++) {
        const end = performance.now() + TURN;
        for (let i = 0; i < MAX_STEPS_A_TURN && performance.now() < end; i++) {
          const { done, value } = work.next();
          if (done) return { type: "judged", judgement: value };
          where = value ?? where;
        }
        postMessage({ type: "judging", generation, turn, where });
        await new Promise((resolve) => setTimeout(resolve));
        if (id !== judging) return { type: "stopped" };
      }
    } catch (error) {
      if (where === "") return { ...refusal(mujoco, error), checking: true };
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
 * Why a text does not compile.
 * @param {MainModule} mujoco
 * @param {unknown} error
 */
function refusal(mujoco, error) {
  failures += 1;
  if (fatal(error)) throw error;
  const message = said(error);
  const line = /line(?: number)?[ =](\d+)/i.exec(message);
  return { type: "refused", message, line: line && Number(line[1]), newer: newer(message, mujoco.mj_versionString()) };
}

/** Whether the module cannot be trusted any longer. @param {unknown} error */
function fatal(error) {
  return error instanceof WebAssembly.RuntimeError || error instanceof RangeError || /Aborted|stack/.test(said(error));
}

/** @param {unknown} error */
function said(error) {
  const message = error instanceof Error ? error.message : "";
  return message.replace(/^MuJoCo Error: (Loading error: )?/, "").trim() || "MuJoCo refused it without saying why";
}

/** @param {any} answer */
function transfers(answer) {
  return answer.frame ? [answer.frame.geoms.buffer] : [];
}
