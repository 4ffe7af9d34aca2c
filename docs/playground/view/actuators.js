// A slider for the control of every actuator: what the reader takes hold of is no longer driven as the record says.

import { button, el } from "../page/elements.js";
import { shown } from "../engine/checks.js";

/** @import {Assets} from "../engine/assets.js" */
/** @import {CaseRecord} from "../record/types.js" */

const MARKS = 200; // steps of a slider

/** The sliders. */
export class Actuators {
  /**
   * @param {CaseRecord} record
   * @param {(controls: Record<string, number>) => void} hold given the controls that the reader holds, by actuator
   */
  constructor(record, hold) {
    this.record = record;
    this.hold = hold;
    /** @type {Record<string, number>} */
    this.held = {};
    /** @type {{id: number, name: string, slider: HTMLInputElement, value: HTMLOutputElement}[]} */
    this.rows = [];
    this.list = el("div", { class: "pg-sliders" });
    this.release = button("Give them back", () => this.giveBack(), { hidden: true });
    const note = el("p", {}, "What you set here is for looking. The check drives the model as the case does.");
    this.whole = el("details", { class: "pg-fold", hidden: true }, el("summary", {}, "Controls"), note, this.list, this.release);
  }

  /**
   * Offers the actuators of a newly compiled model; what the reader holds stays held where the name is still there.
   * @param {Assets} assets
   */
  load({ actuators }) {
    this.whole.hidden = actuators.length === 0;
    this.held = Object.fromEntries(Object.entries(this.held).filter(([name]) => actuators.some((each) => each.name === name)));
    this.rows = actuators.map(({ id, name, range }) => {
      const [low, high] = range[0] < range[1] ? range : this.guess(name);
      const slider = el("input", { type: "range", min: String(low), max: String(high), step: String((high - low) / MARKS), "aria-label": `Control of ${name}` });
      const value = el("output", {});
      slider.addEventListener("input", () => this.take(name, Number(slider.value)));
      return { id, name, slider, value };
    });
    this.list.replaceChildren(...this.rows.map(({ name, slider, value }) => el("label", {}, el("span", {}, name), slider, value)));
    this.tell();
  }

  /**
   * Where an actuator without limits may be sent: a little further than the record sends it.
   * @param {string} name
   */
  guess(name) {
    const driven = this.record.run.ctrl[name] ?? 1;
    const values = typeof driven === "number" ? [driven] : driven.map(([, value]) => value);
    const most = 1.5 * (Math.max(...values.map(Math.abs)) || 1);
    return [-most, most];
  }

  /** @param {number[]} ctrl the control of every actuator, by id */
  show(ctrl) {
    for (const { id, name, slider, value } of this.rows) {
      if (!(name in this.held)) slider.value = String(ctrl[id]);
      const text = shown(ctrl[id], 3);
      if (value.value !== text) value.value = text;
    }
  }

  /**
   * @param {string} name
   * @param {number} value
   */
  take(name, value) {
    this.held[name] = value;
    this.tell();
  }

  giveBack() {
    this.held = {};
    this.tell();
  }

  tell() {
    this.release.hidden = Object.keys(this.held).length === 0;
    this.hold({ ...this.held });
  }
}
