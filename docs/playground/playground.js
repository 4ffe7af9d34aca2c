// The playground on a case's page: joins what the reader sees, edits and asks with what the engine answers.

import { compileError, Draft } from "./editor/draft.js";
import { sentence } from "./engine/errors.js";
import { verdict } from "./judge/verdict.js";
import { button, el, group } from "./page/elements.js";
import { hints } from "./page/hints.js";
import { kept } from "./page/kept.js";
import { listen } from "./page/keys.js";
import { markSolved } from "./page/solved.js";
import { Player } from "./view/player.js";

export { Beside } from "./view/beside.js";

/** @import {Engine, Loss} from "./engine/client.js" */
/** @import {Judgement, Progress} from "./judge/judgement.js" */
/** @import {Linked} from "./page/link.js" */
/** @import {CaseRecord} from "./record/types.js" */

const EDITED = "The text was edited during the check. Check again.";
const MAX_LOSSES = 3; // of engines in a row
const LOST = {
  crashed: "The engine crashed and was started anew.",
  silent: "The engine did not answer for 6 s; it was ended and started anew.",
  unavailable: "The engine could not be fetched. Are you offline?",
};

/** One mounted playground. */
export class Playground {
  /**
   * @param {HTMLElement} root
   * @param {CaseRecord} record
   * @param {Engine} engine running, unless something came with a link
   * @param {Linked | null} linked what came with a link: its text is shown, and nothing is run before the reader asks
   * @throws {Error} if there is no WebGL
   */
  constructor(root, record, engine, linked) {
    this.root = root;
    this.record = record;
    this.engine = engine;
    this.losses = 0;
    /** Whether the broken run has been asked for. */
    this.referred = false;
    /** @type {string | null} the text that is being judged */
    this.judged = null;
    this.status = el("p", { class: "pg-status", role: "status" });
    this.player = new Player(record, engine, () => this.startEngine());
    const act = { changed: () => this.edited(), check: () => this.check(), stop: () => engine.post({ type: "stop" }) };
    const own = record.number === 0 ? null : kept(record.case);
    this.draft = new Draft(record, engine, linked && "text" in linked ? linked.text : (own ?? record.text), act);
    this.before = [...root.childNodes];
    const pg = el("div", { class: "pg" }, this.layout());
    listen(pg, { check: () => this.check(), toggle: () => this.player.toggle(), take: (file) => void this.draft.take(file) });
    root.replaceChildren(pg);
    pg.scrollIntoView({ block: "start" });
    this.setStatus("The engine is starting.");
    this.greet(linked, own);
    addEventListener("hashchange", reloadForLink);
    engine.listen(
      (message) => this.receive(message),
      (reason, message) => this.engineLost(reason, message),
    );
    if (linked === null) {
      this.draft.compile(this.draft.text);
      this.player.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
    }
  }

  /** What is seen stands beside what is edited: the check's button in the middle of the first, so that both are in sight. */
  layout() {
    const { stage, time, pace, warnings, sliders, more, signals, legend } = this.player.controls.parts;
    const { parts, checking } = this.draft.controls;
    const see = el("div", { class: "pg-see" }, stage, group("Run and check", time, ...checking), signals);
    const told = el("div", { class: "pg-said" }, legend, this.status, warnings);
    const asked = this.record.hints.length > 0 ? [hints(this.record.hints)] : [];
    const edit = el("div", { class: "pg-edit" }, ...parts, ...asked, pace, sliders, more);
    return el("div", { class: "pg-room" }, el("div", { class: "pg-left" }, see, told), edit);
  }

  /**
   * Says where the text in the editor comes from.
   * @param {Linked | null} linked
   * @param {string | null} own the text that the reader left here
   */
  greet(linked, own) {
    const { draft } = this;
    if (linked && "problem" in linked) {
      const shown = own === null ? "case's own text" : "text that you left here";
      this.setStatus(`${linked.problem} What you see is the ${shown}. Nothing runs until you press Run.`);
    } else if (linked) {
      this.setStatus("This text came with the link. Nothing runs until you press Run.");
      if (own !== null && own !== draft.text) this.status.append(" ", button("Show the text that I left here", () => (draft.editor.text = own)));
    } else if (own !== null) {
      draft.controls.kept.textContent = "Your text, as you left it in this browser.";
    }
  }

  /** Starts the engine, if the text of a link has kept it from starting, and has it compile what was typed last. */
  startEngine() {
    if (this.engine.worker) return this.draft.settle();
    if (this.losses > MAX_LOSSES) return;
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
        if (!this.referred && this.record.checks.fixed.length > 0) this.engine.post({ type: "refer" });
        this.referred = true;
        return this.draft.accepted(message.missing);
      case "referred":
        return this.player.chart.refer(message);
      case "refused":
        return message.checking ? this.showResult("", compileError(message)) : this.refused(message);
      case "frame":
        this.losses = 0;
        return this.player.receive(message.frame);
      case "grabbed":
        return this.player.grabbed(message.held);
      case "judging":
        return this.showProgress(message);
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
    if (this.draft.editor.knowledge) this.draft.editor.knowledge.version = version;
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
    const said = reason === "silent" ? "" : ` ${sentence(message).replace(/\.?$/, ".")}`;
    if (suspected) this.draft.editor.showError(said.trim() || LOST[reason]);
    const again = reason !== "unavailable" && this.losses <= MAX_LOSSES;
    const next = again ? " The last model that worked is back at its start." : "";
    this.draft.showError(`${LOST[reason]}${said}${next}`);
    if (!again) {
      this.setStatus("The engine is not running.");
      this.status.append(" ", button("Try again", () => this.retry()));
      return;
    }
    this.engine.renew();
    this.draft.compile(this.draft.good);
  }

  /** Starts the engine once more, as the reader asks. */
  retry() {
    this.losses = 0;
    this.setStatus("The engine is starting.");
    this.draft.showError("");
    this.startEngine();
  }

  /** Has the text in the editor judged. */
  check() {
    if (this.draft.controls.check.disabled || this.record.checks.fixed.length === 0) return;
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
    const { summary, parts } = verdict(this.record, judgement, this.judged);
    if (judgement.repaired) markSolved(this.record.case);
    this.showResult(judgement.repaired ? "yes" : "no", summary, ...parts);
    this.draft.controls.result.scrollIntoView({ block: "nearest" });
  }

  /** @param {Progress} progress of a check */
  showProgress({ where, share }) {
    const { result } = this.draft.controls;
    const said = `Checking ${where}.`;
    const percent = `${Math.floor(100 * share)} %`;
    const bar = result.querySelector("progress");
    if (result.firstChild?.textContent === said && bar?.nextSibling) {
      bar.value = share;
      bar.nextSibling.textContent = percent;
    } else {
      const made = el("progress", { max: "1", value: String(share), "aria-label": "Progress" });
      this.showResult(null, said, el("div", { class: "pg-progress" }, made, el("span", { "aria-hidden": "true" }, percent)));
    }
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
    removeEventListener("hashchange", reloadForLink);
    this.engine.end();
    this.player.leave();
    this.draft.leave();
    this.root.replaceChildren(...this.before);
  }
}

/** Opens the text of a link that was put into this page's address; the reader's own is kept. */
function reloadForLink() {
  if (location.hash.startsWith("#model=")) location.reload();
}
