// A diagnosis as the reader sees it: causes with what was measured, then hints, then what was ruled out.

import { button, el } from "../page/elements.js";

/** @import {Diagnosis, Finding} from "./client.js" */

const SHOWN = 3;

/**
 * @param {Diagnosis} diagnosis
 * @param {string} rules the address of the rules' pages
 * @returns {HTMLElement}
 */
export function report(diagnosis, rules) {
  const { causes, hints, ruled_out: ruledOut, engine, file } = diagnosis.data;
  const made = el("div", { class: "dg-report" });
  const head = `${file}, run by MuJoCo ${engine} in this page: `;
  const count = causes.length === 1 ? "one cause" : `${causes.length} causes`;
  const nothing = diagnosis.error ? "it does not compile, and no rule knows why." : "nothing found.";
  made.append(el("p", { class: "dg-head", role: "status" }, head + (causes.length > 0 ? `${count}.` : nothing)));
  if (diagnosis.error && causes.length === 0) made.append(el("pre", {}, diagnosis.error.trim()));
  const list = el("ol", { class: "dg-causes" }, ...causes.slice(0, SHOWN).map((each) => finding(each, rules)));
  if (causes.length > 0) made.append(list);
  const more = causes.slice(SHOWN);
  if (more.length > 0) made.append(fold(`${more.length} more`, el("ol", { start: String(SHOWN + 1) }, ...more.map((each) => finding(each, rules)))));
  if (hints.length > 0) {
    const lines = hints.map((each) => el("li", {}, link(each, rules), ` ${each.elements.slice(0, 3).join(", ")}: ${each.says}`));
    made.append(fold(hints.length === 1 ? "One hint, where only you know what was meant" : `${hints.length} hints, where only you know what was meant`, el("ul", {}, ...lines)));
  }
  if (diagnosis.diff) made.append(fold("All edits as a diff", el("pre", {}, diagnosis.diff)));
  if (ruledOut.length > 0) made.append(fold(`Ruled out: ${ruledOut.length} rules`, el("p", {}, ruledOut.join(", "))));
  made.append(
    el(
      "p",
      { class: "dg-actions" },
      copy("Copy as text", diagnosis.text),
      copy("Copy as JSON", JSON.stringify(diagnosis.data, null, 1)),
      ...(diagnosis.diff ? [save("Save the mended model", Object.values(diagnosis.fixed)[0], file)] : []),
    ),
  );
  return made;
}

/**
 * @param {Finding} found
 * @param {string} rules
 */
function finding(found, rules) {
  const place = found.line ? `${found.file}, line ${found.line}` : found.file;
  const elements = found.elements.slice(0, 3).join(", ") + (found.elements.length > 3 ? ` and ${found.elements.length - 3} more` : "");
  const change = found.attribute ? `${found.attribute}: ${found.now} → ${found.value}` : found.value;
  const made = el("li", {}, el("strong", {}, found.title), " ", link(found, rules));
  made.append(el("p", { class: "dg-place" }, [place, elements].filter(Boolean).join(": ")), el("p", {}, found.says));
  if (change) made.append(el("p", {}, el("code", {}, change)));
  if (found.probe && found.unit !== "errors") {
    const after = found.edit.length > 0 ? ` With the edit: ${shown(found.after, found.unit)}.` : "";
    made.append(el("p", {}, `${found.probe}: ${shown(found.before, found.unit)}.${after}`));
  }
  return made;
}

/**
 * @param {Finding} found
 * @param {string} rules
 */
function link(found, rules) {
  if (found.rule === "engine-dies") return el("code", {}, found.rule);
  return el("a", { href: `${rules}${found.rule}.html` }, found.rule);
}

/**
 * A number of three digits with its unit.
 * @param {number | null} value null where it is not finite
 * @param {string} unit
 */
function shown(value, unit) {
  return value === null ? "beyond all bounds" : `${Number(value.toPrecision(3))} ${unit}`.trim();
}

/**
 * @param {string} title
 * @param {HTMLElement} content
 */
function fold(title, content) {
  return el("details", {}, el("summary", {}, title), content);
}

/**
 * @param {string} label
 * @param {string} text
 */
function copy(label, text) {
  const made = button(label, async () => {
    await navigator.clipboard.writeText(text);
    made.textContent = "Copied";
    setTimeout(() => (made.textContent = label), 2000);
  }, { class: "md-button" });
  return made;
}

/**
 * @param {string} label
 * @param {string} text
 * @param {string} name
 */
function save(label, text, name) {
  return button(label, () => {
    const href = URL.createObjectURL(new Blob([text], { type: "text/xml" }));
    el("a", { href, download: name.replace(/(\.\w+)?$/, ".mended$1") }).click();
    setTimeout(() => URL.revokeObjectURL(href), 1000);
  }, { class: "md-button" });
}
