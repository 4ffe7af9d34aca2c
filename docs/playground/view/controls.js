// The elements that show the running model, and the buttons and choices that move it.

import { button, choice, el, group, tickbox } from "../page/elements.js";

/** @import {CaseRecord} from "../record/types.js" */
/** @import {Player} from "./player.js" */

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
  const canvas = el("canvas", { role: "img", "aria-label": `${record.number ? `The model of case ${record.number}` : record.name}, live: ${record.title}` });
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
  const run = button("Run", () => player.toggle(), { class: "pg-run" });
  const speeds = SPEEDS.includes(record.speed) ? SPEEDS : [...SPEEDS, record.speed].sort((a, b) => a - b);
  const speed = choice("Speed", speeds.map((x) => [String(x), `× ${x}`]), String(record.speed), (value) => (player.speed = Number(value)));
  const time = group("Time", run, button("Step", () => player.step()), button("Reset", () => player.reset()), speed.whole, ...overlays.telling);
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
  const parts = { stage, time, warnings, more: el("details", { class: "pg-fold" }, more, view, overlays.whole, pull), signals: signals.whole };
  return { parts, canvas, clock, warnings, run, camera, body, pulls, signals, overlays };
}

/**
 * @param {CaseRecord} record
 * @param {Player} player
 */
function signalChoice(record, player) {
  const shown = Object.entries(record.signals).filter(([, signal]) => !("measure" in signal));
  const options = shown.map(([name, { label, unit }]) => /** @type {[string, string]} */ ([name, unit ? `${label} in ${unit}` : label]));
  const made = choice("Signal", options, options[0][0], (name) => player.chart.show(name));
  const newest = el("output", { class: "pg-newest" });
  const chart = el("div", { class: "pg-chart", role: "img", "aria-label": "The signal over simulated time" });
  const whole = el("div", { class: "pg-signals" }, el("div", { class: "pg-group" }, made.whole, newest), chart);
  return { whole, chart, newest, first: options[0][0] };
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
