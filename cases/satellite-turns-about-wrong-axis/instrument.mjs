export const about = "Tell the satellite to yaw at 1 rad/s about the world's vertical, and see how it turns in half a second.";

export const controls = [
  { name: "tilt", label: "tilt at the start", min: 0, max: 180, step: 5, value: 90, unit: "°" },
  { name: "written", label: "write the rate into qvel as it is" },
  { name: "turned", label: "turn it into the body's frame first" },
];

const STEPS = 500;

const times = ([a, b, c, d], [e, f, g, h]) => [
  a * e - b * f - c * g - d * h,
  a * f + b * e + c * h - d * g,
  a * g - b * h + c * e + d * f,
  a * h + b * g - c * f + d * e,
];
const inverse = ([w, x, y, z]) => [w, -x, -y, -z];

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["satellite.xml"]);
    this.tilt = 90;
    this.turned = false;
  }

  use(name, value) {
    if (name === "tilt") this.tilt = value;
    else this.turned = name === "turned";
  }

  read() {
    const { mujoco, model, tilt, turned } = this;
    const data = new mujoco.MjData(model);
    const half = (tilt * Math.PI) / 360;
    const start = [Math.cos(half), 0, Math.sin(half), 0];
    const asked = [0, 0, 1];
    const rate = turned ? times(times(inverse(start), [0, ...asked]), start).slice(1) : asked;
    data.qpos.set(start, 3);
    data.qvel.set(rate, 3);
    for (let step = 0; step < STEPS; step++) mujoco.mj_step(model, data);
    const [w, ...axis] = times(Array.from(data.qpos.slice(3, 7)), inverse(start));
    const size = Math.hypot(...axis);
    const speed = (2 * Math.atan2(size, w)) / data.time / size;
    const [x, y, z] = axis.map((part) => part * speed);
    data.delete();
    const told = (each) => `${(Math.abs(each) < 5e-4 ? 0 : each).toFixed(3)} rad/s`;
    return [
      ["angular part of qvel", rate.map((each) => (Math.abs(each) < 5e-4 ? 0 : each).toFixed(3)).join("  ")],
      ["turns about the vertical at", told(z), Math.abs(z - 1) < 1e-3 ? "same" : "differs"],
      ["turns about a horizontal axis at", told(Math.hypot(x, y))],
    ];
  }
}
