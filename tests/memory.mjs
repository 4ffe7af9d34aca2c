// Opens, runs and frees the model of a playground file 300 times, broken and repaired in turn; prints the heap's sizes.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { assets } from "../docs/playground/assets.js";
import { Live } from "../docs/playground/live.js";
import { applyEdits } from "../docs/playground/variant.js";

const mujoco = await loadMujoco();
const record = JSON.parse(readFileSync(process.argv[2], "utf8"));
const texts = [record.text, applyEdits(record.text, record.fixes[0].edits)];
const overlays = ["contact_points", "contact_forces", "joint_axes", "body_frames", "inertia"];
const heaps = [];
for (let k = 0; k < 300; k++) {
  const live = new Live(mujoco, texts[k % 2], record);
  assets(mujoco, live.model, live.scene);
  for (let frame = 0; frame < 10; frame++) live.frame(overlays, 0, live.advance(1 / 60, 0));
  live.restart();
  heaps.push(live.data.qpos.buffer.byteLength);
  live.delete();
}
console.log(JSON.stringify(heaps));
