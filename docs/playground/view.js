// The playground on a case's page: brings engine, scene, editor, chart and verdict together.

import { Chart } from "./chart.js";
import { el } from "./dom.js";
import { Editor } from "./editor.js";
import { toFragment } from "./link.js";
import { panel } from "./panel.js";
import { listen } from "./pointer.js";
import { solve } from "./progress.js";
import { Scene } from "./scene.js";
import { applyEdits } from "./variant.js";
import { verdict } from "./verdict.js";

/** @import {Assets} from "./assets.js" */
/** @import {Engine, Loss} from "./client.js" */
/** @import {Frame} from "./live.js" */
/** @import {Playground} from "./record.js" */

const TYPING = 350; // ms without a key before a text is compiled
const LONGEST = 0.1; // s of the reader's time that a frame may stand for
const CHART_FRAMES = 4; // frames between two drawings of the chart
const MAX_LOSSES = 3; // of engines in a row
const PULL = { frames: 20, share: 0.4 }; // how long a pressed pull lasts, how far of the model's extent it reaches
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
    this.speed = record.speed;
    this.running = false;
    this.looking = -1;
    this.waiting = false;
    this.dirty = true;
    this.steps = 0;
    this.losses = 0;
    this.pulled = 0;
    this.posted = 0;
    /** The text that last compiled. */
    this.good = record.text;
    /** @type {string | null} the text that is being compiled */
    this.compiling = null;
    /** @type {string | null} the text to compile next */
    this.next = null;
    /** @type {string | null} the text that is being judged */
    this.judged = null;
    /** @type {Assets | null} */
    this.assets = null;
    /** @type {{name: string, point: number[]} | null} */
    this.held = null;
    /** @type {[number, number] | null} where a pressed pull goes, in the view */
    this.towards = null;
    /** @type {Frame | null} */
    this.arrived = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.typing = undefined;

    this.panel = this.build();
    this.scene = new Scene(this.panel.canvas);
    this.before = [...root.childNodes];
    root.replaceChildren(this.panel.whole);
    this.chart = new Chart(this.panel.signals.chart, record.signals, this.panel.signals.first);
    const options = { label: `${record.name}, the model's XML`, describedBy: this.panel.help, changed: () => this.edited() };
    this.editor = new Editor(this.panel.editor, linked ?? record.text, options);
    this.listen();
    this.palette = new MutationObserver(() => this.chart.restyle());
    this.palette.observe(document.body, { attributeFilter: ["data-md-color-scheme"] });
    this.request = requestAnimationFrame((now) => this.tick(now));
    engine.listen((message) => this.hear(message), (reason, message) => this.mourn(reason, message));
    if (linked === null) {
      this.say("The engine is starting.");
      this.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
      this.open(record.text);
    } else {
      this.say("This text came with the link. Nothing runs until you press Run.");
    }
  }

  build() {
    return panel(this.record, {
      toggle: () => this.play(!this.running),
      step: () => {
        this.play(false);
        this.wake();
        this.steps += 1;
      },
      reset: () => this.restart(),
      speed: (speed) => (this.speed = speed),
      turn: (right, up) => this.move(() => this.scene.eye.orbit(right, up)),
      zoom: (factor) => this.move(() => this.scene.eye.zoom(factor)),
      home: () => this.lookThrough(this.ownCamera()),
      look: (camera) => this.lookThrough(camera),
      pull: (right, up) => this.pull(right, up),
      redraw: () => (this.dirty = true),
      show: (signal) => this.chart.show(signal),
      check: () => this.check(),
      stop: () => this.engine.post({ type: "stop" }),
      remedy: (id) => this.remedy(id),
      restore: () => this.put(this.record.text, null),
      download: () => this.download(),
      link: () => void this.link(),
    });
  }

  listen() {
    const pull = {
      wanted: () => this.panel.pulls.getAttribute("aria-pressed") === "true",
      grab: (/** @type {object} */ ray) => this.engine.post({ type: "grab", ...ray }),
      held: () => this.held?.point ?? null,
      drag: (/** @type {number[]} */ point) => this.engine.post({ type: "drag", point }),
      release: () => this.release(),
    };
    listen(this.panel.canvas, this.scene, pull, () => this.move(() => {}));
  }

  // --- time

  /** @param {number} now */
  tick(now) {
    this.request = requestAnimationFrame((next) => this.tick(next));
    const frame = this.arrived;
    this.arrived = null;
    if (this.assets && !this.waiting && (this.running || this.steps > 0 || this.dirty)) this.ask(now);
    if (!this.running) this.posted = now;
    if (frame) this.draw(frame);
  }

  /** @param {number} now */
  ask(now) {
    const seconds = this.running ? Math.min((now - this.posted) / 1000, LONGEST) * this.speed : 0;
    const overlays = this.panel.overlays.chosen();
    this.engine.post({ type: "frame", seconds, steps: this.steps, overlays, camera: this.looking });
    this.posted = now;
    this.waiting = true;
    this.dirty = false;
    this.steps = 0;
  }

  /** @param {Frame} frame */
  draw(frame) {
    const { clock, signals } = this.panel;
    this.scene.draw(frame);
    this.chart.add(frame.samples);
    if (!this.running || this.scene.draws % CHART_FRAMES === 0) {
      this.chart.draw();
      signals.newest.value = this.chart.newest;
    }
    clock.value = `${frame.time.toFixed(3)} s${frame.late ? ", slower than asked" : ""}`;
    clock.dataset.steps = String(frame.steps);
    this.warn(frame.warnings);
    if (this.pulled > 0 && --this.pulled === 0) this.release();
  }

  /** @param {boolean} running */
  play(running) {
    this.running = running;
    this.panel.run.textContent = running ? "Pause" : "Run";
    if (running) this.wake();
  }

  /** Starts the engine, if the text of a link has kept it from starting. */
  wake() {
    if (this.engine.worker || this.losses > MAX_LOSSES) return;
    this.engine.renew();
    this.open(this.editor.text);
  }

  restart() {
    this.wake();
    this.engine.post({ type: "reset" });
    this.chart.clear();
    this.panel.warnings.replaceChildren();
    this.dirty = true;
  }

  // --- what the engine says

  /** @param {any} message */
  hear(message) {
    switch (message.type) {
      case "booted":
        return this.introduce(message.version);
      case "opened":
        return this.opened(message.assets, message.missing);
      case "refused":
        return message.checking ? this.finished("", refusal(message)) : this.refused(message);
      case "frame":
        this.waiting = false;
        this.losses = 0;
        this.arrived = message.frame;
        return;
      case "grabbed":
        return this.grabbed(message.held);
      case "judging":
        return this.finished(null, `Checking${".".repeat(1 + (message.turn % 3))}`);
      case "judged":
        return this.decide(message.judgement);
      case "unjudged":
        return this.finished("", `This model cannot be checked: ${message.message}.`);
      case "stopped":
        return this.finished("", "Stopped.");
    }
  }

  /** @param {string} version */
  introduce(version) {
    const { engine } = this.record;
    const differs = version === engine ? "as was the evidence on this page" : `the evidence on this page was made with ${engine}`;
    this.say(`This runs in MuJoCo ${version}; ${differs}.`);
  }

  /** @param {string} text */
  open(text) {
    if (this.compiling !== null) {
      this.next = text;
      return;
    }
    this.compiling = text;
    this.engine.post({ type: "open", text });
  }

  /**
   * @param {Assets} assets
   * @param {string[]} missing
   */
  opened(assets, missing) {
    this.good = this.settle();
    const first = this.assets === null;
    this.assets = assets;
    this.scene.load(assets);
    this.chart.clear();
    this.editor.complain(null);
    this.complain(missing.length > 0 ? `It compiles, but the case's run and signals need more: ${missing.join("; ")}.` : "");
    this.panel.warnings.replaceChildren();
    this.offer(assets);
    if (first || this.looking >= assets.cameras.length) this.lookThrough(this.ownCamera());
    this.dirty = true;
  }

  /** @param {{message: string, line: number | null}} error */
  refused(error) {
    const text = this.settle();
    this.editor.complain(error.message, error.line);
    this.complain(`${refusal(error)}${this.assets ? " The last model that compiled goes on." : ""}${this.unknown(text)}`);
    const { worn } = this.engine;
    if (worn) this.engine.renew();
    if (worn || !this.assets) this.open(this.good);
  }

  /** What was compiled; compiles what has been typed since. @returns {string} */
  settle() {
    const [done, next] = [this.compiling ?? this.good, this.next];
    this.compiling = this.next = null;
    if (next !== null) this.open(next);
    return done;
  }

  /**
   * @param {Loss} reason
   * @param {string} message
   */
  mourn(reason, message) {
    const culprit = this.compiling ?? this.judged;
    if (culprit === null && this.good !== this.record.text) this.good = this.record.text;
    Object.assign(this, { waiting: false, held: null, arrived: null, compiling: null, next: null, pulled: 0, dirty: true });
    this.losses += 1;
    this.play(false);
    if (this.judged !== null) this.finished("", `${LOST[reason]} Nothing was found out about this text.`);
    if (culprit !== null && this.assets) this.editor.complain(message);
    const again = reason !== "unavailable" && this.losses <= MAX_LOSSES;
    const next = again ? "The last model that worked is back at its start." : "Reload the page to try again.";
    this.complain(`${LOST[reason]} It said: ${message}. ${next}`);
    if (!again) return;
    this.engine.renew();
    this.open(this.good);
  }

  // --- the text

  edited() {
    clearTimeout(this.typing);
    this.panel.result.replaceChildren();
    this.panel.result.removeAttribute("data-well");
    this.typing = setTimeout(() => this.engine.worker && this.open(this.editor.text), TYPING);
  }

  /**
   * @param {string} text
   * @param {string | null} original
   */
  put(text, original) {
    this.editor.compare(null);
    this.editor.text = text;
    if (original !== null) this.editor.compare(original);
    this.panel.fix.select.value = "";
  }

  /** @param {string} id */
  remedy(id) {
    const { text, fixes, refuted } = this.record;
    const remedy = [...fixes, ...refuted].find((one) => one.id === id);
    if (remedy) this.put(applyEdits(text, remedy.edits), text);
  }

  /** Whether a refused text is one of ours, which a newer engine knows. @param {string} text */
  unknown(text) {
    const { fixes, refuted, engine } = this.record;
    const ours = [...fixes, ...refuted].some(({ edits }) => applyEdits(this.record.text, edits) === text);
    return ours ? ` MuJoCo ${engine}, which made the evidence, knows this; the engine of this page does not.` : "";
  }

  check() {
    this.wake();
    this.judged = this.editor.text;
    this.engine.post({ type: "check", text: this.judged });
    this.panel.check.disabled = true;
    this.panel.stop.hidden = false;
    this.finished(null, "Checking.");
  }

  /** @param {import("./measure.js").Judgement} judgement */
  decide(judgement) {
    const { record } = this;
    const ours = record.fixes.some(({ edits }) => applyEdits(record.text, edits) === this.judged);
    const { summary, table } = verdict(record, judgement, ours);
    if (judgement.well) solve(record.case);
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

  download() {
    const url = URL.createObjectURL(new Blob([this.editor.text], { type: "application/xml" }));
    el("a", { href: url, download: `${this.record.case}.xml` }).click();
    setTimeout(() => URL.revokeObjectURL(url));
  }

  async link() {
    const { address } = this.panel;
    address.value = new URL(await toFragment(this.editor.text), location.href).href;
    address.hidden = false;
    address.select();
    const copied = await navigator.clipboard?.writeText(address.value).then(() => true, () => false);
    this.say(copied ? "The link to this text is copied." : "Copy the link to this text from the field below the editor.");
  }

  // --- the view

  /** @param {() => void} change */
  move(change) {
    change();
    this.scene.render();
  }

  ownCamera() {
    return this.assets?.cameras.indexOf(this.record.camera) ?? -1;
  }

  /** @param {number} camera */
  lookThrough(camera) {
    this.looking = camera;
    this.panel.camera.select.value = String(camera);
    if (camera < 0) this.scene.eye.overview();
    else this.scene.eye.free = false;
    this.dirty = true;
  }

  /** @param {Assets} assets */
  offer({ cameras, movable }) {
    const { camera, body } = this.panel;
    const options = [["-1", "free"], ...cameras.map((name, i) => [String(i), name])];
    camera.select.replaceChildren(...options.map(([value, name]) => el("option", { value }, name)));
    camera.select.value = String(this.looking);
    body.select.replaceChildren(...movable.map(({ id, name }) => el("option", { value: String(id) }, name)));
  }

  /** @param {Frame["warnings"]} warnings */
  warn(warnings) {
    const list = this.panel.warnings;
    if (warnings.every(({ name }) => list.querySelector(`[data-name="${name}"]`))) return;
    const triage = document.querySelector('a.md-nav__link[href*="triage"]');
    const general = triage instanceof HTMLAnchorElement ? [{ href: `${triage.href}#warnings`, title: "Triage: warnings" }] : [];
    list.replaceChildren(
      ...warnings.map(({ name, text }) => {
        const pages = [...(this.record.explained[name] ?? []), ...general];
        const links = pages.flatMap(({ href, title }) => [" ", el("a", { href }, title)]);
        return el("li", { "data-name": name }, `MuJoCo warns: ${text}`, ...links);
      }),
    );
  }

  // --- pulling

  /**
   * @param {number} right
   * @param {number} up
   */
  pull(right, up) {
    const body = Number(this.panel.body.select.value);
    if (!body) return;
    this.play(true);
    this.towards = [right, up];
    this.engine.post({ type: "hold", body });
  }

  /** @param {{name: string, point: number[]} | null} held */
  grabbed(held) {
    this.held = held;
    if (!held || !this.towards) return;
    const reach = PULL.share * (this.assets?.size.extent ?? 1);
    const [right, up] = this.towards;
    this.engine.post({ type: "drag", point: this.scene.eye.beside(held.point, right * reach, up * reach) });
    this.pulled = PULL.frames;
  }

  release() {
    this.held = null;
    this.towards = null;
    this.engine.post({ type: "release" });
  }

  // --- words

  /** @param {string} text */
  say(text) {
    this.panel.status.textContent = text;
  }

  /** @param {string} text */
  complain(text) {
    this.panel.complaint.textContent = text;
  }

  /** Ends everything and puts back what was there before. */
  leave() {
    cancelAnimationFrame(this.request);
    clearTimeout(this.typing);
    this.palette.disconnect();
    this.engine.end();
    this.scene.dispose();
    this.chart.destroy();
    this.editor.destroy();
    this.root.replaceChildren(...this.before);
  }
}

/** @param {{message: string, line: number | null}} error */
function refusal({ message, line }) {
  const said = message.replaceAll("\n", " ").trim();
  return line ? `Line ${line}: ${said}` : said;
}
