"""Default classes that nothing uses, and classes that were lost."""

from __future__ import annotations

import pytest
from diagnosed import hints

CLASSES = (
    '<mujoco><default><default class="panel"><geom contype="2" conaffinity="2"/></default>'
    '<default class="bolt"><geom contype="4" conaffinity="2"/></default></default><worldbody>{}</worldbody></mujoco>'
)


@pytest.mark.parametrize(
    ("geoms", "told"),
    [
        ('<geom name="bolt" class="panel" size="0.1"/>', ("panel", "bolt")),
        ('<geom name="bolt" size="0.1"/>', ("left out", "bolt")),
        ('<geom name="bolt" class="bolt" size="0.1"/>', None),
        ('<geom name="bolt" class="panel" size="0.1"/><geom class="bolt" size="0.1"/>', None),
        ('<geom name="lid" class="panel" size="0.1"/>', None),
        ('<geom size="0.1" class="panel"/><site name="bolt"/>', None),
    ],
    ids=["another class", "no class", "its class", "a class in use", "another name", "nothing for sites"],
)
def test_what_is_called_as_a_class_that_nothing_uses_is_told(geoms: str, told: tuple[str, str] | None) -> None:
    found = hints(CLASSES.format(geoms), "class-not-reached")
    assert [(each.now, each.value) for each in found] == ([told] if told else [])


@pytest.mark.parametrize(
    ("ends", "told"),
    [("ram ram ram", [("class", "ram")]), ("ram ram pin", []), ("1 2 3", [("type", "slide")])],
    ids=["of-its-name", "of-another-name", "left-out"],
)
def test_the_one_hinge_among_slides_of_its_name_gets_their_class(ends: str, told: list[tuple[str, str]]) -> None:
    joints = [f"{part}_{end}" for part, end in zip(("boom", "stick", "bucket"), ends.split(), strict=True)]
    kinds = ["pin" if "ram" in ends else "free", "ram", "ram"]
    bodies = "".join(
        f'<body pos="{i} 0 0"><joint name="{name}" class="{kind}" range="-0.04 0.05"/><geom size="0.1"/></body>'
        for i, (name, kind) in enumerate(zip(joints, kinds, strict=True))
    ).replace(' class="free"', "")
    classes = (
        '<default class="pin"><joint type="hinge" axis="0 1 0"/></default><default class="ram"><joint type="slide"/>'
    )
    driven = "".join(f'<position joint="{name}" kp="10" kv="1"/>' for name in joints)
    text = (
        f'<mujoco><compiler angle="radian"/><default>{classes}</default></default><worldbody>{bodies}</worldbody>'
        f"<actuator>{driven}</actuator></mujoco>"
    )
    assert [(each.attribute, each.value) for each in hints(text, "hinge-for-slide", "range-in-the-wrong-unit")] == told


@pytest.mark.parametrize(("outer", "told"), [("", "arm"), ('childclass="arm"', None)], ids=["lost", "there"])
def test_the_class_that_all_used_ones_stand_in_is_the_one_that_was_lost(outer: str, told: str | None) -> None:
    inner = '<default class="small"><joint damping="0.4"/></default><default class="big"><geom size=".02"/></default>'
    classes = f'<default><default class="arm"><joint damping="1.5" armature="0.1"/>{inner}</default></default>'
    links = ("", ""), ('childclass="small"', ""), ("", "")
    chain = ""
    for number, (child, _) in enumerate(links[::-1]):
        name = f"j{len(links) - number}"
        chain = f'<body pos="0 0 .2" {child}><joint name="{name}" axis="0 1 0"/><geom size=".02"/>{chain}</body>'
    servos = "".join(f'<position joint="j{number}" kp="9"/>' for number in (1, 2, 3))
    world = f"<worldbody><body {outer}><geom size='.02'/>{chain}</body></worldbody>"
    text = f"<mujoco>{classes}{world}<actuator>{servos}</actuator></mujoco>"
    found = hints(text, "class-not-reached")
    assert [each.value for each in found if each.attribute == "class"] == ([told] if told else [])


@pytest.mark.parametrize(
    ("classes", "told"),
    [
        pytest.param(("big", "big", ""), ("left out", "big"), id="none"),
        pytest.param(("big", "big", "small"), ("small", "big"), id="another"),
        pytest.param(("big", "big", "big"), None, id="its-own"),
        pytest.param(("big", "small", ""), None, id="two-of-them"),
        pytest.param(("big", "big", '" kp="50" kv="5'), None, id="which-writes-the-same"),
    ],
)
def test_the_one_actuator_of_another_class_than_its_joint_is_told(classes, told):
    joints = "".join(f'<body pos="{i} 0 1"><joint name="j{i}" class="big"/><geom size="0.1"/></body>' for i in range(3))
    servos = "".join(f'<position name="a{i}" class="{name}" joint="j{i}"/>' for i, name in enumerate(classes)).replace(
        'class="" ', ""
    )
    made = "".join(
        f'<default class="{name}"><joint axis="0 1 0" damping="{kv}"/><position kp="{kp}" kv="{kv}"/></default>'
        for name, kp, kv in (("big", 50, 5), ("small", 5, 1))
    )
    text = f"<mujoco><default>{made}</default><worldbody>{joints}</worldbody><actuator>{servos}</actuator></mujoco>"
    found = hints(text, "class-not-reached")
    assert [(each.now, each.value) for each in found] == ([told] if told else [])
