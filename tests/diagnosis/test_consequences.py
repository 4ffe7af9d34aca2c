"""A cause whose symptom goes away with another's edit is a consequence of that one."""

from __future__ import annotations

import pytest
from clinic.diagnosis.process import diagnose
from diagnosed import causes, diagnosed, findings, hints

MM = "-20 -20 -20  20 -20 -20  20 20 -20  -20 20 -20  -20 -20 20  20 -20 20  20 20 20  -20 20 20"
ALONE = f"""<mujoco>
  <asset><mesh name="mug" vertex="{MM}"/></asset>
  <worldbody>
    <geom type="plane" size="3 3 0.1"/>
    <body name="mug" pos="0 0 0.1">
      <freejoint/>
      <geom type="mesh" mesh="mug"/>
    </body>
  </worldbody>
</mujoco>
"""


def test_a_mesh_in_millimetres_explains_that_it_begins_in_the_floor(tmp_path):
    (tmp_path / "model.xml").write_text(ALONE)
    found = diagnose(tmp_path / "model.xml")
    assert [each.rule for each in found.causes] == ["mesh-in-another-unit"]
    assert "overlap-at-start" in [each.rule for each in found.hints]
    assert 'scale="0.001 0.001 0.001"' in next(iter(found.fixed.values()))


def test_a_mesh_in_millimetres_explains_most_of_what_a_servo_cannot_hold():
    servo = '<actuator><position joint="lift" kp="1" ctrlrange="-2 2"/></actuator>'
    arm = '<joint name="lift" axis="0 1 0" damping="5"/><geom type="mesh" mesh="mug" pos="0.2 0 0"/>'
    arm += '<geom size="0.05" mass="1" pos="0.2 0 0.05"/>'
    text = ALONE.replace('<freejoint/>\n      <geom type="mesh" mesh="mug"/>', arm).replace(
        "</mujoco>", f"{servo}</mujoco>"
    )
    right = text.replace('name="mug" v', 'name="mug" scale="0.001 0.001 0.001" v')
    for each, told in ((text, "mesh-in-another-unit"), (right, "weak-servo")):
        assert [one.rule for one in diagnosed(each, "mesh-in-another-unit", "weak-servo").causes] == [told]


def test_a_mesh_of_a_text_that_no_parser_reads_is_told_without_an_edit():
    with_two_roots = ALONE + "<mujoco/>"
    found = hints(with_two_roots, "mesh-in-another-unit")
    assert [(each.elements, each.edit) for each in found] == [(('mesh "mug"',), ())]


@pytest.mark.parametrize("scale", ["0.001 0.001 0.001", "1e-5 1e-5 1e-5"])
def test_a_mesh_that_is_scaled_twice_is_scaled_back(tmp_path, scale):
    metres = " ".join(f"{float(each) / 1000:g}" for each in MM.split())
    (tmp_path / "model.xml").write_text(
        ALONE.replace(MM, metres).replace('name="mug" v', f'name="mug" scale="{scale}" v')
    )
    (found,) = diagnose(tmp_path / "model.xml").causes
    assert found.attribute == "scale"
    assert found.value.split() == [f"{1000 * float(each):g}" for each in scale.split()]


def test_in_a_urdf_every_place_of_the_mesh_is_scaled(tmp_path):
    shape = '<geometry><mesh filename="mug.obj"/></geometry>'
    inertial = (
        '<inertial><mass value="1"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>'
    )
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    joint = f'<parent link="base"/><child link="mug"/><origin xyz="0.1 0 0"/><axis xyz="0 1 0"/>{limit}'
    (tmp_path / "model.urdf").write_text(
        f'<robot name="r"><link name="base">{inertial}</link><link name="mug">{inertial}<visual>{shape}</visual>'
        f'<collision>{shape}</collision></link><joint name="j" type="revolute">{joint}</joint></robot>'
    )
    write_mug(tmp_path)
    found = diagnose(tmp_path / "model.urdf", select=["mesh-in-another-unit"])
    assert [each.rule for each in found.causes] == ["mesh-in-another-unit"]
    assert next(iter(found.fixed.values())).count('scale="0.001 0.001 0.001"') == 2


