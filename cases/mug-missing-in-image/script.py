import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("hand.xml")
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
mug = model.geom("mug").id

with mujoco.Renderer(model, 120, 160) as renderer:
    renderer.update_scene(data, camera="front")
    image = renderer.render().astype(int)

    renderer.enable_segmentation_rendering()
    seen = renderer.render()

owner = model.body("mug").id
of_mug = (seen[:, :, 1] == mujoco.mjtObj.mjOBJ_GEOM) & (model.geom_bodyid[np.maximum(seen[:, :, 0], 0)] == owner)
orange = image[:, :, 0] > image[:, :, 2] + 60
print(f"share of orange pixels = {orange.mean():.4f}")
print(f"share of pixels that show the mug = {of_mug.mean():.4f}")
print(f"share of pixels that show a geom = {np.mean(seen[:, :, 0] != -1):.4f}")
touching = data.contact.geom[np.any(data.contact.geom == mug, axis=1)]
print(f"fingers that touch the mug = {len(np.unique(touching[touching != mug]))}")
