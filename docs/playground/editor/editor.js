// The editor for the model's XML. Tab leaves it; Enter, undo and search keys are CodeMirror's own.

import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { xml } from "@codemirror/lang-xml";
import { bracketMatching, HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { unifiedMergeView } from "@codemirror/merge";
import { Compartment, EditorState } from "@codemirror/state";
import { drawSelection, EditorView, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";

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
   * @param {{label: string, describedBy: string, changed: () => void}} options
   */
  constructor(parent, text, { label, describedBy, changed }) {
    this.comparison = new Compartment();
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
          xml({ autoCloseTags: false }),
          syntaxHighlighting(COLOURS),
          keymap.of([...defaultKeymap, ...historyKeymap]),
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

  /**
   * Shows what differs from another text, or no differences.
   * @param {string | null} original
   */
  compare(original) {
    const extension = original === null ? [] : unifiedMergeView({ original, mergeControls: false, gutter: true });
    this.view.dispatch({ effects: this.comparison.reconfigure(extension) });
    const first = this.view.dom.querySelector(".cm-changedLine, .cm-deletedChunk");
    if (original !== null && first) {
      const position = this.view.posAtDOM(first);
      this.view.dispatch({ effects: EditorView.scrollIntoView(position, { y: "center" }) });
    }
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
