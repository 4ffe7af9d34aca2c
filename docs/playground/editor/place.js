// Where in a model's text something stands: in which element, and whether it is a name, an attribute or a value.

const PART = /<!--[^]*?(?:-->|$)|<\?[^]*?(?:\?>|$)|<(\/?)([\w:.-]*)((?:[^<>"']|"[^"]*(?:"|$)|'[^']*(?:'|$))*)(\/?>)?/g;

/**
 * What stands at a place of a text.
 * @typedef {object} Place
 * @property {"element" | "attribute" | "value"} kind
 * @property {string} word as far as it stands before the place
 * @property {string} element around which it is; of an element itself the element
 * @property {string} parent the element around that one; empty for the outermost
 * @property {string} attribute of a value
 */

/**
 * @param {string} text
 * @param {number} at
 * @returns {Place | null} null where neither an element nor an attribute can stand
 */
export function placeOf(text, at) {
  const before = text.slice(0, at);
  /** @type {string[]} */
  const open = [];
  for (const found of before.matchAll(PART)) {
    const [whole, closing, name, rest, end] = found;
    if (name === undefined) {
      if (found.index + whole.length === at && !/(?:-->|\?>)$/.test(whole)) return null;
      continue;
    }
    if (end === undefined && found.index + whole.length === at) return inside(closing ? (open.pop() ?? name) : name, name, rest, open.at(-1) ?? "");
    if (closing) open.splice(Math.max(open.lastIndexOf(name), 0));
    else if (end === ">" && !rest.endsWith("/")) open.push(name);
  }
  return null;
}

/**
 * @param {string} element
 * @param {string} name as it is written
 * @param {string} rest of the element after its name
 * @param {string} parent
 * @returns {Place | null}
 */
function inside(element, name, rest, parent) {
  if (rest === "") return { kind: "element", word: name, element, parent, attribute: "" };
  const value = /([\w:.-]+)\s*=\s*(["'])([^"']*)$/.exec(rest);
  const closed = value && (rest.split(value[2]).length - 1) % 2 === 0;
  if (value && !closed) return { kind: "value", word: value[3], element, parent, attribute: value[1] };
  const attribute = /(?:^|[\s"'])([\w:.-]*)$/.exec(rest);
  return attribute && { kind: "attribute", word: attribute[1], element, parent, attribute: "" };
}

/**
 * The names of the attributes that stand in the element around a place.
 * @param {string} text
 * @param {number} at
 */
export function attributesAround(text, at) {
  const from = text.lastIndexOf("<", at - 1);
  const to = text.indexOf(">", at);
  return new Set(Array.from(text.slice(from, to < 0 ? text.length : to).matchAll(/([\w:.-]+)\s*=/g), ([, name]) => name));
}
