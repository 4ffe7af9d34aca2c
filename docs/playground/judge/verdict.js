// The answer to `Check my fix`: a sentence and a table of measured and expected values.

import { expected, shown } from "../engine/checks.js";
import { el } from "../page/elements.js";

/** @import {Check, CaseRecord} from "../record/types.js" */
/** @import {Judgement} from "./judgement.js" */

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
 * @returns {{summary: string, table: HTMLElement}}
 */
export function verdict(record, judgement, ours) {
  const { fixed, warnings, well } = judgement;
  const names = Object.keys(warnings);
  const rows = fixed.map((made) => {
    const unit = made.check.take === "onset" ? "s" : record.signals[made.check.signal].unit;
    return row(what(record, made.check), `${shown(made.measured, 4)} ${unit}`, `${expected(made.check)} ${unit}`, made.holds);
  });
  rows.push(row("warnings of MuJoCo", names.join(", ") || "none", "none", names.length === 0));
  if (fixed.every(({ holds }) => holds) && judgement.broken.every(({ holds }) => holds)) {
    rows.push(row("what the broken model shows", "all of it", "not all of it", false));
  }
  const heads = ["Measured", "Value", "Expected", "Holds"].map((head) => el("th", { scope: "col" }, head));
  return {
    summary: well ? repaired(ours) : missed(rows.length, rows.filter((made) => made.dataset.holds === "no").length),
    table: scroll(el("table", { class: "pg-table" }, el("thead", {}, el("tr", {}, ...heads)), el("tbody", {}, ...rows))),
  };
}

/** @param {HTMLTableElement} table which may be wider than the page */
function scroll(table) {
  return el("div", { class: "pg-scroll", tabindex: "0", role: "region", "aria-label": "What was measured" }, table);
}

/** @param {boolean} ours */
function repaired(ours) {
  return ours
    ? "Repaired: every check holds."
    : "Repaired: every check holds. Your repair is not one of those on this page; whatever passes is right.";
}

/**
 * @param {number} all
 * @param {number} failed
 */
function missed(all, failed) {
  return `Not repaired: ${failed} of ${all} checks ${failed === 1 ? "fails" : "fail"}.`;
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
