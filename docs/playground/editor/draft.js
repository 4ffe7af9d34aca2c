// The reader's text: edited, compiled while the last good model goes on, compared, shared.

import { applyEdits } from "../engine/variant.js";
import { el } from "../page/elements.js";
import { keep } from "../page/kept.js";
import { toFragment } from "../page/link.js";
import { editorControls } from "./controls.js";
import { Editor } from "./editor.js";

/** @import {Engine} from "../engine/client.js" */
/** @import {CaseRecord} from "../record/types.js" */

const MAX_FILE = 1_000_000; // bytes
const TYPING = 350; // ms without a key before a text is compiled

/** The text in the editor and what the engine makes of it. */
export class Draft {
  /**
   * @param {CaseRecord} record
   * @param {Engine} engine
   * @param {string} text
   * @param {{changed: () => void, check: () => void, stop: () => void}} act what an edit does, and the buttons of the check
   */
  constructor(record, engine, text, act) {
    this.controls = editorControls(record, this, act);
    this.record = record;
    this.engine = engine;
    this.changed = act.changed;
    /** The text that last compiled. */
    this.good = record.text;
    /** @type {string | null} the text that is being compiled */
    this.compiling = null;
    /** @type {string | null} the text to compile next */
    this.next = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.typing = undefined;
    const options = { label: `${record.name}, the model's XML`, describedBy: this.controls.help, schema: engine.source.schema, changed: () => this.edited(), check: act.check };
    this.editor = new Editor(this.controls.editor, text, options);
    this.controls.changes.disabled = text === record.text;
  }

  get text() {
    return this.editor.text;
  }

  edited() {
    clearTimeout(this.typing);
    this.changed();
    this.keep();
    if (location.hash.startsWith("#model=")) history.replaceState(history.state, "", location.pathname + location.search); // a reload brings this text
    this.controls.fix.select.value = "";
    this.controls.why.textContent = "";
    this.typing = setTimeout(() => this.settle(), TYPING);
  }

  /** Has compiled what was typed last, if it waits for that. */
  settle() {
    if (this.typing === undefined) return;
    clearTimeout(this.typing);
    this.typing = undefined;
    this.compile(this.text);
  }

  /** Keeps the text in this browser for the next visit, if it is not the case's own. */
  keep() {
    const { number, case: slug, text } = this.record;
    const same = this.text === text;
    this.controls.changes.disabled = same;
    if (number === 0) return; // the reader's own model, whose file the reader has
    const done = keep(slug, same ? null : this.text);
    this.controls.kept.textContent = same ? "" : done ? "Kept in this browser." : "This browser keeps nothing: copy the link or download the text before you leave.";
  }

  /**
   * Has a text compiled, after the one that is being compiled.
   * @param {string} text
   */
  compile(text) {
    if (!this.engine.worker) return; // the engine was lost before; it compiles the text when it is started again
    if (this.compiling !== null) {
      this.next = text;
      return;
    }
    this.compiling = text;
    this.engine.post({ type: "open", text });
  }

  /** @param {string[]} missing what of the record's run and signals the model lacks */
  accepted(missing) {
    this.good = this.compiled();
    if (this.good !== this.text) return; // what is said of the text in the editor still holds
    this.editor.showError(null);
    this.showError(missing.length > 0 ? `It compiles, but the case's run and signals need more: ${missing.join("; ")}.` : "");
  }

  /**
   * @param {{message: string, line: number | null, newer: string}} error
   * @param {boolean} running whether a model that compiled goes on
   */
  refused(error, running) {
    this.compiled();
    this.editor.showError(error.message, error.line);
    this.showError(compileError(error) + (running ? " (The last model that compiled goes on.)" : ""));
  }

  /** Ends the compilation, starts that of what was typed since, and gives the text that was compiled. @returns {string} */
  compiled() {
    const [done, next] = [this.compiling ?? this.good, this.next];
    this.compiling = this.next = null;
    if (next !== null) this.compile(next);
    return done;
  }

  /**
   * Goes back to a text that can be trusted, since the engine is gone.
   * @param {boolean} suspected whether a text that was being compiled or judged is to blame
   */
  engineLost(suspected) {
    this.compiling = this.next = null;
    if (!suspected) this.good = this.record.text;
  }

  /**
   * Puts a remedy into the editor, with what it changes marked.
   * @param {string} id of a fix or a refuted remedy
   */
  showRemedy(id) {
    const { text, fixes, refuted } = this.record;
    const remedy = [...fixes, ...refuted].find((one) => one.id === id);
    if (!remedy) return;
    this.compare(false);
    this.editor.text = applyEdits(text, remedy.edits);
    this.compare(true);
    this.controls.fix.select.value = id;
    this.controls.why.textContent = `${remedy.title}.`;
  }

  /** @param {boolean} compared whether what differs from the case's own text is marked */
  compare(compared) {
    this.controls.changes.setAttribute("aria-pressed", String(compared));
    this.editor.compare(compared ? this.record.text : null);
  }

  /** Puts the case's own text back. */
  restore() {
    this.compare(false);
    this.editor.text = this.record.text;
  }

  /**
   * Puts a model from a file into the editor.
   * @param {File} file
   */
  async take(file) {
    if (file.size > MAX_FILE) return this.say(`${file.name} is larger than ${MAX_FILE / 1e6} MB, too large for this editor.`);
    const text = await file.text();
    if (!/<(mujoco|robot)[\s>]/.test(text)) return this.say(`${file.name} is no model: there is no <mujoco> in it.`);
    this.compare(false);
    this.editor.text = text;
    const instead = this.record.checks.fixed.length > 0 ? " The checks are still those of this case." : "";
    this.say(`${file.name} is in the editor; Undo takes it out again.${instead}`);
  }

  /** @param {string} text about what was done with the text */
  say(text) {
    this.controls.linked.textContent = text;
  }

  /** @param {string} text about what is wrong with the text in the editor; empty when nothing is */
  showError(text) {
    this.controls.error.textContent = text;
  }

  download() {
    const url = URL.createObjectURL(new Blob([this.text], { type: "application/xml" }));
    el("a", { href: url, download: `${this.record.case}.xml` }).click();
    setTimeout(() => URL.revokeObjectURL(url));
  }

  /** Puts a link to the text into the field below and, where the browser lets it, into the clipboard. */
  async copyLink() {
    const { address } = this.controls;
    const fragment = await toFragment(this.text);
    if (fragment === null) return this.say("This text is too long for a link. Download it instead.");
    address.value = new URL(fragment, location.href).href;
    address.hidden = false;
    address.select();
    const copied = await navigator.clipboard?.writeText(address.value).then(
      () => true,
      () => false,
    );
    this.say(copied ? "The link to this text is copied." : "Copy the link to this text from the field above.");
  }

  leave() {
    clearTimeout(this.typing);
    this.editor.destroy();
  }
}

/**
 * An error of the compiler in a line, after the release that the text needs, if that is known.
 * @param {{message: string, line: number | null, newer: string}} error
 */
export function compileError({ message, line, newer }) {
  const said = message.replaceAll("\n", " ").trim();
  return `${newer && `${newer} `}${line ? `Line ${line}: ` : ""}${said}`;
}
