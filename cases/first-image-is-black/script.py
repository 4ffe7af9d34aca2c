import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("table.xml")
data = mujoco.MjData(model)

with mujoco.Renderer(model, 120, 160) as renderer:
    renderer.update_scene(data, camera="front")
    image = renderer.render()

    renderer.enable_segmentation_rendering()
    seen = renderer.render()[:, :, 0] != -1

print(f"mean brightness = {image.mean():.4f}")
print(f"share of black pixels = {np.mean(image.max(axis=2) == 0):.4f}")
print(f"share of pixels that show a geom = {seen.mean():.4f}")
print(f"distance of the camera from the origin = {np.linalg.norm(data.camera('front').xpos):.4f} m")
