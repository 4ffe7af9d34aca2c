// A model compiled from its text and the files that it names.

/** @import {MainModule, MjModel} from "@mujoco/mujoco" */

const MAIN = "clinic-main.xml"; // `from_xml_string` would take the name `model.xml`, which a file may have

/**
 * Compiles a text.
 * @param {MainModule} mujoco
 * @param {string} text
 * @param {[string, Uint8Array][]} files by path from the model's folder; of two with the same path the later counts
 * @returns {MjModel}
 * @throws {Error} with what MuJoCo says
 */
export function compile(mujoco, text, files) {
  const vfs = new mujoco.MjVFS();
  try {
    for (const [path, bytes] of new Map([...files, ...encoded([[MAIN, text]])])) vfs.addBuffer(path, bytes);
    return mujoco.MjModel.from_xml_path(MAIN, vfs);
  } finally {
    vfs.delete();
  }
}

/**
 * Texts as files.
 * @param {[string, string][]} texts
 * @returns {[string, Uint8Array][]}
 */
export function encoded(texts) {
  const encoder = new TextEncoder();
  return texts.map(([path, text]) => [path, encoder.encode(text)]);
}
