// A case's script on its page: edited, run, judged. Nothing runs before it is asked for.

import { Editor } from "../editor/editor.js";
import { verdict } from "../judge/verdict.js";
import { button, el, group } from "../page/elements.js";
import { keep, kept } from "../page/kept.js";
import { toFragment } from "../page/link.js";
import { markSolved } from "../page/solved.js";
import { run, ScriptError } from "./client.js";
import { judgeScript } from "./judge.js";

/** @import {Linked} from "../page/link.js" */
/** @import {Parts} from "./client.js" */
/** @import {ScriptRecord} from "./types.js" */

const NO_NETWORK = "It runs in this page, without a network.";
const LINKED = "This text came with the link. Nothing runs until you press Run.";

/** The editor, its buttons, and what is said. */
export class Bench {
  /**
   * @param {HTMLElement} root
   * @param {ScriptRecord} record
   * @param {Parts} parts
   * @param {Linked | null} linked what came with a link
   */
  constructor(root, record, parts, linked) {
    this.record = record;
    this.parts = parts;
    /** @type {AbortController | null} */
    this.work = null;
    const help = `pg-help-${record.case}`;
    const place = el("div", { class: "pg-editor" });
    this.output = el("pre", { class: "pg-output", role: "status", "aria-label": "What it prints", tabindex: "0" });
    this.error = el("p", { class: "pg-complaint", role: "alert" });
    this.result = el("div", { class: "pg-result", role: "status" });
    this.runs = button("Run", () => void this.run(), { class: "pg-run" });
    this.check = button("Check my fix", () => void this.judge(), { class: "pg-check" });
    this.stop = button("Stop", () => this.work?.abort(), { hidden: true });
    this.address = el("input", { class: "pg-address", readonly: true, hidden: true, "aria-label": "Link to this text" });
    const changes = button("Show what I changed", () => this.editor.compare(this.comparing() ? null : record.text), {});
    const restore = button("Restore", () => (this.editor.text = record.text));
    const link = button("Copy link", () => void this.copyLink());
    const text = linked && "text" in linked ? linked.text : null;
    const said = el("span", { id: help }, ` ${text === null ? NO_NETWORK : LINKED}`);
    const title = el("p", { class: "pg-file" }, el("strong", {}, record.name), said);
    const acts = group("Script", this.runs, this.check, this.stop);
    const texts = group("Text", restore, changes, link);
    root.append(el("div", { class: "pg pg-script" }, title, place, acts, this.error, this.output, this.result, texts, this.address));
    const options = { label: `${record.name}, the script`, describedBy: help, changed: () => this.edited(), check: () => void this.judge() };
    this.editor = new Editor(place, text ?? kept(record.case) ?? record.text, options);
    if (linked && "problem" in linked) this.error.textContent = linked.problem;
  }

  comparing() {
    return this.editor.view.dom.querySelector(".cm-changedLine, .cm-deletedChunk") !== null;
  }

  /** Keeps the text. */
  edited() {
    keep(this.record.case, this.editor.text === this.record.text ? null : this.editor.text);
    this.forget();
  }

  /** Forgets what was found out about the text, which no longer holds. */
  forget() {
    this.result.replaceChildren();
    this.result.removeAttribute("data-well");
    this.editor.showError(null);
    this.error.textContent = "";
    this.work?.abort();
  }

  async run() {
    const { text } = this.editor;
    await this.working(async (stop) => {
      this.output.textContent = (await run(this.parts, text, this.record.files, stop)) || "It prints nothing.";
    });
  }

  async judge() {
    const { text } = this.editor;
    await this.working(async (stop) => {
      const tell = (/** @type {string} */ where) => this.show("", `Checking ${where}.`);
      const made = await judgeScript(this.record, text, (script, files) => run(this.parts, script, files, stop), tell);
      const { summary, parts } = verdict(this.record, made, text);
      if (made.repaired) markSolved(this.record.case);
      this.show(made.repaired ? "yes" : "no", summary, ...parts);
    });
  }

  /**
   * Does something that can be stopped, and says what went wrong.
   * @param {(stop: AbortSignal) => Promise<void>} work
   */
  async working(work) {
    this.forget();
    const mine = (this.work = new AbortController());
    this.busy(true);
    try {
      await work(mine.signal);
    } catch (error) {
      if (!(error instanceof ScriptError)) throw error;
      this.result.replaceChildren();
      this.error.textContent = `${error.line ? `Line ${error.line}: ` : ""}${error.message}`;
      if (error.line) this.editor.showError(error.message, error.line);
    } finally {
      if (this.work === mine) {
        this.work = null;
        this.busy(false);
      }
    }
  }

  /** @param {boolean} now */
  busy(now) {
    this.runs.disabled = this.check.disabled = now;
    this.stop.hidden = !now;
  }

  /**
   * @param {string} well `yes`, `no`, or nothing
   * @param {string} summary
   * @param {...HTMLElement} parts
   */
  show(well, summary, ...parts) {
    this.result.dataset.well = well;
    this.result.replaceChildren(el("p", {}, summary), ...parts);
  }

  async copyLink() {
    const fragment = await toFragment(this.editor.text);
    if (fragment === null) {
      this.error.textContent = "The text is too long for a link.";
      return;
    }
    this.address.value = new URL(fragment, location.href).href;
    this.address.hidden = false;
    this.address.select();
    await navigator.clipboard?.writeText(this.address.value).catch(() => {});
  }
}
