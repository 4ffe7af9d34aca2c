"""A driven joint takes nothing of the default class that is made for it.

A class applies where it is named: as `class` of the joint, or as `childclass` of a body around it. Where neither is
written, the joint takes the outermost class alone, and MuJoCo says nothing.

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

The number: how many driven joints have no class and none of damping, armature and frictionloss, where a class has some
of these for joints, and either no joint uses it, or more joints do than lack it. A class that all used ones stand in
and nothing uses itself is the one that is told. And how many elements are called as a class that nothing uses and that
has something for their kind: a geom `bolt` of class `panel`, beside a class `bolt`. Of 1113 models one has such a geom,
a cube without the friction of class `cube`. And the one actuator that is not of its joint's class, where that gives
both of them something, and every other actuator of such a joint is of its joint's class.

When it is wrong: a class that is meant for other joints, which are the only ones with damping.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element, Source
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A default class that does not reach what it is for"
FAMILIES = ("oscillates", "explodes", "drifts")
UNPLANTED = "which class a joint was meant to have, only its maker knows"

KINDS = ("joint", "geom", "site", "camera", "light")
FIELDS = ("damping", "armature", "frictionloss")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What is called as a class that nothing uses, and the driven joints that no class reaches, all together."""
    of, source = model.simulation, model.source
    if source is not None and not source.urdf:
        yield from _namesakes(source)
        yield from _unlike_joint(model, source)
    if source is None or source.urdf or not (classes := _classes(source)):
        return
    driven = sorted(of.drivers)
    bare = [joint for joint in driven if (e := model.element("joint", joint)) is not None and _unreached(source, e)]
    users = Counter(name for each in source.elements("joint") if (name := _class(each)) in classes)
    if not bare or (users and users.total() <= len(bare)):
        return
    outer = _around(source, users)
    name = outer or (users.most_common(1)[0][0] if users else classes[0])
    says = f"No class and no childclass gives it anything; class {name} has {_given(source, name)}."
    says += " Classes within it are used, and it is by nothing." * bool(outer)
    probe = counted("driven joints that no class reaches", len(bare))
    names = tuple(of.name("joint", joint) for joint in bare)
    yield Suspect(names, "class", "left out", name, (), probe, 0, says, "damping and armature of a class")


def _around(source: Source, users: Iterable[str]) -> str:
    """The class that all used ones stand in, and that nothing uses itself; empty where there is none."""
    uses = {each.get(name) for each in source.root.walk() for name in ("class", "childclass") if each.tag != "default"}
    used = [each for each in source.elements("default") if each.get("class") in {*users}]
    within = [{outer.get("class") for outer in each.around()} for each in used]
    found = [name for name in _classes(source) if name not in uses and within and all(name in each for each in within)]
    return found[0] if len(found) == 1 else ""


def _namesakes(source: Source) -> Iterator[Suspect]:
    """The elements that are called as a class which no element uses, and which has something for their kind."""
    used = {each.get(name) for each in source.root.walk() for name in ("class", "childclass") if each.tag != "default"}
    leaves = [each for each in source.elements("default") if each.first("default") is None and each.parent]
    unused = {name: each for each in leaves if (name := each.get("class")) not in used}
    called = [each for each in source.of_bodies(*KINDS) if each.get("name") and each.get("name") in unused]
    found = [each for each in called if unused[each.get("name")].first(each.tag)]
    for each in found:
        name, now = each.get("name"), _class(each)
        says = f"Class {name} is used by nothing, and what is called so has {f'class {now}' if now else 'no class'}."
        probe = counted("elements that are called as a class that nothing uses", len(found))
        edits = (set_attribute(each, "class", name),)
        yield Suspect((f'{each.tag} "{name}"',), "class", now or "left out", name, edits, probe, 0, says, name, at=each)


def _unlike_joint(model: ReaderModel, source: Source) -> Iterator[Suspect]:
    """The one actuator of another class than its joint, or of none, where the joint's class is for both."""
    of, leaves = model.simulation, {each.get("class"): each for each in source.elements("default")}
    agree, odd = set[str](), list[tuple[int, Element, str]]()
    for actuator in range(of.count("actuator")):
        element, joint = model.element("actuator", actuator), of.driven_joint(actuator)
        driven = None if joint is None else model.element("joint", joint)
        name = _class(driven) if driven is not None else ""
        gives = leaves[name].first(element.tag) if element is not None and name in leaves else None
        if element is None or gives is None or not leaves[name].first("joint"):
            continue
        if element.get("class") == name:
            agree.add(name)
        elif any(source.value(element, key) != value for key, value in gives.attributes.items()):
            odd.append((actuator, element, name))
    if len(odd) != 1 or odd[0][2] not in agree:
        return
    actuator, element, name = odd[0]
    now = element.get("class") or "left out"
    says = f"Its joint is of class {name}, which has something for both, and all others are of their joints' classes."
    probe, edits = counted("actuators of another class than their joints", 1), (set_attribute(element, "class", name),)
    said = (of.name("actuator", actuator),)
    yield Suspect(said, "class", now, name, edits, probe, 0, says, "that of its joint", level="hint", at=element)


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
