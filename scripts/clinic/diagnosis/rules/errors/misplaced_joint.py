"""A joint where none can be, or more than a body can have.

A free joint belongs to a body directly below the world, alone. The world has no joints. A plane does not move. A body
has at most six degrees of freedom, and a ball joint is not followed by a hinge.

Bad:

    <mujoco>
      <worldbody>
        <body name="base">
          <geom name="foot" type="box" size="0.05 0.05 0.05"/>
          <body name="robot" pos="0 0 1">
            <freejoint name="root"/>
            <geom name="trunk" type="box" size="0.05 0.05 0.05"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <geom name="foot" type="box" size="0.05 0.05 0.05"/>
        <body name="robot" pos="0 0 1">
          <freejoint name="root"/>
          <geom name="trunk" type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

The number: none; the text compiles with the edit, which puts the joint into the body that it stands before, where that
has none, a free one into the body below the world where that is a bare frame, or part of one mechanism with the body,
and takes it out elsewhere. Where keyframes have the place of a free body, the body itself is put into the world.

When it is wrong: where the body is meant to move alone: move it below the world instead.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from clinic.diagnosis.edit import delete, insert, remove_attribute, set_attribute
from clinic.diagnosis.edit import replace as written_anew
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence, told
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "A joint where none can be"
FAMILIES = ("will-not-compile",)

SAID = ("free joint can only", "World body cannot have joints", "more than 6 dofs", "ball followed by")

SAYS = {
    "free": "Only a child of the world can be free; the joint is taken out, and the body is fixed to its parent.",
    "World": "The world does not move: the joint belongs into a <body>.",
    "more": "A body has six degrees of freedom at most, of which a free joint has all.",
    "ball": "A ball turns about every axis already.",
}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joint that is too much, taken out; a plane in a moving body, made a box."""
    said = sentence(model)
    if model.urdf and said.startswith("free joint can only"):
        yield from _floating(model, said)
        return
    for element in meant(model):
        if any(said.startswith(each) for each in SAID):
            joints = [each for each in element.walk() if each.tag in ("joint", "freejoint") and _own(each, element)]
            if said.startswith("World"):
                yield from _moved(model, joints, said)
            for joint in (each for each in joints if each.get("type") == "free" and model.source):
                plain = replace(joint, attributes={k: v for k, v in joint.attributes.items() if k != "type"})
                if model.source and (kind := model.source.value(plain, "type")):
                    says = f"{said}. Its class has {kind}."
                    taken = (remove_attribute(joint, "type"),)
                    yield mends(joint, taken, says, attribute="type", now="free", value=kind)
            yield from (each for joint in joints if _free(joint) for each in _raised(model, joint, said))
            yield from (each for joint in joints if _free(joint) for each in _to_the_world(model, joint, said))
            for joint in [each for each in joints if _free(each)] + joints[::-1]:
                yield mends(joint, (delete(joint),), f"{said}. {SAYS[said.split()[0]]}", value="removed")
        elif said.startswith("plane only allowed"):
            planes = [each for each in element.walk() if each.get("type") == "plane"]
            for plane in planes[:1]:
                edits = (set_attribute(plane, "type", "box"),)
                says = f"{said}: it has no end, and so no inertia; a box has."
                yield mends(plane, edits, says, attribute="type", now="plane", value="box")


def _moved(model: ReaderModel, joints: list[Element], said: str) -> Iterator[Suspect]:
    """A joint that stands right before a body without one, put into that body, where a line slipped."""
    for joint in joints:
        around = joint.parent.children if joint.parent is not None else []
        body = next(iter(around[[*map(id, around)].index(id(joint)) + 1 :]), None) if around else None
        if body is None or body.tag != "body" or body.empty or body.first("joint") or body.first("freejoint"):
            continue
        first = next(iter(body.children), None)
        if first is None or joint.end > body.start:
            continue
        text = model.texts[joint.file].encode()
        own, its = (text[each.start : each.end].decode() for each in (joint, first))
        margin = text[text.rfind(b"\n", 0, first.start) + 1 : first.start].decode()
        edits = (delete(joint), written_anew(first, f"{own}\n{margin if not margin.strip() else ''}{its}"))
        says = f"{said}. It stands right before {told(body)}, which has none: it is put in there."
        yield mends(joint, edits, says, value=f"moved into {told(body)}")


