// The results below a box: links of four kinds, or a word on what is not covered and where to go instead.

import { stem, stems, words } from "./words.js";

/** @typedef {import("./index.js").Answer} Answer */
/** @typedef {import("./index.js").Document} Document */

const MOST = 12; // results
const LIKELY = 3; // symptoms that may be meant
/** @type {Record<string, string>} */
const NAMES = { case: "Case", symptom: "Symptom", message: "MuJoCo says", rule: "Rule", page: "Page" };

/**
 * @param {Element} place what shows the results
 * @param {string} query
 * @param {Answer} answer
 * @param {{site: string, symptoms: Document[], report?: string, more?: HTMLElement}} around `site` is the address that the documents' are relative to
 */
export function show(place, query, { found, covered, families }, { site, symptoms, report, more }) {
  const status = element("p", { role: "status" });
  const shown = found.slice(0, MOST);
  if (covered) status.textContent = `${found.length} found`;
  else status.append("Nothing here is about ", element("em", {}, query), " yet.");
  const parts = [status];
  if (!covered) parts.push(elsewhere(site, likeliest(symptoms, families).slice(0, LIKELY), report));
  if (!covered && shown.length) parts.push(element("p", {}, "Nearest, and perhaps not it:"));
  const asked = new Set(stems(query));
  parts.push(element("ol", {}, ...shown.slice(0, covered ? MOST : 3).map((document) => item(document, site, asked))));
  if (more) parts.push(more);
  place.replaceChildren(...parts);
}

/** @param {Document} document @param {string} site @param {Set<string>} asked */
function item({ kind, at, title, text }, site, asked) {
  const link = element("a", { href: new URL(at, site).href }, element("small", {}, NAMES[kind]), marked(title, asked));
  if (text) link.append(element("span", {}, marked(text, asked)));
  return element("li", {}, link);
}

/** @param {Document[]} symptoms @param {Map<string, number>} families */
const likeliest = (symptoms, families) => [...symptoms].sort((one, other) => (families.get(other.family ?? "") ?? 0) - (families.get(one.family ?? "") ?? 0));

/** @param {string} site @param {Document[]} symptoms @param {string} [report] */
function elsewhere(site, symptoms, report) {
  const links = symptoms.flatMap(({ at, title }) => [element("a", { href: new URL(at, site).href }, title), " · "]).slice(0, -1);
  const all = element("a", { href: new URL("symptoms.html", site).href }, "another symptom");
  const box = element("p", {}, "What do you see? ", ...links, " · ", all, ".");
  if (report) box.append(" Missing a case? ", element("a", { href: report }, "Tell us"), ".");
  return box;
}

/** @param {string} text @param {Set<string>} asked @returns {HTMLElement} the text with the words that were asked for marked */
function marked(text, asked) {
  const parts = text.split(/([\p{L}\p{N}_]+)/u);
  return element("span", {}, ...parts.map((part) => (words(part).some((word) => asked.has(stem(word))) ? element("mark", {}, part) : part)));
}

/**
 * @param {string} name
 * @param {Record<string, string>} attributes
 * @param {...(Node | string)} children
 * @returns {HTMLElement}
 */
function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}
