export const about = "Choose how fast the simulation runs beside the clock on the wall.";

export const controls = [{ name: "speed", label: "times real time", min: 1, max: 60, step: 1, value: 1 }];

const [PERIOD, KP, KD, FALLEN, SECONDS] = [0.01, 20, 4, 0.2, 10];

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["pole.xml"]);
    this.speed = 1;
  }

  use(_, value) {
    this.speed = value;
  }

  read() {
    const { mujoco, model, speed } = this;
    const data = new mujoco.MjData(model);
    mujoco.mj_resetDataKeyframe(model, data, 0);
    let [clock, next, calls] = [0, 0, 0]; // ns on the wall
    while (data.time < SECONDS && Math.abs(data.qpos[0]) < FALLEN) {
      if (clock >= next) {
        data.ctrl[0] = -KP * data.qpos[0] - KD * data.qvel[0];
        next = clock + 1e9 * PERIOD;
        calls += 1;
      }
      mujoco.mj_step(model, data);
      clock += Math.floor((1e9 * model.opt.timestep) / speed);
    }
    const upright = data.time;
    data.delete();
    return [
      ["the controller is called", `${calls} times`],
      ["simulated time from call to call", `${((1000 * upright) / calls).toFixed(1)} ms`],
      ["upright for", `${upright.toFixed(3)} s`, upright > SECONDS - 0.01 ? "same" : "differs"],
    ];
  }
}