def _raised(model: ReaderModel, joint: Element, said: str) -> Iterator[Suspect]:
    """A free joint put into the body below the world that carries its own: a bare frame, or one with other joints."""
    bodies = [each for each in joint.around() if each.tag == "body"]
    if len(bodies) < 2 or any(each.tag in ("joint", "freejoint") for each in bodies[-1].children):
        return
    bare = not any(each.tag in ("geom", "inertial") for body in bodies[1:] for each in body.children)
    others = [each for each in bodies[-1].walk() if each.tag == "joint" and not _free(each)]
    if (bare and len([each for each in bodies[-1].children if each.tag == "body"]) == 1) or any(
        bodies[0] not in each.around() for each in others
    ):
        says = f"{said}. Only a child of the world can be free: the joint is put into {told(bodies[-1])}."
        edits = (delete(joint), insert(bodies[-1], model.text_of(joint)))
        yield mends(joint, edits, says, value=f"moved into {told(bodies[-1])}")


def _to_the_world(model: ReaderModel, joint: Element, said: str) -> Iterator[Suspect]:
    """A body with a free joint put into the world, where it is, if the keyframes have the place of a free body."""
    bodies = [each for each in joint.around() if each.tag == "body"]
    still = model.with_edits((delete(joint),))
    if len(bodies) < 2 or not isinstance(still, CompileError) or "keyframe" not in str(still) or not model.source:
        return
    keys = [delete(each) for each in model.source.section("keyframe")]
    there, name = model.with_edits((delete(joint), *keys)), bodies[1].get("name")
    if isinstance(there, CompileError) or not name or name not in there.names("body"):
        return
    there.as_written()
    around = there.names("body").index(name)
    place, turn = written(there.data_row("xpos", around, 3)), written(there.data_row("xquat", around, 4))
    given = next((each.get("childclass") for each in bodies[1:] if each.get("childclass")), "")
    frame = f'pos="{place}" ' * (place != "0 0 0") + f'quat="{turn}" ' * (turn != "1 0 0 0")
    frame += f'childclass="{given}"' * bool(given)
    text = model.text_of(bodies[0])
    xml = f"<frame {frame.strip()}>{text}</frame>" if frame else text
    edits = (delete(bodies[0]), insert(next(model.source.elements("worldbody")), xml))
    if not isinstance(model.with_edits(edits), CompileError):
        says = f"{said}. Only a child of the world can be free, and the keyframes have its place: it is put there."
        yield mends(joint, edits, says, value=f"{told(bodies[0])} moved into the world")


def _floating(model: ReaderModel, said: str) -> Iterator[Suspect]:
    """A floating joint of a URDF: its parent, where that is an empty root, made the world, or else the joint fixed."""
    assert model.source is not None
    joints = list(model.source.elements("joint"))
    children = {each.get("link") for each in model.source.elements("child")}
    links = {each.get("name"): each for each in model.source.elements("link")}
    for joint in [each for each in joints if each.get("type") == "floating"]:
        parent = joint.first("parent")
        name = parent.get("link") if parent is not None else ""
        root = links.get(name)
        bare = root is not None and not (root.first("inertial") or root.first("collision"))
        if root is not None and bare and name not in children and "world" not in links:
            ends = [each for each in model.source.elements("parent") if each.get("link") == name]
            edits = [set_attribute(root, "name", "world"), *(set_attribute(each, "link", "world") for each in ends)]
            says = (
                f"{said}: a link called world is MuJoCo's world, and what floats in it is free; {name!r} has no mass."
            )
            yield mends(root, edits, says, attribute="name", now=name, value="world")
        edits = [set_attribute(joint, "type", "fixed")]
        says = f"{said}: {told(joint)} floats in {name!r}, which is not the world; it is fixed."
        yield mends(joint, edits, says, attribute="type", now="floating", value="fixed")


def _own(joint: Element, element: Element) -> bool:
    return joint is element or joint.parent is element or (joint.parent is not None and joint.parent.tag == "frame")


def _free(joint: Element) -> bool:
    return joint.tag == "freejoint" or joint.get("type") == "free"
