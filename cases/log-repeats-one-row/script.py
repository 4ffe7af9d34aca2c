import mujoco
import numpy as np

model = mujoco.MjModel.from_xml_path("pendulum.xml")


def raised(angle):
    """The pendulum at rest, its upper joint turned by an angle."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("raised").id)
    data.qpos[0] = angle
    return data


def record(angle, rows):
    """Raises the pendulum, lets go of it and logs its joint positions."""
    data = raised(angle)
    log = []
    for _ in range(rows):
        log.append(data.qpos)
        mujoco.mj_step(model, data, nstep=10)
    return log


def positions(angle, row):
    """Where the joints are at that row of the log, simulated anew."""
    data = raised(angle)
    mujoco.mj_step(model, data, nstep=10 * row)
    return data.qpos


if __name__ == "__main__":
    log = []
    for angle in (1.2, 0.6):
        episode = record(angle, rows=100)
        for row in range(0, len(episode), 20):
            error = np.abs(episode[row] - positions(angle, row)).max()
            print(f"logged angle = {episode[row][0]:.6f} rad")
            print(f"logged angle below = {episode[row][1]:.6f} rad")
            print(f"error of the row = {error:.9f} rad")
        log.extend(episode)
    print(f"rows = {len(log)}")
    print(f"different rows = {len(np.unique(log, axis=0))}")
