"""What is written in a URDF and does not show in the model that MuJoCo makes of it."""

from __future__ import annotations

import pytest
from clinic.diagnosis.rules import rules
from diagnosed import causes, diagnosed, hints, with_edits

ROVER = """
<robot name="rover">
  <link name="base">
    <inertial>
      <origin xyz="0 0 0"/><mass value="20"/>
      <inertia ixx="{i}" ixy="0" ixz="0" iyy="{i}" iyz="0" izz="{i}"/>
    </inertial>
    <visual><geometry><box size="0.4 0.3 0.1"/></geometry></visual>
    <collision><geometry><box size="0.4 0.3 0.1"/></geometry></collision>
  </link>
  <link name="wheel">
    <inertial>
      <origin xyz="0 0 0"/><mass value="0.5"/>
      <inertia ixx="0.0004" ixy="0" ixz="0" iyy="0.0006" iyz="0" izz="0.0004"/>
    </inertial>
    <collision><origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.05" length="0.03"/></geometry></collision>
  </link>
  <joint name="axle" type="continuous">
    <parent link="{parent}"/><child link="wheel"/><origin xyz="0 0.2 -0.05"/><axis xyz="0 1 0"/>
  </joint>
</robot>
"""


def rover(i: float = 0.3, parent: str = "base") -> str:
    return ROVER.format(i=i, parent=parent)


def test_the_root_is_weighed_although_it_is_the_world() -> None:
    assert not hints(rover())
    (found,) = hints(rover(i=0.001))
    assert (found.rule, found.elements, found.line) == ("inertia-unlike-geoms", ('body "base"',), 4)


def test_a_root_that_cannot_be_weighed_leaves_all_else_as_it_was() -> None:
    assert not causes(rover(i=0))


@pytest.mark.parametrize(("kind", "value"), [("hinge", "revolute"), ("free", "floating"), ("continous", "continuous")])
def test_a_joint_of_a_type_that_urdf_has_not_gets_one(kind: str, value: str) -> None:
    text = rover().replace('type="continuous"', f'type="{kind}"')
    (cause,) = causes(text)
    assert (cause.rule, cause.attribute, cause.now, cause.value) == ("invalid-value", "type", kind, value)


@pytest.mark.parametrize(("parent", "value"), [("bas", "base"), ("torso", "removed")])
def test_a_joint_at_a_link_that_is_not_there_is_told(parent: str, value: str) -> None:
    (cause,) = causes(rover(parent=parent))
    assert (cause.rule, cause.now, cause.value) == ("unknown-reference", parent, value)


@pytest.mark.parametrize(
    ("height", "says"),
    [(-0.03, ""), (-0.029, ""), (-0.028, "2 mm above"), (-0.01, "20 mm above"), (-0.04, "10 mm lower")],
)
def test_a_caster_ends_where_the_wheels_do(height: float, says: str) -> None:
    wheel = (
        '<body name="{0}_wheel" pos="-0.1 {1} 0"><joint axis="0 1 0"/>'
        '<geom type="cylinder" size="0.05 0.01" zaxis="0 1 0"/></body>'
    )
    parts = f'<geom name="caster" size="0.02" pos="0.12 0 {height}"/>{wheel.format("left", 0.1)}'
    base = f'<freejoint/><geom type="box" size="0.15 0.08 0.02"/>{parts}{wheel.format("right", -0.1)}'
    text = f'<mujoco><worldbody><body name="base" pos="0 0 0.1">{base}</body></worldbody></mujoco>'
    assert [says in each.says for each in hints(text, "wheels-off-the-ground")] == [True] * bool(says)


