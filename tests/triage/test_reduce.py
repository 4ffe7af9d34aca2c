"""Step 6: what may be removed, and what the motion hangs on."""

from __future__ import annotations

from clinic.triage.cut import cut, groups
from clinic.triage.reduce import look
from clinic.triage.run import Budget
from clinic.triage.watch import Trial
from helpers import MODEL, RESTING
from subjects import subject

SWING = """<mujoco><worldbody><geom name="pole" type="box" size=".01 .01 .5" pos="2 0 0"/>
  <body name="arm"><joint name="j" axis="{0}"/><geom size=".05" pos=".3 0 0"/></body></worldbody></mujoco>"""


def test_a_motion_hangs_on_gravity() -> None:
    said, found = look(Trial(subject(SWING.format("0 1 0")), Budget()))
    assert said == "without geom pole the rest moves as before; the motion hangs on gravity"
    assert found == []


def test_gravity_that_changes_nothing_is_seen() -> None:
    said, found = look(Trial(subject(SWING.format("0 0 1")), Budget()))
    assert said.endswith("nothing moves")
    assert found == [("idle", "gravity", "bodies have weight, and switching it off changes nothing")]


def test_a_floor_that_can_be_deleted_although_it_is_in_the_way() -> None:
    _, found = look(Trial(subject(MODEL), Budget()))
    assert found == [("passed", "geom floor", "lies in the way, and deleting it changes nothing")]


def test_trees_that_touch_are_one_group_and_the_rest_is_cut() -> None:
    trial = Trial(subject(RESTING), Budget())
    trees = groups(trial.subject, trial.base[1])
    assert [sorted(group) for group in trees] == [[0], [1]]
    made = cut(trial)
    assert made is not None
    assert made.geoms == []
    assert made.roots == [2]
    assert made.kept == [1]
    assert made.points.shape[1:] == (1, 3)


def test_what_is_left_starts_as_before_with_its_controls() -> None:
    xml = SWING.format("0 1 0").replace(
        "</mujoco>",
        '<actuator><motor name="m" joint="j"/></actuator>'
        '<keyframe><key name="up" qpos="1" qvel="2" ctrl="3"/></keyframe></mujoco>',
    )
    said, found = look(Trial(subject(xml, keyframe="up"), Budget()))
    assert said == "without geom pole the rest moves as before; the motion hangs on gravity, actuation"
    assert found == []


def test_a_model_without_joints() -> None:
    assert look(Trial(subject("<mujoco/>"), Budget())) == ("nothing moves", [])
