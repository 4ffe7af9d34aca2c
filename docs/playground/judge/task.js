// The same task: what a reader's model changes besides what a repair may, told in sentences.
// What is compared, and how it is told, stands in scripts/clinic/proof/task.json, which Python reads too.

import TABLES from "../../../scripts/clinic/proof/task.json" with { type: "json" };
import { general } from "../engine/checks.js";
import { nameOf } from "../engine/signals.js";

/** @import {MainModule, MjModel} from "@mujoco/mujoco" */
/** @typedef {"mjtJoint" | "mjtGeom" | "mjtSensor" | "mjtTrn" | "mjtDyn" | "mjtGain" | "mjtBias"} Enumeration */

/**
 * A field of an element: numbers, or the name of what it refers to; null where this MuJoCo has no such field.
 * @typedef {number[] | string | null} Value
 */

const FIELDS = /** @type {Record<string, string>} */ (TABLES.fields);
const WORDS = /** @type {Record<string, string>} */ (TABLES.words);
const UNITS = /** @type {Record<string, string>} */ (TABLES.units);
const PREFIX = /** @type {Record<string, string>} */ (TABLES.prefix);
const COUNT = /** @type {Record<string, string>} */ (TABLES.count);
const TYPES = /** @type {Record<string, Enumeration>} */ (TABLES.types);
const LIMITED = /** @type {Record<string, string>} */ (TABLES.limited);
const BOOLEAN = "actgravcomp"; // an array that the binding cannot give; alone, without `gravcomp`, it does nothing
const UNLIMITED = [-Infinity, Infinity];

/** Two models compared: `broken` is the case's, `model` the reader's. */
class Comparison {
  /**
   * @param {MainModule} mujoco
   * @param {MjModel} broken
   * @param {MjModel} model
   * @param {string[]} may what a repair of this case may change as well
   */
  constructor(mujoco, broken, model, may) {
    this.mujoco = mujoco;
    this.broken = /** @type {any} */ (broken);
    this.model = /** @type {any} */ (model);
    this.may = may;
  }

  /** @param {string} kind @returns {Generator<string>} */
  *ofKind(kind) {
    const here = this.elements(this.broken, kind);
    const there = renamed(kind, here, this.elements(this.model, kind));
    for (const [name, i] of here) {
      const other = there.get(name);
      if (other === undefined) {
        if (!this.may.includes(`${kind}(${name})`)) yield `You removed or renamed ${kind} ${name}.`;
        continue;
      }
      for (const field of FIELDS[kind].split(" ")) {
        const [before, after] = [this.value(this.broken, kind, field, i), this.value(this.model, kind, field, other)];
        const allowed = [field, WORDS[field] ?? field].some((word) => this.may.includes(`${kind}(${name}).${word}`));
        const hidden = kind === "geom" && field === "quat" && this.fillsTheSame(i, before, after);
        if (allowed || hidden || same(before, after, field)) continue;
        yield changed(field, ` of ${kind} ${name}`, before, after);
        if (kind === "sensor" && field === "type") break; // what else differs is because of it
      }
    }
    if ([...TABLES.further, ...this.may].includes(kind)) return;
    for (const [name, i] of there) {
      if (!here.has(name) && !(kind === "body" && this.isFrame(i))) yield `You added ${kind} ${name}.`;
    }
  }

  /** Whether a body is a place in the world and nothing more: what a camera is turned to. @param {number} body */
  isFrame(body) {
    return this.model.body_weldid[body] === 0 && this.model.body_geomnum[body] === 0;
  }

  /**
   * Whether a geom is where it was after a turn that its symmetry hides.
   * @param {number} i
   * @param {Value} before
   * @param {Value} after
   */
  fillsTheSame(i, before, after) {
    const [a, b, c, d] = /** @type {number[]} */ (before);
    const [e, f, g, h] = /** @type {number[]} */ (after);
    const turn = [a * e + b * f + c * g + d * h, a * f - b * e - c * h + d * g, a * g + b * h - c * e - d * f, a * h - b * g + c * f - d * e];
    const [w, x, y, z] = turn.map((part) => Math.abs(part) < 1e-5);
    const kinds = this.mujoco.mjtGeom;
    switch (this.broken.geom_type[i]) {
      case kinds.mjGEOM_SPHERE.value:
        return true;
      case kinds.mjGEOM_CAPSULE.value:
      case kinds.mjGEOM_CYLINDER.value:
        return (x && y) || (w && z);
      case kinds.mjGEOM_BOX.value:
      case kinds.mjGEOM_ELLIPSOID.value:
        return [w, x, y, z].filter(Boolean).length === 3;
      default:
        return false;
    }
  }

  /** @returns {Generator<string>} */
  *counted() {
    for (const kind of TABLES.counted) {
      const [before, after] = [count(this.broken, kind), count(this.model, kind)];
      if (before !== after) yield `You ${after > before ? "added" : "removed"} ${/^[aeiou]/.test(kind) ? "an" : "a"} ${kind}.`;
    }
  }

