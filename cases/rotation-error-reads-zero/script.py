import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("camera.xml")
data = mujoco.MjData(model)


def observe(body):
    """The orientation of a body, in single precision, as observations are stored."""
    return data.body(body).xquat.astype(np.float32)


def rotation_error(quat, target):
    """The angle from one orientation to another, in rad."""
    return 2 * np.arccos(min(1.0, abs(quat @ target)))


for angle in (0.3, 0.03, 0.003, 0.0003, 1e-8):
    mujoco.mju_axisAngle2Quat(data.joint("ball").qpos, np.array([0.0, 1.0, 0.0]), -angle)
    mujoco.mj_kinematics(model, data)
    print(f"true angle = {angle:.9g} rad")
    print(f"reported angle = {rotation_error(observe('head'), observe('target')):.9g} rad")
