export const about = "Move the index over qpos, in the scene without the ball and with it.";

export const controls = [
  { name: "index", label: "index", min: 0, max: 20, step: 1, value: 3 },
  { name: "scene", label: "the other scene" },
];

const SCENES = ["before.xml", "after.xml"];

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.scenes = SCENES.map((name) => {
      const model = mujoco.MjModel.from_xml_string(files[name]);
      const data = new mujoco.MjData(model);
      mujoco.mj_resetDataKeyframe(model, data, 0);
      return { name, model, data };
    });
    [this.scene, this.index] = [0, 3];
  }

  use(name, value) {
    if (name === "index") this.index = value;
    if (name === "scene") this.scene = 1 - this.scene;
  }

  read() {
    const { name, model, data } = this.scenes[this.scene];
    const joint = (at) => Array.from(model.jnt_qposadr).findLastIndex((first) => first <= at);
    const called = (at) => model.jnt(joint(at)).name;
    const there = this.index < model.nq;
    const elbow = Array.from({ length: model.njnt }, (_, j) => j).find((j) => model.jnt(j).name === "elbow");
    const address = model.jnt_qposadr[elbow];
    const owner = there ? `${called(this.index)}, entry ${this.index - model.jnt_qposadr[joint(this.index)]} of it` : "nothing: qpos ends before";
    return [
      ["scene", `${name}, ${model.nq} numbers in qpos`],
      [`qpos[${this.index}]`, there ? data.qpos[this.index].toFixed(4) : "undefined", there && called(this.index) === "elbow" ? "same" : "differs"],
      ["whose number that is", owner],
      ["the elbow's own angle", `qpos[${address}] = ${data.qpos[address].toFixed(4)} rad`],
    ];
  }
}
