// A model compiled from its text and the files that it names.

/** @import {MainModule, MjModel} from "@mujoco/mujoco" */

const MAIN = "clinic-main.xml"; // `from_xml_string` would take the name `model.xml`, which a file may have
const UNOPENED = "opening file";
const DEEP = "/of".repeat(16); // where the model's folder is, when its paths are absolute

/**
 * Compiles a text.
 * @param {MainModule} mujoco
 * @param {string} text
 * @param {[string, Uint8Array][]} files by path from the model's folder; of two with the same path the later counts
 * @returns {MjModel}
 * @throws {Error} with what MuJoCo says
 */
export function compile(mujoco, text, files) {
  const all = new Map([...files, ...encoded([[MAIN, text]])]);
  try {
    return loaded(mujoco, MAIN, all);
  } catch (error) {
    if (!String(error).includes(UNOPENED)) throw error;
    try {
      // MuJoCo loses a `..` of what it puts together of relative folders
      return loaded(mujoco, absolute(MAIN), new Map([...all].map(([path, bytes]) => [absolute(path), bytes])));
    } catch {
      throw error;
    }
  }
}

/**
 * @param {MainModule} mujoco
 * @param {string} main
 * @param {Map<string, Uint8Array>} files
 * @returns {MjModel}
 */
function loaded(mujoco, main, files) {
  const vfs = new mujoco.MjVFS();
  try {
    for (const [path, bytes] of files) vfs.addBuffer(path, bytes);
    return mujoco.MjModel.from_xml_path(main, vfs);
  } finally {
    vfs.delete();
  }
}

/** @param {string} path from the model's folder */
function absolute(path) {
  return decodeURIComponent(new URL(encodeURIComponent(path).replaceAll("%2F", "/"), `file://${DEEP}/`).pathname);
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