  /** @returns {Generator<string>} */
  *options() {
    const [before, after] = [this.broken.opt, this.model.opt];
    if (after.timestep > before.timestep) {
      yield `The timestep is ${general(after.timestep)} s, longer than the model's ${general(before.timestep)} s.`;
    }
    for (const field of TABLES.options) {
      const [here, there] = [[before[field]].flatMap(numbers), [after[field]].flatMap(numbers)];
      if (!same(here, there, field)) yield changed(field, "", here, there);
    }
    const bits = /** @type {Record<string, {value: number}>} */ (/** @type {unknown} */ (this.mujoco.mjtDisableBit));
    for (const flag of TABLES.flags.split(" ")) {
      const bit = bits[`mjDSBL_${flag}`]?.value ?? 0;
      if ((before.disableflags ^ after.disableflags) & bit) {
        yield `You switched ${flag.toLowerCase()} ${after.disableflags & bit ? "off" : "on"}.`;
      }
    }
    if ((before.enableflags ^ after.enableflags) & this.mujoco.mjtEnableBit.mjENBL_SLEEP.value) yield "You switched sleep on or off.";
    if (after.enableflags & this.mujoco.mjtEnableBit.mjENBL_OVERRIDE.value && after.o_margin < 0 && before.o_margin >= 0) {
      yield "You switched contact off, by a margin below zero for all of them.";
    }
    if (before.disableactuator !== after.disableactuator) yield "You switched actuators on or off.";
  }

  /** @returns {Generator<string>} */
  *excessive() {
    for (const [field, most] of Object.entries(TABLES.most)) {
      const size = field.endsWith("prm") ? Math.abs : undefined;
      const [before, after] = [largest(this.broken[field], size), largest(this.model[field], size)];
      if (after > Math.max(most, before)) {
        yield `${field} is ${general(after)}: that holds what should move; at most ${general(most)} is accepted.`;
      }
    }
    for (const field of ["geom_margin", "pair_margin"]) {
      const [before, after] = [this.broken, this.model].map((each) => -largest(each[field], (margin) => -margin));
      if (after < before) yield `${field} is ${general(after)}: below zero things go into each other before they push.`;
    }
    const [inertias, times] = [numbers(this.broken.dof_M0), TABLES.heaviest];
    for (const [i, armature] of this.armature().slice(0, inertias.length).entries()) {
      if (armature > times * inertias[i]) {
        const of = this.name(this.broken, "JOINT", this.broken.dof_jntid[i]);
        yield `The armature of joint ${of} is ${general(armature)}, more than ${times} times its inertia ${general(inertias[i], 3)}.`;
      }
    }
    const after = this.frictionOfFree(this.model);
    if (after > this.frictionOfFree(this.broken)) {
      yield `A free joint has a frictionloss of ${general(after)}: that holds to the world what should be free.`;
    }
  }

  /** The armature of each degree of freedom, with those of actuators, which a gear multiplies twice. */
  armature() {
    const { model } = this;
    const made = numbers(model.dof_armature);
    for (const [i, armature] of numbers(model.actuator_armature ?? []).entries()) {
      if (!armature || model.actuator_trntype[i] > this.mujoco.mjtTrn.mjTRN_JOINTINPARENT.value) continue;
      const [[joint], [gear]] = [row(model.actuator_trnid, i, model.nu), row(model.actuator_gear, i, model.nu)];
      made[model.jnt_dofadr[joint]] += armature * gear ** 2;
    }
    return made;
  }

  /** @param {any} model */
  frictionOfFree(model) {
    const free = this.mujoco.mjtJoint.mjJNT_FREE.value;
    const joints = numbers(model.jnt_dofadr).filter((_, i) => model.jnt_type[i] === free);
    return largest(joints.flatMap((first) => numbers(model.dof_frictionloss.slice(first, first + 6))));
  }

  /**
   * The ids of a kind's elements by name; unnamed ones are called by their order: `#0`.
   * @param {any} model
   * @param {string} kind
   * @returns {Map<string, number>}
   */
  elements(model, kind) {
    let unnamed = 0;
    return new Map(
      Array.from({ length: count(model, kind) }, (_, i) => [this.name(model, kind.toUpperCase(), i) || `#${unnamed++}`, i]),
    );
  }

  /**
   * @param {any} model
   * @param {string | number} kind
   * @param {number} id
   * @returns {string}
   */
  name(model, kind, id) {
    const types = /** @type {Record<string, {value: number}>} */ (/** @type {unknown} */ (this.mujoco.mjtObj));
    return nameOf(this.mujoco, model, typeof kind === "number" ? kind : types[`mjOBJ_${kind}`].value, id);
  }

