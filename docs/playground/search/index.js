// Asks the documents: any of the words, with beginnings, typos and synonyms; best first, and whether anything is about it.

import MiniSearch from "minisearch";
import { shares } from "./families.js";
import { pairs, stem, stems, thesaurus, words } from "./words.js";

/** @typedef {{kind: string, at: string, title: string, words: string, text: string, case?: string, family?: string, context?: string}} Document `case` is the address of a message's case */
/** @typedef {{found: Document[], covered: boolean, families: Map<string, number>}} Answer `covered` is whether the best is about most of what was asked, `families` how likely it is about each symptom */

const FIELDS = ["title", "words", "context", "text", "answer"];
const BOOST = { title: 3, words: 2, context: 1, text: 1, answer: 0.5 };
/** @type {Record<string, number>} */
const KINDS = { case: 2, symptom: 0.8, message: 1, rule: 0.6, page: 0.6 };
const BEGINNING = 3; // letters from which on a word may be unfinished
const LONG = 8; // letters from which on a word may have two typos
const OWN = 0.5; // by which the weight grows of what belongs to the symptom that is spoken of
const SENTENCE = 6; // words from which on a query tells of a symptom more than it names things, and OWN is as many times larger
const PASTED = 3; // the weight of a message of whose words most are asked for
const MOST = 2 / 3;
const TOGETHER = 1; // by which the weight grows of what has all that is asked for in the same order
const LIKE = 0.5; // a synonym's weight
const WORTH = 0.1; // of the best one's score, for what is shown at all
const COVERED = 0.42; // of what the words of a query weigh
const SURE = 0.98; // how likely a symptom is that is spoken of, whatever else a query names

/**
 * @param {{documents: Document[], synonyms: string[][], families: import("./families.js").Weights}} index
 * @param {Record<string, string>} [answers] by address
 * @returns {(query: string) => Answer}
 */
export function searcher({ documents, synonyms, families: weights }, answers = {}) {
  const texts = documents.map((document, id) => ({ ...document, id, answer: answers[document.at] ?? "" }));
  const mini = new MiniSearch({ fields: FIELDS, tokenize: words, processTerm: stem });
  mini.addAll(texts);
  /** @type {Map<string, number>} in how many documents a stem stands */
  const known = new Map();
  for (const text of texts) {
    const there = new Set([text.title, text.words, text.text, text.answer].flatMap(stems));
    for (const each of there) known.set(each, (known.get(each) ?? 0) + 1);
  }
  const told = texts.map(({ title, words: lines }) => new Set([title, ...lines.split(/[;\n]/)].flatMap(pairs)));
  const titles = texts.map(({ kind, title }) => (kind === "message" ? stems(title) : []));
  const weight = (/** @type {string} */ term) => Math.log(1 + texts.length / (known.get(term) ?? 1));
  const alike = thesaurus(synonyms);
  const spoken = shares(weights);

  return (query) => {
    const asked = stems(query);
    const families = spoken(query);
    const together = pairs(query);
    const share = (/** @type {number} */ id) => together.filter((pair) => told[id].has(pair)).length / Math.max(1, together.length);
    const own = OWN * (asked.length < SENTENCE ? 1 : SENTENCE);
    const last = stem(words(query).at(-1) ?? "");
    const pasted = (/** @type {number} */ id) => titles[id].length > 1 && titles[id].filter((term) => asked.includes(term)).length >= MOST * titles[id].length;
    const meant = new Map(asked.map((term) => [term, term]));
    for (const [term, others] of alike(query)) for (const other of others) if (!meant.has(other)) meant.set(other, term);
    const results = mini.search([...meant.keys()].join(" "), {
      tokenize: (text) => text.split(" "),
      processTerm: (term) => term,
      boost: BOOST,
      prefix: (term) => term === last && term.length >= BEGINNING,
      fuzzy: (term) => (meant.get(term) === term && !known.has(term) && term.length > BEGINNING ? 1 + Number(term.length >= LONG) : false),
      boostTerm: (term) => (meant.get(term) === term ? 1 : LIKE),
      boostDocument: (id) => KINDS[texts[id].kind] * (pasted(id) ? PASTED : 1) * (1 + TOGETHER * share(id)) * (1 + own * (families.get(texts[id].family ?? "") ?? 0)),
    });
    const total = asked.reduce((sum, term) => sum + weight(term), 0);
    const best = results.slice(0, 3).map(({ queryTerms }) => {
      const hit = new Set(queryTerms.map((term) => meant.get(term)));
      return asked.reduce((sum, term) => sum + (hit.has(term) ? weight(term) : 0), 0) / total;
    });
    const worth = results.filter(({ score }) => score >= WORTH * results[0].score);
    const found = worth.map(({ id }) => texts[id]);
    const shown = found.findIndex(({ at }) => at === found[0].case);
    if (shown > 1 && pasted(worth[0].id)) found.splice(1, 0, ...found.splice(shown, 1)); // what is about the message, right after it
    return { found, covered: Math.max(0, ...best) >= COVERED || Math.max(0, ...families.values()) >= SURE, families };
  };
}
