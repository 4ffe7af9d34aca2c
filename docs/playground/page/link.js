// An edited text in the fragment of an address: deflated, in base64 for URLs.

const KEY = "#model=";
const MAX_TEXT = 1_000_000; // characters: a longer one is neither written nor read

/**
 * Packs a text into a fragment.
 * @param {string} text
 * @returns {Promise<string | null>} the fragment, with its `#`; null if the text is too long for a link
 */
export async function toFragment(text) {
  if (text.length > MAX_TEXT) return null;
  const packed = await new Response(new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"))).arrayBuffer();
  const binary = Array.from(new Uint8Array(packed), (byte) => String.fromCharCode(byte)).join("");
  return KEY + btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/**
 * What came with an address: a text, or why it cannot be read, in a sentence.
 * @typedef {{text: string} | {problem: string}} Linked
 */

/**
 * Unpacks the text of a fragment.
 * @param {string} fragment
 * @returns {Promise<Linked | null>} null if there is none
 */
export async function fromFragment(fragment) {
  if (!fragment.startsWith(KEY)) return null;
  try {
    const binary = atob(fragment.slice(KEY.length).replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(binary, (char) => char.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    const reader = stream.pipeThrough(new TextDecoderStream("utf-8", { fatal: true })).getReader();
    let text = "";
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      text += part.value;
      if (text.length > MAX_TEXT) {
        await reader.cancel();
        return { problem: `The text in this link is too long: more than ${MAX_TEXT.toLocaleString("en")} characters.` };
      }
    }
    return { text };
  } catch {
    return { problem: "This link is damaged: the text in it cannot be read. Perhaps its end was cut off when it was copied." };
  }
}
