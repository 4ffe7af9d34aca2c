// A variant: the broken text of a case after named text edits.

/** @import {Edit} from "../record/types.js" */

/** An edit whose text does not occur exactly once. */
export class EditError extends Error {
  /**
   * @param {number} index which edit of the sequence
   * @param {number} count how often its text occurs
   */
  constructor(index, count) {
    super(`edit ${index} matches ${count} times`);
    this.index = index;
    this.count = count;
  }
}

/**
 * The text after the edits, applied in order.
 * @param {string} text
 * @param {readonly Edit[]} edits
 * @returns {string}
 * @throws {EditError} if an edit's text does not occur exactly once
 */
export function applyEdits(text, edits) {
  edits.forEach((edit, index) => {
    const count = occurrences(text, edit.find);
    if (count !== 1) throw new EditError(index, count);
    text = text.replace(edit.find, () => edit.replace);
  });
  return text;
}

/**
 * How often `part` occurs, overlaps included.
 * @param {string} text
 * @param {string} part
 */
function occurrences(text, part) {
  let count = 0;
  for (let at = text.indexOf(part); at >= 0; at = text.indexOf(part, at + 1)) count += 1;
  return count;
}
