// The answer to `Check my fix`: what holds and what does not in sentences, and a table of all that was measured.

import { expected, shown } from "../engine/checks.js";
import { el } from "../page/elements.js";

/** @import {Verdict} from "../engine/checks.js" */
/** @import {Check, CaseRecord} from "../record/types.js" */
/** @import {Judgement, Situation} from "./judgement.js" */

const TAKES = {
  final: "at the end",
  first: "after one step",
  min: "lowest",
  max: "highest",
  mean: "mean",
  span: "span",
  onset: "first differs from zero at",
};

/**
 * @param {CaseRecord} record
 * @param {Judgement} judgement
 * @param {boolean} ours whether the text is a fix of the record
 * @returns {{summary: string, parts: HTMLElement[]}}
 */
export function verdict(record, judgement, ours) {
  const { changes, situations, repaired } = judgement;
  const told = [...changes, ...situations.flatMap(({ failed }) => failed)];
  const list = el("ul", { class: "pg-told" }, ...told.map((sentence) => el("li", {}, sentence)));
  const measured = el("details", { class: "pg-fold" }, el("summary", {}, "All that was measured"), table(record, situations));
  return {
    summary: repaired ? accepted(record, ours) : refused(judgement),
    parts: [...(told.length > 0 ? [list] : []), ...(situations.length > 0 ? [measured] : [])],
  };
}

/**
 * @param {CaseRecord} record
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
 * @param {CaseRecord} record
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
 * @param {CaseRecord} record
 * @param {Verdict} made
 */
function measuredRow(record, { check, measured, holds }) {
  const unit = check.take === "onset" ? "s" : record.signals[check.signal].unit;
  return row(what(record, check), `${shown(measured, 4)} ${unit}`, `${expected(check)} ${unit}`, holds);
}

/**
 * @param {CaseRecord} record
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
