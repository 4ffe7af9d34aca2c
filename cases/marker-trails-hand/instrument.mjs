export const about = "The arm falls for 0.2 s, and after each step the marker is put where the hand is said to be.";

export const controls = [
  { name: "timestep", label: "timestep", min: 1, max: 10, step: 1, value: 5, unit: "ms" },
  { name: "stepped", label: "read the hand right after mj_step" },
  { name: "forward", label: "call mj_forward before" },
];

const SECONDS = 0.2;

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["arm.xml"]);
    this.timestep = 5;
    this.forward = false;
  }

  use(name, value) {
    if (name === "timestep") this.timestep = value;
    else this.forward = name === "forward";
  }

  read() {
    const { mujoco, model, timestep, forward } = this;
    model.opt.timestep = timestep / 1000;
    const [data, scratch] = [new mujoco.MjData(model), new mujoco.MjData(model)];
    data.qpos.set([-0.3, 0]);
    let marker = [];
    for (let step = 0; step < Math.round((1000 * SECONDS) / timestep); step++) {
      mujoco.mj_step(model, data);
      if (forward) mujoco.mj_forward(model, data);
      marker = Array.from(data.site_xpos);
    }
    scratch.qpos.set(data.qpos);
    scratch.qvel.set(data.qvel);
    mujoco.mj_forward(model, scratch);
    const apart = Math.hypot(...Array.from(scratch.site_xpos).map((x, i) => x - marker[i]));
    const speed = Math.hypot(...Array.from(scratch.sensordata).slice(3, 6));
    data.delete();
    scratch.delete();
    return [
      ["speed of the hand", `${speed.toFixed(3)} m/s`],
      ["the marker is behind by", `${(1000 * apart).toFixed(2)} mm`, apart < 1e-9 ? "same" : "differs"],
      ["which is a delay of", `${((1000 * apart) / speed).toFixed(2)} ms`],
    ];
  }
}
