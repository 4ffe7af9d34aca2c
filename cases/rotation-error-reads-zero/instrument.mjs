export const about = "Turn the head away from its target, by less and less, and read the angle between the two in four ways.";

export const controls = [{ name: "power", label: "angle, power of ten", min: -9, max: 0, step: 0.1, value: -1 }];

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["camera.xml"]);
    this.data = new mujoco.MjData(this.model);
    this.angle = 0.1;
  }

  use(_, power) {
    this.angle = 10 ** power;
  }

  read() {
    const { mujoco, model, data, angle } = this;
    data.qpos.set([Math.cos(angle / 2), 0, -Math.sin(angle / 2), 0]);
    mujoco.mj_kinematics(model, data);
    const [target, head] = ["target", "head"].map((name) => {
      const body = Array.from({ length: model.nbody }, (_, b) => b).find((b) => model.body(b).name === name);
      return Array.from(data.xquat.slice(4 * body, 4 * body + 4));
    });
    const single = [target, head].map((quat) => quat.map(Math.fround));
    const told = (name, value) => [name, `${value.toPrecision(4)} rad`, Math.abs(value / angle - 1) < 0.01 ? "same" : "differs"];
    return [
      ["true angle", `${angle.toPrecision(4)} rad`],
      told("single precision, arccos of the product", byCosine(...single)),
      told("single precision, the vector part", byVector(...single)),
      told("double precision, arccos of the product", byCosine(target, head)),
      told("double precision, the vector part", byVector(target, head)),
    ];
  }
}

function byCosine(a, b) {
  return 2 * Math.acos(Math.min(1, Math.abs(a.reduce((sum, x, i) => sum + x * b[i], 0))));
}

function byVector([w, x, y, z], [p, q, r, s]) {
  const vector = [w * q - x * p - y * s + z * r, w * r + x * s - y * p - z * q, w * s - x * r + y * q - z * p];
  return 2 * Math.asin(Math.min(1, Math.hypot(...vector)));
}
