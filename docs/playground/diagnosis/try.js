// A finding's edit, tried in the playground on the reader's own model.

import { measured } from "./report.js";

/** @import {CaseRecord} from "../record/types.js" */
/** @import {Diagnosis, Request, Texts} from "./client.js" */

const INCLUDE = /<!--[^]*?-->|<include\s[^>]*?file\s*=\s*["']([^"']+)["'][^>]*?(?:\/>|>\s*<\/include>)/g;
const ROOT = /<(mujoco|mujocoinclude)(?:\s[^>]*)?>([^]*)<\/\1\s*>/;
const DEEPEST = 20; // files that include each other

/**
 * The reader's model as the playground takes it: a record without checks, whose only fix is the edit, begun as the diagnosis
 * began. Of an edit in several files the text is the whole model, with what it includes in the place of each `<include>`.
 * @param {Request} request
 * @param {Diagnosis} made
 * @param {number} index of the finding, causes before hints
 * @returns {CaseRecord}
 */
export function readersRecord({ text: main, name, files }, made, index) {
  const edited = made.edited[index];
  const several = Object.keys(edited).length > 1;
  const file = several ? name : Object.keys(edited)[0];
  const text = several ? whole(made.texts, name) : made.texts[file];
  const after = several ? whole({ ...made.texts, ...edited }, name) : edited[file];
  const found = [...made.data.causes, ...made.data.hints][index];
  const { title, keyframe } = found;
  return {
    ...{ case: name.replace(/\.\w+$/, ""), number: 0, title, engine: "", name: file, text, files, measured: measured(found) },
    ...(file === name ? {} : { main }),
    run: { duration: 1, keyframe, qpos: {}, qvel: {}, ctrl: {} },
    signals: { contacts: { path: "ncon", columns: [], unit: "", label: "number of contacts", seen: true } },
    checks: { broken: [], fixed: [] },
    fixes: [{ id: "edit", title, edits: [{ find: text, replace: after }], needs: "" }],
    ...{ trials: [], task: { may: [] }, refuted: [], camera: null, speed: 1, telling: [], hints: [], guards: [], explained: {} },
  };
}

/**
 * A text with what it includes in the place of each `<include>`.
 * @param {Texts} texts
 * @param {string} file
 * @returns {string}
 */
export function whole(texts, file, depth = 0) {
  return texts[file].replace(INCLUDE, (found, name) => {
    if (!(name in texts) || depth === DEEPEST) return found;
    return ROOT.exec(whole(texts, name, depth + 1))?.[2].trim() ?? found;
  });
}
