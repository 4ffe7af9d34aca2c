"""URDF that does not compile."""

from __future__ import annotations

import pytest
from diagnosed import causes, mended

pytestmark = pytest.mark.usefixtures("folder")

URDF = """<robot name="r">{top}
  <link name="base"/>
  <link name="wheel">
    <inertial>{mass}<inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>{more}
    <collision><geometry>{shape}</geometry></collision>
  </link>
  <joint name="axle" type="{kind}"><parent link="base"/><child link="wheel"/>{axis}</joint>
</robot>
"""
WHEEL = {
    "top": "",
    "mass": '<mass value="1"/>',
    "more": "",
    "shape": '<sphere radius="1"/>',
    "kind": "continuous",
    "axis": "",
}
APART = '<mujoco><compiler fusestatic="false"/></mujoco>'
AGAIN = '<inertial><mass value="1"/></inertial>'


@pytest.mark.parametrize(
    ("changes", "rule", "value"),
    [
        ({"mass": ""}, "left-out", "1"),
        ({"mass": '<mass value="0"/>'}, "massless-body", "0.0025"),
        ({"mass": '<mass value="0"/>', "shape": '<cylinder radius="0.1" length="0.1"/>'}, "massless-body", "0.26"),
        ({"mass": '<mass value="0"/>', "shape": '<box size="0.1 0.1 0.1"/>'}, "massless-body", "0.6"),
        ({"more": AGAIN}, "given-twice", "removed"),
        ({"kind": "floating", "top": APART}, "misplaced-joint", "world"),
        ({"shape": '<sphere radius="0"/>'}, "invalid-value", "0.001"),
        ({"shape": '<cylinder radius="1" height="2"/>'}, "left-out", "length='2'"),
        ({"axis": '<axis xyz="0 0 0"/>'}, "invalid-value", "1 0 0"),
        ({"shape": '<mesh filename="flat.obj"/>'}, "unusable-file", "box"),
    ],
)
def test_what_is_wrong_in_a_urdf_is_mended(changes, rule, value, folder):
    (folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 3 2\nf 2 3 4\n")
    found = mended(URDF.format(**WHEEL | changes))
    assert [(each.rule, each.value) for each in found.causes] == [(rule, value)], found.text()


@pytest.mark.parametrize(
    ("parent", "child", "edits"),
    [
        pytest.param("left_thigh", "right_shank", [("child", "left_shank")], id="copied"),
        pytest.param("left_shank", "left_thigh", [("parent", "left_thigh"), ("child", "left_shank")], id="exchanged"),
        pytest.param("left_thigh", "right_thigh", [("child", "left_shank")], id="led-elsewhere"),
        pytest.param("pelvis", "left_thigh", [("child", "left_shank")], id="twice-from-one"),
    ],
)
def test_a_joint_to_a_link_that_has_one_leads_to_the_link_without(parent, child, edits):
    inertia = '<inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/>'
    names = ("pelvis", "left_thigh", "left_shank", "right_thigh", "right_shank")
    links = "".join(f'<link name="{name}"><inertial><mass value="1"/>{inertia}</inertial></link>' for name in names)
    ends = {
        "left_hip": ("pelvis", "left_thigh"),
        "left_knee": (parent, child),
        "right_hip": ("pelvis", "right_thigh"),
        "right_knee": ("right_thigh", "right_shank"),
    }
    joints = "".join(
        f'<joint name="{name}" type="continuous"><parent link="{a}"/><child link="{b}"/></joint>'
        for name, (a, b) in ends.items()
    )
    (found,) = causes(f'<robot name="r">{links}{joints}</robot>')
    assert found.elements == ('<joint name="left_knee">',)
    assert [(each.element, each.value) for each in found.edit] == edits


def test_a_joint_of_a_urdf_without_parent_goes_to_the_link_that_is_called_most_like_it():
    links = "".join(f"<link name='{name}'/>" for name in ("pelvis", "l_uarm", "l_larm", "head"))
    text = f"<robot name='r'>{links}"
    for parent, child in (("pelvis", "l_uarm"), ("", "l_larm"), ("pelvis", "head")):
        end = f"<parent link='{parent}'/>" if parent else ""
        text += f"<joint name='to_{child}' type='fixed'>{end}<child link='{child}'/></joint>"
    (cause,) = causes(f"{text}</robot>")
    assert (cause.attribute, cause.value) == ("parent", "l_uarm")
