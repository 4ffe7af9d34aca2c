// The playground's elements: the stage with its buttons, the signals, the editor's place, the verdict's place.

import { button, choice, el, group, tickbox } from "./dom.js";

/** @import {Playground} from "./record.js" */

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
const LIVE = "https://live.mujoco.org/?model=";

/**
 * What the controls do.
 * @typedef {object} Actions
 * @property {() => void} toggle run or pause
 * @property {() => void} step
 * @property {() => void} reset
 * @property {(speed: number) => void} speed
 * @property {(right: number, up: number) => void} turn
 * @property {(factor: number) => void} zoom
 * @property {() => void} home the model's own camera again
 * @property {(camera: number) => void} look through a camera
 * @property {(right: number, up: number) => void} pull the chosen body
 * @property {() => void} redraw
 * @property {(signal: string) => void} show a signal
 * @property {() => void} check
 * @property {() => void} stop checking
 * @property {(id: string) => void} remedy put into the editor
 * @property {() => void} restore
 * @property {() => void} download
 * @property {() => void} link
 */

/** @typedef {ReturnType<typeof panel>} Panel */

/**
 * @param {Playground} record
 * @param {Actions} act
 */
export function panel(record, act) {
  const canvas = el("canvas", { role: "img", "aria-label": `The model of case ${record.number}, live: ${record.title}` });
  const clock = el("output", { class: "pg-clock" });
  const stage = el("div", { class: "pg-stage" }, canvas, clock);
  const status = el("p", { class: "pg-status", role: "status" });
  const warnings = el("ul", { class: "pg-warnings", "aria-live": "polite" });
  const signals = signalChoice(record, act);
  const overlays = overlayBoxes(record, act);
  const camera = choice("Camera", [], "", (value) => act.look(Number(value)));
  const body = choice("Body", [], "", () => {});
  const pulls = el("button", { type: "button", "aria-pressed": "false" }, "Drag pulls");
  pulls.addEventListener("click", () => {
    const pressed = pulls.getAttribute("aria-pressed") === "true";
    pulls.setAttribute("aria-pressed", String(!pressed));
    stage.toggleAttribute("data-pulling", !pressed);
  });
  const run = button("Run", act.toggle, { class: "pg-run" });
  const speeds = SPEEDS.includes(record.speed) ? SPEEDS : [...SPEEDS, record.speed].sort((a, b) => a - b);
  const speed = choice("Speed", speeds.map((x) => [String(x), `× ${x}`]), String(record.speed), (value) => act.speed(Number(value)));
  const time = group("Time", run, button("Step", act.step), button("Reset", act.reset), speed.whole, ...overlays.telling);
  const view = group(
    "View",
    button("←", () => act.turn(-TURN, 0), { "aria-label": "Turn the view left" }),
    button("→", () => act.turn(TURN, 0), { "aria-label": "Turn the view right" }),
    button("↑", () => act.turn(0, TURN), { "aria-label": "Tilt the view up" }),
    button("↓", () => act.turn(0, -TURN), { "aria-label": "Tilt the view down" }),
    button("+", () => act.zoom(0.85), { "aria-label": "Zoom in" }),
    button("−", () => act.zoom(1 / 0.85), { "aria-label": "Zoom out" }),
    button("Model's view", act.home),
    camera.whole,
  );
  const pull = group(
    "Pull a body",
    pulls,
    body.whole,
    button("←", () => act.pull(-1, 0), { "aria-label": "Pull the body left" }),
    button("→", () => act.pull(1, 0), { "aria-label": "Pull the body right" }),
    button("↑", () => act.pull(0, 1), { "aria-label": "Pull the body up" }),
    button("↓", () => act.pull(0, -1), { "aria-label": "Pull the body down" }),
  );
  const editing = editorPlace(record, act);
  const whole = el(
    "div",
    { class: "pg" },
    stage,
    time,
    status,
    warnings,
    el("details", { class: "pg-fold" }, el("summary", {}, "View, overlays, and pulling a body"), view, overlays.whole, pull),
    signals.whole,
    ...editing.parts,
    hints(record),
  );
  return { whole, stage, canvas, clock, status, warnings, run, camera, body, pulls, signals, overlays, ...editing };
}

/**
 * @param {Playground} record
 * @param {Actions} act
 */
function signalChoice(record, act) {
  const shown = Object.entries(record.signals).filter(([, signal]) => !("measure" in signal));
  const options = shown.map(([name, { label, unit }]) => /** @type {[string, string]} */ ([name, unit ? `${label} in ${unit}` : label]));
  const made = choice("Signal", options, options[0][0], act.show);
  const newest = el("output", { class: "pg-newest" });
  const chart = el("div", { class: "pg-chart", role: "img", "aria-label": "The signal over simulated time" });
  const whole = el("div", { class: "pg-signals" }, el("div", { class: "pg-group" }, made.whole, newest), chart);
  return { whole, chart, newest, first: options[0][0] };
}

/**
 * @param {Playground} record
 * @param {Actions} act
 */
function overlayBoxes(record, act) {
  const boxes = Object.entries(OVERLAYS).map(([name, label]) => ({ name, ...tickbox(label, () => changed()) }));
  const changed = () => {
    tell.setAttribute("aria-pressed", String(told()));
    act.redraw();
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

/**
 * @param {Playground} record
 * @param {Actions} act
 */
function editorPlace(record, act) {
  const help = `pg-help-${record.case}`;
  const editor = el("div", { class: "pg-editor" });
  const complaint = el("p", { class: "pg-complaint", role: "alert" });
  const check = button("Check my fix", act.check, { class: "pg-check" });
  const stop = button("Stop checking", act.stop, { hidden: true });
  const result = el("div", { class: "pg-result", role: "status" });
  const linked = el("p", { role: "status" });
  const address = el("input", { class: "pg-address", readonly: true, hidden: true, "aria-label": "Link to this text" });
  const remedies = /** @type {[string, string][]} */ ([
    ["", "choose one"],
    ...record.fixes.map(({ id, title }) => [id, title]),
    ...record.refuted.map(({ id, title }) => [id, `does not help: ${title}`]),
  ]);
  const fix = choice("Show the fix", remedies, "", (id) => id && act.remedy(id));
  const parts = [
    el("p", { class: "pg-file" }, el("strong", {}, record.name), el("span", { id: help }, " Edit it; Tab leaves the editor, as does Escape and then Tab.")),
    editor,
    complaint,
    group("Repair", check, stop, fix.whole),
    result,
    group("Text", button("Restore", act.restore), button("Download XML", act.download), button("Copy link", act.link), ...live(record)),
    address,
    linked,
  ];
  return { parts, editor, complaint, check, stop, result, address, linked, fix, help };
}

/**
 * MuJoCo Live fetches the published model itself, which it can from a public host only.
 * @param {Playground} record
 */
function live(record) {
  if (location.protocol !== "https:") return [];
  const model = new URL(record.name, location.href).href;
  const note = "The model as published; your edits stay here";
  return [el("a", { href: LIVE + encodeURIComponent(model), target: "_blank", rel: "noopener", title: note }, "Open in MuJoCo Live")];
}

/** @param {Playground} record */
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