@pytest.mark.parametrize(("geom", "told"), [("", True), ('<geom size="0.02"/>', False)])
def test_a_caster_without_a_geom_is_told(geom: str, told: bool) -> None:
    wheel = '<body name="{0}_wheel" pos="-0.1 {1} 0"><geom type="cylinder" size="0.05 0.01" zaxis="0 1 0"/></body>'
    caster = (
        f'<body name="caster" pos="0.12 0 -0.03"><inertial pos="0 0 0" mass="0.1" diaginertia="1e-5 1e-5 1e-5"/>{geom}'
    )
    parts = f"{caster}</body>{wheel.format('left', 0.1)}{wheel.format('right', -0.1)}"
    text = f'<mujoco><worldbody><body name="base"><freejoint/>{parts}</body></worldbody></mujoco>'
    assert [each.elements for each in hints(text, "wheels-off-the-ground")] == [('body "caster"',)] * told


@pytest.mark.parametrize(("radius", "told"), [(0.055, False), (0.045, True)])
def test_a_mesh_is_as_low_as_its_lowest_vertex(radius: float, told: bool) -> None:
    """Its box, turned as it is, would be 17 mm lower."""
    wheels = "".join(
        f'<body name="{side}_wheel" pos="0 {y} 0"><joint axis="0 1 0"/>'
        f'<geom type="cylinder" size="{radius} 0.01" zaxis="0 1 0"/></body>'
        for side, y in (("left", 0.1), ("right", -0.1))
    )
    mesh = '<mesh name="hull" vertex="0.1 0 0 -0.1 0 0 0 0.05 0 0 -0.05 0 0 0 0.02 0 0 -0.02"/>'
    base = f'<freejoint/><geom type="mesh" mesh="hull" euler="0 30 0"/>{wheels}'
    text = f'<mujoco><asset>{mesh}</asset><worldbody><body pos="0 0 0.1">{base}</body></worldbody></mujoco>'
    assert ["5 mm lower" in each.says for each in hints(text, "wheels-off-the-ground")] == [True] * told


@pytest.mark.parametrize("floating", [False, True], ids=["fixed to the world", "with a floating joint of its own"])
def test_a_link_that_mujoco_fuses_is_weighed(floating: bool) -> None:
    text = rover(i=0.001).replace('link name="base"', 'link name="body"', 1)
    root = '<link name="base"/><joint name="fixed" type="fixed"><parent link="base"/><child link="body"/></joint>'
    if floating:
        root += (
            '<link name="world"/><joint name="free" type="floating"><parent link="world"/><child link="base"/></joint>'
        )
    (found,) = hints(text.replace("</robot>", f"{root}</robot>"))
    assert (found.rule, found.elements) == ("inertia-unlike-geoms", ('body "body"',))


@pytest.mark.parametrize(("others", "told"), [("fixed", True), ("continuous", False)])
def test_wheels_that_are_all_fixed_and_have_an_axis_are_told(others: str, told: bool) -> None:
    inertial = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    wheel = (
        '<link name="{0}_wheel">{2}</link><joint name="{0}_wheel_joint" type="{1}"><parent link="base"/>'
        '<child link="{0}_wheel"/><axis xyz="0 1 0"/></joint>'
    )
    kinds = [("left", "fixed"), ("right", "fixed"), ("rear", others)]
    text = f'<robot name="r"><link name="base"/>{"".join(wheel.format(*kind, inertial) for kind in kinds)}</robot>'
    assert [len(each.elements) for each in hints(text, "urdf-fixed-with-range")] == [3] * told


@pytest.mark.parametrize(("second", "told"), [('<axis xyz="0 1 0"/>', ["fork", "roll"]), ("", [])])
def test_a_caster_whose_fork_and_wheel_are_fixed_and_have_axes_is_told(second: str, told: list[str]) -> None:
    joint = '<joint name="caster_{0}" type="fixed"><parent link="{1}"/><child link="{0}"/>{2}</joint>'
    joints = joint.format("fork", "base", '<axis xyz="0 0 1"/>') + joint.format("roll", "fork", second)
    drive = '<joint name="drive" type="continuous"><parent link="base"/><child link="tyre"/><axis xyz="0 1 0"/></joint>'
    inertial = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    links = "".join(f'<link name="{name}">{inertial}</link>' for name in ("fork", "roll", "tyre"))
    found = hints(f'<robot name="r"><link name="base"/>{links}{joints}{drive}</robot>', "urdf-fixed-with-range")
    assert [each.elements for each in found] == [tuple(f'joint "caster_{name}"' for name in told)] * bool(told)


