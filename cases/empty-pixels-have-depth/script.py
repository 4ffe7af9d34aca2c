import mujoco
import numpy as np

HEIGHT, WIDTH = 120, 160

model = mujoco.MjModel.from_xml_path("table.xml")
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
far = model.vis.map.zfar * model.stat.extent


def depth_by_rays():
    """The depth at every pixel's centre, along the camera's axis; -1 where its ray hits nothing."""
    camera = data.camera("front")
    pixel = 2 * np.tan(np.radians(model.camera("front").fovy[0]) / 2) / HEIGHT
    row, column = np.mgrid[:HEIGHT, :WIDTH]
    x, y = (column + 0.5 - WIDTH / 2) * pixel, (HEIGHT / 2 - row - 0.5) * pixel
    rays = np.stack([x, y, np.full_like(x, -1)], axis=2).reshape(-1, 3) @ camera.xmat.reshape(3, 3).T
    geom, depth = np.zeros(len(rays), np.int32), np.zeros(len(rays))
    mujoco.mj_multiRay(model, data, camera.xpos, rays.ravel(), None, 1, -1, geom, depth, None, len(rays), 100)
    return depth


with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
    renderer.enable_depth_rendering()
    renderer.update_scene(data, "front")
    depth = renderer.render()
    distance = depth.mean()

rays = depth_by_rays()
print(f"mean depth = {distance:.6f} m")
print(f"mean depth by rays = {rays[rays >= 0].mean():.6f} m")
print(f"share of empty pixels = {np.mean(rays < 0):.6f}")
print(f"far distance = {far:.6f} m")
