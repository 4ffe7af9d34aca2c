// Which symptom a query speaks of: the same reckoning as `likely_families` in scripts/clinic/record/families.py.

const SUFFIX = /(?<=[a-z]{3})(?:ations?|ings?|ies|ed|es|s|ly|e|y)$/;
const DOUBLE = /([bdfglmnprtz])\1$/;
const NOT = new Set("no never cannot without unable fail nothing nobody barely".split(" "));
const IDLE = new Set(
  (
    "a an and are as at be been but by can did do does doing done for from had has have i if in is it its me my of on " +
    "or so that the their them there they this to was we were when while with you your mujoco simulation"
  ).split(" "),
);
const PART = 0.5;
const BESIDE = 0.4;

/** @typedef {{called: Set<string>[], beside: Set<string>[]}} Phrases */

/**
 * @param {{family: string, words: string[], further: string[], context: string[]}[]} families
 * @returns {(query: string) => Map<string, number>} how much the query speaks of each family that it speaks of, as a share of the loudest
 */
export function likely(families) {
  const known = new Map(families.map(({ family, words, further, context }) => [family, { called: phrases([family, ...words, ...further]), beside: phrases(context) }]));
  /** @type {Map<string, number>} */
  const users = new Map();
  for (const { called, beside } of known.values()) {
    for (const stem of new Set([...called, ...beside].flatMap((phrase) => [...phrase]))) users.set(stem, (users.get(stem) ?? 0) + 1);
  }
  const rarity = (/** @type {string} */ stem) => Math.log(1 + known.size / (users.get(stem) ?? 1));
  const weight = (/** @type {Set<string>} */ stems) => [...stems].reduce((sum, stem) => sum + rarity(stem), 0);
  return (query) => {
    const said = stemmed(query);
    const whole = (/** @type {Set<string>[]} */ those) => new Set(those.filter((phrase) => shared(phrase, said) === phrase.size).flatMap((phrase) => [...phrase]));
    const scores = [...known].map(([family, { called, beside }]) => {
      const own = whole(called);
      const near = new Set([...whole(beside)].filter((stem) => !own.has(stem)));
      const part = Math.max(...called.map((phrase) => shared(phrase, said) / phrase.size));
      const score = weight(own) + BESIDE * weight(near) + PART * part;
      return /** @type {[string, number]} */ ([family, Number(score.toFixed(9))]); // equal ones stay equal, in whatever order they are summed
    });
    const loudest = Math.max(...scores.map(([, score]) => score));
    return new Map(scores.filter(([, score]) => score > PART / 2).map(([family, score]) => [family, score / loudest]));
  };
}

/** @param {Parameters<typeof likely>[0]} families @param {string[]} queries @returns {string[][]} of each the names, likeliest first */
export function ranked(families, queries) {
  const spoken = likely(families);
  return queries.map((query) => [...spoken(query)].sort(([, a], [, b]) => b - a).map(([family]) => family));
}

/** @param {string[]} texts */
const phrases = (texts) => texts.map(stemmed).filter(({ size }) => size);

/** @param {Set<string>} phrase @param {Set<string>} said */
const shared = (phrase, said) => [...phrase].filter((stem) => said.has(stem)).length;

/** @param {string} text @returns {Set<string>} */
function stemmed(text) {
  const found = text.toLowerCase().replace(/n['’]t\b/g, " not").match(/[a-z0-9_]+/g) ?? [];
  const stems = found.filter((word) => !IDLE.has(word)).map((word) => word.replace(SUFFIX, "").replace(DOUBLE, "$1"));
  return new Set(stems.map((stem) => (NOT.has(stem) ? "not" : stem)));
}
