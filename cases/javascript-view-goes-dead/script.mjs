import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";

const mujoco = await loadMujoco();
const model = mujoco.MjModel.from_xml_string(readFileSync("pendulum.xml", "utf8"));
const data = new mujoco.MjData(model);
const qpos = data.qpos;

/** The joint angles that the page draws. */
const drawn = new Float64Array(model.nq);
function draw() {
  drawn.set(qpos);
}

/** Keeps the present state, to go back to. */
const snapshots = [];
function snapshot() {
  const copy = new mujoco.MjData(model);
  copy.qpos.set(data.qpos);
  copy.qvel.set(data.qvel);
  snapshots.push(copy);
}

console.log(`memory = ${data.qpos.buffer.byteLength / 2 ** 20} MiB`);
mujoco.mj_resetDataKeyframe(model, data, 0);
for (let frame = 0; frame < 12; frame++) {
  if (frame === 4 || frame === 8) snapshot();
  for (let step = 0; step < 50; step++) mujoco.mj_step(model, data);
  draw();
  console.log(`drawn angle = ${drawn[0].toFixed(6)} rad`);
  console.log(`simulated angle = ${data.qpos[0].toFixed(6)} rad`);
}
console.log(`memory = ${data.qpos.buffer.byteLength / 2 ** 20} MiB`);
console.log(`length of the stored view = ${qpos.length}`);