  /**
   * @param {any} model
   * @param {string} kind
   * @param {string} field
   * @param {number} i
   * @returns {Value}
   */
  value(model, kind, field, i) {
    const prefix = PREFIX[kind] ?? kind;
    if (TABLES.bodies.includes(field)) {
      const other = model[`${prefix}_${field}`][i];
      return other >= 0 ? this.name(model, "BODY", other) : "none";
    }
    if (`${kind}.${field}` in TYPES) return this.type(TYPES[`${kind}.${field}`], model[`${prefix}_${field}`][i]);
    if (field === "trnid") {
      const [type, ids] = [model.actuator_trntype[i], row(model.actuator_trnid, i, model.nu)];
      return type >= 0 && type < TABLES.transmissions.length ? this.name(model, TABLES.transmissions[type], ids[0]) : ids;
    }
    if (field === "objid" || field === "refid") {
      const [type, other] = [model[`sensor_${field.slice(0, 3)}type`][i], model[`sensor_${field}`][i]];
      return other >= 0 ? this.name(model, type, other) || String(other) : "none";
    }
    if (field === "bias") return row(model.actuator_biasprm, i, model.nu).slice(0, 1);
    if (field === "qpos0" || field === "qpos_spring") {
      const scalar = model.jnt_type[i] >= this.mujoco.mjtJoint.mjJNT_SLIDE.value;
      return scalar ? [model[field][model.jnt_qposadr[i]]] : [0];
    }
    if (field in LIMITED) {
      const element = model[prefix](i);
      const limited = element[LIMITED[field]];
      element.delete();
      if (!limited) return UNLIMITED;
    }
    const whole = field === BOOLEAN ? undefined : model[`${prefix}_${field}`];
    return whole ? row(whole, i, count(model, kind)) : null;
  }

  /**
   * What a type is called: `hinge`.
   * @param {Enumeration} enumeration
   * @param {number} number
   */
  type(enumeration, number) {
    const names = Object.entries(this.mujoco[enumeration]);
    const [name] = names.find(([, member]) => member?.value === number) ?? [`_${number}`];
    return name.slice(name.indexOf("_") + 1).toLowerCase();
  }
}

/**
 * What `model` has changed of the task of `broken`, a sentence each; none for a fair repair.
 * @param {MainModule} mujoco
 * @param {MjModel} broken
 * @param {MjModel} model
 * @param {string[]} may what a repair of this case may change as well
 */
export function changes(mujoco, broken, model, may) {
  const compared = new Comparison(mujoco, broken, model, may);
  const kinds = Object.keys(FIELDS).flatMap((kind) => [...compared.ofKind(kind)]);
  return [...kinds, ...compared.counted(), ...compared.options(), ...compared.excessive()];
}

/**
 * The elements of a kind under their old names, where they may be called otherwise.
 * @param {string} kind
 * @param {Map<string, number>} here
 * @param {Map<string, number>} there
 */
function renamed(kind, here, there) {
  if (!TABLES.renamed.includes(kind)) return there;
  const old = new Map([...here].filter(([name]) => !there.has(name)).map(([name, i]) => [i, name]));
  return new Map([...there].map(([name, i]) => [here.has(name) ? name : (old.get(i) ?? name), i]));
}

/**
 * How many elements of a kind there are.
 * @param {any} model
 * @param {string} kind
 * @returns {number}
 */
function count(model, kind) {
  return model[COUNT[kind] ?? `n${kind}`] ?? 0;
}

/**
 * An element's part of a flat array.
 * @param {ArrayLike<number>} whole
 * @param {number} i
 * @param {number} elements
 */
function row(whole, i, elements) {
  const width = whole.length / elements;
  return Array.from({ length: width }, (_, k) => whole[i * width + k]);
}

/** @param {number | ArrayLike<number>} value */
function numbers(value) {
  return typeof value === "number" ? [value] : Array.from(value);
}

/**
 * The largest of some numbers, or of what `size` makes of each; 0 where none is above.
 * @param {ArrayLike<number> | undefined} values
 */
function largest(values, size = (/** @type {number} */ value) => value) {
  return Array.from(values ?? []).reduce((most, value) => Math.max(most, size(value)), 0);
}

/**
 * @param {Value} before
 * @param {Value} after
 * @param {string} field
 */
function same(before, after, field) {
  if (!Array.isArray(before) || !Array.isArray(after)) return before === after;
  if (TABLES.ranges.includes(field) && before.every((value) => Math.abs(value) === Infinity)) return true; // the checks tell whether a new range holds anything back
  if (after.length < before.length) return false; // longer is a keyframe where an actuator was added
  const within = field in LIMITED ? 1e-3 : 1e-4;
  const close = (/** @type {number} */ sign) =>
    before.every((value, k) => value === after[k] || (Number.isFinite(after[k]) && Math.abs(value - sign * after[k]) <= 1e-6 + within * Math.abs(after[k])));
  return close(1) || (field === "quat" && close(-1));
}

/**
 * @param {string} field
 * @param {string} of
 * @param {Value} before
 * @param {Value} after
 */
function changed(field, of, before, after) {
  if (field === "gravity" && Array.isArray(after) && !after.some(Boolean)) return "You turned gravity off.";
  const [here, there] = [before, after].map((value) => (Array.isArray(value) ? told(value) : String(value)));
  return `You changed the ${WORDS[field] ?? field}${of} from ${here} to ${there} ${UNITS[field] ?? ""}`.trimEnd() + ".";
}

/** @param {number[]} values */
function told(values) {
  return values.every((value) => Math.abs(value) === Infinity) ? "none" : values.map((value) => general(value, 4)).join(" ");
}
