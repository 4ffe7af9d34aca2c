export const about = "Put the mug into another group, and see what a renderer is handed.";

export const controls = [
  { name: "group", label: "group of the mug", min: 0, max: 5, step: 1, value: 3 },
  { name: "usual", label: "draw the groups that are drawn by default" },
  { name: "all", label: "draw every group" },
];

const MUG = "mug";

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["hand.xml"]);
    this.data = new mujoco.MjData(this.model);
    mujoco.mj_forward(this.model, this.data);
    this.mug = mujoco.mj_name2id(this.model, mujoco.mjtObj.mjOBJ_GEOM.value, MUG);
    this.option = new mujoco.MjvOption();
    this.usual = Array.from(this.option.geomgroup);
    this.scene = new mujoco.MjvScene(this.model, 100);
    this.camera = new mujoco.MjvCamera();
    this.perturb = new mujoco.MjvPerturb();
  }

  use(name, value) {
    if (name === "group") this.model.geom_group[this.mug] = value;
    else this.option.geomgroup.set(name === "all" ? this.usual.map(() => 1) : this.usual);
  }

  read() {
    const { mujoco, model, data, option, scene, camera, perturb, mug } = this;
    mujoco.mjv_updateScene(model, data, option, perturb, camera, mujoco.mjtCatBit.mjCAT_ALL.value, scene);
    const drawn = [];
    for (let k = 0; k < scene.ngeom; k++) {
      const geom = scene.geoms.get(k);
      if (geom.objtype === mujoco.mjtObj.mjOBJ_GEOM.value) drawn.push(geom.objid);
      geom.delete();
    }
    return [
      ["group of the mug", `${model.geom_group[mug]}`],
      ["groups that are drawn", Array.from(option.geomgroup).flatMap((on, k) => (on ? [k] : [])).join(" ")],
      ["geoms handed to the renderer", `${drawn.length} of ${model.ngeom}`],
      ["the mug is among them", drawn.includes(mug) ? "yes" : "no", drawn.includes(mug) ? "same" : "differs"],
    ];
  }
}
