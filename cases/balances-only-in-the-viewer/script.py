import mujoco

PERIOD = 10_000_000  # ns from one call of the controller to the next
KP, KD = 20, 4  # N m/rad, N m s/rad
FALLEN = 0.2  # rad

model = mujoco.MjModel.from_xml_path("pole.xml")
step_ns = round(1e9 * model.opt.timestep)


def balance(speed):
    """Simulates at so many times real time; returns the time upright, the calls and the last tilt."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    clock = 0  # stands in for time.perf_counter_ns(), so that a run can be repeated
    last, calls = -PERIOD, 0
    for step in range(10_000):
        now = clock
        if now - last >= PERIOD:
            data.ctrl[0] = -KP * data.qpos[0] - KD * data.qvel[0]
            last, calls = now, calls + 1
        mujoco.mj_step(model, data)
        clock += step_ns // speed
        if abs(data.qpos[0]) >= FALLEN:
            break
    return data.time, calls, data.qpos[0]


if __name__ == "__main__":
    for speed in (1, 20, 1000):
        upright, calls, tilt = balance(speed)
        print(f"time upright = {upright:.3f} s")
        print(f"calls = {calls}")
        print(f"tilt = {tilt:.6f} rad")
