"""A driven joint takes nothing of the default class that is made for it.

A class applies where it is named: as `class` of the joint, or as `childclass` of a body around it. Where neither is
written, the joint has no damping and no armature, and nothing says so.

Bad:

    <mujoco>
      <default>
        <default class="arm">
          <joint damping="1" armature="0.1"/>
        </default>
      </default>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint name="shoulder" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.5"/>
        </body>
      </worldbody>
      <actuator>
        <position joint="shoulder" kp="50" kv="5"/>
      </actuator>
    </mujoco>

Good:

    -     <body name="upper" pos="0 0 1">
    +     <body name="upper" pos="0 0 1" childclass="arm">

The number: how many driven joints have no class and none of damping, armature and frictionloss, where a class gives
joints some of it, which no joint uses, or more than there are such driven joints.

When it is wrong: a class that is meant for other joints, which are the only ones with damping.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element, Source
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A default class that does not reach a joint"
FAMILIES = ("oscillates", "explodes", "drifts")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "which class a joint was meant to have, only its maker knows"

FIELDS = ("damping", "armature", "frictionloss")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The driven joints that no class reaches, all together."""
    of, source = model.simulation, model.source
    if source is None or source.urdf or not (classes := _classes(source)):
        return
    driven = sorted(of.drivers)
    bare = [joint for joint in driven if (e := model.element("joint", joint)) is not None and _unreached(source, e)]
    users = Counter(name for each in source.elements("joint") if (name := _class(each)) in classes)
    if not bare or (users and users.total() <= len(bare)):
        return
    name = users.most_common(1)[0][0] if users else classes[0]
    says = f"No class and no childclass gives it anything; class {name} has {_given(source, name)}."
    probe = counted("driven joints that no class reaches", len(bare))
    names = tuple(of.name("joint", joint) for joint in bare)
    yield Suspect(names, "class", "left out", name, (), probe, 0, says, "damping and armature of a class")


def _classes(source: Source) -> list[str]:
    """The classes but the main one that give joints damping, armature or dry friction."""
    return [
        each.get("class")
        for each in source.elements("default")
        if each.parent is not None and each.parent.tag == "default" and each.get("class") and _fields(each)
    ]


def _fields(default: Element) -> list[tuple[str, str]]:
    """What a class itself gives joints, but for zeros."""
    joints = [child for child in default.children if child.tag == "joint"]
    found = [(name, joint.get(name)) for joint in joints for name in FIELDS]
    return [(name, value) for name, value in found if value.strip("0. ")]


def _given(source: Source, name: str) -> str:
    """What a class gives joints, in words."""
    found = next(each for each in source.elements("default") if each.get("class") == name)
    return ", ".join(f"{attribute} {value}" for attribute, value in _fields(found))


def _class(joint: Element) -> str:
    """The class that is named for a joint, or around it; empty where none is."""
    return joint.get("class") or next((name for outer in joint.around() if (name := outer.get("childclass"))), "")


def _unreached(source: Source, joint: Element) -> bool:
    """Whether nothing gives a joint any of the fields, and no class is named for it."""
    return joint.tag == "joint" and not _class(joint) and all(source.written(joint, name) is None for name in FIELDS)
