// What a reader drops: a model, or a folder or zip with its meshes, as files by path.

import { unzip } from "fflate";

export const MAX_FILES = 5000;
export const MAX_BYTES = 300_000_000; // in all, unpacked
const MAX_TEXT = 20_000_000; // bytes of a model
const MODEL = /\.(xml|mjcf|urdf)$/i;
const HIDDEN = /(^|\/)(\.|__MACOSX\/)/;

/** What cannot be read, in a sentence. */
export class FilesError extends Error {}

/**
 * The files of a drop or a choice; zips are unpacked.
 * @param {Iterable<FileSystemEntry | File>} given what was dropped, or chosen
 * @returns {Promise<Map<string, Uint8Array<ArrayBuffer>>>} by path
 * @throws {FilesError} if there are too many, or they cannot be read
 */
export async function readFiles(given) {
  /** @type {[string, File][]} */
  let found = [];
  for (const each of given) {
    if (each instanceof File) found.push([each.webkitRelativePath || each.name, each]);
    else await walk(each, found);
  }
  found = found.filter(([path]) => !HIDDEN.test(path));
  if (found.length > MAX_FILES || found.reduce((sum, [, file]) => sum + file.size, 0) > MAX_BYTES) throw new FilesError(tooLarge());
  /** @type {Map<string, Uint8Array<ArrayBuffer>>} */
  const made = new Map();
  for (const [path, file] of found) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.zip$/i.test(path)) for (const [name, content] of await unpacked(bytes, path)) made.set(name.replaceAll("\\", "/"), content);
    else made.set(path, bytes);
  }
  return made;
}

/**
 * @param {FileSystemEntry} entry
 * @param {[string, File][]} found
 */
async function walk(entry, found) {
  if (found.length > MAX_FILES) throw new FilesError(tooLarge());
  const path = entry.fullPath.replace(/^\//, "");
  if (entry.isFile) {
    const file = await new Promise((resolve, reject) => /** @type {FileSystemFileEntry} */ (entry).file(resolve, reject));
    found.push([path, file]);
    return;
  }
  const reader = /** @type {FileSystemDirectoryEntry} */ (entry).createReader();
  for (;;) {
    /** @type {FileSystemEntry[]} */
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return;
    for (const inner of some) if (!inner.name.startsWith(".")) await walk(inner, found);
  }
}

/**
 * @param {Uint8Array} bytes
 * @param {string} path of the zip
 * @returns {Promise<[string, Uint8Array<ArrayBuffer>][]>}
 */
function unpacked(bytes, path) {
  let [size, count] = [0, 0];
  return new Promise((resolve, reject) => {
    const filter = (/** @type {{name: string, originalSize: number}} */ { name, originalSize }) => {
      [size, count] = [size + originalSize, count + 1];
      return !name.endsWith("/") && !HIDDEN.test(name) && size <= MAX_BYTES && count <= MAX_FILES;
    };
    unzip(bytes, { filter }, (error, files) => {
      if (error) reject(new FilesError(`${path} cannot be unpacked: ${error.message}.`));
      else if (size > MAX_BYTES || count > MAX_FILES) reject(new FilesError(`${path}: ${tooLarge()}`));
      else resolve(/** @type {[string, Uint8Array<ArrayBuffer>][]} */ (Object.entries(files)));
    });
  });
}

function tooLarge() {
  return `more than ${megabytes(MAX_BYTES)} or ${MAX_FILES} files: give the model's own folder only.`;
}

/**
 * The models among files, the likeliest first: those that no other includes, scenes before parts.
 * @param {Map<string, Uint8Array>} files
 * @returns {string[]}
 */
export function models(files) {
  const given = [...files].filter(([path]) => MODEL.test(path));
  const texts = given.map(([path, bytes]) => ({ path, text: new TextDecoder().decode(bytes.subarray(0, MAX_TEXT)) }));
  const whole = texts.filter(({ text, path }) => /<(mujoco|robot)[\s>]/.test(text) || texts.length === 1 || /\.urdf$/i.test(path));
  const included = new Set(whole.flatMap(({ path, text }) => includes(text).map((name) => resolved(path, name))));
  const main = whole.filter(({ path }) => !included.has(path));
  const rank = (/** @type {string} */ path) => (/scene/i.test(path) ? 0 : 1) + path.split("/").length / 100;
  return (main.length > 0 ? main : whole).map(({ path }) => path).sort((a, b) => rank(a) - rank(b));
}

/**
 * The text of a model.
 * @param {Map<string, Uint8Array>} files
 * @param {string} path
 * @throws {FilesError} if it is too large, or no text
 */
export function textOf(files, path) {
  const bytes = files.get(path) ?? new Uint8Array();
  const large = bytes.length > MAX_TEXT;
  if (large) throw new FilesError(`the text has ${megabytes(bytes.length)}; this page reads up to ${megabytes(MAX_TEXT)}. \`clinic diagnose\` in a terminal reads more.`);
  if (bytes.includes(0)) throw new FilesError("this is not a text in UTF-8; expected MJCF or URDF.");
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder("latin1").decode(bytes); // byte by byte, as MuJoCo reads it
  }
}

/**
 * The last part of a path.
 * @param {string} path
 */
export function last(path) {
  return path.slice(Math.max(path.lastIndexOf("/"), path.lastIndexOf("\\")) + 1);
}

/** @param {number} bytes */
function megabytes(bytes) {
  return `${Math.round(bytes / 1e6)} MB`;
}

/** @param {string} text */
function includes(text) {
  return [...text.matchAll(/<include\s[^>]*?file\s*=\s*["']([^"']+)["']/g)].map((found) => found[1]);
}

/**
 * @param {string} from
 * @param {string} name
 */
function resolved(from, name) {
  return decodeURIComponent(new URL(name, `file:///${encodeURI(from)}`).pathname.slice(1));
}

/**
 * The files that a model may need, by their path as seen from its folder: all texts, and what is named in one of them.
 * @param {Map<string, Uint8Array<ArrayBuffer>>} files
 * @param {string} main
 * @returns {[string, Uint8Array<ArrayBuffer>][]}
 */
export function seenFrom(files, main) {
  const here = main.split("/").slice(0, -1);
  const texts = [...files].filter(([path, bytes]) => MODEL.test(path) && bytes.length <= MAX_TEXT);
  const written = texts.flatMap(([, bytes]) => [...new TextDecoder().decode(bytes).matchAll(/["']([^"']+\.\w+)["']/g)]);
  const names = new Set(written.map(([, name]) => last(name)));
  const named = [...files].filter(([path]) => MODEL.test(path) || names.has(last(path)));
  return named.map(([path, bytes]) => {
    const parts = path.split("/");
    let same = 0;
    while (same < here.length && same < parts.length - 1 && here[same] === parts[same]) same += 1;
    return [[...here.slice(same).map(() => ".."), ...parts.slice(same)].join("/"), bytes];
  });
}
