"""Something is given twice that can be there once.

A body or link has one `<inertial>`, a visual or collision one `<geometry>`, a fixed tendon each joint once, a spatial
one no site twice in a row, and a link one joint that leads to it. A file is included once. Merging two files or
exporting twice makes such models.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0"/>
          <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
          <inertial pos="0 0 0" mass="2" diaginertia="0.02 0.02 0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 0 0" mass="2" diaginertia="0.02 0.02 0.02"/>

The number: none; the text compiles with the edit, which keeps the first. A tendon or an equality that has one of a pair
twice, left and right, is given the other, where no line of its kind has that. Of two joints of a URDF that lead to one
link, the one whose parent no joint leads to has parent and child exchanged; else the one that is called like a link to
which none leads, leads there.

When it is wrong: the second may be the right one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete, remove_attribute, set_attribute
from clinic.diagnosis.probes.sides import right_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence, told
from clinic.diagnosis.source import Element, Source
from clinic.diagnosis.suspect import Suspect

TITLE = "Something given twice"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "what is given twice in a text was written by hand or by an exporter, and healthy models have none"

TWICE = re.compile(r"repeated element: '(\w+)'|unique element '(\w+)' found")
REPEATED = re.compile(r"(site|joint|geom) (\d+) is repeated|element '([^']*)' is repeated in equality")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The second one, taken out."""
    said, source = sentence(model), model.source
    if source is None:
        return
    if found := TWICE.search(said):
        yield from _children(model, found[1] or found[2])
    elif found := REPEATED.search(said):
        for element in meant(model):
            yield from _path(source, element, said) if found[1] else _ends(source, element, found[3], said)
    elif "multiple parents" in said:
        yield from _parents(list(source.elements("joint")))
    elif found := re.search(r"File '([^']*)' already included", said):
        again = _includes(model, found[1])
        for element in again[1:]:
            says = f"{said.rstrip('.')}: what it holds is there once already."
            yield mends(element, (delete(element),), says, attribute="file", now=found[1], value="removed")
    elif "repeated URDF name" in said:
        yield from _named(model)


def _children(model: ReaderModel, tag: str) -> Iterator[Suspect]:
    """What has two children of a kind, where the message is about one of them or about their parent."""
    for element in meant(model):
        for owner in (element, element.parent):
            alike = [each for each in owner.children if each.tag == tag] if owner else []
            for again in alike[1:]:
                assert owner is not None
                name = f" {owner.get('name')!r}" if owner.get("name") else ""
                says = f"{owner.tag}{name} has {len(alike)} <{tag}>; MuJoCo takes one, and the first is kept."
                yield mends(again, [delete(each) for each in alike[1:]], says, value="removed")
                return


def _path(source: Source, tendon: Element, said: str) -> Iterator[Suspect]:
    """The elements of a tendon's path that stand there before."""
    seen = set[tuple[str, str]]()
    for each in tendon.children:
        tag, name = each.tag, each.get(each.tag)
        if (tag, name) in seen:
            says, twin = f"{said}. {told(tendon)} goes through {name!r} already", _twin(source, "tendon", tag, name)
            yield (
                _given(each, tag, name, twin, says)
                if twin
                else mends(each, (delete(each),), f"{says}.", value="removed")
            )
        seen.add((tag, name))


def _ends(source: Source, element: Element, name: str, said: str) -> Iterator[Suspect]:
    """The second of two equal ends of an equality."""
    same = [key for key, value in element.attributes.items() if value == name and key != "name"]
    for attribute in same[1:]:
        says = f"{said}. Something cannot be held to itself"
        if twin := _twin(source, "equality", attribute.rstrip("2"), name):
            yield _given(element, attribute, name, twin, says)
            continue
        says += f"; without {attribute} it is held to the world or to a constant."
        yield mends(
            element, (remove_attribute(element, attribute),), says, attribute=attribute, now=name, value="left out"
        )


def _given(element: Element, attribute: str, name: str, twin: str, says: str) -> Suspect:
    """The suspect that names the twin in the place of what is there twice."""
    edits = (set_attribute(element, attribute, twin),)
    return mends(element, edits, f"{says}, and none has {twin!r}.", attribute=attribute, now=name, value=twin)


