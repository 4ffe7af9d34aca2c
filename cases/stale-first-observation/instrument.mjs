export const about = "Press in any order. The hand as MuJoCo has it stands beside the hand where the joints put it.";

export const controls = [
  { name: "write", label: "write another pose into qpos" },
  { name: "forward", label: "mj_forward" },
  { name: "step", label: "mj_step" },
];

const AT_REST = "0.000 mm";

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["arm.xml"]);
    this.data = new mujoco.MjData(this.model);
    this.scratch = new mujoco.MjData(this.model);
    mujoco.mj_resetDataKeyframe(this.model, this.data, 0);
    mujoco.mj_forward(this.model, this.data);
    this.poses = 0;
  }

  use(name) {
    const { mujoco, model, data } = this;
    if (name === "write") data.qpos[3] = ++this.poses % 2 ? 0.4 : 1.6;
    if (name === "forward") mujoco.mj_forward(model, data);
    if (name === "step") mujoco.mj_step(model, data);
  }

  read() {
    const { mujoco, model, data, scratch } = this;
    scratch.qpos.set(data.qpos);
    mujoco.mj_forward(model, scratch);
    const [seen, true_] = [Array.from(data.site_xpos), Array.from(scratch.site_xpos)];
    const apart = `${(1000 * Math.hypot(...seen.map((x, i) => x - true_[i]))).toFixed(3)} mm`;
    const place = (at) => `${at.map((x) => x.toFixed(4)).join("  ")} m`;
    return [
      ["elbow, in qpos", `${data.qpos[3].toFixed(4)} rad`],
      ["hand, in site_xpos", place(seen)],
      ["hand, where qpos puts it", place(true_)],
      ["between the two", apart, apart === AT_REST ? "same" : "differs"],
    ];
  }
}