def test_efforts_that_are_all_zero_are_told_with_a_symptom_alone() -> None:
    text = rules()["effort-zero"].example("Bad").replace('effort="20"', 'effort="0"')
    assert not hints(text, "effort-zero")
    assert [len(each.elements) for each in hints(text, "effort-zero", symptom="stuck")] == [2]


@pytest.mark.parametrize(("ends", "told"), [('lower="0" upper="0"', True), ("", False)])
def test_joints_that_all_have_a_point_for_a_range_are_told(ends: str, told: bool) -> None:
    limit = f'<limit effort="1" velocity="1" {ends}/></joint>'
    text = rover().replace('"continuous"', '"revolute"').replace("</joint>", limit)
    assert [each.elements for each in hints(text, "range-empty")] == [('joint "axle"',)] * told


@pytest.mark.parametrize(("name", "told"), [("elbow", True), ("left_wheel", False)])
def test_a_wheel_without_a_range_is_well_beside_joints_that_have_one(name: str, told: bool) -> None:
    joint = (
        '<link name="{0}_link"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        '</inertial></link><joint name="{0}" type="revolute"><parent link="base"/><child link="{0}_link"/>'
        "<limit {1}/></joint>"
    )
    joints = joint.format("hip", 'lower="-1" upper="1"') + joint.format(name, 'effort="1"')
    text = f'<robot name="r"><link name="base"/>{joints}</robot>'
    assert [each.elements for each in hints(text, "range-empty")] == [(f'joint "{name}"',)] * told


def test_a_moment_that_the_twin_link_has_is_the_one_that_is_told() -> None:
    link = (
        '<link name="{0}_arm"><inertial><mass value="1"/><inertia ixx="0.0007" iyy="0.0065" izz="{1}" ixy="0" ixz="0"'
        ' iyz="0"/></inertial></link>'
        '<joint name="{0}" type="continuous"><parent link="base"/><child link="{0}_arm"/></joint>'
    )
    text = (
        f'<robot name="r"><link name="base"/>{link.format("left", "0.0066")}{link.format("right", "0.00066")}</robot>'
    )
    (cause,) = causes(text)
    assert (cause.rule, cause.attribute, cause.value) == ("invalid-inertia", "izz", "0.0066")


def test_products_of_inertia_with_the_other_sign_are_turned_where_that_alone_fits() -> None:
    inertia = '<inertia ixx="0.0054" iyy="0.0032" izz="0.005" ixy="0.0014" ixz="-0.0009" iyz="-0.0017"/>'
    link = f'<link name="arm"><inertial><mass value="2"/>{inertia}</inertial></link>'
    joint = '<joint name="j" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>'
    found = causes(f'<robot name="r"><link name="base"/>{link}{joint}</robot>')
    assert [(each.rule, each.attribute, each.value) for each in found] == [("invalid-inertia", "ixy", "-0.0014")]
    assert [each.value for each in found[0].edit] == ["-0.0014", "0.0009", "0.0017"]


def test_an_origin_of_a_link_that_is_its_joints_is_told() -> None:
    origin = '<origin rpy="1.5708 0 0"/>'
    text = rover()
    twice = text.replace(origin, '<origin rpy="1.5708 0 0" xyz="0 0.2 -0.05"/>')
    assert not hints(text, "place-twice")
    assert [each.elements[0] for each in hints(twice, "place-twice")] == ['body "wheel"']


