// Opens, runs and frees the model of a playground file 300 times, broken and repaired in turn; prints the heap's sizes.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { assets } from "../../docs/playground/engine/assets.js";
import { InteractiveSimulation } from "../../docs/playground/engine/interactive.js";
import { applyEdits } from "../../docs/playground/engine/variant.js";

const mujoco = await loadMujoco();
const record = JSON.parse(readFileSync(process.argv[2], "utf8"));
const texts = [record.text, applyEdits(record.text, record.fixes[0].edits)];
const overlays = ["contact_points", "contact_forces", "joint_axes", "body_frames", "inertia"];
const heaps = [];
for (let k = 0; k < 300; k++) {
  const simulation = new InteractiveSimulation(mujoco, texts[k % 2], record);
  assets(mujoco, simulation.model, simulation.scene);
  for (let frame = 0; frame < 10; frame++) simulation.frame(overlays, 0, simulation.advance(1 / 60, 0));
  simulation.restart();
  heaps.push(simulation.data.qpos.buffer.byteLength);
  simulation.delete();
}
console.log(JSON.stringify(heaps));
