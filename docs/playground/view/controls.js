// The elements that show the running model, and the buttons and choices that move it.

import { button, choice, el, group, tickbox } from "../page/elements.js";
import { Actuators } from "./actuators.js";
import { runs } from "./chart.js";

/** @import {CaseRecord} from "../record/types.js" */
/** @import {Player} from "./player.js" */

const LEAST_STEPS = 30; // a second: fewer would be seen one by one
const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
const OVERLAYS = {
  contact_points: "contacts",
  contact_forces: "contact forces",
  joint_axes: "joint axes",
  body_frames: "body frames",
  centre_of_mass: "centre of mass",
  inertia: "inertia boxes",
  convex_hulls: "convex hulls",
  transparent: "transparent",
  actuators: "actuators",
  cameras: "cameras",
};
const TURN = 0.15; // rad a press

/**
 * @param {CaseRecord} record
 * @param {Player} player
 */
export function viewControls(record, player) {
  const actuators = new Actuators(record, (controls) => player.control(controls));
  const canvas = el("canvas", { role: "img", tabindex: "0", "aria-label": `${record.number ? `The model of case ${record.number}` : record.name}, live: ${record.title}` });
  const clock = el("output", { class: "pg-clock" });
  const stage = el("div", { class: "pg-stage" }, canvas, clock);
  const warnings = el("ul", { class: "pg-warnings", "aria-live": "polite" });
  const signals = signalChoice(record, player);
  const overlays = overlayBoxes(record, player);
  const camera = choice("Camera", [], "", (value) => player.lookThrough(Number(value)));
  const body = choice("Body", [], "", () => {});
  const pulls = el("button", { type: "button", "aria-pressed": "false" }, "Drag pulls");
  pulls.addEventListener("click", () => {
    const pressed = pulls.getAttribute("aria-pressed") === "true";
    pulls.setAttribute("aria-pressed", String(!pressed));
    stage.toggleAttribute("data-pulling", !pressed);
  });
  const run = button("Run", () => player.toggle(), { class: "pg-run", title: "Space", "aria-keyshortcuts": "Space" });
  const speeds = [...new Set([...SPEEDS, record.speed])].sort((a, b) => a - b);
  const speed = choice("Speed", speeds.map((x) => [String(x), `× ${x}`]), String(record.speed), (value) => player.chooseSpeed(Number(value)));
  const time = group("Time", run, button("Step", () => player.step()), button("Reset", () => player.reset()));
  const pace = group("Pace", speed.whole, ...overlays.telling);
  const view = group(
    "View",
    button("←", () => player.turn(-TURN, 0), { "aria-label": "Turn the view left" }),
    button("→", () => player.turn(TURN, 0), { "aria-label": "Turn the view right" }),
    button("↑", () => player.turn(0, TURN), { "aria-label": "Tilt the view up" }),
    button("↓", () => player.turn(0, -TURN), { "aria-label": "Tilt the view down" }),
    button("+", () => player.zoom(0.85), { "aria-label": "Zoom in" }),
    button("−", () => player.zoom(1 / 0.85), { "aria-label": "Zoom out" }),
    button("Model's view", () => player.lookThrough(player.ownCamera())),
    camera.whole,
  );
  const pull = group(
    "Pull a body",
    pulls,
    body.whole,
    button("←", () => player.pull(-1, 0), { "aria-label": "Pull the body left" }),
    button("→", () => player.pull(1, 0), { "aria-label": "Pull the body right" }),
    button("↑", () => player.pull(0, 1), { "aria-label": "Pull the body up" }),
    button("↓", () => player.pull(0, -1), { "aria-label": "Pull the body down" }),
  );
  const more = el("summary", {}, "View, overlays, and pulling a body");
  const parts = { stage, time, pace, warnings, sliders: actuators.whole, more: el("details", { class: "pg-fold pg-more" }, more, view, overlays.whole, pull), signals: signals.whole, legend: signals.legend };
  return { parts, canvas, clock, warnings, run, speed, camera, body, pulls, signals, overlays, actuators };
}

/**
 * The speed to begin with: the record's, unless so few steps a second were made that the model would jump.
 * @param {CaseRecord} record
 * @param {number} timestep in s
 */
export function firstSpeed(record, timestep) {
  const enough = SPEEDS.find((speed) => speed >= LEAST_STEPS * timestep) ?? 1;
  return Math.max(record.speed, enough);
}

/**
 * @param {CaseRecord} record
 * @param {Player} player
 */
function signalChoice(record, player) {
  const shown = Object.entries(record.signals).filter(([, signal]) => !("measure" in signal));
  const all = shown.map(([name, { label, unit, seen }]) => ({ seen, option: /** @type {[string, string]} */ ([name, unit ? `${label} in ${unit}` : label]) }));
  const options = all.filter(({ seen }) => seen).map(({ option }) => option);
  const others = all.filter(({ seen }) => !seen).map(({ option }) => option);
  const more = /** @type {[string, string][]} */ (others.length > 0 ? [["", "more, which may tell the cause"]] : []);
  const made = choice("Signal", [...options, ...more], options[0][0], (name) => {
    if (name) return player.chart.show(name);
    made.select.replaceChildren(...[...options, ...others].map(([value, text]) => el("option", { value }, text)));
    made.select.value = player.chart.name;
  });
  const newest = el("output", { class: "pg-newest" });
  const plot = el("div", { class: "pg-chart", role: "img", "aria-label": "The signal over simulated time" });
  const asked = el("p", { class: "pg-asked" });
  const judged = record.checks.fixed.length > 0;
  const [yours, other] = runs(record);
  const broken = tickbox(other, () => player.chart.compare(broken.box.checked));
  broken.box.checked = true;
  const key = el("p", { class: "pg-key" }, el("span", { class: "pg-mine" }, yours), broken.whole, ...(judged ? [el("span", { class: "pg-wanted" }, "asked")] : []));
  const whole = el("div", { class: "pg-signals" }, el("div", { class: "pg-group" }, made.whole, newest), plot);
  return { whole, legend: el("div", {}, key, asked), places: { plot, newest, asked }, first: options[0][0] };
}

/**
 * @param {CaseRecord} record
 * @param {Player} player
 */
function overlayBoxes(record, player) {
  const boxes = Object.entries(OVERLAYS).map(([name, label]) => ({ name, ...tickbox(label, () => changed()) }));
  const changed = () => {
    tell.setAttribute("aria-pressed", String(told()));
    player.dirty = true;
  };
  const chosen = () => boxes.filter(({ box }) => box.checked).map(({ name }) => name);
  const told = () => boxes.every(({ name, box }) => box.checked || !record.telling.includes(name));
  const tell = button("Show what matters", () => {
    const all = !told();
    for (const { name, box } of boxes) box.checked = all && record.telling.includes(name);
    changed();
  });
  tell.setAttribute("aria-pressed", "false");
  const telling = record.telling.length > 0 ? [tell] : [];
  return { whole: group("Overlays", ...boxes.map(({ whole }) => whole)), telling, chosen };
}
