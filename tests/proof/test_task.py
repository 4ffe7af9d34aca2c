"""What belongs to the task, changed one thing at a time."""

from __future__ import annotations

import mujoco
import pytest
from clinic.proof.task import changes
from clinic.record.fields import Task

MODEL = """\
<mujoco>
  <option timestep="0.01"/>
  <worldbody>
    <camera name="side" pos="0 -2 0.2" xyaxes="1 0 0 0 0 1"/>
    <geom name="floor" type="plane" size="1 1 0.1"/>
    <body name="arm" pos="0 0 0.5">
      <joint name="hinge" axis="0 1 0" damping="1"/>
      <geom name="arm" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="0.4"/>
      <body name="hand" pos="0.3 0 0"><geom size="0.02" mass="0.1"/></body>
    </body>
  </worldbody>
  <actuator><position name="servo" joint="hinge" kp="20"/></actuator>
  <sensor><jointpos name="angle" joint="hinge"/></sensor>
  <keyframe><key name="start" qpos="0.1"/></keyframe>
</mujoco>
"""


def told(find: str, replace: str, *may: str) -> list[str]:
    assert MODEL.count(find) == 1
    broken, model = (mujoco.MjModel.from_xml_string(xml) for xml in (MODEL, MODEL.replace(find, replace)))
    return changes(broken, model, Task(may=list(may)))


@pytest.mark.parametrize(
    ("find", "replace", "said"),
    [
        ('timestep="0.01"', 'timestep="1"', "The timestep is 1 s, longer than the model's 0.01 s."),
        ('timestep="0.01"', 'gravity="0 0 0" timestep="0.01"', "You turned gravity off."),
        ('<option timestep="0.01"/>', '<option timestep="0.01"><flag gravity="disable"/></option>',
         "You switched gravity off."),
        ('<option timestep="0.01"/>', '<option timestep="0.01"><flag sleep="enable"/></option>',
         "You switched sleep on or off."),
        ('<option timestep="0.01"/>', '<option timestep="0.01" o_margin="-1"><flag override="enable"/></option>',
         "You switched contact off, by a margin below zero for all of them."),
        ('timestep="0.01"', 'timestep="0.01" wind="1 0 0"', "You changed the wind from 0 0 0 to 1 0 0."),
        ('mass="0.4"', 'mass="0.1"', "You changed the mass of body arm from 0.4 to 0.1 kg."),
        ('name="hand" pos="0.3 0 0"', 'name="hand" pos="0.2 0 0"',
         "You changed the position of body hand from 0.3 0 0 to 0.2 0 0 m."),
        ('name="arm" pos="0 0 0.5"', 'name="arm" gravcomp="1" pos="0 0 0.5"',
         "You changed the gravcomp of body arm from 0 to 1."),
        ('axis="0 1 0"', 'axis="0 1 0" range="-1 1"',
         "You changed the range of joint hinge from none to -0.01745 0.01745."),
        ('axis="0 1 0"', 'axis="0 1 0" ref="57.29578"', "You changed the ref of joint hinge from 0 to 1."),
        ('axis="0 1 0"', 'axis="0 1 0" stiffness="5"', "You changed the stiffness of joint hinge from 0 to 5."),
        ('damping="1"', 'damping="1e6"',
         "dof_damping is 1e+06: that holds what should move; at most 1000 is accepted."),
        ('damping="1"', 'frictionloss="1e6"',
         "dof_frictionloss is 1e+06: that holds what should move; at most 10 is accepted."),
        ('size="1 1 0.1"', 'size="1 1 0.1" friction="1e6"',
         "geom_friction is 1e+06: that holds what should move; at most 100 is accepted."),
        ('size="1 1 0.1"', 'size="1 1 0.1" margin="-0.3"',
         "geom_margin is -0.3: below zero things go into each other before they push."),
        ('<body name="arm"', '<geom name="prop" size="0.1"/><body name="arm"', "You added geom prop."),
        ('<body name="arm"', '<body name="prop"><geom size="0.1"/></body><body name="arm"', "You added body prop."),
        ('<body name="arm"', '<body name="prop" mocap="true"/><body name="arm"', "You added body prop."),
        ('<geom name="arm" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="0.4"/>',
         '<geom name="link" type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="0.4"/>',
         "You changed the size of geom arm from 0.02 0.15 0 to 0.03 0.15 0 m."),
        ("<sensor>", '<equality><weld body1="hand"/></equality><sensor>', "You added an equality."),
        ('<body name="hand" pos="0.3 0 0"><geom size="0.02" mass="0.1"/></body>', "",
         "You removed or renamed body hand."),
        ('<body name="arm" pos="0 0 0.5">', '<body name="arm" pos="1 0 0"/><body name="old" pos="0 0 0.5">',
         "You changed the body of joint hinge from arm to old."),
        ('kp="20"', 'kp="20" gear="5"', "You changed the gear of actuator servo from 1 0 0 0 0 0 to 5 0 0 0 0 0."),
        ('joint="hinge" kp', 'jointinparent="hinge" kp',
         "You changed the kind of transmission of actuator servo from joint to jointinparent."),
        ('kp="20"', 'kp="20" timeconst="1"',
         "You changed the kind of dynamics of actuator servo from none to filterexact."),
        ('<jointpos name="angle"', '<jointvel name="angle"',
         "You changed the type of sensor angle from jointpos to jointvel."),
        ('qpos="0.1"', 'qpos="0"', "You changed the qpos of key start from 0.1 to 0."),
        ("xyaxes=", 'fovy="10" xyaxes=', "You changed the field of view of camera side from 45 to 10 °."),
    ],
)  # fmt: skip
def test_a_change_of_the_task_is_told(find: str, replace: str, said: str) -> None:
    assert said in told(find, replace)


