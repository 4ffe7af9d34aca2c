// Signals: paths into MuJoCo's named access, parsed and bound to a model, never evaluated as code.
// The paths are those of scripts/clinic/engine/signals.py.

/** @import {DoubleBuffer, MainModule, MjData, MjModel} from "@mujoco/mujoco" */
/** @import {PathSignal} from "../record/types.js" */

/**
 * @typedef {object} Path
 * @property {boolean} model whether the field is the model's rather than the data's
 * @property {string} kind `body`, `contact`, `warning`, ...; empty for a plain field
 * @property {string} name the text in parentheses
 * @property {string} field the attribute, with dots for nested ones
 * @property {number[]} index the indices; empty when none was written
 */

/** A path that cannot be read. */
export class SignalError extends Error {}

/** Kinds of named elements: the accessor's name here, and the name of the object type. */
const KINDS = /** @type {const} */ ({
  body: ["body", "mjOBJ_BODY"],
  joint: ["jnt", "mjOBJ_JOINT"],
  geom: ["geom", "mjOBJ_GEOM"],
  site: ["site", "mjOBJ_SITE"],
  camera: ["cam", "mjOBJ_CAMERA"],
  actuator: ["actuator", "mjOBJ_ACTUATOR"],
  tendon: ["tendon", "mjOBJ_TENDON"],
  sensor: ["sensor", "mjOBJ_SENSOR"],
  light: ["light", "mjOBJ_LIGHT"],
  equality: ["eq", "mjOBJ_EQUALITY"],
  key: ["key", "mjOBJ_KEY"],
});
/** @typedef {keyof typeof KINDS} Kind */

const PATH = /^(model\.)?(?:([a-z]+)\(([^()]*)\))?\.?([A-Za-z_][A-Za-z0-9_.]*)?((?:\[-?\d+\])*)$/;

/**
 * The path's parts.
 * @param {string} text
 * @returns {Path}
 * @throws {SignalError} if the text is no path
 */
export function parsePath(text) {
  const match = PATH.exec(text.trim());
  if (!match || !(match[2] || match[4])) throw new SignalError(`${text} is no signal path`);
  const [, model, kind = "", name = "", written = "", brackets = ""] = match;
  if (kind && !Object.hasOwn(KINDS, kind) && !["contact", "warning"].includes(kind)) {
    throw new SignalError(`${kind}(...) is no kind of element`);
  }
  const field = kind === "sensor" && !written ? "data" : written;
  const index = Array.from(brackets.matchAll(/-?\d+/g), ([digits]) => Number(digits));
  return { model: Boolean(model), kind, name: name.trim(), field, index };
}

/**
 * A function of no arguments that reads the signal's present value.
 *
 * Arrays are looked up at every reading: their memory moves when the module's heap grows.
 * @param {PathSignal} signal
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {MjData} data
 * @param {{delete: () => void}[]} held receives what has to be freed when the reader is no longer used
 * @returns {() => number}
 * @throws {SignalError} if the model has no such element, field or index
 */
export function bind(signal, mujoco, model, data, held) {
  const path = parsePath(signal.path);
  if (path.kind === "warning") return bindWarning(path, mujoco, data);
  if (path.kind === "contact") return bindContact(path, mujoco, model, data);
  /** @type {any} */
  const owner = path.model ? model : data;
  if (path.kind === "") return bindField(path, owner, signal.columns);
  const element = named(path, mujoco, model, owner);
  held.push(element);
  return bindField(path, element, []);
}

/**
 * The id of a named element.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {Kind} kind
 * @param {string} name
 * @returns {number}
 * @throws {SignalError} if the model has none of that name
 */
export function requireId(mujoco, model, kind, name) {
  const id = mujoco.mj_name2id(model, mujoco.mjtObj[KINDS[kind][1]].value, name);
  if (id < 0) throw new SignalError(`the model has no ${kind} named ${name}`);
  return id;
}

/**
 * An element's name; empty if it has none, for which the binding gives whatever text stands at address 0.
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {number} type of object
 * @param {number} id
 */
export function nameOf(mujoco, model, type, id) {
  const name = mujoco.mj_id2name(model, type, id);
  return mujoco.mj_name2id(model, type, name) === id ? name : "";
}

/**
 * @param {Path} path
 * @param {any} owner
 * @param {number[]} columns
 * @returns {() => number}
 */
function bindField(path, owner, columns) {
  const [holder, last, at] = place(path, owner, columns);
  return at === null ? () => holder[last] : () => holder[last][at] ?? NaN;
}

