export const about = "Log the joints of the swinging pendulum, and look at the log.";

export const controls = [
  { name: "view", label: "log data.qpos" },
  { name: "copy", label: "log a copy of it" },
  { name: "rows", label: "rows", min: 2, max: 100, step: 1, value: 50 },
];

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["pendulum.xml"]);
    this.copies = false;
    this.rows = 50;
  }

  use(name, value) {
    if (name === "rows") this.rows = value;
    else this.copies = name === "copy";
  }

  read() {
    const { mujoco, model, copies, rows } = this;
    const data = new mujoco.MjData(model);
    mujoco.mj_resetDataKeyframe(model, data, 0);
    const [log, seen] = [[], []];
    for (let row = 0; row < rows; row++) {
      log.push(copies ? data.qpos.slice() : data.qpos);
      seen.push(data.qpos[0]);
      for (let step = 0; step < 10; step++) mujoco.mj_step(model, data);
    }
    const logged = log.map((row) => row[0]);
    data.delete();
    const different = new Set(logged).size;
    const told = (angle) => `${angle.toFixed(4)} rad`;
    return [
      ["first row of the log", `${told(logged[0])}, the joint was at ${told(seen[0])}`],
      ["last row of the log", `${told(logged[rows - 1])}, the joint was at ${told(seen[rows - 1])}`],
      ["rows that differ", `${different} of ${rows}`, different === rows ? "same" : "differs"],
    ];
  }
}
