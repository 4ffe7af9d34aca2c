"""The numbers of contacts: friction, condim, solref, and pairs."""

from __future__ import annotations

import pytest
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules
from diagnosed import findings, hints
from scenery import BOX, FLOOR


def test_friction_is_given_to_geoms_and_pairs_in_their_own_form():
    named = (
        rules()["grasp-slips"]
        .example("Bad")
        .replace("<geom type", '<geom name="pad" type', 2)
        .replace('"pad"', '"floor"', 1)
    )
    pair = '<contact><pair geom1="cube" geom2="pad" friction="0.15 0.15 0.005 0.0001 0.0001"/></contact>'
    found = findings(named.replace("</worldbody>", f"</worldbody>{pair}"))
    (told,) = [each for each in found if each.rule == "grasp-slips"]
    assert {edit.value for edit in told.edit} == {"1 0.005 0.0001", "1 1 0.005 0.0001 0.0001"}


@pytest.mark.parametrize(("ratio", "told"), [(5, False), (10, True)])
def test_impratio_hardens_the_contact_itself_under_pyramidal_cones(ratio, told):
    box = BOX.format(z=0.05, more=' mass="1"')

    def depth(option: str) -> float:
        text = f"<mujoco><option {option}/><worldbody>{FLOOR}{box}</worldbody></mujoco>"
        compiled = NativeEngine().compile(text, {})
        compiled.step(1000)
        found = hints(text, "impratio-without-elliptic")
        assert len(found) == ("elliptic" not in option and "impratio" in option and told)
        return 0.05 - compiled.data("qpos")[2]

    assert depth(f'impratio="{ratio}"') == pytest.approx(depth("") / ratio, rel=0.1)
    assert depth(f'impratio="{ratio}" cone="elliptic"') == pytest.approx(depth(""), rel=0.1)


@pytest.mark.parametrize(("priority", "told"), [(1, [("condim", "1", "3")]), (0, [])])
def test_friction_that_condim_switches_off_is_told_by_the_condim(priority, told):
    more = f' friction="0.5" condim="1" priority="{priority}"'
    text = f"<mujoco><worldbody>{FLOOR}{BOX.format(z=0.05, more=more)}</worldbody></mujoco>"
    assert [(each.attribute, each.now, each.value) for each in hints(text, "attribute-without-effect")] == told


@pytest.mark.parametrize(
    ("geom", "joint", "told"),
    [
        ('class="deco" friction="0.4"', "<freejoint/>", True),
        ('class="deco"', "<freejoint/>", False),
        ('contype="0" conaffinity="0" friction="0.4"', "<freejoint/>", False),
        ('class="deco" friction="0.4"', "<joint/>", False),
        ('friction="0.4"', "<freejoint/>", False),
    ],
    ids=["friction of its own", "no friction", "masks of its own", "not free", "collides"],
)
def test_friction_of_a_free_body_whose_class_touches_nothing_is_told(geom: str, joint: str, told: bool) -> None:
    deco = '<default><default class="deco"><geom contype="0" conaffinity="0"/></default></default>'
    body = f'<body pos="0 0 1">{joint}<geom {geom} size="0.1"/></body>'
    text = f"<mujoco>{deco}<worldbody>{FLOOR}{body}</worldbody></mujoco>"
    found = hints(text, "attribute-without-effect")
    assert [(each.attribute, each.value) for each in found] == [("contype", "1")] * told


RUNG = """<mujoco><worldbody><geom name="floor" type="plane" size="1 1 .1"/>
  <body pos="0 0 .2"><freejoint/><geom name="box" type="box" size=".1 .1 .1" {geom}/></body>
  <body pos="1 0 1"><joint name="arm" axis="0 1 0" range="-20 20" {joint}/><geom size=".05" pos=".3 0 0"/></body>
</worldbody><tendon><fixed name="rope" range="0 1" {tendon}><joint joint="arm" coef="1"/></fixed></tendon></mujoco>"""


@pytest.mark.parametrize(
    ("where", "written", "told"),
    [
        ("geom", 'solref="1 0.01"', "0.01 1"),
        ("joint", 'solreflimit="0.9 0.02"', "0.02 0.9"),
        ("tendon", 'solreflimit="1 0.01"', "0.01 1"),
        ("geom", 'solref="0.01 1"', None),
        ("geom", 'solref="0.02 0.05"', None),
        ("geom", 'solref="1 1"', None),
        ("geom", 'solref="1 0"', None),
        ("geom", 'solref="-1000 -1"', None),
    ],
)
def test_a_time_constant_exchanged_with_its_damping_ratio_is_told(where, written, told):
    text = RUNG.format(**{"geom": "", "joint": "", "tendon": ""} | {where: written})
    assert [each.value for each in hints(text, "solref-exchanged")] == ([told] if told else [])