def write_mug(folder):
    numbers = MM.split()
    corners = "".join(f"v {' '.join(numbers[i : i + 3])}\n" for i in range(0, 24, 3))
    faces = (
        "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n"
    )
    (folder / "mug.obj").write_text(corners + faces)


@pytest.mark.parametrize("odd", [0, 1])
def test_only_the_use_of_a_file_that_lacks_its_scale_is_mended(tmp_path, odd):
    write_mug(tmp_path)
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    inertial = (
        '<inertial><mass value="1"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>'
    )
    links, joints = "", ""
    for number in range(3):
        scale = "" if number == odd else ' scale="0.001 0.001 0.001"'
        shape = f'<collision><geometry><mesh filename="mug.obj"{scale}/></geometry></collision>'
        links += f'<link name="link{number}">{inertial}{shape}</link>'
        joints += (
            f'<joint name="j{number}" type="revolute"><parent link="base"/><child link="link{number}"/>'
            f'<origin xyz="0.1 0 0"/><axis xyz="0 1 0"/>{limit}</joint>'
        )
    (tmp_path / "model.urdf").write_text(f'<robot name="r"><link name="base">{inertial}</link>{links}{joints}</robot>')
    found = diagnose(tmp_path / "model.urdf", select=["mesh-in-another-unit"])
    assert [edit.value for each in found.causes for edit in each.edit] == ["0.001 0.001 0.001"]
    assert next(iter(found.fixed.values())).count('scale="0.001 0.001 0.001"') == 3


@pytest.mark.parametrize(("scale", "told"), [("0.001 0.001 0.001", ['mesh "lid"']), ("0.03 0.03 0.03", [])])
def test_one_mesh_among_others_is_a_speck_or_a_screw(scale, told):
    metres = " ".join(f"{float(each) / 1000:g}" for each in MM.split())
    meshes = "".join(
        f'<mesh name="{name}" vertex="{metres}" scale="{size}"/>' for name, size in (("mug", "1 1 1"), ("lid", scale))
    )
    bodies = "".join(
        f'<body pos="{x} 0 1"><joint axis="0 1 0"/><geom type="mesh" mesh="{name}" mass="1"/>'
        f'<body pos="0 0 0.1"><joint/><geom size="0.02"/></body></body>'
        for x, name in enumerate(("mug", "lid"))
    )
    text = f"<mujoco><asset>{meshes}</asset><worldbody>{bodies}</worldbody></mujoco>"
    assert [each for finding in findings(text, "mesh-in-another-unit") for each in finding.elements] == told


ARM = """<mujoco>
  <worldbody>
    <body name="arm" pos="0 0 1">
      <joint name="shoulder" axis="0 1 0" damping="3"/>
      <inertial pos="{centre} 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
    </body>
  </worldbody>
  <actuator><position joint="shoulder" kp="{kp}" forcerange="-30 30" ctrlrange="-1 1"/></actuator>
</mujoco>
"""


@pytest.mark.parametrize(
    ("centre", "kp", "causes"),
    [("150", "40", ["centre-of-mass-outside"]), ("0.5", "2", ["weak-servo"]), ("0.15", "40", [])],
    ids=["in millimetres", "beyond the end", "in the middle"],
)
def test_a_servo_is_too_weak_but_for_a_mass_beyond_all_measure(centre, kp, causes):
    found = diagnosed(ARM.format(centre=centre, kp=kp))
    assert [each.rule for each in found.causes] == causes, found.text()


def test_what_a_comment_silences_takes_no_cause_away():
    silenced = "<!-- clinic: ignore[centre-of-mass-outside] the counterweight is not drawn -->"
    text = ARM.format(centre="150", kp="40").replace("<inertial", f"{silenced}\n      <inertial")
    found = diagnosed(text)
    assert "weak-servo" in [each.rule for each in found.causes], found.text()


def test_two_links_in_millimetres_are_one_reason():
    forearm = """<body name="forearm" pos="0.3 0 0">
        <joint name="elbow" axis="0 1 0" damping="3"/>
        <inertial pos="150 0 0" mass="0.5" diaginertia="0.01 0.01 0.01"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
      </body>
    </body>"""
    text = ARM.format(centre="-150", kp="40").replace("</body>", forearm)
    assert {each.rule for each in causes(text)} == {"centre-of-mass-outside"}


