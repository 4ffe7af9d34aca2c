// What a first letter in a search box fetches, beside the index: asks it at each letter. It runs from a file too.

import { searcher } from "./search/index.js";
import { show } from "./search/panel.js";

/** @typedef {import("./search/index.js").Document} Document */

const KEYS = /** @type {Record<string, number>} */ ({ ArrowDown: 1, ArrowUp: -1 });
/** @param {typeof globalThis.clinicIndex.documents} packed by `packed` of scripts/clinic/pages/search_index.py @returns {Document[]} */
const unpacked = (packed) =>
  Object.entries(packed).flatMap(([kind, { around, fields, rows }]) =>
    rows.map(([rest, ...values]) => ({ kind, at: around[0] + rest + around[1], title: "", words: "", text: "", ...Object.fromEntries(fields.map((name, k) => [name, values[k]])) })),
  );
const index = { documents: unpacked(globalThis.clinicIndex.documents), synonyms: globalThis.clinicIndex.synonyms, families: globalThis.clinicIndex.families };
const symptoms = index.documents.filter(({ kind }) => kind === "symptom");
let ask = searcher(index);

/** @param {HTMLFormElement} form @param {string} site @param {(name: string) => Promise<void>} fetched */
globalThis.clinicSearch = (form, site, fetched) => {
  const input = /** @type {HTMLInputElement} */ (form.querySelector("input"));
  const place = /** @type {HTMLElement} */ (form.querySelector(".search-results"));
  const more = document.createElement("button");
  more.type = "button";
  more.textContent = "Search the answers too";
  more.onclick = async () => {
    more.disabled = true;
    await fetched("answers.js");
    ask = searcher(index, globalThis.clinicAnswers);
    more.remove();
    answer();
    input.focus();
  };
  const answer = () => {
    const query = input.value.trim();
    place.hidden = !query;
    if (query) show(place, query, ask(query), { site, symptoms, report: form.dataset.report, more: globalThis.clinicAnswers ? undefined : more });
  };
  const stops = () => /** @type {HTMLElement[]} */ ([input, ...place.querySelectorAll("ol a")]);
  input.oninput = answer;
  input.onfocus = answer;
  form.onsubmit = (event) => {
    event.preventDefault();
    stops()[1]?.click();
  };
  form.onkeydown = (event) => {
    if (event.key === "Escape") {
      input.focus();
      place.hidden = true;
    }
    const step = KEYS[event.key];
    if (!step) return;
    event.preventDefault();
    const all = stops();
    all[Math.min(all.length - 1, Math.max(0, all.indexOf(/** @type {HTMLElement} */ (document.activeElement)) + step))].focus();
  };
  form.addEventListener("focusout", ({ relatedTarget }) => {
    if (form.matches(".search-header") && !(relatedTarget instanceof Node && form.contains(relatedTarget))) place.hidden = true;
  });
  place.onmousedown = (event) => event.preventDefault(); // a press on what takes no focus is no leaving
  place.onclick = ({ target }) => {
    if (target instanceof Element && target.closest("a")) {
      place.hidden = true;
      input.value = "";
    }
  };
  answer();
};

/** @param {string} path of a page that is not there @returns {Document | undefined} the page that its words mean */
globalThis.clinicNearest = (path) => ask(path.replace(/\.\w+$/, "").replace(/[^\p{L}\p{N}]+/gu, " ")).found[0];
