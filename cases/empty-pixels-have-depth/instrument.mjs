export const about = "Move the far plane of the camera. Nothing in the scene moves.";

export const controls = [{ name: "zfar", label: "zfar", min: 3, max: 100, step: 1, value: 50 }];

const [HEIGHT, WIDTH] = [60, 80];

export default class {
  constructor(mujoco, files) {
    const model = mujoco.MjModel.from_xml_string(files["table.xml"]);
    const data = new mujoco.MjData(model);
    mujoco.mj_forward(model, data);
    const [eye, axes] = [Array.from(data.cam_xpos), Array.from(data.cam_xmat)];
    const pixel = (2 * Math.tan((model.cam_fovy[0] * Math.PI) / 360)) / HEIGHT;
    const [geoms, distances] = [new mujoco.IntBuffer(WIDTH), new mujoco.DoubleBuffer(WIDTH)];
    this.extent = model.stat.extent;
    this.depths = [];
    for (let row = 0; row < HEIGHT; row++) {
      const y = (HEIGHT / 2 - row - 0.5) * pixel;
      const seen = Array.from({ length: WIDTH }, (_, column) => [(column + 0.5 - WIDTH / 2) * pixel, y, -1]);
      const rays = seen.flatMap((ray) => [0, 1, 2].map((k) => axes[3 * k] * ray[0] + axes[3 * k + 1] * ray[1] + axes[3 * k + 2] * ray[2]));
      mujoco.mj_multiRay(model, data, eye, rays, null, true, -1, geoms, distances, null, WIDTH, 1e10);
      this.depths.push(...distances.GetView());
    }
    this.zfar = 50;
  }

  use(_, value) {
    this.zfar = value;
  }

  read() {
    const far = this.zfar * this.extent;
    const hit = this.depths.filter((depth) => depth >= 0);
    const sum = hit.reduce((a, b) => a + b, 0);
    const mean = sum / hit.length;
    const all = (sum + far * (this.depths.length - hit.length)) / this.depths.length;
    return [
      ["far plane, zfar times the extent", `${far.toFixed(2)} m`],
      ["pixels in which nothing is", `${((100 * (this.depths.length - hit.length)) / this.depths.length).toFixed(1)} %`],
      ["mean depth, with the far plane where nothing is", `${all.toFixed(3)} m`, Math.abs(all - mean) < 0.01 ? "same" : "differs"],
      ["mean depth of what is there", `${mean.toFixed(3)} m`],
    ];
  }
}