def test_an_armature_far_beyond_the_arm_s_inertia_is_told() -> None:
    (said,) = told('damping="1"', 'armature="1e6"')
    assert said.startswith("The armature of joint hinge is 1e+06, more than 1000 times its inertia 0.02")


def test_an_actuator_s_armature_is_seen_through_its_gear() -> None:
    broken, model = (
        mujoco.MjModel.from_xml_string(MODEL.replace('kp="20"', f'kp="20" gear="20" armature="{each}"'))
        for each in (0, 0.2)
    )
    (said,) = changes(broken, model, Task())
    assert said.startswith("The armature of joint hinge is 80, more than 1000 times its inertia 0.02")


def test_of_a_sensor_of_another_type_nothing_else_is_told() -> None:
    assert told('<jointpos name="angle" joint="hinge"/>', '<framepos name="angle" objtype="body" objname="hand"/>') == [
        "You changed the type of sensor angle from jointpos to framepos."
    ]


def test_dry_friction_of_a_free_joint_is_told() -> None:
    xml = '<mujoco><worldbody><body><joint name="free" type="free"/><geom size="0.1"/></body></worldbody></mujoco>'
    broken, model, damped = (
        mujoco.MjModel.from_xml_string(xml.replace('"free"/>', each))
        for each in ('"free"/>', '"free" frictionloss="3"/>', '"free" damping="0.01"/>')
    )

    assert changes(broken, model, Task()) == [
        "A free joint has a frictionloss of 3: that holds to the world what should be free."
    ]
    assert changes(model, model, Task()) == changes(broken, damped, Task()) == []


