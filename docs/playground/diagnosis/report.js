// A diagnosis as the reader sees it: causes with what was measured, then hints, then what was ruled out.

import { strToU8, zipSync } from "fflate";
import { button, el } from "../page/elements.js";
import { last } from "./files.js";

/** @import {Diagnosis, Finding, Request, Texts} from "./client.js" */

const SHOWN = 3;
const NO_PAGE = new Set(["engine-dies", "rule-fails", "ignore-comment"]); // what is said of no rule
const BUTTON = { class: "md-button" };

/**
 * @param {Diagnosis} diagnosis
 * @param {Request} request what was asked
 * @param {string} rules the address of the rules' pages
 * @param {(place: HTMLElement, index: number) => void} tryEdit opens the model with the edit of a finding, causes before hints, in a place
 * @returns {HTMLElement}
 */
export function report(diagnosis, request, rules, tryEdit) {
  const { causes, hints, silenced, ruled_out: ruledOut, untried, engine, error } = diagnosis.data;
  const made = el("div", { class: "dg-report" }, el("p", { role: "status" }, el("strong", {}, request.name), ` ${summary(diagnosis)}`));
  if (error && causes.length === 0) made.append(el("pre", {}, error.trim()));
  if (causes.length === 0 && (!error || hints.length > 0) && !request.symptom) made.append(el("p", {}, "Choose above what you see: weaker signs of it are told then, too."));
  if (request.single && hints.some(({ rule }) => rule === "missing-file")) made.append(el("p", {}, "Drop the model's folder, or a zip of it, to have its files looked at too."));
  const tried = el("div", { class: "dg-tried" });
  const item = (/** @type {Finding} */ found, /** @type {number} */ index) => {
    const told = el("li", {}, ...finding(found, rules));
    const act = button("Try this edit", () => {
      told.closest(".dg-report > *")?.after(tried);
      tryEdit(tried, index);
    }, BUTTON);
    if (Object.keys(diagnosis.edited[index]).length > 0) told.append(act);
    return told;
  };
  const items = causes.map(item);
  if (items.length > 0) made.append(el("ol", { class: "dg-found" }, ...items.slice(0, SHOWN)));
  const more = items.slice(SHOWN);
  if (more.length > 0) made.append(fold(count(more.length, "more cause"), el("ol", { class: "dg-found", start: String(SHOWN + 1) }, ...more)));
  if (hints.length > 0) {
    const hinted = hints.map((each, index) => item(each, causes.length + index));
    const told = fold(`${count(hints.length, "hint")}, where only you know what was meant`, el("ul", { class: "dg-found" }, ...hinted));
    told.open = causes.length === 0;
    made.append(told);
  }
  if (diagnosis.diff) made.append(fold(causes.length === 1 ? "The edit as a diff" : "The edits as a diff", el("pre", {}, diagnosis.diff)));
  if (silenced.length > 0) {
    const lines = silenced.map((each) => el("li", {}, each.title, " (", link(each.rule, rules), "): ", where(each), ": ", each.silenced));
    made.append(fold(`Silenced by comments in the model: ${count(silenced.length, "finding")}`, el("ul", {}, ...lines)));
  }
  const named = (/** @type {string[]} */ ids) => el("ul", {}, ...ids.map((id) => el("li", {}, diagnosis.titles[id] ?? id, " (", link(id, rules), ")")));
  if (ruledOut.length > 0) made.append(fold(`Ruled out: ${count(ruledOut.length, "rule")} found nothing`, named(ruledOut)));
  if (untried.length > 0) made.append(fold(`No time was left for ${count(untried.length, "rule")}`, named(untried)));
  const mended = Object.keys(diagnosis.mended).length > 0 ? [button("Save the mended model", () => save(diagnosis.mended, request.name), BUTTON)] : [];
  const text = `clinic diagnose ${request.name}, in a page with MuJoCo ${engine}\n${diagnosis.text}\n`;
  const actions = [copy("Copy as text", text), copy("Copy as JSON", JSON.stringify(diagnosis.data, null, 1)), ...mended];
  made.append(el("p", { class: "dg-actions" }, ...actions));
  return made;
}

