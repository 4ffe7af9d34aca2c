// A text that stays as it was, run and drawn beside the one that is edited: in step with it, seen from the same place.

import { el } from "../page/elements.js";
import { Samples } from "./samples.js";
import { Scene } from "./scene.js";

/** @import {Engine} from "../engine/client.js" */
/** @import {Player} from "./player.js" */

/** The second picture of a player. */
export class Beside {
  /**
   * @param {Player} player
   * @param {Engine} engine of its own
   */
  constructor(player, engine) {
    this.player = player;
    this.engine = engine;
    this.samples = player.chart.broken = new Samples(Object.keys(player.record.signals));
    this.asked = { seconds: 0, steps: 0 };
    this.waiting = true;
    this.caption = el("figcaption", {}, "As it was");
    const canvas = el("canvas", { role: "img", "aria-label": "The model as it was, live" });
    const { stage } = player.controls.parts;
    const place = el("div", { class: "pg-beside" });
    stage.replaceWith(place);
    const was = el("figure", {}, el("div", { class: "pg-stage" }, canvas), this.caption);
    place.append(was, el("figure", {}, stage, el("figcaption", {}, "With the edit")));
    if (player.record.measured) place.append(el("p", {}, player.record.measured));
    this.scene = new Scene(canvas);
    this.scene.camera = player.scene.camera;
    player.scene.rendered = () => this.scene.render();
    player.beside = this;
    engine.listen(
      (message) => this.receive(message),
      (_, message) => (this.caption.textContent = `As it was: it ended the engine (${message})`),
    );
    engine.renew();
    engine.post({ type: "open", text: player.record.text });
  }

  /** @param {any} message from the engine */
  receive(message) {
    if (message.type === "opened") {
      this.scene.load(message.assets);
      this.waiting = false;
      this.player.dirty = true; // its first picture is asked for
    } else if (message.type === "refused") {
      this.caption.textContent = `As it was: it does not compile. ${message.message}`;
    } else if (message.type === "frame") {
      this.waiting = false;
      const { warnings } = message.frame;
      this.caption.textContent = warnings.length > 0 ? `As it was: MuJoCo warns: ${warnings[0].text}` : "As it was";
      this.samples.add(message.frame.samples);
      this.scene.draw(message.frame);
    }
  }

  /**
   * Asks for what the player asks for; while an answer is owed, it adds up.
   * @param {{seconds: number, steps: number} & Record<string, unknown>} message
   */
  ask(message) {
    this.asked.seconds += message.seconds;
    this.asked.steps += message.steps;
    if (this.waiting) return;
    this.engine.post({ type: "frame", ...message, ...this.asked });
    this.asked = { seconds: 0, steps: 0 };
    this.waiting = true;
  }

  /** Back to the start of the run. */
  reset() {
    this.samples.clear();
    this.asked = { seconds: 0, steps: 0 };
    this.engine.post({ type: "reset" });
  }

  leave() {
    this.engine.end();
    this.scene.dispose();
  }
}
