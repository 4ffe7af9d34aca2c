export const about = "Make the top larger, put the mug down, and wait a second.";

export const controls = [
  { name: "scale", label: "factor of the size", min: 1, max: 6, step: 0.5, value: 3 },
  { name: "place", label: "from the middle to the edge", min: 0, max: 95, step: 5, value: 80, unit: "%" },
  { name: "written", label: "write the size into the model" },
  { name: "compiled", label: "compile it with the size" },
];

const [HALF, TOP, MUG, SECONDS] = [0.1, 2, 1, 1]; // m; the third geom; the first body; s

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.text = files["table.xml"];
    this.scale = 3;
    this.place = 80;
    this.compiled = false;
  }

  use(name, value) {
    if (name === "scale") this.scale = value;
    else if (name === "place") this.place = value;
    else this.compiled = name === "compiled";
  }

  read() {
    const { mujoco, text, scale, place, compiled } = this;
    const half = HALF * scale;
    const model = mujoco.MjModel.from_xml_string(compiled ? text.replace('size="0.1 0.1 0.02"', `size="${half} ${half} 0.02"`) : text);
    model.geom_size.set([half, half], 3 * TOP);
    const data = new mujoco.MjData(model);
    data.qpos[0] = (half * place) / 100;
    while (data.time < SECONDS) mujoco.mj_step(model, data);
    const height = data.xpos[3 * MUG + 2];
    const box = model.geom_aabb[6 * TOP + 3];
    data.delete();
    model.delete();
    return [
      ["half the width of the top", `${half.toFixed(2)} m`],
      ["half the width of the box around it, which decides what is near", `${box.toFixed(2)} m`, Math.abs(box - half) < 1e-9 ? "same" : "differs"],
      [`the mug, put ${((half * place) / 100).toFixed(3)} m from the middle, is at a height of`, `${height.toFixed(3)} m`, height > 0.5 ? "same" : "differs"],
    ];
  }
}
