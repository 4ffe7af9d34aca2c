export const about = "Try one action twice, and go back between the tries to what you saved of the state.";

export const controls = [
  { name: "part", label: "save qpos and qvel" },
  { name: "act", label: "save act as well" },
  { name: "warm", label: "save qacc_warmstart too" },
  { name: "seconds", label: "duration of the action", min: 0.1, max: 0.6, step: 0.1, value: 0.5, unit: "s" },
];

const SPEED = 0.2;

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["table.xml"]);
    this.saved = ["qpos", "qvel"];
    this.seconds = 0.5;
  }

  use(name, value) {
    if (name === "seconds") this.seconds = value;
    else this.saved = { part: ["qpos", "qvel"], act: ["qpos", "qvel", "act"], warm: ["qpos", "qvel", "act", "qacc_warmstart"] }[name];
  }

  push(data) {
    data.ctrl[0] = SPEED;
    for (let step = 0; step < Math.round(this.seconds / this.model.opt.timestep); step++) this.mujoco.mj_step(this.model, data);
    return data.qpos[0];
  }

  read() {
    const data = new this.mujoco.MjData(this.model);
    this.push(data);
    const state = this.saved.map((name) => [name, data[name].slice()]);
    const ends = [0, 1].map(() => {
      for (const [name, values] of state) data[name].set(values);
      return [data.act[0], this.push(data)];
    });
    data.delete();
    const told = (metres) => `${(1000 * metres).toFixed(1)} mm`;
    const apart = Math.abs(ends[1][1] - ends[0][1]);
    return [
      ["saved and restored", this.saved.join(", ")],
      ...ends.map(([act, end], k) => [k ? "the second try" : "the first try", `begins with act ${act.toFixed(4)}, the pusher ends at ${told(end)}`]),
      ["the ends are apart by", apart > 0 && apart < 1e-6 ? `${(1000 * apart).toExponential(0)} mm` : told(apart), apart === 0 ? "same" : "differs"],
    ];
  }
}
