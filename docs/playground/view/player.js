// The player of the running model: the scene and the chart in time with the screen, the camera, the pull on a body.

import { el } from "../page/elements.js";
import { Chart } from "./chart.js";
import { firstSpeed, viewControls } from "./controls.js";
import { listenToPointer } from "./pointer.js";
import { Scene } from "./scene.js";

/** @import {Assets} from "../engine/assets.js" */
/** @import {Engine} from "../engine/client.js" */
/** @import {Frame} from "../engine/interactive.js" */
/** @import {Beside} from "./beside.js" */
/** @import {CaseRecord} from "../record/types.js" */

const LONGEST = 0.1; // s of the reader's time that a frame may stand for
const CHART_FRAMES = 4; // frames between two drawings of the chart
const PULL = { frames: 20, share: 0.4 }; // how long a pressed pull lasts, how far of the model's extent it reaches

/** Plays the model: asks the engine for frames, draws them, and passes on what the reader does. */
export class Player {
  /**
   * @param {CaseRecord} record
   * @param {Engine} engine
   * @param {() => void} startEngine called when the reader asks for what only the engine can do
   * @throws {Error} if there is no WebGL
   */
  constructor(record, engine, startEngine) {
    this.record = record;
    this.startEngine = startEngine;
    this.controls = viewControls(record, this);
    this.engine = engine;
    this.speed = record.speed;
    this.speedChosen = false;
    this.running = false;
    /** @type {Assets | null} */
    this.assets = null;
    /** @type {Beside | null} */
    this.beside = null;
    this.looking = -1;
    this.posted = 0;
    this.steps = 0;
    this.dirty = true;
    this.waiting = false;
    /** @type {Frame | null} */
    this.arrived = null;
    /** @type {{name: string, point: number[]} | null} */
    this.held = null;
    /** @type {[number, number] | null} where a pressed pull goes, in the view */
    this.towards = null;
    this.pulled = 0;
    this.scene = new Scene(this.controls.canvas);
    this.chart = new Chart(this.controls.signals.places, record, this.controls.signals.first);
    const pull = {
      wanted: () => this.controls.pulls.getAttribute("aria-pressed") === "true",
      grab: (/** @type {object} */ ray) => engine.post({ type: "grab", ...ray }),
      held: () => this.held?.point ?? null,
      drag: (/** @type {number[]} */ point) => engine.post({ type: "drag", point }),
      release: () => this.release(),
    };
    listenToPointer(this.controls.canvas, this.scene, pull);
    this.palette = new MutationObserver(() => this.chart.restyle());
    this.palette.observe(document.body, { attributeFilter: ["data-md-color-scheme"] });
    this.request = requestAnimationFrame((now) => this.tick(now));
  }

  /**
   * Draws what has arrived and asks for what comes next, once a frame of the screen.
   * @param {number} now in ms
   */
  tick(now) {
    this.request = requestAnimationFrame((next) => this.tick(next));
    const frame = this.arrived;
    this.arrived = null;
    if (this.assets && !this.waiting && (this.running || this.steps > 0 || this.dirty)) this.ask(now);
    if (!this.running) this.posted = now;
    if (frame) this.draw(frame);
  }

  /**
   * Asks the engine for a frame.
   * @param {number} now in ms
   */
  ask(now) {
    const seconds = this.running ? Math.min((now - this.posted) / 1000, LONGEST) * this.speed : 0;
    const overlays = this.controls.overlays.chosen();
    const wanted = { seconds, steps: this.steps, overlays, camera: this.looking };
    this.engine.post({ type: "frame", ...wanted });
    this.beside?.ask(wanted);
    this.posted = now;
    this.waiting = true;
    this.dirty = false;
    this.steps = 0;
  }

  /** @param {Frame | null} frame from the engine */
  receive(frame) {
    this.waiting = false;
    this.arrived = frame;
  }

  /** @param {Frame} frame */
  draw(frame) {
    const { clock, actuators } = this.controls;
    this.scene.draw(frame);
    this.chart.add(frame.samples);
    if (!this.running || this.scene.draws % CHART_FRAMES === 0) {
      this.chart.draw();
      actuators.show(frame.ctrl);
    }
    clock.value = `${frame.time.toFixed(3)} s${frame.late ? ", slower than asked" : ""}`;
    clock.dataset.steps = String(frame.steps);
    this.warn(frame.warnings);
    if (this.pulled > 0 && --this.pulled === 0) this.release();
  }

  /** Runs, or pauses. */
  toggle() {
    this.startEngine();
    this.play(!this.running);
  }

  /** @param {boolean} running */
  play(running) {
    this.running = running;
    this.controls.run.textContent = running ? "Pause" : "Run";
  }

