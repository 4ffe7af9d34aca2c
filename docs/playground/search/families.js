// Which symptom a query speaks of: the same reckoning as `family_shares` in scripts/clinic/record/families.py.

const SUFFIX = /(?<=[a-z]{3})(?:ations?|ings?|ies|ed|es|s|ly|e|y)$/;
const DOUBLE = /([bdfglmnprtz])\1$/;
const STOP = /[.;!?](?:\s|$)/;
const NOT = new Set("no never cannot without unable fail nothing nobody barely".split(" "));
const IDLE = new Set(
  (
    "a an and are as at be been but by can did do does doing done for from had has have i if in is it its me my of on " +
    "or so that the their them there they this to was we were when while with you your mujoco simulation"
  ).split(" "),
);

const SHARP = 12;
const UNIT = 40;
const NOUGHT = 80;

/** @typedef {{families: string[], prior: number[], stems: string, adds: string[]}} Weights what stems say, by family, in fortieths, a letter each */

/**
 * @param {Weights} weights
 * @returns {(query: string) => Map<string, number>} how likely the query speaks of each family; empty if it has no word of any
 */
export function shares({ families, prior, stems, adds }) {
  const places = new Map(stems.split(" ").map((stem, place) => [stem, place]));
  return (query) => {
    const said = [...stemmed(query)].map((stem) => places.get(stem)).filter((place) => place !== undefined);
    if (!said.length) return new Map();
    const added = adds.map((letters) => sum(said.map((place) => letters.charCodeAt(place) - NOUGHT)));
    const scores = prior.map((each, family) => (SHARP / UNIT) * (each + added[family] / Math.sqrt(said.length)));
    const odds = scores.map((score) => Math.exp(score - Math.max(...scores)));
    const total = sum(odds);
    return new Map(families.map((family, index) => [family, odds[index] / total]));
  };
}

/** @param {Weights} weights @param {string[]} queries @returns {Record<string, number>[]} */
export function told(weights, queries) {
  const spoken = shares(weights);
  return queries.map((query) => Object.fromEntries(spoken(query)));
}

/** @param {Iterable<number>} numbers */
const sum = (numbers) => [...numbers].reduce((total, number) => total + number, 0);

/** @param {string} text @returns {Set<string>} */
function stemmed(text) {
  /** @type {Set<string>} */
  const said = new Set();
  for (const clause of text.toLowerCase().replace(/n['’]t\b/g, " not").split(STOP)) {
    const found = clause.match(/[a-z0-9_]+/g) ?? [];
    const stems = found.filter((word) => !IDLE.has(word)).map((word) => word.replace(SUFFIX, "").replace(DOUBLE, "$1"));
    const heard = stems.map((stem) => (NOT.has(stem) ? "not" : stem));
    for (const stem of heard) said.add(stem);
    for (const gap of [1, 2]) heard.slice(gap).forEach((stem, at) => heard[at] === "not" && said.add(`not_${stem}`));
  }
  return said;
}
