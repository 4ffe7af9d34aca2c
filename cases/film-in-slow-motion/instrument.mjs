export const about = "Film the ball for two simulated seconds, and read what the film is like.";

export const controls = [
  { name: "rate", label: "images a second", min: 10, max: 100, step: 10, value: 50 },
  { name: "steps", label: "steps for an image", min: 1, max: 50, step: 1, value: 1 },
];

const DURATION = 2; // s, simulated

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["ball.xml"]);
    this.rate = 50;
    this.steps = 1;
  }

  use(name, value) {
    this[name] = value;
  }

  read() {
    const { mujoco, model, rate, steps } = this;
    const data = new mujoco.MjData(model);
    mujoco.mj_resetDataKeyframe(model, data, 0);
    let [images, bounce, seen, step] = [0, null, Infinity, 0];
    while (data.time < DURATION) {
      mujoco.mj_step(model, data);
      step += 1;
      if (step % steps !== 0) continue;
      const height = data.qpos[0];
      if (bounce === null && height > seen) bounce = (images - 1) / rate;
      [images, seen] = [images + 1, height];
    }
    const [length, pace] = [step / steps / rate, (data.time * steps * rate) / step];
    data.delete();
    return [
      ["images to draw", `${images}`],
      ["length of the film", `${length.toFixed(2)} s`],
      ["first bounce in the film", `${bounce.toFixed(2)} s`],
      ["pace", pace.toFixed(3), Math.abs(pace - 1) < 0.001 ? "same" : "differs"],
    ];
  }
}