  /** @param {number} speed simulated seconds a second */
  chooseSpeed(speed) {
    this.speed = speed;
    this.speedChosen = true;
  }

  /** @param {Record<string, number>} controls that the reader holds, by actuator */
  control(controls) {
    this.engine.post({ type: "control", controls });
    this.dirty = true;
  }

  /** Makes one step and stands still. */
  step() {
    this.startEngine();
    this.play(false);
    this.steps += 1;
  }

  /** Back to the start of the run. */
  reset() {
    this.startEngine();
    this.engine.post({ type: "reset" });
    this.beside?.reset();
    this.clear();
  }

  /** Forgets what was seen of a run. */
  clear() {
    this.chart.clear();
    this.controls.warnings.replaceChildren();
    this.dirty = true;
  }

  /**
   * Shows a newly compiled model.
   * @param {Assets} assets
   */
  load(assets) {
    const first = this.assets === null;
    this.assets = assets;
    this.arrived = null;
    this.beside?.reset();
    this.scene.load(assets);
    this.clear();
    this.offer(assets);
    this.controls.actuators.load(assets);
    if (!this.speedChosen) {
      this.speed = firstSpeed(this.record, assets.timestep);
      this.controls.speed.select.value = String(this.speed);
    }
    if (first || this.looking >= assets.cameras.length) this.lookThrough(this.ownCamera());
  }

  /** Forgets what was asked of the engine, which is gone. */
  engineLost() {
    this.play(false);
    Object.assign(this, { waiting: false, held: null, towards: null, arrived: null, pulled: 0, dirty: true });
  }

  /**
   * @param {Assets} assets
   */
  offer({ cameras, movable }) {
    const { camera, body } = this.controls;
    const options = [["-1", "free"], ...cameras.map((name, i) => [String(i), name])];
    camera.select.replaceChildren(...options.map(([value, name]) => el("option", { value }, name)));
    camera.select.value = String(this.looking);
    body.select.replaceChildren(...movable.map(({ id, name }) => el("option", { value: String(id) }, name)));
  }

  /** @param {Frame["warnings"]} warnings */
  warn(warnings) {
    const list = this.controls.warnings;
    if (warnings.every(({ name }) => list.querySelector(`[data-name="${name}"]`))) return;
    const triage = document.querySelector('a.md-nav__link[href*="triage"]');
    const general = triage instanceof HTMLAnchorElement ? [{ href: `${triage.href}#warnings`, title: "Triage: warnings" }] : [];
    list.replaceChildren(
      ...warnings.map(({ name, text }) => {
        const pages = [...(this.record.explained[name] ?? []), ...general];
        const links = pages.flatMap(({ href, title }, i) => [i ? ", " : " See ", el("a", { href }, title)]);
        return el("li", { "data-name": name }, `MuJoCo warns: ${text}`, ...links);
      }),
    );
  }

  /**
   * Turns the view.
   * @param {number} right in rad
   * @param {number} up in rad
   */
  turn(right, up) {
    this.scene.camera.orbit(right, up);
    this.scene.render();
  }

  /** @param {number} factor below 1 is nearer */
  zoom(factor) {
    this.scene.camera.approach(factor);
    this.scene.render();
  }

  /** The camera that the record names, by number. */
  ownCamera() {
    const { camera } = this.record;
    return camera === null ? -1 : (this.assets?.cameras.indexOf(camera) ?? -1);
  }

  /** @param {number} camera */
  lookThrough(camera) {
    this.looking = camera;
    this.controls.camera.select.value = String(camera);
    if (camera < 0) this.scene.camera.overview();
    else this.scene.camera.free = false;
    this.dirty = true;
  }

  /**
   * Pulls the chosen body for a moment.
   * @param {number} right
   * @param {number} up
   */
  pull(right, up) {
    const body = Number(this.controls.body.select.value);
    if (!body) return;
    this.play(true);
    this.towards = [right, up];
    this.engine.post({ type: "hold", body });
  }

  /** @param {{name: string, point: number[]} | null} held by the engine */
  grabbed(held) {
    this.held = held;
    if (!held || !this.towards) return;
    const reach = PULL.share * (this.assets?.size.extent ?? 1);
    const [right, up] = this.towards;
    this.engine.post({ type: "drag", point: this.scene.camera.beside(held.point, right * reach, up * reach) });
    this.pulled = PULL.frames;
  }

  release() {
    this.held = null;
    this.towards = null;
    this.engine.post({ type: "release" });
  }

  /** Ends everything and gives the graphics context back. */
  leave() {
    cancelAnimationFrame(this.request);
    this.palette.disconnect();
    this.scene.dispose();
    this.chart.destroy();
    this.beside?.leave();
  }
}
