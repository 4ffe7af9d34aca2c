// The types of `playground.json`, as scripts/clinic/pages/playground.py writes it. See the record's reference for their meaning.

/**
 * @typedef {{find: string, replace: string}} Edit
 * @typedef {{id: string, title: string, edits: Edit[], needs: string, why?: string}} Remedy needs: the release of MuJoCo, if not
 *   every one will do; why: of what does not help, in words
 * @typedef {"final" | "first" | "min" | "max" | "mean" | "span" | "onset"} Take
 *
 * @typedef {object} Comparison
 * @property {number} [above]
 * @property {number} [below]
 * @property {[number, number]} [between]
 * @property {number} [equals]
 * @property {number} [within]
 *
 * @typedef {Comparison & {signal: string, take: Take, window?: [number, number]}} Check
 *
 * @typedef {object} Described
 * @property {string} unit
 * @property {string} label
 * @property {boolean} seen whether it tells what is seen, and not why
 *
 * @typedef {Described & {path: string, columns: number[]}} PathSignal columns: the lengths of all dimensions but the first
 * @typedef {Described & {expr: string}} ExpressionSignal
 * @typedef {Described & {measure: "fraction_of_starts", joint: string, index: number, offset: [number, number],
 *   count: number, holds: Check}} StartsSignal
 * @typedef {Described & {measure: "image_row", camera: string, geom: string}} RowSignal
 * @typedef {PathSignal | ExpressionSignal | StartsSignal | RowSignal} Signal
 *
 * @typedef {object} RunSpec
 * @property {number} duration in s
 * @property {string | number | null} keyframe its name; of a reader's own model its number
 * @property {Record<string, number>} qpos
 * @property {Record<string, number>} qvel
 * @property {Record<string, number | [number, number][]>} ctrl
 *
 * @typedef {{path: string, columns: number[], value: number}} Written a number written to a path
 *
 * @typedef {object} Trial
 * @property {string} title
 * @property {Written[]} start
 * @property {Written[]} set
 * @property {Record<string, number | [number, number][]>} ctrl
 * @property {number | null} duration in s
 * @property {{broken?: Check[], fixed?: Check[]}} checks
 *
 * @typedef {object} CaseRecord
 * @property {string} case
 * @property {number} number
 * @property {string} title
 * @property {string} engine the version of MuJoCo that made the evidence
 * @property {string} name the model's file name
 * @property {string} text the broken model
 * @property {RunSpec} run
 * @property {Record<string, Signal>} signals
 * @property {{broken: Check[], fixed: Check[]}} checks
 * @property {Trial[]} trials
 * @property {{may: string[]}} task
 * @property {Remedy[]} fixes
 * @property {Remedy[]} refuted
 * @property {string | null} camera the record's own; null for a view of all
 * @property {number} speed simulated seconds a second
 * @property {string[]} telling the overlays that show the cause
 * @property {{title: string, text: string}[]} hints
 * @property {{symptom: boolean, against: string[]}[]} guards of every check in `checks.fixed`, whether the broken model fails it, and
 *   which remedies that do not help do; empty if that is not known
 * @property {Record<string, {href: string, title: string}[]>} explained pages that explain a warning
 * @property {[string, Uint8Array][]} [files] what a reader's own model names, by path from its folder
 * @property {string} [measured] what the diagnosis measured in it, in a sentence
 * @property {string} [main] the text of the reader's model, if `text` is that of a file that it includes
 */

export {};
