"""Something refers to a name that no element has.

An actuator, sensor, equality, exclude, material or class names a joint, site, body, mesh or texture that is misspelt,
was renamed, or has a prefix since it was attached.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="1"/>
          <geom name="link" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
      <actuator>
        <motor name="motor" joint="elbo"/>
      </actuator>
    </mujoco>

Good:

    -     <motor name="motor" joint="elbo"/>
    +     <motor name="motor" joint="elbow"/>

The number: none; the text compiles with the edit. The nearest name that stands in the model is tried.

When it is wrong: where several names are equally near. A name of the other side, or with another number, is not taken
for it: what is called `left_knee` was left out where only `right_knee` is there.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete, remove_attribute, set_attribute
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, nearest, sentence
from clinic.diagnosis.rules.errors._remedy import advised
from clinic.diagnosis.source import Element, Source, stem
from clinic.diagnosis.suspect import Suspect

TITLE = "A reference to a name that does not exist"
FAMILIES = ("will-not-compile",)

NAME = re.compile(r"'([^']+)'")
SAID = re.compile(
    r"unknown|unrecognized name|unrecognized object|not found|could not find|does not exist|invalid name|missing"
)
OTHER = re.compile(
    r"attribute|(?<!unknown )element|keyword|'' not found|plugin|decoder|geometry specification|base site|target for"
)
SIDES = [{"left", "right"}, {"l", "r"}, {"front", "rear"}, {"front", "back"}, {"fl", "fr"}, {"rl", "rr"}]
SIDES += [{"fl", "rl"}, {"fr", "rr"}, {"lf", "rf"}, {"lh", "rh"}, {"upper", "lower"}]
CLASSES = ("class", "childclass")
OPTIONAL = {"class", "childclass", "material", "texture"}  # without them the element still is what it was


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The reference with the nearest name; a class or material also without it; an element without its target gone."""
    said = sentence(model)
    if model.source is not None and model.urdf and "parent or child missing" in said:
        yield from _links(model, model.source)
        return
    if not SAID.search(said) or model.source is None or OTHER.search(said):
        return
    names = NAME.findall(said)
    every = list(model.source.root.walk())
    known = [each.get("name") or each.get("class" if each.tag == "default" else "name") for each in every]
    known += [stem(each.get("file")) for each in every if each.tag in ("mesh", "texture", "hfield")]
    for element in meant(model) or [each for each in every if set(each.attributes.values()) & set(names)]:
        for attribute, now in element.attributes.items():
            wrong = now in names or (not names and attribute in (*OPTIONAL, "target"))
            if attribute == "name" or not wrong or (now in known and attribute in ("name", "file")):
                continue
            if attribute in CLASSES and now in (each.get("class") for each in every if each.tag == "default"):
                continue
            if (found := _nearest(model, element, attribute, now, known)) is not None:
                yield found
                if attribute in CLASSES and model.measured(found.probe, found.edits) > 0:
                    says = f"No <default> has the class {now!r}: the <include> that has it may be missing."
                    yield advised(element, says, attribute)
                return
        if names and set(element.attributes.values()) & set(names):
            if other := next((name for name in nearest(names[0], known) if _another(names[0], name)), ""):
                attribute = next(key for key, value in element.attributes.items() if value in names)
                says = f"Nothing of that kind is called {names[0]!r}. {other!r} is another of its kind, and there."
                yield advised(element, says, attribute)
                return
            says = f"Nothing is called {names[0]!r}, nor nearly so."
            yield mends(element, (delete(element),), says, value="removed")
            return


def _links(model: ReaderModel, source: Source) -> Iterator[Suspect]:
    """The links of a URDF's joints that the file does not have; a joint to a part that was left out goes with it."""
    links = [each.get("name") for each in source.elements("link")]
    for joint in source.elements("joint"):
        for end in (joint.first("parent"), joint.first("child")):
            if end is None or end.get("link") in links:
                continue
            now = end.get("link")
            says = f"No link is called {now!r}."
            for name in nearest(now, links):
                edits = (set_attribute(end, "link", name),)
                if str(model.with_edits(edits)) != model.error:
                    yield mends(joint, edits, says, attribute="link", now=now, value=name)
                    return
            yield mends(joint, (delete(joint),), says, attribute="link", now=now, value="removed")


def _nearest(model: ReaderModel, element: Element, attribute: str, now: str, known: list[str]) -> Suspect | None:
    ends = [name for name in known if name.endswith(now) or now.endswith(name)]
    for name in [*nearest(now, known), *nearest(now, ends)]:
        if attribute not in OPTIONAL and _another(now, name):
            break
        edits = (set_attribute(element, attribute, name),)
        if not _says(model, edits, name):
            says = f"Nothing of that kind is called {now!r}; {name!r} is there."
            return mends(element, edits, says, attribute=attribute, now=now, value=name)
    if attribute in OPTIONAL:
        edits = (remove_attribute(element, attribute),)
        says = f"Nothing of that kind is called {now!r}."
        return mends(element, edits, says, attribute=attribute, now=now, value="left out")
    return None


def _another(name: str, other: str) -> bool:
    """Whether a name is of the other side or has another number: such parts stand beside each other."""
    words, others = (re.findall(r"[A-Za-z]+|\d+", each) for each in (name, other))
    differ = [(a.lower(), b.lower()) for a, b in zip(words, others, strict=False) if a.lower() != b.lower()]
    if len(words) != len(others) or not differ:
        return False
    return all((a.isdigit() and b.isdigit()) or {a, b} in SIDES for a, b in differ)


def _says(model: ReaderModel, edits: tuple[object, ...], name: str) -> bool:
    made = model.with_edits(edits)  # type: ignore[arg-type]
    return isinstance(made, CompileError) and (name in str(made) or str(made) == model.error)