def _twin(source: Source, section: str, kind: str, name: str) -> str:
    """The other one of a pair, left and right, where no line of a section has it; empty where there is none."""
    taken = {value for line in source.section(section) for each in line.walk() for value in each.attributes.values()}
    every = source.bodies() if kind == "body" else source.of_bodies(kind)
    free = (other for each in every if (other := each.get("name")) and other not in taken)
    return next((each for each in free if each in right_of(name) or name in right_of(each)), "")


def _parents(joints: list[Element]) -> Iterator[Suspect]:
    """The second joint that leads to a link of a URDF: to a link without one, or back to its parent, or taken out."""
    first = dict[str, Element]()
    for joint in joints:
        name = _link(joint, "child")
        if name in first:
            says = (
                f"Link {name!r} is a child of joint {first[name].get('name')!r} already, and a tree has one way to it."
            )
            yield from _led_elsewhere(joints, [joint, first[name]], says)
            yield mends(joint, (delete(joint),), says, attribute="child", now=name, value="removed")
            return
        if name:
            first[name] = joint


def _led_elsewhere(joints: list[Element], both: list[Element], says: str) -> Iterator[Suspect]:
    """One of two joints with its parent and child exchanged, or led to the link without one that is called like it."""
    children = {_link(each, "child") for each in joints}
    for joint, other in (both, both[::-1]):
        parent, child = joint.first("parent"), joint.first("child")
        name = _link(joint, "child")
        if parent is None or child is None or (up := parent.get("link")) in children or up == _link(other, "parent"):
            continue
        told = f"{says} None leads to its parent {up!r}: the two were exchanged."
        edits = (set_attribute(parent, "link", name), set_attribute(child, "link", up))
        yield mends(joint, edits, told, attribute="child", now=name, value=up)
    free = [name for each in joints if (name := _link(each, "parent")) not in children]
    free += [name for each in joints[:1] for name in _links(each) if name not in {*children, *free}]
    for _, joint, name in sorted(
        ((_alike(joint, name, other), joint, name) for joint, other in (both, both[::-1]) for name in free),
        key=lambda each: -each[0],
    ):
        child = joint.first("child")
        if child is not None and name != _link(joint, "parent"):
            told = f"{says} No joint leads to link {name!r}."
            yield mends(
                joint, (set_attribute(child, "link", name),), told, attribute="child", now=child.get("link"), value=name
            )


def _link(joint: Element, end: str) -> str:
    """The link at an end of a joint."""
    found = joint.first(end)
    return found.get("link") if found is not None else ""


def _links(joint: Element) -> list[str]:
    """The names of all links beside a joint."""
    around = joint.parent.children if joint.parent is not None else []
    return [each.get("name") for each in around if each.tag == "link"]


def _alike(joint: Element, link: str, other: Element) -> int:
    """How many more words of a link's name are in those of a joint and its parent than in those of another joint."""
    words = [
        set(re.split(r"[^a-z0-9]+", f"{each.get('name')} {_link(each, 'parent')}".lower())) for each in (joint, other)
    ]
    own = set(re.split(r"[^a-z0-9]+", link.lower()))
    return len(own & words[0]) - len(own & words[1])


def _includes(model: ReaderModel, file: str) -> list[Element]:
    """The places where a file is included."""
    assert model.source is not None
    here = [each for each in model.source.root.walk() if each.tag == "include" and each.get("file") == file]
    first = model.source.included.get(file)
    return ([first] if first else []) + [each for each in here if each is not first]


def _named(model: ReaderModel) -> Iterator[Suspect]:
    """A link or joint of a URDF whose name is used before: an equal one goes, another gets a number."""
    assert model.source is not None
    for kind in ("link", "joint"):
        seen = dict[str, Element]()
        for each in model.source.root.children:
            name = each.get("name")
            if each.tag == kind and name in seen:
                says = f"A {kind} before it is called {name!r}."
                yield mends(each, (delete(each),), says, attribute="name", now=name, value="removed")
                return
            if each.tag == kind:
                seen[name] = each
