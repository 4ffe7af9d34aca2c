import mujoco
import numpy as np

HEIGHT, WIDTH = 120, 160

model = mujoco.MjModel.from_xml_path("table.xml")
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
far = model.vis.map.zfar * model.stat.extent


def depth_by_ray(row, column):
    """The depth at a pixel's centre, along the camera's axis; -1 where its ray hits nothing."""
    camera = data.camera("front")
    pixel = 2 * np.tan(np.radians(model.camera("front").fovy[0]) / 2) / HEIGHT
    x, y = (column + 0.5 - WIDTH / 2) * pixel, (HEIGHT / 2 - row - 0.5) * pixel
    ray = camera.xmat.reshape(3, 3) @ [x, y, -1]
    geom = np.zeros(1, np.int32)
    return mujoco.mj_ray(model, data, camera.xpos, ray, None, 1, -1, geom, None)


with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
    renderer.enable_depth_rendering()
    renderer.update_scene(data, "front")
    depth = renderer.render()
    distance = depth.mean()

rays = np.array([depth_by_ray(*pixel) for pixel in np.ndindex(HEIGHT, WIDTH)])
print(f"mean depth = {distance:.6f} m")
print(f"mean depth by rays = {rays[rays >= 0].mean():.6f} m")
print(f"share of empty pixels = {np.mean(rays < 0):.6f}")
print(f"far distance = {far:.6f} m")
