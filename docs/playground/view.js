// The playground on a case's page: what the controls do, and what the engine's answers mean.

import { el } from "./dom.js";
import { Draft, refusal } from "./draft.js";
import { panel } from "./panel.js";
import { solve } from "./progress.js";
import { Stage } from "./stage.js";
import { verdict } from "./verdict.js";

/** @import {Engine, Loss} from "./client.js" */
/** @import {Judgement} from "./measure.js" */
/** @import {Playground} from "./record.js" */

const EDITED = "The text was edited during the check. Check again.";
const MAX_LOSSES = 3; // of engines in a row
const LOST = {
  crashed: "The engine crashed and was started anew.",
  silent: "The engine did not answer for 6 s; it was ended and started anew.",
  unavailable: "The engine could not be started.",
};

/** One mounted playground. */
export class View {
  /**
   * @param {HTMLElement} root
   * @param {Playground} record
   * @param {Engine} engine running, unless there is a text from a link
   * @param {string | null} linked a text from a link: shown, and not run before the reader asks
   * @throws {Error} if there is no WebGL
   */
  constructor(root, record, engine, linked) {
    this.root = root;
    this.record = record;
    this.engine = engine;
    this.losses = 0;
    /** @type {string | null} the text that is being judged */
    this.judged = null;
    this.panel = this.build();
    this.stage = new Stage(this.panel, record, engine);
    this.before = [...root.childNodes];
    root.replaceChildren(this.panel.whole);
    this.draft = new Draft(this.panel, record, engine, linked ?? record.text, () => this.edited());
    this.say(linked === null ? "The engine is starting." : "This text came with the link. Nothing runs until you press Run.");
    engine.listen(
      (message) => this.hear(message),
      (reason, message) => this.mourn(reason, message),
    );
    if (linked === null) {
      this.draft.compile(record.text);
      this.stage.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    }
  }

  build() {
    const awake = (/** @type {() => void} */ act) => () => {
      this.wake();
      act();
    };
    return panel(this.record, {
      toggle: awake(() => this.stage.play(!this.stage.running)),
      step: awake(() => this.stage.step()),
      reset: awake(() => this.stage.reset()),
      check: awake(() => this.check()),
      stop: () => this.engine.post({ type: "stop" }),
      speed: (speed) => (this.stage.speed = speed),
      turn: (right, up) => this.stage.move(() => this.stage.scene.eye.orbit(right, up)),
      zoom: (factor) => this.stage.move(() => this.stage.scene.eye.zoom(factor)),
      home: () => this.stage.lookThrough(this.stage.ownCamera()),
      look: (camera) => this.stage.lookThrough(camera),
      pull: (right, up) => this.stage.pull(right, up),
      redraw: () => (this.stage.dirty = true),
      show: (signal) => this.stage.chart.show(signal),
      remedy: (id) => this.draft.remedy(id),
      restore: () => this.draft.put(this.record.text, null),
      download: () => this.draft.download(),
      link: () => void this.draft.link(),
    });
  }

  /** Starts the engine, if the text of a link has kept it from starting. */
  wake() {
    if (this.engine.worker || this.losses > MAX_LOSSES) return;
    this.engine.renew();
    this.draft.compile(this.draft.text);
  }

  /** @param {any} message */
  hear(message) {
    switch (message.type) {
      case "booted":
        return this.introduce(message.version);
      case "opened":
        this.stage.load(message.assets);
        return this.draft.accepted(message.missing);
      case "refused":
        return message.checking ? this.finished("", refusal(message)) : this.refused(message);
      case "frame":
        this.losses = 0;
        return this.stage.receive(message.frame);
      case "grabbed":
        return this.stage.grabbed(message.held);
      case "judging":
        return this.finished(null, `Checking${".".repeat(1 + (message.turn % 3))}`);
      case "judged":
        return this.decide(message.judgement);
      case "unjudged":
        return this.finished("", `This model cannot be checked: ${message.message}.`);
      case "stopped":
        return this.finished("", this.judged === this.draft.text ? "Stopped." : EDITED);
    }
  }

  /** @param {string} version of the engine */
  introduce(version) {
    const { engine } = this.record;
    const differs = version === engine ? "as was the evidence on this page" : `the evidence on this page was made with ${engine}`;
    this.say(`This runs in MuJoCo ${version}; ${differs}.`);
  }

  /** @param {{message: string, line: number | null}} error */
  refused(error) {
    const running = this.stage.assets !== null;
    this.draft.refused(error, running);
    const { worn } = this.engine;
    if (worn) {
      this.engine.renew();
      this.stage.lost();
      if (this.judged !== null) this.finished("", "Stopped: the engine was renewed. Check again.");
    }
    if (worn || !running) this.draft.compile(this.draft.good);
  }

  /**
   * @param {Loss} reason
   * @param {string} message
   */
  mourn(reason, message) {
    const suspected = this.draft.compiling !== null || this.judged !== null;
    this.losses += 1;
    this.stage.lost();
    this.draft.lost(suspected);
    if (this.judged !== null) this.finished("", `${LOST[reason]} Nothing was found out about this text.`);
    if (suspected) this.draft.editor.complain(message);
    const again = reason !== "unavailable" && this.losses <= MAX_LOSSES;
    const next = again ? "The last model that worked is back at its start." : "Reload the page to try again.";
    this.draft.complain(`${LOST[reason]} It said: ${message}. ${next}`);
    if (!again) return;
    this.engine.renew();
    this.draft.compile(this.draft.good);
  }

  check() {
    this.judged = this.draft.text;
    this.engine.post({ type: "check", text: this.judged });
    this.panel.check.disabled = true;
    this.panel.stop.hidden = false;
    this.finished(null, "Checking.");
  }

  /** What was found out about the text no longer holds. */
  edited() {
    this.panel.result.replaceChildren();
    this.panel.result.removeAttribute("data-well");
    if (this.judged !== null) this.engine.post({ type: "stop" });
  }

  /** @param {Judgement} judgement */
  decide(judgement) {
    if (this.judged !== this.draft.text) return this.finished("", EDITED);
    const { summary, table } = verdict(this.record, judgement, this.draft.isOurs(this.judged));
    if (judgement.well) solve(this.record.case);
    this.finished(judgement.well ? "yes" : "no", summary, table);
  }

  /**
   * @param {string | null} well `yes` or `no` when judged, empty when not, null while judging
   * @param {string} summary
   * @param {...HTMLElement} parts
   */
  finished(well, summary, ...parts) {
    const { result, check, stop } = this.panel;
    result.dataset.well = well ?? "";
    result.replaceChildren(el("p", {}, summary), ...parts);
    if (well === null) return;
    this.judged = null;
    check.disabled = false;
    stop.hidden = true;
  }

  /** @param {string} text */
  say(text) {
    this.panel.status.textContent = text;
  }

  /** Ends everything and puts back what was there before. */
  leave() {
    this.engine.end();
    this.stage.leave();
    this.draft.leave();
    this.root.replaceChildren(...this.before);
  }
}