@pytest.mark.parametrize(("upper", "told"), [("900", ["0 0.9"]), ("0.9", []), ("3", [])])
def test_a_telescope_with_a_range_in_millimetres_is_told(upper: str, told: list[str]) -> None:
    inertial = '<inertial><mass value="5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    shape = '<collision><origin xyz="0.5 0 0"/><geometry><box size="2 0.1 0.1"/></geometry></collision>'
    links = "".join(f'<link name="{name}">{inertial}{shape}</link>' for name in ("jib", "boom"))
    pan = '<link name="base"/><joint name="pan" type="continuous"><parent link="base"/><child link="jib"/></joint>'
    slide = '<joint name="telescope" type="prismatic"><parent link="jib"/><child link="boom"/><origin xyz="0.6 0 0"/>'
    slide += f'<axis xyz="1 0 0"/><limit lower="0" upper="{upper}" effort="400" velocity="1"/></joint>'
    text = f'<robot name="crane">{pan}{links}{slide}</robot>'
    found = hints(text, "slides-out")
    assert [each.value for each in found] == told
    assert all(each.after is not None and each.after <= 0 for each in found)


CUP = """
<robot name="cup">
  <link name="base">
    {visual}<collision><geometry><mesh filename="cup.obj"/></geometry></collision>
  </link>
  <link name="ball">
    <inertial>
      <origin xyz="0 0 0"/><mass value="0.1"/>
      <inertia ixx="0.0004" ixy="0" ixz="0" iyy="0.0004" iyz="0" izz="0.0004"/>
    </inertial>
    <collision><geometry><sphere radius="0.02"/></geometry></collision>
  </link>
  <joint name="lift" type="{kind}">
    <parent link="base"/><child link="ball"/><origin xyz="0.01 0 0.15"/><axis xyz="0 0 1"/>
    <limit lower="-0.2" upper="0.2" effort="1" velocity="1"/>
  </joint>
</robot>
"""


