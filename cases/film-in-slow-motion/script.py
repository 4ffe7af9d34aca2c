import mujoco

FPS = 50  # images a second, as the film is played

model = mujoco.MjModel.from_xml_path("ball.xml")


def image(data):
    """Stands in for a renderer: the height at which the ball is seen, in m."""
    return data.qpos[0]


def film(duration):
    """Lets go of the ball and films it, for so many simulated seconds."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("held").id)
    images = []
    while data.time < duration:
        mujoco.mj_step(model, data)
        images.append(image(data))
    return images


if __name__ == "__main__":
    duration = 2
    images = film(duration)
    length = len(images) / FPS
    bounces = next(k for k in range(len(images)) if images[k + 1] > images[k]) / FPS
    print(f"images = {len(images)}")
    print(f"images a second = {FPS}")
    print(f"length of the film = {length:.4f} s")
    print(f"simulated = {duration:.4f} s")
    print(f"first bounce = {bounces:.4f} s")
    print(f"gravity as seen = {(2 * images[1] - images[0] - images[2]) * FPS**2:.6f} m/s²")
    print(f"gravity = {-model.opt.gravity[2]:.6f} m/s²")
    print(f"timestep = {model.opt.timestep:.6f} s")
    for moment in range(25):
        shown = min(round(moment * FPS / 12), len(images) - 1)
        print(f"height = {images[shown]:.6f} m")
