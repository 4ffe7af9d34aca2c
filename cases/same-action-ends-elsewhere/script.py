import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("table.xml")
data = mujoco.MjData(model)
SPEED = 0.2
SECONDS = 0.5


def save():
    """The state, to come back to."""
    return data.qpos.copy(), data.qvel.copy()


def restore(state):
    """Goes back to a saved state."""
    data.qpos[:], data.qvel[:] = state


def push(speed, seconds):
    """Pushes at a speed in m/s, and gives where pusher and box then are, in m."""
    data.ctrl[0] = speed
    mujoco.mj_step(model, data, nstep=round(seconds / model.opt.timestep))
    return np.array([data.joint("pusher").qpos[0], data.joint("box").qpos[0]])


push(0.2, 0.5)
state = save()
ends = []
for attempt in range(2):
    restore(state)
    ends.append(push(SPEED, SECONDS))
    print(f"end of the pusher = {ends[-1][0]:.6f} m")
    print(f"end of the box = {ends[-1][1]:.6f} m")
pusher, box = np.abs(ends[1] - ends[0])
print(f"difference of the pusher = {pusher:.3g} m")
print(f"difference of the box = {box:.3g} m")
