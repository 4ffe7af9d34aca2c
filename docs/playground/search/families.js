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

const SMOOTH = 0.3;
const VAGUE = 0.7;

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
  const smooth = SMOOTH * table.size;
  return (query) => {
    const said = [...stemmed(query)].map((stem) => table.get(stem)).filter((users) => users !== undefined);
    if (!said.length) return new Map();
    const odds = [...own].map(([family, total]) => {
      const each = said.map((users) => {
        const all = sum(Object.values(users));
        const inside = (SMOOTH + (users[family] ?? 0)) / (total + smooth);
        const outside = (SMOOTH + all - (users[family] ?? 0)) / (everything - total + smooth);
        return (1 - VAGUE * entropy(Object.values(users).map((count) => count / all), own.size)) * Math.log(inside / outside);
      });
      return /** @type {[string, number]} */ ([family, sum(each)]);
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

/** @param {number[]} shares @param {number} base of the logarithm */
const entropy = (shares, base) => -sum(shares.map((share) => (share * Math.log(share)) / Math.log(base)));

/** @param {string} text @returns {Set<string>} */
function stemmed(text) {
  /** @type {Set<string>} */
  const said = new Set();
  for (const clause of text.toLowerCase().replace(/n['’]t\b/g, " not").split(STOP)) {
    const found = clause.match(/[a-z0-9_]+/g) ?? [];
    const stems = found.filter((word) => !IDLE.has(word)).map((word) => word.replace(SUFFIX, "").replace(DOUBLE, "$1"));
    const heard = stems.map((stem) => (NOT.has(stem) ? "not" : stem));
    for (const stem of heard) said.add(stem);
    for (const gap of [1, 2]) heard.slice(gap).forEach((stem, at) => heard[at] === "not" && said.add(`not ${stem}`));
  }
  return said;
}
