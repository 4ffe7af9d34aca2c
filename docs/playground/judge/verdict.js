// The answer to `Check my fix`: what holds and what does not in sentences, and a table of all that was measured.

import { expected, shown, TAKES } from "../engine/checks.js";
import { applyEdits } from "../engine/variant.js";
import { el } from "../page/elements.js";

/** @import {Verdict} from "../engine/checks.js" */
/** @import {Check, CaseRecord, Remedy} from "../record/types.js" */
/** @import {Judgement, Situation} from "./judgement.js" */

/** @typedef {Pick<CaseRecord, "text" | "signals" | "checks" | "fixes" | "refuted" | "guards"> & {trials: readonly unknown[]}} Judged */


/**
 * @param {Judged} record
 * @param {Judgement} judgement
 * @param {string} text that was judged
 * @returns {{summary: string, parts: HTMLElement[]}}
 */
export function verdict(record, judgement, text) {
  const { changes, situations, repaired } = judgement;
  const isText = (/** @type {Remedy} */ { edits }) => applyEdits(record.text, edits) === text;
  const tried = record.refuted.find(isText);
  const why = tried?.why ? [el("p", { class: "pg-refuted" }, el("strong", {}, `${tried.title}: `), ...code(tried.why))] : [];
  const told = [...changes.map((text) => ({ text, guard: "" })), ...failures(record, situations)];
  const list = el("ul", { class: "pg-told" }, ...told.map(({ text, guard }) => el("li", {}, text, ...(guard ? [el("span", { class: "pg-guard" }, guard)] : []))));
  const measured = el("details", { class: "pg-fold" }, el("summary", {}, "All that was measured"), table(record, situations));
  return {
    summary: repaired ? accepted(record, record.fixes.some(isText)) : refused(judgement),
    parts: [...why, ...(told.length > 0 ? [list] : []), ...(situations.length > 0 ? [measured] : [])],
  };
}

/**
 * What failed, and once for each check what it is there for.
 * @param {Judged} record
 * @param {Situation[]} situations
 */
function failures({ checks, guards }, situations) {
  /** @type {Set<number>} */
  const said = new Set();
  return situations.flatMap(({ failed, fixed, warnings }) => {
    const missed = fixed.filter(({ holds }) => !holds);
    return failed.map((text, i) => {
      const check = missed[i - warnings.length]?.check;
      const k = check ? checks.fixed.findIndex(({ signal, take }) => signal === check.signal && take === check.take) : -1;
      if (!guards[k] || said.has(k)) return { text, guard: "" };
      said.add(k);
      return { text, guard: guarded(guards[k]) };
    });
  });
}

/** @param {CaseRecord["guards"][number]} guard */
function guarded({ symptom, against }) {
  if (symptom) return " This is the symptom: the broken model fails it as well.";
  const such = against.length > 0 ? `, such as “${against[0]}”` : "";
  return ` The broken model passes this: it guards against repairs that spoil something else${such}.`;
}

/**
 * A text with what stands between backticks as code.
 * @param {string} text
 */
function code(text) {
  return text.split("`").map((part, i) => (i % 2 === 1 ? el("code", {}, part) : part));
}

/**
 * @param {Judged} record
 * @param {boolean} ours
 */
function accepted({ trials }, ours) {
  const where = trials.length > 0 ? ` in the case's own run and in ${trials.length === 1 ? "its trial" : `its ${trials.length} trials`}` : "";
  const other = ours ? "" : " Your repair is not one of those on this page; whatever passes is right.";
  return `Repaired: every check holds${where}.${other}`;
}

/** @param {Judgement} judgement */
function refused({ changes, situations }) {
  const number = situations.flatMap(({ failed }) => failed).length;
  const fails = number === 1 ? "one check fails" : `${number} checks fail`;
  if (changes.length > 0) {
    return `Not repaired: the task was changed${number > 0 ? `, and ${fails}` : "; a repair leaves it as it is"}.`;
  }
  const lucky = situations[0].failed.length === 0;
  return lucky ? `Not repaired: every check holds in the case's own run, but ${fails} in its trials.` : `Not repaired: ${fails}.`;
}

/**
 * @param {Judged} record
 * @param {Situation[]} situations
 */
function table(record, situations) {
  const heads = ["Measured", "Value", "Expected", "Holds"].map((head) => el("th", { scope: "col" }, head));
  const bodies = situations.map(({ title, fixed, warnings }) => {
    const name = el("th", { scope: "rowgroup", colspan: "4" }, title ? `Trial: ${title}` : "The case's own run");
    const rows = fixed.map((made) => measuredRow(record, made));
    const raised = row("warnings of MuJoCo", warnings.join(", ") || "none", "none", warnings.length === 0);
    return el("tbody", {}, el("tr", { class: "pg-situation" }, name), ...(fixed.length > 0 ? [...rows, raised] : []));
  });
  // the table may be wider than the page
  const attributes = { class: "pg-scroll", tabindex: "0", role: "region", "aria-label": "What was measured" };
  return el("div", attributes, el("table", { class: "pg-table" }, el("thead", {}, el("tr", {}, ...heads)), ...bodies));
}

/**
 * @param {Judged} record
 * @param {Verdict} made
 */
function measuredRow(record, { check, measured, holds }) {
  const unit = check.take === "onset" ? "s" : record.signals[check.signal].unit;
  return row(what(record, check), `${shown(measured, 4)} ${unit}`, `${expected(check)} ${unit}`, holds);
}

/**
 * @param {Judged} record
 * @param {Check} check
 */
function what(record, check) {
  const signal = record.signals[check.signal];
  const span = check.window ? `, ${check.window[0]} to ${check.window[1]} s` : "";
  return signal.label + ("measure" in signal ? "" : `, ${TAKES[check.take]}`) + span;
}

/**
 * @param {string} label
 * @param {string} measured
 * @param {string} wanted
 * @param {boolean} holds
 */
function row(label, measured, wanted, holds) {
  const mark = el("td", {}, holds ? "✓ yes" : "✗ no");
  return el("tr", { "data-holds": holds ? "yes" : "no" }, el("th", { scope: "row" }, label), el("td", {}, measured), el("td", {}, wanted), mark);
}
