// An instrument on a case's page: a few controls, and what the engine reads after each.

import { button, el, group } from "../page/elements.js";
import { Running, ScriptError } from "./client.js";

/** @import {Parts} from "./client.js" */
/** @import {Control, Row, ScriptRecord} from "./types.js" */

/** The controls and the table of readings. */
export class InstrumentPanel {
  /**
   * @param {HTMLElement} root
   * @param {ScriptRecord} record
   * @param {Parts} parts
   */
  constructor(root, record, parts) {
    this.error = el("p", { class: "pg-complaint", role: "alert" });
    this.rows = el("tbody", {});
    this.place = el("div", { class: "pg pg-script" });
    /** @type {[string, number] | null} the control to use next; of a slider only where it is now counts */
    this.next = null;
    this.busy = true;
    root.append(this.place);
    this.running = new Running(parts, record.instrument ?? "", record.files, "instrument");
    void this.asked(this.running.begun, ({ about, controls, rows }) => this.begin(about, controls, rows));
  }

  /**
   * @param {string} about
   * @param {Control[]} controls
   * @param {Row[]} rows
   */
  begin(about, controls, rows) {
    const made = controls.map((control) => (control.max === undefined ? this.button(control) : this.slider(control)));
    const table = el("table", { class: "pg-table pg-readings", "aria-live": "polite" }, this.rows);
    this.place.append(el("p", {}, about), group("Instrument", ...made), this.error, table);
    this.show(rows);
  }

  /** @param {Control} control */
  button({ name, label }) {
    return button(label, () => this.use(name, 0));
  }

  /** @param {Control} control */
  slider({ name, label, min = 0, max = 1, step = 0.01, value = min, unit = "" }) {
    const shown = el("output", {}, `${value} ${unit}`);
    const input = el("input", { type: "range", min: `${min}`, max: `${max}`, step: `${step}`, value: `${value}`, "aria-label": label });
    input.addEventListener("input", () => {
      shown.textContent = `${input.value} ${unit}`;
      this.use(name, Number(input.value));
    });
    return el("label", { class: "pg-slider" }, label, input, shown);
  }

  /**
   * @param {string} name
   * @param {number} value
   */
  use(name, value) {
    this.next = [name, value];
    if (!this.busy) this.ask();
  }

  ask() {
    const [use, value] = /** @type {[string, number]} */ (this.next);
    this.next = null;
    this.busy = true;
    void this.asked(this.running.ask({ use, value }), ({ rows }) => this.show(rows));
  }

  /**
   * @param {Promise<any>} answer
   * @param {(answer: any) => void} then
   */
  async asked(answer, then) {
    try {
      then(await answer);
    } catch (error) {
      if (!(error instanceof ScriptError)) throw error;
      if (!this.error.isConnected) this.place.append(this.error);
      this.error.textContent = `The instrument failed: ${error.message}`;
    }
    this.busy = false;
    if (this.next) this.ask();
  }

  /** @param {Row[]} rows */
  show(rows) {
    const made = rows.map(([label, value, agrees]) => el("tr", agrees ? { "data-holds": agrees === "same" ? "yes" : "no" } : {}, el("th", { scope: "row" }, label), el("td", {}, value)));
    this.rows.replaceChildren(...made);
  }
}
