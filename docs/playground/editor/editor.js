// The editor for the model's XML. Tab leaves it; Enter, undo and search keys are CodeMirror's own.

import { defaultKeymap, history, historyKeymap, undo } from "@codemirror/commands";
import { xml } from "@codemirror/lang-xml";
import { bracketMatching, HighlightStyle, indentOnInput, indentRange, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { getChunks, unifiedMergeView } from "@codemirror/merge";
import { Compartment, EditorState } from "@codemirror/state";
import { drawSelection, EditorView, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { Knowledge } from "./completion.js";

const COLOURS = HighlightStyle.define([
  { tag: tags.tagName, color: "var(--pg-tag)" },
  { tag: tags.attributeName, color: "var(--pg-attribute)" },
  { tag: tags.attributeValue, color: "var(--pg-value)" },
  { tag: [tags.comment, tags.processingInstruction], color: "var(--pg-comment)" },
]);

/** The text, where it differs from the published one, and what MuJoCo says of it. */
export class Editor {
  /**
   * @param {HTMLElement} parent
   * @param {string} text
   * @param {{label: string, describedBy: string, schema?: string, changed: () => void, check: () => void}} options schema: of the
   *   XML, its address; without one the text is no XML
   */
  constructor(parent, text, { label, describedBy, schema, changed, check }) {
    this.knowledge = schema === undefined ? null : new Knowledge(schema);
    this.comparison = new Compartment();
    const run = () => {
      check();
      return true;
    };
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers(),
          EditorView.lineWrapping,
          lintGutter(),
          history(),
          drawSelection(),
          indentOnInput(),
          bracketMatching(),
          this.knowledge ? [xml({ autoCloseTags: false }), this.knowledge.extensions] : [],
          syntaxHighlighting(COLOURS),
          keymap.of([{ key: "Mod-Enter", run }, ...defaultKeymap, ...historyKeymap]),
          this.comparison.of([]),
          EditorView.contentAttributes.of({ "aria-label": label, "aria-describedby": describedBy, tabindex: "0" }),
          EditorView.updateListener.of((update) => update.docChanged && changed()),
        ],
      }),
    });
  }

  get text() {
    return this.view.state.doc.toString();
  }

  /** @param {string} text */
  set text(text) {
    if (text === this.text) return;
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
  }

  /** Takes the last change back. */
  undo() {
    undo(this.view);
    this.view.focus();
  }

  /** Indents every line as its elements are nested, and drops spaces at the ends of lines. */
  format() {
    const { doc } = this.view.state;
    const ends = [];
    for (let n = 1; n <= doc.lines; n++) {
      const { from, to, text } = doc.line(n);
      const blank = text.length - text.trimEnd().length;
      if (blank > 0) ends.push({ from: Math.max(to - blank, from), to });
    }
    const trimmed = this.view.state.update({ changes: ends }).state;
    const indented = trimmed.update({ changes: indentRange(trimmed, 0, trimmed.doc.length) }).state;
    this.text = indented.doc.toString();
  }

  /**
   * Shows what differs from another text, or no differences.
   * @param {string | null} original
   */
  compare(original) {
    const extension = original === null ? [] : unifiedMergeView({ original, mergeControls: false, gutter: true });
    this.view.dispatch({ effects: this.comparison.reconfigure(extension) });
    const first = getChunks(this.view.state)?.chunks[0];
    if (first) this.view.dispatch({ effects: EditorView.scrollIntoView(Math.min(first.fromB, this.view.state.doc.length), { y: "center" }) });
  }

  /**
   * Marks a line with a message; without one, marks nothing.
   * @param {string | null} message
   * @param {number | null} [line]
   */
  showError(message, line = null) {
    const { doc } = this.view.state;
    const place = doc.line(Math.min(Math.max(line ?? 1, 1), doc.lines));
    const found = message === null ? [] : [{ from: place.from, to: place.to, severity: /** @type {const} */ ("error"), message }];
    this.view.dispatch(setDiagnostics(this.view.state, found));
    if (message !== null && line !== null) {
      this.view.dispatch({ effects: EditorView.scrollIntoView(place.from, { y: "nearest", yMargin: 30 }) });
    }
  }

  /** Removes the editor. */
  destroy() {
    this.view.destroy();
  }
}
