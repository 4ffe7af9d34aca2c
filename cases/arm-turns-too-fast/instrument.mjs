export const about = "Make the beam heavier, and give the arm a torque of 2 N m.";

export const controls = [
  { name: "factor", label: "factor of the mass", min: 1, max: 8, step: 1, value: 3 },
  { name: "mass", label: "write body_mass" },
  { name: "inertia", label: "write body_inertia as well" },
];

const BEAM = 2; // the second body

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

  acceleration(model) {
    const data = new this.mujoco.MjData(model);
    data.ctrl[0] = 2;
    this.mujoco.mj_forward(model, data);
    const found = data.qacc[0];
    data.delete();
    model.delete();
    return found;
  }

  read() {
    const { mujoco, text, factor, inertia } = this;
    const written = mujoco.MjModel.from_xml_string(text);
    written.body_mass[BEAM] *= factor;
    if (inertia) for (let axis = 0; axis < 3; axis++) written.body_inertia[3 * BEAM + axis] *= factor;
    const got = this.acceleration(written);
    const compiled = this.acceleration(mujoco.MjModel.from_xml_string(text.replace('mass="1"', `mass="${factor}"`)));
    const told = (each) => `${each.toFixed(3)} rad/s²`;
    return [
      ["written into the model", inertia ? "body_mass and body_inertia" : "body_mass"],
      ["acceleration", told(got), Math.abs(got - compiled) < 1e-6 * compiled ? "same" : "differs"],
      ["acceleration, compiled with that mass", told(compiled)],
    ];
  }
}
