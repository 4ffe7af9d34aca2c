// A text's words as the search compares them: in lower case, without endings, and those of no meaning left out.

import { stemmer } from "stemmer";

const STOP = new Set(
  (
    "a about after again all also although always am an and any apply applies are as at be been but by can cannot cant could did do does doesn dont for from get gets got had has have " +
    "how i if in instead into is isn it its just keep keeps like ll make makes me my never no not of off on only or our out s should so some still t than that the their " +
    "them then there these they this to too try trying up use used using ve very was wasn we were what when where which while who why will with won yet " +
    "without work works would you your mujoco simulation simulator simulate sim model robot please help problem issue wrong weird strange"
  ).split(" "),
);

/** @param {string} text @returns {string[]} */
export const words = (text) =>
  text
    .normalize("NFKD")
    .toLowerCase()
    .replace(/['’]/g, "")
    .split(/[^\p{L}\p{N}_]+/u)
    .flatMap((word) => (word.includes("_") ? [word, ...word.split("_")] : [word]))
    .filter(Boolean);

/** @param {string} word @returns {string} its stem; empty for a word of no meaning */
export const stem = (word) => (STOP.has(word) || (word.length === 1 && !/\d/.test(word)) ? "" : stemmer(word));

/** @param {string} text @returns {string[]} the stems, each once */
export const stems = (text) => [...new Set(words(text).map(stem))].filter(Boolean);

/** @param {string} text @returns {string[]} each two stems that follow one another, what has no meaning left out */
export const pairs = (text) => {
  const there = words(text).map(stem).filter(Boolean);
  return there.slice(1).map((each, k) => `${there[k]} ${each}`);
};

/**
 * For every phrase of a group of synonyms the stems of the others.
 *
 * @param {string[][]} groups
 * @returns {(query: string) => Map<string, Set<string>>} by each stem of a query that stands in a group, the stems that mean the same
 */
export function thesaurus(groups) {
  const entries = groups.flatMap((group) => group.map((phrase) => ({ phrase: all(phrase), others: group.filter((other) => other !== phrase).flatMap(stems) })));
  return (query) => {
    const said = ` ${all(query)} `;
    /** @type {Map<string, Set<string>>} */
    const found = new Map();
    for (const { phrase, others } of entries) {
      if (!said.includes(` ${phrase} `)) continue;
      for (const each of phrase.split(" ").filter((part) => stems(query).includes(part))) {
        found.set(each, new Set([...(found.get(each) ?? []), ...others]));
      }
    }
    return found;
  };
}

/** @param {string} text */
const all = (text) => words(text).map(stemmer).join(" ");
