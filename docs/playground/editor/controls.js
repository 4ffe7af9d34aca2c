// The editor's place on the page, its buttons, and the places of what is said about the text.

import { isNewer } from "../engine/mjcf.js";
import { button, choice, el, group } from "../page/elements.js";

/** @import {CaseRecord} from "../record/types.js" */
/** @import {Draft} from "./draft.js" */

const LIVE = "https://live.mujoco.org/?model=";

/**
 * @param {CaseRecord} record
 * @param {Draft} draft
 * @param {{check: () => void, stop: () => void}} act
 */
export function editorControls(record, draft, { check: startCheck, stop: stopCheck }) {
  const help = `pg-help-${record.case}`;
  const editor = el("div", { class: "pg-editor" });
  const error = el("p", { class: "pg-complaint", role: "alert" });
  const check = button("Check my fix", startCheck, { class: "pg-check", title: "Ctrl+Enter", "aria-keyshortcuts": "Control+Enter" });
  const stop = button("Stop checking", stopCheck, { hidden: true });
  const result = el("div", { class: "pg-result", role: "status" });
  const linked = el("p", { role: "status" });
  const address = el("input", { class: "pg-address", readonly: true, hidden: true, "aria-label": "Link to this text" });
  const judged = record.checks.fixed.length > 0; // a reader's own model has no checks
  const why = el("p", { class: "pg-why" });
  const kept = el("span", { class: "pg-kept", role: "status" });
  const remedies = /** @type {[string, string][]} */ ([
    ["", "choose one"],
    ...record.fixes.map(({ id, title }, i) => [id, judged ? `fix ${i + 1} of ${record.fixes.length}` : title]), // titles would tell the cause
    ...record.refuted.map(({ id }, i) => [id, `what does not help, ${i + 1} of ${record.refuted.length}`]),
  ]);
  const fix = choice(judged ? "Show the fix" : "Show the edit", remedies, "", (id) => id && draft.showRemedy(id));
  /** Marks the remedies that a version of MuJoCo is too old for. @param {string} version */
  const tellNeeds = (version) => {
    for (const { id, needs } of [...record.fixes, ...record.refuted]) {
      const option = [...fix.select.options].find(({ value }) => value === id);
      if (option && needs && isNewer(needs, version)) option.textContent += ` (needs MuJoCo ${needs})`;
    }
  };
  const changes = button("My changes", () => draft.compare(changes.getAttribute("aria-pressed") !== "true"), { "aria-pressed": "false", disabled: true });
  const share = judged ? [button("Copy link", () => void draft.copyLink()), ...openElsewhere(record)] : [];
  const text = group(
    "Text",
    button("Undo", () => draft.editor.undo(), { title: "Ctrl+Z" }),
    changes,
    button("Format", () => draft.editor.format()),
    button("Restore", () => draft.restore(), { title: "The case's own text" }),
    button("Download XML", () => draft.download()),
    ...share,
  );
  const parts = [
    el("p", { class: "pg-file" }, el("strong", {}, record.name), " ", kept, el("span", { id: help, class: "pg-help" }, "Tab leaves the editor, as does Escape and then Tab. Ctrl+Enter checks.")),
    editor,
    error,
    result,
    text,
    group("Repair", fix.whole),
    why,
    address,
    linked,
  ];
  const checking = judged ? [check, stop] : [];
  return { parts, checking, tellNeeds, editor, error, check, stop, result, address, linked, fix, why, kept, changes, help };
}

/**
 * MuJoCo Live fetches the published model itself, which it can from a public host only.
 * @param {CaseRecord} record
 */
function openElsewhere(record) {
  if (location.protocol !== "https:") return [];
  const model = new URL(record.name, location.href).href;
  const note = "The model as published; your edits stay here";
  return [el("a", { href: LIVE + encodeURIComponent(model), target: "_blank", rel: "noopener", title: note }, "Open in MuJoCo Live")];
}
