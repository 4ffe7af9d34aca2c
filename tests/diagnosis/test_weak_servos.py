"""Servos too weak or too slow for what they move."""

from __future__ import annotations

import pytest
from diagnosed import causes, diagnosed, hints


@pytest.mark.parametrize(("damping", "named"), [(10000, ["weak-servo"]), (200, [])])
def test_a_slide_that_its_damping_all_but_holds_has_too_weak_a_servo(damping, named):
    body = f'<joint name="way" type="slide" axis="1 0 0" damping="{damping}" range="-1 1"/><geom size="0.1" mass="5"/>'
    servo = '<actuator><position joint="way" kp="50" ctrlrange="-1 1"/></actuator>'
    found = diagnosed(f'<mujoco><worldbody><body pos="0 0 1">{body}</body></worldbody>{servo}</mujoco>')
    assert [each.rule for each in found.causes if each.rule == "weak-servo"] == named


STOOL = """
<mujoco>
  <worldbody>
    <geom name="floor" type="plane" size="3 3 0.1"/>
    <body name="trunk" pos="0 0 0.72">
      <freejoint/>
      <geom type="box" size="0.1 0.1 0.1" mass="10" pos="0.01 0 0"/>
      {legs}
    </body>
  </worldbody>
  <actuator>{servos}</actuator>
</mujoco>
"""


@pytest.mark.parametrize(
    ("kp", "symptom", "told"), [(10, "", True), (20, "", False), (20, "sags", True), (100, "sags", False)]
)
@pytest.mark.parametrize("meets", ["by both masks", "by one", "in pairs"])
def test_a_robot_that_falls_after_a_while_has_too_little_stiffness(kp, symptom, told, meets):
    legs = "".join(
        f'<body pos="0 {y} -0.1"><joint name="hip{y}" axis="0 1 0" damping="3"/>'
        '<geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="1"/>'
        f'<body pos="0 0 -0.3"><joint name="ankle{y}" axis="0 1 0" damping="3"/>'
        f'<geom name="foot{y}" type="box" size="0.08 0.03 0.02" pos="0 0 -0.3" mass="0.5"/></body></body>'
        for y in (-0.1, 0.1)
    )
    names = [f"{name}{y}" for y in (-0.1, 0.1) for name in ("hip", "ankle")]
    servos = "".join(f'<position joint="{name}" kp="{kp}" kv="2"/>' for name in names)
    text = STOOL.format(legs=legs, servos=servos)
    if meets == "by one":
        text = text.replace('type="box"', 'type="box" contype="0" conaffinity="1"')
    if meets == "in pairs":  # as the models for MJX have it
        feet = "".join(f'<pair geom1="floor" geom2="foot{y}"/>' for y in (-0.1, 0.1))
        text = text.replace("</mujoco>", f"<contact>{feet}</contact></mujoco>")
        text = text.replace("<geom", '<geom contype="0" conaffinity="0"')
    found = diagnosed(text, symptom=symptom)
    said = [each for each in (*found.causes, *found.hints) if "falls within 5 s" in each.says]
    assert [each.rule for each in said] == ["weak-servo"] * told, found.text()


@pytest.mark.parametrize(("kp", "told"), [(100, True), (200, False)])
def test_a_finger_may_sag_by_a_tenth_of_its_way(kp: float, told: bool):
    slide = '<body pos="0 0 1"><joint name="finger" type="slide" axis="0 0 1" range="0 0.04" damping="2"/>'
    text = f'<mujoco><worldbody>{slide}<geom size="0.01" mass="0.05"/></body></worldbody>'
    text += f'<actuator><position joint="finger" kp="{kp}"/></actuator></mujoco>'
    assert [each.attribute for each in hints(text, "weak-servo")] == ["kp"] * told


@pytest.mark.parametrize(
    ("given", "own", "mass", "written"),
    [
        ('kp="500" dampratio="1" forcerange="-1 1"', "", 2, {"of the class": "-22 22"}),
        ('kp="500" dampratio="1" forcerange="-1 1"', 'forcerange="-2 2"', 2,
         {"of the class": "-22 22", "its own": "-15 15"}),
        ('kp="1"', "", 3, {"of the class": "370"}),
    ],
    ids=["the largest for the class", "one with its own", "one gain for the class"],
)  # fmt: skip
def test_what_servos_have_from_a_class_is_mended_there(given, own, mass, written):
    arms = "".join(
        f'<body pos="0 {each} 1"><joint name="{each}" axis="0 1 0"/>'
        f'<geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.02" mass="{each}"/></body>'
        for each in (mass, 3.0)
    )
    servos = f'<actuator><position joint="{mass}" {own}/><position joint="3.0"/></actuator>'
    text = f"<mujoco><default><position {given}/></default><worldbody>{arms}</worldbody>{servos}</mujoco>"
    (found,) = (each for each in causes(text) if each.attribute in ("forcerange", "kp"))
    place = text.index("<worldbody>")
    assert {("of the class" if each.start < place else "its own"): each.value for each in found.edit} == written
    assert len(found.edit) == len(written)


@pytest.mark.parametrize(
    ("kv", "others", "told"),
    [(400, 2.2, ("kv", "2.2")), (400, 400, ("kp", "8000")), (400, 40, ("kp", "8000"))],
    ids=["one of many", "as all are", "ten times the others'"],
)
def test_a_servo_that_is_late_by_its_own_kv_is_told_to_have_less_of_that(kv, others, told):
    arms = "".join(
        f'<body pos="0 {each} 1"><joint name="j{each}" axis="0 0 1"/>'
        '<geom type="capsule" fromto="0 0 0 0.6 0 0" size="0.06"/></body>'
        for each in range(5)
    )
    servos = "".join(f'<position joint="j{each}" kp="190" kv="{others if each else kv}"/>' for each in range(5))
    text = f"<mujoco><worldbody>{arms}</worldbody><actuator>{servos}</actuator></mujoco>"
    (found,) = causes(text, "weak-servo")
    assert (found.attribute, found.value) == told
    assert found.after < found.before / 2


@pytest.mark.parametrize(("root", "symptom", "told"), [("", "", True), ("free", "", False), ("free", "sags", True)])
def test_little_sag_of_a_free_robot_is_told_to_whoever_sees_it(root: str, symptom: str, told: bool):
    arm = '<body><joint name="hip" axis="0 1 0" damping="1"/>'
    arm += '<geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>'
    trunk = "<freejoint/>" * bool(root) + '<geom type="box" size="0.2 0.2 0.1" mass="9"/>'
    base = f'<body pos="0 0 0.1">{trunk}{arm}</body></body>'
    floor = '<geom type="plane" size="2 2 0.1"/>'
    servo = '<actuator><position name="hip" joint="hip" kp="15" kv="1"/></actuator>'  # 1.5 N m: 0.1 rad
    text = f"<mujoco><worldbody>{floor}{base}</worldbody>{servo}</mujoco>"
    assert [each.elements for each in hints(text, "weak-servo", symptom=symptom)] == [('actuator "hip"',)] * told
