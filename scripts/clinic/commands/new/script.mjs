import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";

const mujoco = await loadMujoco();
const model = mujoco.MjModel.from_xml_string(readFileSync("model.xml", "utf8"));
const data = new mujoco.MjData(model);

data.qpos[0] = 60;
mujoco.mj_forward(model, data);

console.log(`height of the tip = ${data.site("tip").xpos[2].toFixed(6)} m`);
