import mujoco
import numpy as np


def observe(data):
    """The observation: the elbow angle."""
    return data.qpos[3]


def bend(data):
    """The angle between upper arm and forearm, measured on the bodies themselves."""
    upper_arm, forearm = (data.body(name).xmat[[2, 5, 8]] for name in ("upper_arm", "forearm"))
    return np.arccos(upper_arm @ forearm)


for scene in ("before.xml", "after.xml"):
    model = mujoco.MjModel.from_xml_path(scene)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    mujoco.mj_forward(model, data)
    print(f"observed angle = {observe(data):.9f} rad")
    print(f"bend of the arm = {bend(data):.9f} rad")
