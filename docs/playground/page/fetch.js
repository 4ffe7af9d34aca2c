// Bytes of the site's own files.

/** @type {Map<string, Promise<string>>} */
const kept = new Map();

/**
 * The bytes of a file that may be gzipped; some servers inflate it on the way.
 * @param {string} url
 * @returns {Promise<ArrayBuffer>}
 */
export async function fetchBytes(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${new URL(url).pathname} could not be loaded (${response.status})`);
  const bytes = await response.arrayBuffer();
  const [first, second] = new Uint8Array(bytes, 0, Math.min(2, bytes.byteLength));
  if (first !== 0x1f || second !== 0x8b) return bytes;
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/**
 * An address in this page's memory for a file of the site: it is fetched once, and then there without a network too.
 * @param {string} url
 * @param {(bytes: number) => void} arrived called with every part of it
 * @returns {Promise<string>}
 */
export function keep(url, arrived) {
  const made = kept.get(url) ?? fetched(url, arrived);
  kept.set(url, made);
  made.catch(() => kept.delete(url));
  return made;
}

/**
 * @param {string} url
 * @param {(bytes: number) => void} arrived
 */
async function fetched(url, arrived) {
  const response = await fetch(url);
  if (!response.ok || !response.body) throw new Error(`${new URL(url).pathname} could not be loaded (${response.status})`);
  /** @type {Uint8Array<ArrayBuffer>[]} */
  const parts = [];
  const reader = response.body.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    arrived(part.value.length);
  }
  return URL.createObjectURL(new Blob(parts, { type: "text/javascript" })); // the type matters to scripts only
}
