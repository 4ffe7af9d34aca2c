import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("pendulum.xml")
torques = np.random.default_rng(0).uniform(-3, 3, size=100)


def apply(data, torque):
    """Holds the torque for one control period."""
    data.ctrl[0] = torque
    mujoco.mj_step(model, data, nstep=10)


def record():
    """Drives the pendulum and logs one row (angle, speed, torque) a control period."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    log = []
    for torque in torques:
        apply(data, torque)
        log.append((data.qpos[0], data.qvel[0], torque))
    return log


def replay(log):
    """Starts in the first logged state, applies the logged torques; returns the errors and the angle of each row."""
    data = mujoco.MjData(model)
    data.qpos[0], data.qvel[0], _ = log[0]
    errors = []
    for angle, speed, torque in log:
        errors.append((abs(data.qpos[0] - angle), abs(data.qvel[0] - speed), data.qpos[0]))
        apply(data, torque)
    return np.array(errors)


if __name__ == "__main__":
    log = record()
    errors = replay(log)
    for row in range(0, len(log), 10):
        print(f"angle error = {errors[row, 0]:.6g} rad")
        print(f"logged angle = {log[row][0]:.6g} rad")
        print(f"replayed angle = {errors[row, 2]:.6g} rad")
    print(f"largest angle error = {errors[:, 0].max():.6g} rad")
    print(f"largest speed error = {errors[:, 1].max():.6g} rad/s")
    print(f"smallest logged angle = {min(angle for angle, _, _ in log):.6g} rad")
