import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("arm.xml")
model.opt.timestep = 0.005
data = mujoco.MjData(model)
HAND = model.site("hand").id


def follow():
    """Puts the marker where the hand is, and gives the velocity of the hand in m/s."""
    data.mocap_pos[0] = data.site_xpos[HAND]
    jacobian = np.zeros((3, model.nv))
    mujoco.mj_jacSite(model, data, jacobian, None, HAND)
    return jacobian @ data.qvel


def truth():
    """Where the hand is at the present joint positions, and its velocity in m/s."""
    scratch, velocity = mujoco.MjData(model), np.zeros(6)
    scratch.qpos[:], scratch.qvel[:] = data.qpos, data.qvel
    mujoco.mj_forward(model, scratch)
    mujoco.mj_objectVelocity(model, scratch, mujoco.mjtObj.mjOBJ_SITE, HAND, velocity, 0)
    return scratch.site_xpos[HAND], velocity[3:]


mujoco.mj_resetDataKeyframe(model, data, model.key("raised").id)
for tenth in range(4):
    for step in range(round(0.1 / model.opt.timestep)):
        mujoco.mj_step(model, data)
        velocity = follow()
    true_position, true_velocity = truth()
    print(f"speed of the hand = {np.linalg.norm(true_velocity):.6f} m/s")
    print(f"error of the marker = {np.linalg.norm(data.mocap_pos[0] - true_position):.7f} m")
    print(f"error of the velocity = {np.linalg.norm(velocity - true_velocity):.6f} m/s")
