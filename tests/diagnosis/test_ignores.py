"""Comments in a model that silence rules."""

from __future__ import annotations

import pytest
from clinic.diagnosis.diagnose import Diagnosis, examine
from clinic.diagnosis.ignores import ID
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules
from diagnosed import diagnosed, hints

DRILL = """<body name="drill" pos="0 0 1">
  <freejoint/>
  <geom name="shell" size="0.05" contype="0" conaffinity="0"/>
  <geom size="0.05" mass="0.2"/>
</body>
"""
WHY = "<!-- clinic: ignore[visual-mass] the shell weighs -->\n"


def examined(*parts: str, **files: str) -> Diagnosis:
    included = {f"{name}.xml": text for name, text in files.items()}
    return examine(NativeEngine(), {"model.xml": "\n".join(parts), **included}, select=["visual-mass", "masks"])


def scene(inside: str) -> str:
    return f"<mujoco>\n<worldbody>\n{inside}</worldbody>\n</mujoco>\n"


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(scene(WHY + DRILL), id="before the element that it names"),
        pytest.param(
            scene(DRILL.replace("  <geom name", WHY + "<geom name")), id="before the element that the edit changes"
        ),
        pytest.param(WHY + scene(DRILL), id="before the whole"),
        pytest.param(scene(DRILL).replace("<worldbody>", WHY + "<worldbody>"), id="around it"),
        pytest.param(scene(WHY + "<!-- a drill -->\n" + DRILL), id="another comment between"),
        pytest.param(scene(WHY.replace("[visual-mass]", "[condim-1 , visual-mass]") + DRILL), id="one of two rules"),
    ],
)
def test_a_rule_is_silenced_on_the_element_that_follows(text):
    made = examined(text)
    assert made.causes == ()
    (silenced,) = made.silenced
    assert (silenced.rule, silenced.silenced) == ("visual-mass", "the shell weighs")
    assert made.fixed == made.texts
    assert "visual-mass" not in made.ruled_out


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        (scene(WHY.replace(" the shell weighs", "") + DRILL), 3, "It gives no reason"),
        (scene(WHY.replace("mass]", "mas]") + DRILL), 3, "No rule is called visual-mas; visual-mass is"),
        (scene(WHY.replace("visual-mass", "repeated-name") + DRILL), 3, "models that do not compile"),
        (scene(WHY.replace("visual-mass", "masks") + DRILL), 3, "The rule masks finds nothing here"),
        (scene(WHY.replace("ignore[", "ignore [[") + DRILL), 3, "No rule is called [visual-mass"),
        (scene(WHY.replace("[visual-mass]", " visual-mass") + DRILL), 3, "expected `clinic: ignore[a-rule] why`"),
        (scene(DRILL + WHY), 8, "No element follows it"),
        (
            scene(DRILL.replace("  <geom size", WHY + "<geom size")),
            6,
            "finds nothing that lies in what follows it alone",
        ),
    ],
)
def test_a_comment_that_silences_nothing_is_told_with_its_line(text, line, said):
    made = examined(text)
    assert [each.rule for each in made.causes] == ["visual-mass"]
    assert made.silenced == ()
    (hint,) = (each for each in made.hints if each.rule == ID)
    assert hint.line == line
    assert said in hint.says


def test_a_finding_about_two_elements_is_silenced_where_both_are():
    other = DRILL.replace("drill", "lamp").replace("0 0 1", "0 0 3").replace("shell", "shade")
    assert examined(scene(WHY + DRILL + other)).silenced == ()
    both = examined(scene(WHY + DRILL + WHY.replace("shell", "shade") + other))
    assert [each.silenced for each in both.silenced] == ["the shell weighs; the shade weighs"]


def test_a_finding_about_no_element_is_silenced_where_its_edit_is():
    visual = '<visual><headlight active="0"/></visual><worldbody>'
    text = scene(DRILL).replace("<worldbody>", WHY.replace("visual-mass", "nothing-lit") + visual)
    (silenced,) = diagnosed(text, "nothing-lit").silenced
    assert silenced.elements == ("the headlight",)


def test_a_rule_that_is_not_tried_leaves_its_comment_alone():
    assert not hints(scene(WHY + DRILL), "visual-mass", "masks", ignore=["visual-mass"])


def test_a_comment_holds_in_an_included_file_and_for_one():
    part = scene(WHY + DRILL)
    inside = examined('<mujoco><include file="part.xml"/></mujoco>', part=part)
    assert [(each.file, each.line) for each in inside.silenced] == [("part.xml", 6)]
    before = examined(f'<mujoco>{WHY}<include file="part.xml"/></mujoco>', part=scene(DRILL))
    assert [(each.file, each.line) for each in before.silenced] == [("part.xml", 5)]
    beside = examined(f'<mujoco><include file="part.xml"/>{WHY}<option/></mujoco>', part=scene(DRILL))
    assert [each.rule for each in beside.causes] == ["visual-mass"]


def test_what_is_silenced_is_counted_in_the_text_and_told_in_the_data():
    made = examined(scene(WHY + DRILL))
    assert made.text().endswith("\nsilenced (1): visual-mass model.xml:6")
    assert [each["silenced"] for each in made.data()["silenced"]] == ["the shell weighs"]


def test_a_keyframe_is_tried_where_all_causes_of_the_start_are_silenced():
    text = scene(WHY + DRILL).replace("</worldbody>", '</worldbody><keyframe><key name="up"/></keyframe>')
    (silenced,) = examined(text).silenced
    assert silenced.keyframe == 0


def test_a_hint_without_an_edit_has_the_line_of_its_element():
    text = rules()["mass-unlike-links"].example("Bad")
    (hint,) = hints(text, "mass-unlike-links")
    assert hint.edit == ()
    assert f'name="{hint.elements[0].split(chr(34))[1]}"' in text.splitlines()[(hint.line or 0) - 1]
