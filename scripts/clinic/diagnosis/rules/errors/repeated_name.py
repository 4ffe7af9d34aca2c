"""Two elements of a kind have the same name.

Names are unique among all bodies, all geoms, all joints, also of included files. A part that is included or copied
twice brings its names twice.

Bad:

    <mujoco>
      <worldbody>
        <geom name="box" type="box" size="0.1 0.1 0.1"/>
        <geom name="box" type="box" size="0.1 0.1 0.1" pos="1 0 0"/>
      </worldbody>
    </mujoco>

Good:

    -     <geom name="box" type="box" size="0.1 0.1 0.1" pos="1 0 0"/>
    +     <geom name="box_2" type="box" size="0.1 0.1 0.1" pos="1 0 0"/>

The number: none; the text compiles with the edit.

When it is wrong: what refers to the name now means the first of both. An asset, or a line pasted twice, that is the
same as one before is taken out. Where something refers to a name that nothing has, that is the one that was meant. A
body whose joints are called as the first one's but for a word gets that word, not a number: `left_foot` with
`left_ankle` and with `right_ankle` in it.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from difflib import SequenceMatcher

from clinic.diagnosis.edit import Edit, delete, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import mends, sentence
from clinic.diagnosis.source import Element, Source, stem
from clinic.diagnosis.suspect import Suspect

TITLE = "A name that is used twice"
FAMILIES = ("will-not-compile",)

MESSAGE = re.compile(r".*repeated (?:default )?(?:name|class name)(?: '([^']+)')?(?: in (\w+))?")
WORD = re.compile(r"([A-Za-z]+|\d+)")
ASSETS = ("material", "texture", "mesh", "hfield")
KINDS = {"joint": ("joint", "freejoint"), "key": ("key",)}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Every second use of a name, with a number behind it."""
    found = MESSAGE.match(sentence(model))
    if not found or model.source is None:
        return
    classes = "class name" in found[0]
    attribute, kind = ("class", "default") if classes else ("name", found.group(2) or "")
    every = list(model.source.elements(*KINDS.get(kind, (kind,)))) if kind else []
    of_file = kind in ASSETS[1:]
    names = {id(each): each.get(attribute) or (stem(each.get("file")) if of_file else "") for each in every}
    if not classes and found.group(1) not in names.values():
        every = [each for each in model.source.root.walk() if each.get("name") == found.group(1)]
        names = {id(each): each.get("name") for each in every}
    if again := _again(every, names) or _copies(every, kind):
        name = names[id(again[0])]
        says = f"The same stands there before, with all that is in it: {name!r} is taken out where it comes again."
        yield mends(again[0], tuple(map(delete, again)), says, attribute=attribute, now=name, value="removed")
        return
    if missing := _missing(model.source, kind, {*names.values()}):
        several = Counter(names.values())
        twice = [each for each in every if names[id(each)] and several[names[id(each)]] > 1]
        element = max(twice[::-1], key=lambda each: _like(each, missing))
        name = names[id(element)]
        says = f"{several[name]} elements are called {name!r}, and none {missing!r}, which is referred to."
        edits = [set_attribute(element, attribute, missing)]
        yield mends(element, edits, says, attribute=attribute, now=name, value=missing)
    used, edits, first = Counter[str](["world"] if kind == "body" else []), list[Edit](), None
    for element in every:
        name = names[id(element)]
        if name and used[name]:
            number = next(n for n in range(used[name] + 1, 10_000) if f"{name}_{n}" not in names.values())
            before = next(each for each in every if names[id(each)] == name)
            like = (other for other in _like_its_parts(name, before, element) if other not in names.values())
            edits.append(set_attribute(element, attribute, next(like, f"{name}_{number}")))
            first = first or element
        used[name] += 1
    if first:
        name = names[id(first)]
        says = f"{used[name]} elements are called {name!r}."
        says = "The world is a body, and called 'world'." if (kind, name) == ("body", "world") else says
        yield mends(first, edits, says, attribute=attribute, now=name, value=edits[0].value)


def _missing(source: Source, kind: str, names: set[str]) -> str:
    """The one name that is referred to and that no element of the kind has; empty where there is none, or several."""
    said = {
        value
        for each in source.root.walk()
        for attribute, value in each.attributes.items()
        if each.tag not in ("body", "default")
        and (
            attribute.rstrip("12") == kind
            or (attribute == "objname" and each.get("objtype") == kind)
            or (attribute == "refname" and each.get("reftype") == kind)
        )
    }
    left = {value for value in said - names if value and "/" not in value and value != "world"}
    return left.pop() if kind and len(left) == 1 else ""


def _like(element: Element, name: str) -> float:
    """How like a name those of the elements around are: `rf` beside body "rfinger"."""
    around = [each.get("name") for each in element.around() if each.get("name")][:1]
    around += [each.get("name") for each in element.children if each.get("name")]
    return max((SequenceMatcher(None, name, each).ratio() for each in around), default=0.0)


def _like_its_parts(name: str, before: Element, again: Element) -> Iterator[str]:
    """The name with the one word changed by which names in and around the second differ from those of the first."""
    parts = [[each.parent, *each.children] for each in (before, again)]
    for one, other in zip(*parts, strict=False):
        if one is None or other is None or one.tag != other.tag:
            continue
        words = [WORD.split(each.get("name")) for each in (one, other)]
        apart = [pair for pair in zip(*words, strict=False) if pair[0] != pair[1]]
        if len(words[0]) == len(words[1]) and len(apart) == 1 and apart[0][0] in WORD.split(name):
            yield "".join(apart[0][1] if word == apart[0][0] else word for word in WORD.split(name))


def _again(elements: list[Element], names: dict[int, str]) -> list[Element]:
    """The first element that is the next one to the same, attribute by attribute, as a line that was pasted twice."""
    for each in elements:
        around = each.parent.children if each.parent is not None else []
        at = next((place for place, one in enumerate(around) if one is each), 0)
        if at and names[id(each)] and _alike(around[at - 1], each):
            return [each]
    return []


def _copies(elements: list[Element], kind: str) -> list[Element]:
    """Every asset that is the same as one before it, as where a file is included twice."""
    return [
        each for i, each in enumerate(elements) if kind in ASSETS and any(_alike(one, each) for one in elements[:i])
    ]


def _alike(one: Element, other: Element) -> bool:
    same = (one.tag, one.attributes, len(one.children)) == (other.tag, other.attributes, len(other.children))
    return same and all(map(_alike, one.children, other.children))