@pytest.mark.parametrize(
    ("find", "replace"),
    [
        ('timestep="0.01"', 'timestep="0.001" integrator="implicit" solver="CG" iterations="3" cone="elliptic"'),
        ('size="1 1 0.1"', 'size="1 1 0.1" friction="2" solref="-1000 -10" margin="0.002" condim="4" contype="3"'),
        ('damping="1"', 'damping="5" armature="0.1" frictionloss="0.1"'),
        ('kp="20"', 'kp="200" kv="5" ctrlrange="-3 3"'),
        ('<camera name="side"', '<camera name="other"/><light/><site name="mark"/><camera name="side"'),
        ('<camera name="side"', '<body name="look" pos="0 0 1"/><camera name="side"'),
        ("<sensor>", '<contact><exclude body1="arm" body2="hand"/></contact><sensor><clock/>'),
        ('qpos="0.1"/>', 'qpos="0.1"/><key name="other" qpos="1"/>'),
        ('size="0.02" mass="0.1"', 'size="0.02" mass="0.1" rgba="1 0 0 1"'),
        ('axis="0 1 0"', 'axis="0 2 0"'),
        ('geom name="floor"', 'geom name="ground"'),
        ('<geom size="0.02" mass="0.1"/>', '<geom name="palm" size="0.02" mass="0.1"/>'),
        ('axis="0 1 0"', 'axis="0 1 0" actuatorfrcrange="-5 5"'),
        ('geom name="arm"', 'geom name="upper arm" friction="2"'),
    ],
)
def test_what_every_repair_may_change_is_not_told(find: str, replace: str) -> None:
    assert told(find, replace) == []


def test_a_renamed_geom_is_compared_as_the_one_it_was() -> None:
    assert told('geom name="floor" type="plane" size="1 1 0.1"', 'geom name="ground" type="plane" size="2 1 0.1"') == [
        "You changed the size of geom floor from 1 1 0.1 to 2 1 0.1 m."
    ]
    assert told('<geom name="floor" type="plane" size="1 1 0.1"/>', '<geom name="ground" size="0.1"/>') != []


@pytest.mark.parametrize(
    ("shape", "turn", "same"),
    [
        ('type="sphere" size="0.1"', "10 20 30", True),
        ('type="cylinder" size="0.1 0.2"', "0 0 40", True),
        ('type="capsule" size="0.1 0.2"', "180 0 40", True),
        ('type="capsule" size="0.1 0.2"', "90 0 0", False),
        ('type="box" size="0.1 0.2 0.3"', "0 180 0", True),
        ('type="ellipsoid" size="0.1 0.2 0.3"', "180 0 180", True),
        ('type="box" size="0.1 0.2 0.3"', "0 0 90", False),
        ('type="plane" size="1 1 0.1"', "180 0 0", False),
    ],
)
def test_a_turn_that_the_shape_hides_is_not_told(shape: str, turn: str, same: bool) -> None:
    xml = '<mujoco><worldbody><frame euler="20 30 40"><geom name="it" {} euler="{}"/></frame></worldbody></mujoco>'
    broken, model = (mujoco.MjModel.from_xml_string(xml.format(shape, euler)) for euler in ("0 0 0", turn))
    assert (changes(broken, model, Task()) == []) == same


@pytest.mark.parametrize(("range_", "same"), [("-1.5708 1.5708", True), ("-1.6 1.6", False)])
def test_a_range_may_be_rounded(range_: str, same: bool) -> None:
    limited = MODEL.replace('kp="20"', 'kp="20" ctrlrange="-1.57 1.57"')
    broken, model = (mujoco.MjModel.from_xml_string(xml) for xml in (limited, limited.replace("-1.57 1.57", range_)))
    assert (changes(broken, model, Task()) == []) == same


def test_what_the_record_allows_is_not_told() -> None:
    assert told('axis="0 1 0"', 'axis="0 1 0" range="-1 1"', "joint(hinge).range") == []
    assert told('axis="0 1 0"', 'axis="0 1 0" ref="9"', "joint(hinge).ref") == []
    assert told('kp="20"/>', 'kp="20"/><motor name="m" joint="hinge"/>', "actuator") == []
    assert told('<geom name="floor" type="plane" size="1 1 0.1"/>', "", "geom(floor)") == []
    assert told('kp="20"/>', 'kp="20"/><motor name="m" joint="hinge"/>') == ["You added actuator m."]
