// A cause's edit, tried in the playground on the reader's own model.

/** @import {CaseRecord} from "../record/types.js" */
/** @import {Diagnosis, Request} from "./client.js" */

/**
 * The reader's model as the playground takes it: a record without checks, whose only fix is the edit.
 * @param {Request} request
 * @param {Diagnosis} made
 * @param {number} index of the cause
 * @returns {CaseRecord}
 */
export function readersRecord({ text: main, name, files }, made, index) {
  const [[file, edited]] = Object.entries(made.edited[index]);
  const { title } = made.data.causes[index];
  const text = made.texts[file];
  return {
    ...{ case: name.replace(/\.\w+$/, ""), number: 0, title, engine: "", name: file, text, files },
    ...(file === name ? {} : { main }),
    run: { duration: 1, keyframe: null, qpos: {}, qvel: {}, ctrl: {} },
    signals: { contacts: { path: "ncon", columns: [], unit: "", label: "number of contacts" } },
    checks: { broken: [], fixed: [] },
    fixes: [{ id: "edit", title, edits: [{ find: text, replace: edited }], needs: "" }],
    ...{ trials: [], task: { may: [] }, refuted: [], camera: "", speed: 1, telling: [], hints: [], explained: {} },
  };
}
