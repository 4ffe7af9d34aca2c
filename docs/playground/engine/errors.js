// What the engine says when it refuses a model, made a sentence that a reader can act on.

/** What stands in a message, and what to say instead. The first that fits counts. */
const SENTENCES = /** @type {[RegExp, string][]} */ ([
  [/bad_alloc|^vector$|length_error|allocat|out of memory|basic_string/i, "The model needs more memory than this page's engine has. Look for a very large `nrow`, `ncol`, `count`, `width`, `height` or `memory`."],
  [/XML_ERROR_MISMATCHED_ELEMENT/, "<NAME> is not closed, or is closed by another name: each element ends with `/>` or with its own `</NAME>`."],
  [/XML_ERROR_PARSING_ATTRIBUTE/, 'An attribute cannot be read: each is written `name="value"`, once, with both quotes.'],
  [/XML_ERROR_PARSING_ELEMENT/, "An element cannot be read: look for a `<` too many, or a `>` or a quote that is missing."],
  [/XML_ERROR_PARSING_COMMENT/, "A comment is not closed: it ends with `-->`."],
  [/XML_ERROR_PARSING_(?:CDATA|DECLARATION|UNKNOWN)/, "A part that begins with `<!` or `<?` is not closed."],
  [/XML_ERROR_PARSING_TEXT/, "There is text where an element should be."],
  [/XML_ERROR_PARSING\b/, "What follows the last element is no XML."],
  [/XML_ERROR_EMPTY_DOCUMENT/, "The text is empty: a model begins with `<mujoco>` and ends with `</mujoco>`."],
  [/XML_ELEMENT_DEPTH_EXCEEDED|stack overflow|maximum call stack|memory access out of bounds/i, "The model is nested too deeply for this page's engine, which takes about 100 bodies within each other."],
  [/empty file/i, "The text is empty: a model begins with `<mujoco>` and ends with `</mujoco>`."],
  [/could not open file|resource not found|error opening file|file not found/i, "The model names a file, which this page does not have: write out what it names."],
  [/root element not found|no root element/i, "There is no element: a model begins with `<mujoco>` and ends with `</mujoco>`."],
  [/^unreachable|^table index|^null function|^function signature|RuntimeError|^Aborted/i, "The model ended the engine, which did not say why."],
]);
const UNKNOWN = /unrecognized (?:attribute: '([^']*)'|element)\s+Element '([^']*)'/;
const PREFIX = /^(?:MuJoCo Error: |Loading error: |XML parse error \d+:|Error: )+/;

/**
 * The message of an error of the engine, in a sentence; MuJoCo's own words where they are one.
 * @param {string} message
 */
export function sentence(message) {
  const said = message.trim();
  const found = SENTENCES.find(([pattern]) => pattern.test(said));
  const unknown = UNKNOWN.exec(said);
  if (unknown) return unknown[1] ? `<${unknown[2]}> has no attribute "${unknown[1]}" in this MuJoCo.` : `There is no <${unknown[2]}> at this place in this MuJoCo.`;
  if (!found) return said.replace(PREFIX, "").trim() || "MuJoCo refused it without saying why";
  const name = /XMLElement name=(\S+)/.exec(said)?.[1] ?? "element";
  return found[1].replaceAll("NAME", name);
}

/**
 * The line that a message names, counted from 1.
 * @param {string} message
 */
export function lineOf(message) {
  const found = /line(?: number)?[ =](\d+)/i.exec(message);
  return found && Number(found[1]);
}
