import mujoco

model = mujoco.MjModel.from_xml_path("model.xml")
data = mujoco.MjData(model)

data.joint("hinge").qpos[0] = 60
mujoco.mj_forward(model, data)

print(f"height of the tip = {data.site('tip').xpos[2]:.6f} m")
