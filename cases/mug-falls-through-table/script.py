import mujoco
import numpy as np


def scene(scale):
    """The scene with a table top that is larger by a factor."""
    model = mujoco.MjModel.from_xml_path("table.xml")
    model.geom("top").size[:2] *= scale
    return model


def put_down(model, x):
    """The height of the mug a second after it was put onto the table, x from the middle."""
    data = mujoco.MjData(model)
    data.joint("mug").qpos[0] = x
    mujoco.mj_step(model, data, nstep=round(1 / model.opt.timestep))
    return data.body("mug").xpos[2]


if __name__ == "__main__":
    model = scene(scale=3)
    top = model.geom("top").id
    half, count = model.geom_size[top, 0], 10
    places = half * (np.arange(count) + 0.5) / count
    heights = [put_down(model, x) for x in places]
    for x, height in zip(places, heights):
        print(f"place of the mug = {x:.6f} m")
        print(f"height of the mug = {height:.6f} m")
    print(f"places that hold = {np.mean(np.array(heights) > 0.5):.6f}")
    print(f"half the width of the top = {half:.6f} m")
    print(f"half the width of its box = {model.geom_aabb[top, 3]:.6f} m")
    print(f"radius of the mug = {model.geom('cup').size[0]:.6f} m")
