import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("arm.xml")
data = mujoco.MjData(model)


def reset():
    """Puts the arm into its home pose and returns the episode's first observation."""
    data.qpos[:] = model.key("home").qpos
    data.qvel[:] = 0
    return data.site("hand").xpos.copy()


def hand_at(qpos):
    """Where the hand is at these joint positions."""
    scratch = mujoco.MjData(model)
    scratch.qpos[:] = qpos
    mujoco.mj_forward(model, scratch)
    return scratch.site("hand").xpos.copy()


for episode in range(4):
    observed = reset()
    start = hand_at(data.qpos)
    mujoco.mj_step(model, data, nstep=200)
    end = hand_at(data.qpos)
    print(f"observed x = {observed[0]:.6f} m")
    print(f"observed z = {observed[2]:.6f} m")
    print(f"observation error = {1000 * np.linalg.norm(observed - start):.6f} mm")
    print(f"distance travelled = {1000 * np.linalg.norm(end - start):.6f} mm")