BALL = """<mujoco><worldbody><geom name="cloth" type="plane" size="2 2 .1" {cloth}/>
  <body name="ball" pos="0 0 .03"><freejoint/><geom name="ball" size=".03" mass=".2" {ball}/></body>
</worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("ball", "cloth", "told"),
    [
        pytest.param('friction=".2 .005 .0003"', "", True, id="condim 3"),
        pytest.param('friction=".2 .005 .0003"', 'condim="6"', False, id="the cloth has 6"),
        pytest.param('friction=".2 .005 .0003"', 'condim="4"', False, id="the cloth has 4"),
        pytest.param('friction="1 .1 .1"', "", False, id="what people write for all"),
        pytest.param('friction=".2 .005 .0001"', "", False, id="the default"),
    ],
)
def test_a_ball_whose_rolling_friction_nothing_reads_is_told(ball, cloth, told):
    found = hints(BALL.format(ball=ball, cloth=cloth), "rolls-for-ever")
    assert ["nothing reads" in each.says for each in found if each.value == "6"] == [True] * told


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ('condim="6" friction="0.8 0.0001 0.005"', "0.8 0.005 0.0001"),
        ('condim="6" friction="0.8 0.005 0.008"', None),
        ('condim="6" friction="0.8 0.01 0.01"', None),
        ('condim="4" friction="0.8 0.0001 0.005"', None),
    ],
)
def test_a_rolling_friction_in_the_place_of_the_torsional_one_is_told(written, told):
    found = hints(BALL.format(ball=written, cloth=""), "friction-beyond-any-material")
    assert [each.value for each in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("ball", "cloth", "told"),
    [
        pytest.param('condim="4"', 'friction="0.8 0.8 0.5"', ["cloth"], id="of the floor"),
        pytest.param('condim="4" friction="1 0.4 0.0001"', "", ["ball"], id="its own"),
        pytest.param('condim="4" friction="1 0.2 0.0001"', "", [], id="of three times its size"),
        pytest.param('condim="4" priority="1"', 'friction="0.8 0.8 0.5"', [], id="the ball decides"),
        pytest.param('friction="1 0.4 0.0001"', "", [], id="not read"),
    ],
)
def test_a_foot_that_cannot_pivot_is_told(ball, cloth, told):
    found = hints(BALL.format(ball=ball, cloth=cloth), "friction-beyond-any-material")
    assert [one for each in found for one in each.elements] == [f'geom "{name}"' for name in told]


PADS = """<mujoco><worldbody><body name="hand" pos="0 0 1">
  <body name="left"><joint type="slide" axis="0 1 0"/><geom name="{name}" type="box" size=".01 .01 .02" {pad}/></body>
</body></worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("name", "pad", "told"),
    [
        ("l_pad", 'friction="0.012 0.02 0.0005" priority="1"', True),
        ("l_pad", 'friction="0.012"', False),
        ("l_pad", 'friction="0.4" priority="1"', False),
        ("l_pad", 'friction="0.012" priority="1" condim="1"', False),
        ("ski", 'friction="0.012" priority="1"', False),
    ],
)
def test_a_pad_that_has_the_last_word_and_no_friction_is_told(name, pad, told):
    found = hints(PADS.format(name=name, pad=pad), "friction-too-low")
    assert [each.elements for each in found] == [('geom "l_pad"',)] * told


FEET = """<mujoco><worldbody><geom name="floor" type="plane" size="1 1 .1"/><body pos="0 0 .1"><freejoint/>
  <geom name="left_foot" size=".05" pos="0 .1 0"/><geom name="right_foot" size=".05" pos="0 -.1 0"/></body></worldbody>
<contact><pair name="left_foot_floor" geom1="left_foot" geom2="floor"/>{pairs}</contact></mujoco>"""


SECOND = '<pair name="{0}" geom1="{1}" geom2="{2}"/>'


@pytest.mark.parametrize(
    ("pairs", "told"),
    [
        ([("right_foot_floor", "left_foot", "floor")], [("geom1", "right_foot")]),
        ([("right_foot_floor", "floor", "left_foot")], [("geom2", "right_foot")]),
        ([("right_foot_floor", "right_foot", "floor")], []),
        ([("again", "left_foot", "floor")], []),
        ([("right_foot_floor", "left_foot", "floor"), ("right", "right_foot", "floor")], []),
    ],
    ids=["copied", "the other way round", "adapted", "called otherwise", "both there"],
)
def test_a_pair_that_is_called_after_a_geom_without_one_is_told(pairs, told):
    text = FEET.format(pairs="".join(SECOND.format(*each) for each in pairs))
    assert [(each.attribute, each.value) for each in hints(text, "pair-of-another-geom")] == told


@pytest.mark.parametrize(("name", "told"), [("caster", 0), ("heel", 1)])
def test_a_caster_that_slides_by_its_priority_is_meant_to(name: str, told: int):
    slick = '<geom name="{}{}" size="0.02" pos="{} -0.03" friction="0.02" priority="1"/>'
    feet = "".join(slick.format(name, i, at) for i, at in enumerate(("0.1 0", "-0.1 0.08", "-0.1 -0.08")))
    sled = f'<body pos="0 0 0.05"><freejoint/><geom type="box" size="0.1 0.1 0.02"/>{feet}'
    text = f"<mujoco><worldbody>{FLOOR}{sled}</body></worldbody></mujoco>"
    assert len(findings(text, "friction-too-low")) == told
