export const about = "Make the beam heavier, and give the arm a torque of 2 N m.";

export const controls = [
  { name: "factor", label: "factor of the mass", min: 1, max: 8, step: 1, value: 3 },
  { name: "mass", label: "write body_mass" },
  { name: "inertia", label: "write body_inertia as well" },
];

const [ARM, BEAM] = [1, 2]; // the first body, the second

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.text = files["arm.xml"];
    this.factor = 3;
    this.inertia = false;
  }

  use(name, value) {
    if (name === "factor") this.factor = value;
    else this.inertia = name === "inertia";
  }

  measured(model) {
    const data = new this.mujoco.MjData(model);
    data.ctrl[0] = 2;
    this.mujoco.mj_forward(model, data);
    const found = [data.qacc[0], Math.hypot(data.subtree_com[3 * ARM], data.subtree_com[3 * ARM + 1])];
    data.delete();
    model.delete();
    return found;
  }

  read() {
    const { mujoco, text, factor, inertia } = this;
    const written = mujoco.MjModel.from_xml_string(text);
    written.body_mass[BEAM] *= factor;
    if (inertia) for (let axis = 0; axis < 3; axis++) written.body_inertia[3 * BEAM + axis] *= factor;
    const got = this.measured(written);
    const compiled = this.measured(mujoco.MjModel.from_xml_string(text.replace('mass="1"', `mass="${factor}"`)));
    const told = ([acceleration, centre]) => [`${acceleration.toFixed(3)} rad/s²`, `${centre.toFixed(3)} m from the axis`];
    const same = (k) => (Math.abs(got[k] - compiled[k]) < 1e-6 * compiled[k] ? "same" : "differs");
    return [
      ["written into the model", inertia ? "body_mass and body_inertia" : "body_mass"],
      ["acceleration", told(got)[0], same(0)],
      ["acceleration, compiled with that mass", told(compiled)[0]],
      ["centre of mass", told(got)[1], same(1)],
      ["centre of mass, compiled with that mass", told(compiled)[1]],
    ];
  }
}
