export const about = "Replay the log with the torques of other rows than its own.";

export const controls = [{ name: "shift", label: "torque from so many rows later", min: -3, max: 3, step: 1, value: 0 }];

const ROWS = 100;

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["pendulum.xml"]);
    this.shift = 0;
    this.log = this.record();
  }

  use(_, value) {
    this.shift = value;
  }

  apply(data, torque) {
    data.ctrl[0] = torque;
    for (let step = 0; step < 10; step++) this.mujoco.mj_step(this.model, data);
  }

  record() {
    const data = new this.mujoco.MjData(this.model);
    this.mujoco.mj_resetDataKeyframe(this.model, data, 0);
    const log = [];
    for (let row = 0, seed = 1; row < ROWS; row++) {
      seed = (48271 * seed) % 2147483647; // the minimal standard generator of Park and Miller
      const torque = 6 * (seed / 2147483647) - 3;
      this.apply(data, torque);
      log.push([data.qpos[0], data.qvel[0], torque]);
    }
    data.delete();
    return log;
  }

  read() {
    const data = new this.mujoco.MjData(this.model);
    const first = Math.max(0, -this.shift);
    [data.qpos[0], data.qvel[0]] = this.log[first];
    const errors = [];
    for (let row = first; row < ROWS && row + this.shift < ROWS; row++) {
      errors.push(Math.abs(data.qpos[0] - this.log[row][0]));
      this.apply(data, this.log[row + this.shift][2]);
    }
    data.delete();
    const most = Math.max(...errors);
    return [
      ["begins with the state of", `row ${first}, and the torque of row ${first + this.shift}`],
      ["angle, off after one row", `${errors[1].toPrecision(3)} rad`],
      ["angle, off at most", `${most.toPrecision(3)} rad`, most < 1e-9 ? "same" : "differs"],
    ];
  }
}
