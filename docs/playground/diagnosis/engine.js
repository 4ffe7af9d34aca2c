// The engine as the diagnosis asks for it: `Engine` and `Compiled` of scripts/clinic/diagnosis/engine.py, on WebAssembly.

import { compile, encoded } from "../engine/compile.js";
import { nameOf, warningStat } from "../engine/signals.js";

/** @import {MainModule, MjData, MjModel} from "@mujoco/mujoco" */

const KEPT = 12; // compiled models; an older one is compiled anew when it is asked for again
/** @type {Record<string, string>} */
const BOOLEANS = { jnt: "njnt", actuator: "nu", eq: "neq" }; // how many, where it is not `n` and the prefix
const COUNTS = { joint: "njnt", camera: "ncam", equality: "neq", actuator: "nu", dof: "nv", sensor: "nsensor" };

/** Compiles texts, and keeps the last few models. */
export class DiagnosisEngine {
  /**
   * @param {MainModule} mujoco
   * @param {[string, Uint8Array][]} files what the model names, by path from the model's folder
   */
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.files = files;
    this.version = mujoco.mj_versionString();
    /** @type {CompiledModel[]} the last used at the end */
    this.kept = [];
  }

  /**
   * @param {string} main
   * @param {[string, string][]} texts included ones, in place of those in `files`
   * @throws {Error} with what MuJoCo says
   */
  compile(main, texts) {
    const made = new CompiledModel(this, main, texts);
    made.use();
    return made;
  }

  /**
   * @param {string} main
   * @param {[string, string][]} texts
   * @returns {MjModel}
   */
  load(main, texts) {
    return compile(this.mujoco, main, [...this.files, ...encoded(texts)]);
  }

  /** Frees what is kept. */
  end() {
    for (const model of this.kept.splice(0)) model.drop();
  }

  /** @param {CompiledModel} model that is in use now */
  touch(model) {
    if (this.kept.at(-1) === model) return;
    this.kept = [...this.kept.filter((each) => each !== model), model];
    for (const old of this.kept.splice(0, Math.max(0, this.kept.length - KEPT))) old.drop();
  }
}

/** One text, compiled, with one state. */
class CompiledModel {
  /**
   * @param {DiagnosisEngine} engine
   * @param {string} main
   * @param {[string, string][]} texts
   */
  constructor(engine, main, texts) {
    this.engine = engine;
    this.source = /** @type {const} */ ([main, texts]);
    /** @type {{model: MjModel, data: MjData} | null} */
    this.live = null;
  }

  /** @returns {{model: MjModel, data: MjData}} compiled from the text */
  made() {
    const model = this.engine.load(...this.source);
    try {
      return { model, data: new this.engine.mujoco.MjData(model) };
    } catch (error) {
      model.delete();
      throw error;
    }
  }

  /** The model and its data; compiled now if it was dropped. */
  use() {
    if (!this.live) {
      try {
        this.live = this.made();
      } catch (error) {
        if (!/could not allocate|out of memory/i.test(String(error))) throw error;
        this.engine.end(); // the others are compiled anew when they are asked for again
        this.live = this.made();
      }
    }
    this.engine.touch(this);
    return this.live;
  }

  drop() {
    this.live?.data.delete();
    this.live?.model.delete();
    this.live = null;
  }

  /** @param {string} kind */
  count(kind) {
    return Number(this.field("model", /** @type {Record<string, string>} */ (COUNTS)[kind] ?? `n${kind}`));
  }

  /**
   * @param {string} kind
   * @param {number} index
   */
  name(kind, index) {
    const { mujoco } = this.engine;
    const type = /** @type {Record<string, any>} */ (mujoco.mjtObj)[`mjOBJ_${kind.toUpperCase()}`];
    return nameOf(mujoco, this.use().model, type.value, index);
  }

  /**
   * A field of the model or the data: an array or a number.
   * @param {"model" | "data"} of
   * @param {string} path
   */
  field(of, path) {
    /** @type {any} */
    let value = this.use()[of];
    try {
      for (const part of path.split(".")) value = value[part];
    } catch (error) {
      if (of === "model" && /memory_viewI[bE]/.test(String(error))) return this.booleans(path);
      throw error;
    }
    if (value === undefined) throw new Error(`${of} has no ${path}`);
    return value?.value ?? value;
  }

  /**
   * An array of booleans, which the binding gives element by element alone, and of some fields not at all: those follow
   * from the range that they belong to, or are 0.
   * @param {string} path such as `jnt_limited`
   */
  booleans(path) {
    const model = /** @type {any} */ (this.use().model);
    const [prefix, ...rest] = path.split("_");
    const name = rest.join("_");
    const range = name.endsWith("limited") ? model[`${prefix}_${name.replace(/limited$/, "range")}`] : undefined;
    return Array.from({ length: Number(model[BOOLEANS[prefix] ?? `n${prefix}`]) }, (_, i) => {
      const element = model[prefix]?.(i);
      const value = element?.[name];
      element?.delete?.();
      if (value !== undefined) return Number(value);
      return Number(Boolean(range?.[2 * i] || range?.[2 * i + 1]));
    });
  }

  /**
   * @param {"model" | "data"} of
   * @param {string} path
   * @param {number[]} values
   * @param {number} start
   */
  write(of, path, values, start) {
    /** @type {any} */
    let holder = this.use()[of];
    const parts = path.split(".");
    const last = /** @type {string} */ (parts.pop());
    for (const part of parts) holder = holder[part];
    if (typeof holder[last] === "number") holder[last] = values[0];
    else for (let i = 0; i < values.length; i++) holder[last][start + i] = values[i];
  }

  /** @param {number} key */
  reset(key) {
    const { model, data } = this.use();
    if (key >= 0) this.engine.mujoco.mj_resetDataKeyframe(model, data, key);
    else this.engine.mujoco.mj_resetData(model, data);
  }

  forward() {
    const { model, data } = this.use();
    this.engine.mujoco.mj_forward(model, data);
  }

  /** @param {number} count */
  step(count) {
    const { model, data } = this.use();
    for (let i = 0; i < count; i++) this.engine.mujoco.mj_step(model, data);
  }

  /** Geoms, distance, position, normal and normal force of every contact. */
  contacts() {
    const { mujoco } = this.engine;
    const { model, data } = this.use();
    const all = data.contact; // a copy, which has to be freed, as has every contact taken from it
    const force = new mujoco.DoubleBuffer(6);
    const made = [];
    for (let i = 0; i < all.size(); i++) {
      const contact = /** @type {any} */ (all.get(i));
      mujoco.mj_contactForce(model, data, i, force);
      made.push([...contact.geom, contact.dist, ...contact.pos, ...Array.from(contact.frame).slice(0, 3), force.GetView()[0]]);
      contact.delete();
    }
    force.delete();
    all.delete();
    return made;
  }

  mass_diagonal() {
    const { mujoco } = this.engine;
    const { model, data } = this.use();
    if (model.nv === 0) return [];
    const dense = new mujoco.DoubleBuffer(model.nv * model.nv);
    mujoco.mj_fullM(model, data, dense);
    const view = dense.GetView();
    const made = Array.from({ length: model.nv }, (_, i) => view[i * (model.nv + 1)]);
    dense.delete();
    return made;
  }

  /** How often MuJoCo warned, by name. */
  warnings() {
    const { data } = this.use();
    return Object.entries(this.engine.mujoco.mjtWarning)
      .filter(([key]) => key.startsWith("mjWARN_"))
      .map(([key, kind]) => [key.slice("mjWARN_".length), warningStat(data, kind.value).number])
      .filter(([, number]) => Number(number) > 0);
  }
}
