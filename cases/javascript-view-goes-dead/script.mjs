import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";

const mujoco = await loadMujoco();
const model = mujoco.MjModel.from_xml_string(readFileSync("pendulum.xml", "utf8"));
const data = new mujoco.MjData(model);
mujoco.mj_resetDataKeyframe(model, data, 0);

const qpos = data.qpos; // looked up once, read in every frame
const angle = () => qpos[0];

let ghost, frames = 0;
for (let frame = 0; frame < 6; frame++) {
  if (frame === 3) ghost = new mujoco.MjData(model); // a second pendulum joins the first
  for (let step = 0; step < 50; step++) mujoco.mj_step(model, data);
  if (Number.isFinite(angle())) frames++;
  console.log(`drawn angle = ${angle()} rad`);
  console.log(`simulated angle = ${data.qpos[0]} rad`);
}
console.log(`frames drawn = ${frames}`);
