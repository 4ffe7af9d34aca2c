import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("satellite.xml")
data = mujoco.MjData(model)


def launch(joint, velocity, rate):
    """Lets the satellite go at a velocity in m/s and an angular velocity in rad/s."""
    joint.qvel[:3] = velocity
    joint.qvel[3:] = rate


def turning(before, after, seconds):
    """The angular velocity in the world that leads from one orientation to another, in rad/s."""
    inverse, turn, rate = np.zeros(4), np.zeros(4), np.zeros(3)
    mujoco.mju_negQuat(inverse, before)
    mujoco.mju_mulQuat(turn, after, inverse)
    mujoco.mju_quat2Vel(rate, turn, seconds)
    return rate


for tilt in (0, 45, 90):
    mujoco.mj_resetData(model, data)
    joint = data.joint("satellite")
    mujoco.mju_axisAngle2Quat(joint.qpos[3:], np.array([0.0, 1.0, 0.0]), np.radians(tilt))
    start = joint.qpos.copy()
    launch(joint, velocity=np.array([0.0, 0.0, 0.2]), rate=np.array([0.0, 0.0, 1.0]))
    mujoco.mj_step(model, data, nstep=500)
    x, y, z = turning(start[3:], joint.qpos[3:], data.time)
    upright = np.array([1.0, 0.0, 0.0, 0.0])
    print(f"tilt at the start = {np.degrees(np.linalg.norm(turning(upright, start[3:], 1))):.6f} deg")
    print(f"turning about the vertical = {z:.6f} rad/s")
    print(f"turning about a horizontal axis = {np.hypot(x, y):.6f} rad/s")
    print(f"climb = {(joint.qpos[2] - start[2]) / data.time:.6f} m/s")
