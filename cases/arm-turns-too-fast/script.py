import mujoco
import numpy as np


def loaded(factor):
    """The arm with a beam that is heavier by a factor."""
    model = mujoco.MjModel.from_xml_path("arm.xml")
    model.body("beam").mass *= factor
    return model


if __name__ == "__main__":
    model = loaded(factor=3)
    data = mujoco.MjData(model)
    data.ctrl[0] = 2
    mujoco.mj_forward(model, data)
    print(f"acceleration = {data.qacc[0]:.6f} rad/s2")
    print(f"centre of mass = {np.hypot(*data.body('arm').subtree_com[:2]):.6f} m")
    for _ in range(10):
        mujoco.mj_step(model, data, nstep=30)
        print(f"angle = {data.qpos[0]:.6f} rad")
    mujoco.mj_step(model, data, nstep=1000)
    print(f"past the stop = {1000 * (data.qpos[0] - model.jnt_range[0, 1]):.6f} mrad")
    print(f"mass = {model.body_mass.sum():.6f} kg")
    print(f"dof_invweight0 = {model.dof_invweight0[0]:.9f} 1/(kg m2)")
    print(f"body_invweight0 = {model.body('beam').invweight0[0]:.9f} 1/kg")