def walker(shin: str) -> str:
    """Six legs in pairs, on a floor that they reach; of the left one in the middle the shin hangs elsewhere."""
    legs = ""
    for part, length in (("front", 0.25), ("middle", 0.26), ("rear", 0.27)):
        for side, y in (("left", 0.2), ("right", -0.2)):
            at = shin if (part, side) == ("middle", "left") else f"0 0 -{length}"
            legs += f"""
      <body name="{side}_{part}_thigh" pos="{40 * length - 10.4:g} {y} 0">
        <joint axis="0 1 0" damping="1" range="-60 60"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.03"/>
        <body name="{side}_{part}_shin" pos="{at}">
          <joint axis="0 1 0" damping="1" range="-60 60"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.1" size="0.03"/>
          <body name="{side}_{part}_foot" pos="0.03 0 -0.25">
            <joint axis="0 1 0" damping="1" range="-60 60"/>
            <geom size="0.06"/>
          </body>
        </body>
      </body>"""
    trunk = f'<body pos="0 0 0.58"><freejoint/><geom type="box" size="0.4 0.1 0.05"/>{legs}\n    </body>'
    return f'<mujoco><worldbody><geom type="plane" size="3 3 1"/>{trunk}</worldbody></mujoco>'


@pytest.mark.parametrize(
    ("shin", "follows"),
    [
        pytest.param("0 0 -0.01", "overlap-of-relatives", id="within its thigh"),
        pytest.param("0 0 -0.39", "overlap-at-start", id="down into the floor"),
    ],
)
def test_an_overlap_follows_from_the_part_that_is_not_its_twins_image_and_tells_which_it_is(shin, follows):
    found = diagnosed(walker(shin))
    told = [each.rule for each in found.hints]
    assert not found.causes, found.text()
    assert told.index("twin-place-differs") < told.index(follows)
    first = next(each for each in found.hints if each.rule == "twin-place-differs")
    assert (first.elements, first.value) == (('body "left_middle_shin"',), "0 0 -0.26")


def test_an_overlap_without_a_part_that_is_displaced_is_told_as_it_was():
    buried = walker("0 0 -0.26").replace('pos="0 0 0.58"', 'pos="0 0 0.4"')
    assert [each.rule for each in causes(buried)] == ["overlap-at-start"]


@pytest.mark.parametrize(("odd", "value"), [(3, "-0.1 0 0"), (0, "")])
def test_a_link_that_goes_back_to_where_its_parent_hangs_is_turned(odd, value):
    chain = "".join(
        f'<body name="s{i}" pos="{0.1 if i == odd else -0.1} 0 {1 if i == 1 else 0}"><joint axis="0 0 1" damping="1"/>'
        '<geom type="capsule" fromto="0 0 0 -0.06 0 0" size="0.02"/>'
        for i in range(1, 7)
    )
    found = diagnosed(f"<mujoco><worldbody>{chain}{'</body>' * 6}</worldbody></mujoco>")
    told = [(each.rule, each.elements[0], each.value) for each in found.hints if "overlap" not in each.rule]
    assert told == [("parts-coincide", 'body "s3"', value)] * bool(value), found.text()


def test_a_keyframe_is_in_the_floor_for_a_foot_a_decimal_point_off_its_twins():
    legs = "".join(
        f'<body name="{side}" pos="0 {y} 0"><joint axis="0 1 0"/>'
        f'<geom name="{side}_foot" type="box" size="0.09 0.03 0.01" pos="0.04 0 {z}"/></body>'
        for side, y, z in (("left", 0.1, -0.29), ("right", -0.1, -0.029))
    )
    body = f'<body name="pelvis" pos="0 0 0.5"><freejoint/><geom size="0.05"/>{legs}</body>'
    key = '<keyframe><key qpos="0 0 0.039 1 0 0 0 0 0"/></keyframe>'
    text = f'<mujoco><worldbody><geom type="plane" size="2 2 1"/>{body}</worldbody>{key}</mujoco>'
    found = diagnosed(text, "key-in-the-floor", "twin-place-differs")
    assert [(each.rule, each.value) for each in found.causes] == [("twin-place-differs", "0.04 0 -0.029")]
    assert [each.rule for each in found.hints] == ["key-in-the-floor"]
