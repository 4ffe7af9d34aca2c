// The playground on a case's page: joins what the reader sees, edits and asks with what the engine answers.

import { compileError, Draft } from "./editor/draft.js";
import { verdict } from "./judge/verdict.js";
import { button, el } from "./page/elements.js";
import { markSolved } from "./page/solved.js";
import { Player } from "./view/player.js";

export { Beside } from "./view/beside.js";

/** @import {Engine, Loss} from "./engine/client.js" */
/** @import {Judgement} from "./judge/judgement.js" */
/** @import {CaseRecord} from "./record/types.js" */

const EDITED = "The text was edited during the check. Check again.";
const MAX_LOSSES = 3; // of engines in a row
const LOST = {
  crashed: "The engine crashed and was started anew.",
  silent: "The engine did not answer for 6 s; it was ended and started anew.",
  unavailable: "The engine could not be started.",
};

/** One mounted playground. */
export class Playground {
  /**
   * @param {HTMLElement} root
   * @param {CaseRecord} record
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
    this.status = el("p", { class: "pg-status", role: "status" });
    this.player = new Player(record, engine, () => this.startEngine());
    const act = { changed: () => this.edited(), check: () => this.check(), stop: () => engine.post({ type: "stop" }) };
    this.draft = new Draft(record, engine, linked ?? record.text, act);
    const { stage, time, warnings, more, signals } = this.player.controls.parts;
    const parts = [stage, time, this.status, warnings, more, signals, ...this.draft.controls.parts, ...(record.hints.length > 0 ? [hints(record)] : [])];
    this.before = [...root.childNodes];
    root.replaceChildren(el("div", { class: "pg" }, ...parts));
    this.setStatus(linked === null ? "The engine is starting." : "This text came with the link. Nothing runs until you press Run.");
    engine.listen(
      (message) => this.receive(message),
      (reason, message) => this.engineLost(reason, message),
    );
    if (linked === null) {
      this.draft.compile(record.text);
      this.player.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    }
  }

  /** Starts the engine, if the text of a link has kept it from starting. */
  startEngine() {
    if (this.engine.worker || this.losses > MAX_LOSSES) return;
    this.engine.renew();
    this.draft.compile(this.draft.text);
  }

  /** @param {any} message from the engine */
  receive(message) {
    switch (message.type) {
      case "booted":
        return this.showVersion(message.version);
      case "opened":
        this.player.load(message.assets);
        return this.draft.accepted(message.missing);
      case "refused":
        return message.checking ? this.showResult("", compileError(message)) : this.refused(message);
      case "frame":
        this.losses = 0;
        return this.player.receive(message.frame);
      case "grabbed":
        return this.player.grabbed(message.held);
      case "judging":
        return this.showResult(null, `Checking ${message.where}${".".repeat(1 + (message.turn % 3))}`);
      case "judged":
        return this.showJudgement(message.judgement);
      case "unjudged":
        return this.showResult("", `This model cannot be checked: ${message.message}.`);
      case "stopped":
        return this.showResult("", this.judged === this.draft.text ? "Stopped." : EDITED);
    }
  }

  /** @param {string} version of the engine */
  showVersion(version) {
    const { engine } = this.record;
    const differs = version === engine ? "as was the evidence on this page" : `the evidence on this page was made with ${engine}`;
    this.setStatus(`This runs in MuJoCo ${version}${engine && `; ${differs}`}.`);
    this.draft.controls.tellNeeds(version);
  }

  /**
   * Tells why a text does not compile, and goes on with the last one that did.
   * @param {{message: string, line: number | null, newer: string}} error
   */
  refused(error) {
    const running = this.player.assets !== null;
    this.draft.refused(error, running);
    const { wornOut } = this.engine;
    if (wornOut) {
      this.engine.renew();
      this.player.engineLost();
      if (this.judged !== null) this.showResult("", "Stopped: the engine was renewed. Check again.");
    }
    if (wornOut || !running) this.draft.compile(this.draft.good);
  }

  /**
   * Tells what became of the engine, and starts another with the last text that can be trusted.
   * @param {Loss} reason
   * @param {string} message
   */
  engineLost(reason, message) {
    const suspected = this.draft.compiling !== null || this.judged !== null;
    this.losses += 1;
    this.player.engineLost();
    this.draft.engineLost(suspected);
    if (this.judged !== null) this.showResult("", `${LOST[reason]} Nothing was found out about this text.`);
    if (suspected) this.draft.editor.showError(message);
    const again = reason !== "unavailable" && this.losses <= MAX_LOSSES;
    const next = again ? "The last model that worked is back at its start." : "Reload the page to try again.";
    this.draft.showError(`${LOST[reason]} It said: ${message}. ${next}`);
    if (!again) return;
    this.engine.renew();
    this.draft.compile(this.draft.good);
  }

  /** Has the text in the editor judged. */
  check() {
    this.startEngine();
    this.judged = this.draft.text;
    this.engine.post({ type: "check", text: this.judged });
    this.draft.controls.check.disabled = true;
    this.draft.controls.stop.hidden = false;
    this.showResult(null, "Checking.");
  }

  /** Forgets what was found out about the text, which no longer holds. */
  edited() {
    this.draft.controls.result.replaceChildren();
    this.draft.controls.result.removeAttribute("data-well");
    if (this.judged !== null) this.engine.post({ type: "stop" });
  }

  /** @param {Judgement} judgement */
  showJudgement(judgement) {
    if (this.judged !== this.draft.text) return this.showResult("", EDITED);
    const { summary, parts } = verdict(this.record, judgement, this.draft.isOurs(this.judged));
    if (judgement.repaired) markSolved(this.record.case);
    this.showResult(judgement.repaired ? "yes" : "no", summary, ...parts);
  }

  /**
   * @param {string | null} well `yes` or `no` when judged, empty when not, null while judging
   * @param {string} summary
   * @param {...HTMLElement} parts
   */
  showResult(well, summary, ...parts) {
    const { result, check, stop } = this.draft.controls;
    result.dataset.well = well ?? "";
    result.replaceChildren(el("p", {}, summary), ...parts);
    if (well === null) return;
    this.judged = null;
    check.disabled = false;
    stop.hidden = true;
  }

  /** @param {string} text */
  setStatus(text) {
    this.status.textContent = text;
  }

  /** Ends everything and puts back what was there before. */
  leave() {
    this.engine.end();
    this.player.leave();
    this.draft.leave();
    this.root.replaceChildren(...this.before);
  }
}

/**
 * Hints one by one, the last of which opens the diagnosis.
 * @param {CaseRecord} record
 */
function hints(record) {
  const said = el("ol", { "aria-live": "polite" });
  const ask = button("Give me a hint", () => {
    const hint = record.hints[said.childElementCount];
    if (hint) {
      said.append(el("li", {}, el("strong", {}, `${hint.title}: `), hint.text));
      ask.textContent = said.childElementCount < record.hints.length ? "Another hint" : "Open the diagnosis";
      return;
    }
    const fold = document.querySelector("details.question");
    if (fold instanceof HTMLDetailsElement) fold.open = true;
    fold?.scrollIntoView({ block: "start" });
  });
  return el("div", { class: "pg-hints" }, said, ask);
}