/**
 * Where a field's number is: what holds the field, the field's name, and the place in its array; null if it is a number.
 * @param {Path} path
 * @param {any} owner
 * @param {number[]} columns
 * @returns {[any, string, number | null]}
 */
function place(path, owner, columns) {
  const parents = path.field.split(".");
  const last = /** @type {string} */ (parents.pop());
  for (const parent of parents) owner = present(owner, parent, path);
  if (typeof present(owner, last, path) === "number") return [owner, last, null];
  const at = flatIndex(path, columns);
  const grows = path.kind === "" && !path.model && last.startsWith("efc_");
  if (!grows && !(at < owner[last].length)) throw new SignalError(`${path.field} has no entry ${at}`);
  return [owner, last, at];
}

/**
 * Writes one number to where a signal's path reads it.
 * @param {{path: string, columns: number[]}} number
 * @param {number} value
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {MjData} data
 * @throws {SignalError} if the model has no such number
 */
export function write(number, value, mujoco, model, data) {
  const path = parsePath(number.path);
  /** @type {any} */
  const owner = path.model ? model : data;
  const element = path.kind ? named(path, mujoco, model, owner) : null;
  try {
    const [holder, last, at] = place(path, element ?? owner, number.columns);
    if (at === null) holder[last] = value;
    else holder[last][at] = value;
  } finally {
    element?.delete();
  }
}

/**
 * @param {Path} path
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {any} owner
 */
function named(path, mujoco, model, owner) {
  const kind = /** @type {Kind} */ (path.kind);
  requireId(mujoco, model, kind, path.name);
  return owner[KINDS[kind][0]](path.name);
}

/**
 * @param {any} owner
 * @param {string} name
 * @param {Path} path
 */
function present(owner, name, path) {
  const value = name in owner ? owner[name] : undefined;
  if (value === undefined || value === null || typeof value === "function") {
    throw new SignalError(`${path.name || (path.model ? "the model" : "the data")} has no field ${name}`);
  }
  return value;
}

/**
 * @param {Path} path
 * @param {number[]} columns
 */
function flatIndex(path, columns) {
  const index = path.index.length ? path.index : [0];
  return index.reduce((flat, i, k) => flat * (k ? columns[k - 1] : 1) + i, 0);
}

/**
 * @param {Path} path
 * @param {MainModule} mujoco
 * @param {MjData} data
 */
function bindWarning(path, mujoco, data) {
  const kinds = /** @type {Record<string, {value: number}>} */ (/** @type {unknown} */ (mujoco.mjtWarning));
  const kind = kinds[`mjWARN_${path.name}`];
  if (!kind) throw new SignalError(`MuJoCo has no warning ${path.name}`);
  return () => warningStat(data, kind.value).number;
}

/**
 * A warning's counter.
 * @param {MjData} data
 * @param {number} id
 */
export function warningStat(data, id) {
  const stat = /** @type {any} */ (data.warning.get(id)); // a copy; the list itself is not, and freeing it aborts
  const { number, lastinfo } = stat;
  stat.delete();
  return { number, lastinfo };
}

/**
 * @param {Path} path
 * @param {MainModule} mujoco
 * @param {MjModel} model
 * @param {MjData} data
 */
function bindContact(path, mujoco, model, data) {
  const at = path.index[0] ?? 0;
  const pair = path.name === "*" ? null : path.name.split(",").map((name) => requireId(mujoco, model, "geom", name.trim()));
  const force = path.field === "force" ? forceBuffer(mujoco) : null;
  return () => {
    let [count, largest] = [0, NaN];
    if (data.ncon > 0) {
      const contacts = data.contact; // a copy, which has to be freed, as has every contact taken from it
      for (let i = 0; i < data.ncon; i++) {
        const contact = /** @type {any} */ (contacts.get(i));
        const [first, second] = contact.geom;
        if (!pair || (first === pair[0] && second === pair[1]) || (first === pair[1] && second === pair[0])) {
          count += 1;
          if (force) mujoco.mj_contactForce(model, data, i, force);
          const value = force ? force.GetView() : path.field === "count" ? 0 : contact[path.field];
          const number = typeof value === "number" ? value : value[at];
          largest = number <= largest ? largest : number;
        }
        contact.delete();
      }
      contacts.delete();
    }
    return path.field === "count" ? count : largest;
  };
}

/** @type {WeakMap<MainModule, DoubleBuffer>} */
const buffers = new WeakMap();

/** @param {MainModule} mujoco */
function forceBuffer(mujoco) {
  const buffer = buffers.get(mujoco) ?? new mujoco.DoubleBuffer(6);
  buffers.set(mujoco, buffer);
  return buffer;
}
