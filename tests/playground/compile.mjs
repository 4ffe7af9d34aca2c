// Compiles the models in the JSON file named first, each its text and files by path from its folder; prints how many meshes
// each has, or what MuJoCo says, as JSON.

import { readFileSync } from "node:fs";
import loadMujoco from "@mujoco/mujoco";
import { compile, encoded } from "../../docs/playground/engine/compile.js";

const mujoco = await loadMujoco({ print: () => {}, printErr: () => {} });
const said = JSON.parse(readFileSync(process.argv[2], "utf8")).map((/** @type {any} */ { text, files }) => {
  try {
    return compile(mujoco, text, encoded(Object.entries(files))).nmesh;
  } catch (error) {
    return String(error);
  }
});
console.log(JSON.stringify(said));