@pytest.mark.parametrize("visual", ["", '<visual><geometry><mesh filename="shell.glb"/></geometry></visual>'])
@pytest.mark.parametrize(("kind", "told"), [("prismatic", False), ("floating", True)])
def test_a_base_that_is_the_world_is_of_one_mechanism_with_its_limbs(tmp_path, monkeypatch, visual, kind, told):
    monkeypatch.chdir(tmp_path)
    rings = [(0.06, 0), (0.06, 0.08), (0.05, 0.08), (0.05, 0.02)]
    corners = [(x * r, y * r, z) for r, z in rings for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    edges = [(4 * k + a, 4 * k + (a + 1) % 4) for k in range(3) for a in range(4)]
    sides = [(one, other, other + 4, one + 4) for one, other in edges]
    quads = [(3, 2, 1, 0), *sides, (12, 13, 14, 15)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + ["f " + " ".join(str(k + 1) for k in each) for each in quads]
    (tmp_path / "cup.obj").write_text("\n".join(lines))
    (tmp_path / "shell.glb").write_bytes(b"glTF")
    text = CUP.format(visual=visual, kind=kind)
    found = diagnosed(text, "hull-over-hole")
    assert not found.error
    assert bool(found.causes or found.hints) == told


@pytest.mark.parametrize(("tag", "told"), [("material", False), ("surface", True)])
def test_the_colour_of_a_collision_is_no_finding(tag: str, told: bool) -> None:
    link = (
        f'<link name="base"><collision><geometry><sphere radius="1"/></geometry><{tag} name="red"/></collision></link>'
    )
    found = hints(f'<robot name="ball">{link}</robot>', "urdf-element-ignored")
    assert [each.attribute for each in found] == [tag] * told


@pytest.mark.parametrize(
    ("name", "kind", "told"),
    [
        ("telescope", "revolute", True),
        ("telescope", "prismatic", False),
        ("slider_crank", "revolute", False),
        ("axle", "revolute", False),
    ],
)
def test_a_revolute_joint_that_is_called_a_telescope_is_told(name: str, kind: str, told: bool) -> None:
    text = rover().replace('"axle" type="continuous"', f'"{name}" type="{kind}"')
    text = text.replace("</joint>", '<limit lower="0" upper="0.9" effort="9" velocity="1"/></joint>')
    found = hints(text, "hinge-for-slide")
    assert [(each.attribute, each.value) for each in found] == [("type", "prismatic")] * told
    for each in found:
        assert 'type="prismatic"' in with_edits(text, each)


@pytest.mark.parametrize(("links", "told"), [((1, 2), False), ((0, 1), True)], ids=["an arm's", "a robot's"])
def test_the_base_of_an_arm_may_weigh_what_it_does(links: tuple[int, int], told: bool) -> None:
    moving = (
        '<link name="{1}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        '</inertial></link><joint name="{1}" type="continuous"><parent link="{0}"/><child link="{1}"/></joint>'
    )
    base = '<link name="l0"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>'
    chain = moving.format("l0", "l1") + moving.format(f"l{links[0]}", "l2") + moving.format(f"l{links[1]}", "l3")
    found = hints(f'<robot name="r">{base}{chain}</robot>', "inertial-forgotten")
    assert [each.elements for each in found] == [('body "l0"',)] * told


@pytest.mark.parametrize(
    ("name", "kind", "told"), [("fix", "floating", True), ("root", "floating", False), ("fix", "fixed", False)]
)
def test_a_joint_that_is_called_fixed_and_floats_is_told(name: str, kind: str, told: bool) -> None:
    inertial = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    case = f'<link name="world"/><link name="case">{inertial}</link>'
    joint = f'<joint name="{name}" type="{kind}"><parent link="world"/><child link="case"/></joint>'
    text = f'<robot name="r">{case}{joint}</robot>'
    found = hints(text, "urdf-fixed-with-range")
    assert [(each.elements[0], each.value) for each in found] == [('joint "fix"', "fixed")] * told


def test_a_joint_is_mended_where_it_is_and_not_where_a_transmission_names_it():
    inertia = '<inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/>'
    links = '<link name="palm"/>' + "".join(
        f'<link name="{name}"><inertial><mass value="1"/>{inertia}</inertial></link>' for name in ("knuckle", "tip")
    )
    joint = '<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{0}"/><origin xyz="0.1 0 0"/>'
    limit = '<axis xyz="0 1 0"/><limit lower="0" upper="{}" effort="9" velocity="2"/>'
    knuckle = f"{joint.format('knuckle', 'palm')}{limit.format(0.8)}</joint>"
    mimic = '<mimic joint="knuckle" multiplier="-1"/>'
    tip = f"{joint.format('tip', 'knuckle')}{limit.format(0.81)}{mimic}</joint>"
    control = '<ros2_control name="c" type="system"><joint name="tip"/><joint name="knuckle"/></ros2_control>'
    text = f'<robot name="hand">{links}{knuckle}{tip}{control}</robot>'
    found = causes(text, "follower-out-of-range")
    assert [(each.attribute, each.now, each.value) for each in found] == [("multiplier", "-1", "1")]
    assert 'multiplier="1"' in with_edits(text, found[0])


def test_the_one_finger_of_three_that_mimics_with_the_other_sign_is_told_by_its_multiplier():
    inertia = '<inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/>'
    link = f'<link name="{{0}}"><inertial><mass value="1"/>{inertia}</inertial></link>'
    joint = (
        '<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{0}"/><origin xyz="0.1 0 0"/>'
        '<axis xyz="0 1 0"/><limit lower="{2}" upper="0.8" effort="9" velocity="2"/>{3}</joint>'
    )
    parts = '<link name="palm"/>'
    for one, times in (("a", 0.7), ("b", -0.7), ("c", 0.7)):
        mimic = f'<mimic joint="{one}1" multiplier="{times}"/>'
        parts += link.format(f"{one}1") + joint.format(f"{one}1", "palm", 0, "")
        parts += link.format(f"{one}2") + joint.format(f"{one}2", f"{one}1", -0.1, mimic)
    text = f'<robot name="hand">{parts}</robot>'
    (found,) = hints(text, "coupling-unlike-others", "follower-out-of-range")
    assert (found.elements[0], found.attribute, found.now, found.value) == ('joint "b2"', "multiplier", "-0.7", "0.7")
    assert 'multiplier="-' not in with_edits(text, found)
