// Elements and attributes offered while one types, and MuJoCo's manual on them under the pointer. What can stand where is
// MuJoCo's own schema: scripts/clinic/pages/completion.py.

import { autocompletion, completionKeymap } from "@codemirror/autocomplete";
import { hoverTooltip, keymap } from "@codemirror/view";
import { isNewer, sinceOf } from "../engine/mjcf.js";
import { el } from "../page/elements.js";
import { attributesAround, placeOf } from "./place.js";

/** @import {Completion, CompletionContext, CompletionResult} from "@codemirror/autocomplete" */
/** @import {EditorView} from "@codemirror/view" */

/**
 * @typedef {{says: string, children: string[], attributes: Record<string, [string, string]>}} Element attributes: type and sentence
 * @typedef {{engine: string, elements: Record<string, Element>}} Schema elements by `parent/element`
 */

const WORD = /[\w:.-]/;
const BODY = new Set(["worldbody", "frame", "replicate"]); // which hold what a body holds

/** What the editor knows of MuJoCo's XML; fetched when it is first asked for. */
export class Knowledge {
  /** @param {string} address of the schema */
  constructor(address) {
    this.address = address;
    /** The version of MuJoCo that this page runs; empty until it is known. */
    this.version = "";
    /** @type {Promise<Schema | null> | null} */
    this.asked = null;
  }

  /** @returns {Promise<Schema | null>} null if it cannot be fetched now */
  schema() {
    this.asked ??= fetch(this.address).then(
      (response) => (response.ok ? response.json() : null),
      () => {
        this.asked = null;
        return null;
      },
    );
    return this.asked;
  }

  /** The extensions of an editor that offer and tell what is known. */
  get extensions() {
    return [
      autocompletion({ override: [(context) => this.complete(context)], icons: false, interactionDelay: 0 }),
      keymap.of(completionKeymap),
      hoverTooltip((view, at) => this.hover(view, at)),
    ];
  }

  /**
   * @param {CompletionContext} context
   * @returns {Promise<CompletionResult | null>}
   */
  async complete(context) {
    const text = context.state.doc.toString();
    const place = placeOf(text, context.pos);
    const schema = place && (await this.schema());
    if (!place || !schema) return null;
    const from = context.pos - place.word.length;
    if (place.kind === "element") {
      if (text[from - 1] === "/") return null;
      const around = find(schema, place.parent, "");
      const options = (place.parent ? (around?.children ?? []) : ["mujoco"]).map((name) => this.element(schema, place.parent, name));
      return { from, options, validFor: /^[\w:.-]*$/ };
    }
    const element = find(schema, place.element, place.parent);
    if (!element) return null;
    if (place.kind === "value") {
      const words = /^\[(.+?)\]/.exec(element.attributes[place.attribute]?.[0] ?? "")?.[1].split(/,\s*/) ?? [];
      return words.length > 0 ? { from, options: words.map((label) => ({ label })), validFor: /^\w*$/ } : null;
    }
    if (place.word === "" && !context.explicit && !/\s/.test(text[from - 1])) return null;
    const there = attributesAround(text, context.pos);
    const options = Object.keys(element.attributes)
      .filter((name) => name === place.word || !there.has(name))
      .map((name) => this.attribute(element, place.element, name));
    return { from, options, validFor: /^[\w:.-]*$/ };
  }

  /**
   * @param {Schema} schema
   * @param {string} parent
   * @param {string} name
   * @returns {Completion}
   */
  element(schema, parent, name) {
    const known = find(schema, name, parent);
    const rest = known && known.children.length > 0 && name !== "geom" && name !== "mesh" ? ` ></${name}>` : " />";
    const apply = (/** @type {EditorView} */ view, /** @type {Completion} */ _, /** @type {number} */ from, /** @type {number} */ to) => {
      const closed = /^[^<]*\/?>/.test(view.state.sliceDoc(to, to + 200)); // the name of an element that is there already
      view.dispatch({ changes: { from, to, insert: name + (closed ? "" : rest) }, selection: { anchor: from + name.length + (closed ? 0 : 1) } });
    };
    return { label: name, apply, detail: this.since(name), info: known?.says ? () => told("", known.says, "") : undefined };
  }

  /**
   * @param {Element} element
   * @param {string} around the element's name
   * @param {string} name
   * @returns {Completion}
   */
  attribute(element, around, name) {
    const [kind, says] = element.attributes[name];
    const since = this.since(`${around}.${name}`);
    const apply = (/** @type {EditorView} */ view, /** @type {Completion} */ _, /** @type {number} */ from, /** @type {number} */ to) => {
      const given = /^\s*=/.test(view.state.sliceDoc(to, to + 20));
      view.dispatch({ changes: { from, to, insert: given ? name : `${name}=""` }, selection: { anchor: from + name.length + (given ? 0 : 2) } });
    };
    return { label: name, apply, detail: since || kind, info: () => told(kind, says, since) };
  }

  /**
   * @param {EditorView} view
   * @param {number} at
   */
  async hover(view, at) {
    const text = view.state.doc.toString();
    let [from, to] = [at, at];
    while (WORD.test(text[from - 1] ?? "")) from -= 1;
    while (WORD.test(text[to] ?? "")) to += 1;
    const place = from < to ? placeOf(text, to) : null;
    if (!place || place.kind === "value") return null;
    const schema = await this.schema();
    const element = schema && find(schema, place.element, place.parent);
    if (!element) return null;
    const attribute = place.kind === "attribute" ? element.attributes[place.word] : undefined;
    if (place.kind === "attribute" && !attribute) return null;
    const [kind, says] = attribute ?? ["", element.says];
    const since = this.since(attribute ? `${place.element}.${place.word}` : place.element);
    if (!says && !kind) return null;
    return { pos: from, end: to, above: true, create: () => ({ dom: told(kind, says, since) }) };
  }

  /**
   * The release that a name needs, if it is newer than the page's engine; else empty.
   * @param {string} name an element, or `element.attribute`
   */
  since(name) {
    const release = sinceOf(name);
    return release && this.version && isNewer(release, this.version) ? `needs MuJoCo ${release}; this page runs ${this.version}` : "";
  }
}

/**
 * An element of the schema.
 * @param {Schema} schema
 * @param {string} name
 * @param {string} parent
 * @returns {Element | undefined}
 */
function find({ elements }, name, parent) {
  const named = BODY.has(name) && name === "worldbody" ? "body" : name;
  const around = BODY.has(parent) ? "body" : parent;
  const own = elements[`${around}/${named}`] ?? elements[`mujoco/${named}`] ?? elements[named];
  const found = own ?? Object.entries(elements).find(([path]) => path.endsWith(`/${named}`))?.[1];
  if (!found || name === "worldbody") return found && { ...found, attributes: {} };
  return BODY.has(name) ? { ...found, children: elements["mujoco/body"].children } : found;
}

/**
 * @param {string} kind
 * @param {string} says
 * @param {string} since
 */
function told(kind, says, since) {
  const lines = [kind && el("code", {}, kind), says, since && el("strong", {}, since)].filter(Boolean);
  return el("div", { class: "pg-told-of" }, ...lines.map((line) => el("p", {}, line)));
}