/** @param {Diagnosis} diagnosis */
function summary({ data: { causes, hints, ruled_out: ruledOut, engine, error } }) {
  const ran = error ? `does not compile in MuJoCo ${engine}, which this page runs` : `was run by MuJoCo ${engine} in this page`;
  if (causes.length > 0) return `${ran}: ${count(causes.length, "cause")}.`;
  if (hints.length > 0) return `${ran}: no cause, ${count(hints.length, "hint")}.`;
  return error ? `${ran}, and none of ${count(ruledOut.length, "rule")} knows why. It says:` : `${ran}. Nothing found by ${count(ruledOut.length, "rule")}.`;
}

/**
 * @param {Finding} found
 * @param {string} rules
 */
function finding(found, rules) {
  const written = [found.now, found.value].filter(Boolean).join(" → ");
  const change = found.value && (found.attribute ? `${found.attribute}: ${written}` : found.value);
  const made = [el("p", { class: "dg-title" }, el("strong", {}, found.title), " ", link(found.rule, rules))];
  made.push(el("p", {}, where(found)), el("p", {}, found.says));
  if (change) made.push(el("p", {}, el("code", {}, change)));
  const numbers = measured(found);
  if (numbers) made.push(el("p", {}, numbers));
  return made;
}

/**
 * What a finding's probe measured without its edit and with it; empty where that says nothing.
 * @param {Finding} found
 */
export function measured({ level, probe, keyframe, before, after, unit }) {
  if (!probe || unit === "errors" || (level === "hint" && after === null)) return "";
  const edited = after === null ? "" : ` With the edit: ${shown(after, unit)}.`;
  const begun = keyframe === null ? "" : `, from keyframe ${keyframe}`;
  return `${capital(probe)}${begun}: ${shown(before, unit)}.${edited}`;
}

/** @param {Finding} found */
function where({ file, line, elements }) {
  const named = elements.filter((each) => each !== `line ${line}`);
  const more = named.length > 3 ? ` and ${named.length - 3} more` : "";
  return [line ? `${file}, line ${line}` : file, named.slice(0, 3).join(", ") + more].filter(Boolean).join(": ");
}

/**
 * @param {string} rule
 * @param {string} rules
 */
function link(rule, rules) {
  if (NO_PAGE.has(rule)) return el("code", {}, rule);
  return el("a", { href: `${rules}${rule}.html`, target: "_blank", rel: "noopener" }, rule);
}

/** @param {string} text */
function capital(text) {
  return text.slice(0, 1).toUpperCase() + text.slice(1);
}

/**
 * @param {number} number
 * @param {string} what
 */
function count(number, what) {
  return number === 1 ? `one ${what}` : `${number} ${what}s`;
}

/**
 * A number of three digits with its unit.
 * @param {number | null} value null where it is not finite
 * @param {string} unit
 */
function shown(value, unit) {
  const kept = value !== null && Math.abs(value) < 1e-12 ? 0 : value; // what rounding leaves
  return kept === null ? "beyond all bounds" : `${kept.toLocaleString("en", { maximumSignificantDigits: 3, useGrouping: "min2" })} ${unit}`.trim();
}

/**
 * @param {string} title
 * @param {HTMLElement} content
 */
function fold(title, content) {
  return el("details", {}, el("summary", {}, capital(title)), content);
}

/**
 * @param {string} label
 * @param {string} text
 */
function copy(label, text) {
  const said = el("span", {}, label);
  const made = button("", async () => {
    said.textContent = await navigator.clipboard.writeText(text).then(
      () => "Copied",
      () => "The browser does not let this page copy",
    );
    setTimeout(() => (said.textContent = label), 2000);
  }, BUTTON);
  made.append(said);
  return made;
}

/**
 * Saves the files that the edits change: one as it is, several as a zip.
 * @param {Texts} texts
 * @param {string} name of the model
 */
function save(texts, name) {
  const files = Object.entries(texts).map(([path, text]) => /** @type {const} */ ([path, strToU8(text)]));
  const [[path, bytes]] = files.length === 1 ? files : [[name.replace(/(\.\w+)?$/, ".zip"), zipSync(Object.fromEntries(files))]];
  const href = URL.createObjectURL(new Blob([bytes]));
  el("a", { href, download: last(path).replace(/(\.\w+)?$/, ".mended$1") }).click();
  setTimeout(() => URL.revokeObjectURL(href), 1000);
}
