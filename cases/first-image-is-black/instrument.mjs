export const about = "What the renderer copies, before anything is computed and after. Press in any order.";

export const controls = [
  { name: "mj_resetData", label: "mj_resetData" },
  { name: "mj_kinematics", label: "mj_kinematics" },
  { name: "mj_camlight", label: "mj_camlight" },
  { name: "mj_forward", label: "mj_forward" },
];

const [CRATE, CAN] = [4, 5]; // geoms, in the order of the file

export default class {
  constructor(mujoco, files) {
    this.mujoco = mujoco;
    this.model = mujoco.MjModel.from_xml_string(files["table.xml"]);
    this.data = new mujoco.MjData(this.model);
  }

  use(name) {
    this.mujoco[name](this.model, this.data);
  }

  read() {
    const { data } = this;
    const place = (array, at = 0) => {
      const found = Array.from(array.slice(3 * at, 3 * at + 3));
      const told = found.map((x) => (Math.abs(x) < 5e-4 ? 0 : x).toFixed(2)).join("  ");
      return [told, found.some((x) => x !== 0) ? "same" : "differs"];
    };
    return [
      ["place of the crate", ...place(data.geom_xpos, CRATE)],
      ["place of the can", ...place(data.geom_xpos, CAN)],
      ["place of the camera", ...place(data.cam_xpos)],
      ["direction of the lamp", ...place(data.light_xdir)],
    ];
  }
}
