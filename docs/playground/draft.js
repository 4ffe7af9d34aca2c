// The reader's text: edited, compiled while the last good model goes on, compared, shared.

import { el } from "./dom.js";
import { Editor } from "./editor.js";
import { toFragment } from "./link.js";
import { applyEdits } from "./variant.js";

/** @import {Engine} from "./client.js" */
/** @import {Panel} from "./panel.js" */
/** @import {Playground} from "./record.js" */

const TYPING = 350; // ms without a key before a text is compiled

/** The text in the editor and what the engine makes of it. */
export class Draft {
  /**
   * @param {Panel} panel
   * @param {Playground} record
   * @param {Engine} engine
   * @param {string} text
   * @param {() => void} changed called with every edit
   */
  constructor(panel, record, engine, text, changed) {
    this.panel = panel;
    this.record = record;
    this.engine = engine;
    this.changed = changed;
    /** The text that last compiled. */
    this.good = record.text;
    /** @type {string | null} the text that is being compiled */
    this.compiling = null;
    /** @type {string | null} the text to compile next */
    this.next = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.typing = undefined;
    const options = { label: `${record.name}, the model's XML`, describedBy: panel.help, changed: () => this.edited() };
    this.editor = new Editor(panel.editor, text, options);
  }

  get text() {
    return this.editor.text;
  }

  /** Whether the text is one of the record's fixes, or with `all` one of its remedies. */
  isOurs(text = this.text, all = false) {
    const { fixes, refuted } = this.record;
    return (all ? [...fixes, ...refuted] : fixes).some(({ edits }) => applyEdits(this.record.text, edits) === text);
  }

  edited() {
    clearTimeout(this.typing);
    this.changed();
    this.panel.fix.select.value = "";
    this.typing = setTimeout(() => this.engine.worker && this.compile(this.text), TYPING);
  }

  /**
   * Has a text compiled, after the one that is being compiled.
   * @param {string} text
   */
  compile(text) {
    if (this.compiling !== null) {
      this.next = text;
      return;
    }
    this.compiling = text;
    this.engine.post({ type: "open", text });
  }

  /** @param {string[]} missing what of the record's run and signals the model lacks */
  accepted(missing) {
    this.good = this.settle();
    if (this.good !== this.text) return; // what is said of the text in the editor still holds
    this.editor.complain(null);
    this.complain(missing.length > 0 ? `It compiles, but the case's run and signals need more: ${missing.join("; ")}.` : "");
  }

  /**
   * @param {{message: string, line: number | null}} error
   * @param {boolean} running whether a model that compiled goes on
   */
  refused(error, running) {
    const text = this.settle();
    this.editor.complain(error.message, error.line);
    const newer = this.isOurs(text, true)
      ? ` MuJoCo ${this.record.engine}, which made the evidence, knows this; the engine of this page does not.`
      : "";
    this.complain(refusal(error) + (running ? " (The last model that compiled goes on.)" : "") + newer);
  }

  /** What was compiled; has what was typed since compiled. @returns {string} */
  settle() {
    const [done, next] = [this.compiling ?? this.good, this.next];
    this.compiling = this.next = null;
    if (next !== null) this.compile(next);
    return done;
  }

  /**
   * The engine is gone: goes back to a text that can be trusted.
   * @param {boolean} suspected whether a text that was being compiled or judged is to blame
   */
  lost(suspected) {
    this.compiling = this.next = null;
    if (!suspected) this.good = this.record.text;
  }

  /**
   * @param {string} text
   * @param {string | null} original to show the differences from
   */
  put(text, original) {
    this.editor.compare(null);
    this.editor.text = text;
    if (original !== null) this.editor.compare(original);
  }

  /** @param {string} id of a fix or a refuted remedy */
  remedy(id) {
    const { text, fixes, refuted } = this.record;
    const remedy = [...fixes, ...refuted].find((one) => one.id === id);
    if (!remedy) return;
    this.put(applyEdits(text, remedy.edits), text);
    this.panel.fix.select.value = id;
  }

  /** @param {string} text */
  complain(text) {
    this.panel.complaint.textContent = text;
  }

  download() {
    const url = URL.createObjectURL(new Blob([this.text], { type: "application/xml" }));
    el("a", { href: url, download: `${this.record.case}.xml` }).click();
    setTimeout(() => URL.revokeObjectURL(url));
  }

  /** Puts a link to the text into the field below and, where the browser lets it, into the clipboard. */
  async link() {
    const { address, linked } = this.panel;
    address.value = new URL(await toFragment(this.text), location.href).href;
    address.hidden = false;
    address.select();
    const copied = await navigator.clipboard?.writeText(address.value).then(
      () => true,
      () => false,
    );
    linked.textContent = copied ? "The link to this text is copied." : "Copy the link to this text from the field above.";
  }

  leave() {
    clearTimeout(this.typing);
    this.editor.destroy();
  }
}

/** @param {{message: string, line: number | null}} error */
export function refusal({ message, line }) {
  const said = message.replaceAll("\n", " ").trim();
  return line ? `Line ${line}: ${said}` : said;
}
