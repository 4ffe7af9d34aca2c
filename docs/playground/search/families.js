// Which symptom a query speaks of: the same reckoning as `family_shares` in scripts/clinic/record/families.py.

const SUFFIX = /(?<=[a-z]{3})(?:ations?|ings?|ies|ed|es|s|ly|e|y)$/;
const DOUBLE = /([bdfglmnprtz])\1$/;
const NOT = new Set("no never cannot without unable fail nothing nobody barely".split(" "));
const IDLE = new Set(
  (
    "a an and are as at be been but by can did do does doing done for from had has have i if in is it its me my of on " +
    "or so that the their them there they this to was we were when while with you your mujoco simulation"
  ).split(" "),
);

/** @typedef {Record<string, Record<string, number>>} Counts how often each stem stands in what people say of each family */

/**
 * @param {Counts} counts
 * @returns {(query: string) => Map<string, number>} how likely the query speaks of each family; empty if it has no word of any
 */
export function shares(counts) {
  const table = new Map(Object.entries(counts));
  /** @type {Map<string, number>} */
  const own = new Map();
  for (const users of table.values()) for (const [family, count] of Object.entries(users)) own.set(family, (own.get(family) ?? 0) + count);
  const everything = sum(own.values());
  return (query) => {
    const said = [...stemmed(query)].map((stem) => table.get(stem)).filter((users) => users !== undefined);
    if (!said.length) return new Map();
    const odds = [...own].map(([family, total]) => {
      const inside = said.map((users) => Math.log((1 + (users[family] ?? 0)) / (total + table.size)));
      const outside = said.map((users) => Math.log((1 + sum(Object.values(users)) - (users[family] ?? 0)) / (everything - total + table.size)));
      return /** @type {[string, number]} */ ([family, sum(inside) - sum(outside)]);
    });
    const best = Math.max(...odds.map(([, value]) => value));
    const weights = odds.map(([, value]) => Math.exp(value - best));
    const total = sum(weights);
    return new Map(odds.map(([family], index) => [family, weights[index] / total]));
  };
}

/** @param {Counts} counts @param {string[]} queries @returns {Record<string, number>[]} */
export function told(counts, queries) {
  const spoken = shares(counts);
  return queries.map((query) => Object.fromEntries(spoken(query)));
}

/** @param {Iterable<number>} numbers */
const sum = (numbers) => [...numbers].reduce((total, number) => total + number, 0);

/** @param {string} text @returns {Set<string>} */
function stemmed(text) {
  const found = text.toLowerCase().replace(/n['’]t\b/g, " not").match(/[a-z0-9_]+/g) ?? [];
  const stems = found.filter((word) => !IDLE.has(word)).map((word) => word.replace(SUFFIX, "").replace(DOUBLE, "$1"));
  return new Set(stems.map((stem) => (NOT.has(stem) ? "not" : stem)));
}
