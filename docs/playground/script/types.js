// The types of scripts and instruments, as scripts/clinic/pages/script_playground.py and the cases' `instrument.mjs` have them.

/** @import {CaseRecord, Check, Edit, Remedy, Signal} from "../record/types.js" */

/**
 * @typedef {object} ScriptTrial
 * @property {string} title
 * @property {string | null} file that `edits` change; the script
 * @property {Edit[]} edits
 * @property {{broken?: Check[], fixed?: Check[]}} checks
 *
 * @typedef {object} ScriptRecord `playground.json` of a code case
 * @property {string} case
 * @property {string} title
 * @property {"javascript" | "python"} language
 * @property {string} name of the script
 * @property {string} text the broken script
 * @property {Record<string, string>} files that it reads, by name
 * @property {string | null} instrument its text
 * @property {Record<string, Signal>} signals
 * @property {{broken: Check[], fixed: Check[]}} checks
 * @property {ScriptTrial[]} trials
 * @property {Remedy[]} fixes
 * @property {CaseRecord["refuted"]} refuted
 * @property {CaseRecord["guards"]} guards
 *
 * What an instrument has its reader press or move: a button, or a slider where there is a `max`.
 * @typedef {object} Control
 * @property {string} name
 * @property {string} label
 * @property {number} [min]
 * @property {number} [max]
 * @property {number} [step]
 * @property {number} [value]
 * @property {string} [unit]
 *
 * @typedef {[string, string, ("same" | "differs")?]} Row a label, what it reads, and whether it agrees with what it should
 *
 * @typedef {object} Instrument
 * @property {(name: string, value: number) => void} use a control was pressed or moved
 * @property {() => Row[]} read
 */

export {};
