"""Tags that a slip of the hand has harmed, and elements outside of their section."""

from __future__ import annotations

import pytest
from diagnosed import FILE, diagnosed, mended

pytestmark = pytest.mark.usefixtures("folder")

WHOLE = """<mujoco>
  <default>
    <geom friction="0.9"
          condim="4"/>
  </default>
  <worldbody>
    <body name="arm" pos="0 0 1">
      <joint name="elbow" axis="0 1 0"/>
      <geom name="link" size="0.1"/>
      <body name="hand" pos="0 0 1">
        <geom name="palm" size="0.1"/>
      </body>
      <body name="tool" pos="0 1 0">
        <geom name="tip" size="0.1"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor name="motor" joint="elbow"/>
  </actuator>
</mujoco>
"""
HARMED = {  # what a slip of the hand makes of a part of the text
    "a quote is left out before": ('"0 0 1">\n      <joint', '0 0 1">\n      <joint'),
    "a quote is left out after": ('name="arm" pos', 'name="arm pos'),
    "an attribute stands twice, in two lines": ('condim="4"', 'condim="4"\n          condim="4"'),
    "a tag is opened twice": ("  <worldbody>\n", "  <worldbody>\n  <worldbody>\n"),
    "a tag is closed twice": ("  </worldbody>\n", "  </worldbody>\n  </worldbody>\n"),
    "a section is not closed": ("  </worldbody>\n", ""),
    "a body is not closed": ("      </body>\n      <body", "      <body"),
    "a geom is not closed": ('"palm" size="0.1"/>', '"palm" size="0.1">'),
    "a tag has no end": ('"tool" pos="0 1 0">', '"tool" pos="0 1 0"'),
    "a closing tag has no end": ("</body>\n    </body>", "</body\n    </body>"),
    "a tag has no beginning": ("  <worldbody>", "  worldbody>"),
    "a name is misspelt where it is closed": ("</actuator>", "</actuater>"),
    "a character that is none": ("<motor", "<mo\0tor"),
}


@pytest.mark.parametrize("harm", HARMED)
def test_a_slip_in_the_tags_is_undone_and_nothing_else_is_touched(harm):
    before, after = HARMED[harm]
    assert WHOLE.count(before) == 1
    found = diagnosed(WHOLE.replace(before, after))
    assert [each.rule for each in found.causes] == ["malformed-xml"], found.text()
    assert found.fixed[FILE] == WHOLE


def test_of_a_body_that_is_not_opened_only_the_end_is_taken():
    found = diagnosed(WHOLE.replace('      <body name="hand" pos="0 0 1">\n', ""))
    assert found.diff().count("\n-") == 1
    assert "</body> of line 11 closes nothing" in found.causes[0].says
    assert '<motor name="motor" joint="elbow"/>' in found.fixed[FILE]


def test_of_a_conflict_that_a_merge_has_left_the_first_side_is_kept():
    sides = "<<<<<<< HEAD\n  <actuator>\n=======\n  <actuator><!-- theirs -->\n>>>>>>> theirs\n"
    assert WHOLE.count("  <actuator>\n") == 1
    found = diagnosed(WHOLE.replace("  <actuator>\n", sides))
    assert found.fixed[FILE] == WHOLE
    assert "both sides of a conflict" in found.causes[0].says


def test_a_comment_that_has_no_end_ends_with_its_line():
    found = diagnosed(WHOLE.replace("  <actuator>", "  <!-- the motors\n  <actuator>"))
    assert found.fixed[FILE] == WHOLE.replace("  <actuator>", "  <!-- the motors -->\n  <actuator>")


@pytest.mark.parametrize("end", ['"tip" si', "<body na", '"palm" size="0.1"/>'])
def test_a_text_that_was_cut_off_is_told_as_such(end):
    found = mended(WHOLE[: WHOLE.index(end) + len(end)])
    assert "as if the rest of the file were missing" in found.causes[0].says


def test_an_element_that_was_pasted_twice_is_taken_out():
    found = diagnosed(
        WHOLE.replace('        <geom name="tip"', 2 * '        <geom name="tip" size="0.1"/>\n' + "        <geom")
    )
    assert [each.value for each in found.causes] == ["removed"]
    assert found.fixed[FILE].count('name="tip"') == 1
    assert found.fixed[FILE].count("<geom") == 5


def test_a_joint_right_before_a_body_without_one_is_put_into_it():
    joint, body = '      <joint name="elbow" axis="0 1 0"/>\n', '    <body name="arm" pos="0 0 1">\n'
    assert diagnosed(WHOLE.replace(body + joint, joint + body)).fixed[FILE] == WHOLE


@pytest.mark.parametrize(
    "wrong",
    [
        WHOLE.replace("  </worldbody>\n", "").replace("</mujoco>", "<sensor><clock/></sensor></worldbody></mujoco>"),
        WHOLE.replace("  <actuator>", '  <jointpos joint="elbow"/>\n  <jointpos joint="elbow"/>\n  <actuator>'),
        WHOLE.replace("  <actuator>\n", "").replace("  </actuator>\n", '    <motor joint="elbow"/>\n'),
    ],
)
def test_elements_that_stand_outside_of_their_section_are_moved_and_none_is_lost(wrong):
    found = mended(wrong)
    assert {each.rule for each in found.causes} == {"unknown-element"}, found.text()
    for kept in ("<motor", "<clock", "<jointpos", "<geom"):
        assert found.fixed[FILE].count(kept) == wrong.count(kept)
