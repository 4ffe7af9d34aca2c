"""Something that must be there is left out.

An inertial without mass, a joint equality without its joint, a sensor that does not say of what, an asset without a
name: MuJoCo says `required attribute missing`, `missing element` or `empty name`.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0"/>
          <geom name="link" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
      <tendon>
        <fixed name="pull">
          <joint joint="elbow"/>
        </fixed>
      </tendon>
    </mujoco>

Good:

    -       <joint joint="elbow"/>
    +       <joint joint="elbow" coef="1"/>

The number: none; the text compiles with the edit. Where a name is left out, the only element of that kind is tried, or
the one with nearly the same name; where a mass is left out, that of a ball of 50 mm radius with the written inertia.

When it is wrong: what is put in is a stopgap, which only who made the model can replace.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete, insert, remove_attribute, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._ball import MOMENTS, ball_in, mass_of_a_ball, moments_of_a_ball
from clinic.diagnosis.rules.errors._message import meant, mends, nearest, sentence, told
from clinic.diagnosis.rules.errors._remedy import advised
from clinic.diagnosis.source import Element, asset_name
from clinic.diagnosis.suspect import Suspect

TITLE = "Something that must be there is left out"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "models of which something was left out do not compile, and no healthy one is without what it needs"

VALUES = {  # by element and attribute; what stands for any element has no tag
    "joint.coef": "1",
    "replicate.count": "2",
    "user.dim": "1",
    "hfield.size": "1 1 0.1 0.1",
    "inertial.pos": "0 0 0",
    "axis.xyz": "1 0 0",
    "sphere.radius": "0.01",
    "cylinder.radius": "0.01",
    "cylinder.length": "0.01",
    "capsule.radius": "0.01",
    "capsule.length": "0.01",
    "box.size": "0.01 0.01 0.01",
    "limit.effort": "0",
    "limit.velocity": "0",
    "color.rgba": "0.5 0.5 0.5 1",
    "key.time": "0",
}
OTHERWISE = {"height": "length", "name": "link", "rpy": "xyz", "r": "radius", "file": "filename", "url": "filename"}
OTHERWISE |= {"mass": "value", "body": "objname", "site": "objname", "joint": "joint1", "body1": "body2"}
KINDS = (
    "joint",
    "body",
    "site",
    "geom",
    "tendon",
    "actuator",
    "mesh",
    "texture",
    "material",
    "camera",
    "flex",
    "hfield",
)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What is left out, put in; a hint of what belongs there where nothing is known of it."""
    said = sentence(model)
    if model.source is None:
        return
    for element in _elements(model, said):
        if found := re.search(r"required attribute missing: '(\w+)'", said):
            yield from _attribute(model, element, found[1])
        elif found := re.search(r"missing element: '(\w+)'", said):
            yield from _child(model, element, found[1])
        elif found := re.search(r"one of (.*) must be specified", said):
            yield from _one_of(model, element, re.findall(r"\w+", found[1]))
        elif found := re.search(r"attributes '(\w+)', '(\w+)' must be specified together", said):
            for name in (each for each in found.groups() if each in element.attributes):
                says = f"{found[1]} and {found[2]} say together what is meant."
                yield mends(
                    element,
                    (remove_attribute(element, name),),
                    says,
                    attribute=name,
                    now=element.get(name),
                    value="left out",
                )
        elif said.startswith("Parent body must have name") and element.parent is not None:
            body = next((each for each in element.around() if each.tag == "body"), element.parent)
            yield from _name(model, body, "name")
        elif said.startswith("empty"):
            yield from _name(model, element, "class" if "class" in said else "name")
        elif found := re.search(r"must have valid (mesh|hfield)id", said):
            yield from _attribute(model, element, found[1])
        elif "missing transmission target" in said:
            yield from _target(model, element)
        elif "geometry specification not found" in said:
            says = f"A <geometry> of URDF is a box, cylinder, sphere or mesh; {told(element)} is none of them."
            owner = next((each for each in element.around() if each.tag in ("visual", "collision")), element)
            yield mends(owner, (delete(owner),), says, value="removed")
        elif found := re.search(r"(geom|body) '' not found", said):
            name = next(each for each in (f"{found[1]}1", f"{found[1]}2") if not element.get(each))
            yield advised(element, f"{told(element)} is between two: {name} is left out.", name)


def _elements(model: ReaderModel, said: str) -> list[Element]:
    """What is meant; of those that stand in one line, what the sentence fits."""
    every = meant(model)
    if "must have valid" in said:
        return [
            each
            for each in every
            if each.get("type") in ("mesh", "sdf", "hfield") and not (each.get("mesh") or each.get("hfield"))
        ][:1]
    if "'' not found" in said:
        return [each for each in every if each.tag in ("pair", "exclude")][:1]
    if said.startswith("empty"):
        return [each for each in every if not each.get("class" if "class" in said else "name")]
    return every


def _attribute(model: ReaderModel, element: Element, name: str) -> Iterator[Suspect]:
    tag = element.tag
    says = f"<{tag}> needs {name}."
    if tag == "inertia" and name in MOMENTS:
        yield moments_of_a_ball(element)
        return
    for other in (each for each, better in OTHERWISE.items() if better == name and each in element.attributes):
        now = element.get(other)
        edits = (remove_attribute(element, other), set_attribute(element, name, now))
        yield mends(
            element,
            edits,
            f"<{tag}> calls it {name}, and not {other}.",
            attribute=other,
            now=now,
            value=f"{name}={now!r}",
        )
    if name == "objtype" and (kind := _kind(model, element.get("objname"))):
        yield _put(element, name, kind, f"{says} {element.get('objname')!r} is a {kind}.")
    values = [VALUES[f"{tag}.{name}"]] if f"{tag}.{name}" in VALUES else _names(model, element, name)
    if (tag, name) in (("inertial", "mass"), ("mass", "value")):
        values = [mass_of_a_ball(element if tag == "inertial" else element.parent)]
    elif tag == "joint" and name == "type":
        values = (
            ["fixed"] if element.first("axis") is None else ["revolute" if element.first("limit") else "continuous"]
        )
    elif name == "name":
        yield from _name(model, element, name)
    elif name == "prefix":
        values = [f"{element.get('model', 'part')}_"]
    yield from (_put(element, name, value, f"{says} {value!r} is put in.") for value in values)
    if not values:
        yield advised(element, f"{says} {_advice(name)}", name)


def _advice(name: str) -> str:
    """What an attribute is for."""
    kind = name.rstrip("12")
    if kind in KINDS:
        return f"It names a {kind}, and which one is meant is not in the text."
    return {
        "file": "It names the file that is to be put in here.",
        "filename": "It names the mesh's file.",
        "objname": "It names the element that is sensed.",
        "objtype": "It is the kind of what objname names: body, xbody, geom, site or camera.",
    }.get(name, "Without it there is nothing to compile.")


def _put(element: Element, name: str, value: str, says: str) -> Suspect:
    return mends(element, (set_attribute(element, name, value),), says, attribute=name, now="nothing", value=value)


def _kind(model: ReaderModel, name: str) -> str:
    assert model.source is not None
    kinds = ("body", "geom", "site", "camera")
    return next((each.tag for each in model.source.elements(*kinds) if name and each.get("name") == name), "")


def _names(model: ReaderModel, element: Element, attribute: str) -> list[str]:
    """The names that an attribute may refer to: what is called nearly as the element, or the only one of its kind."""
    assert model.source is not None
    kind = element.get("objtype", "") if attribute == "objname" else attribute.rstrip("12")
    kind = "body" if kind == "xbody" else kind
    if kind not in KINDS:
        return []
    holder = {"tendon", "actuator"} & {kind}
    every = model.source.section(kind) if holder else model.source.elements(kind)
    used = set(element.attributes.values())
    there = [
        name for each in every if (name := asset_name(each)) and name not in used and each.parent is not element.parent
    ]
    if element.parent is not None and element.parent.tag == "actuator":
        taken = {each.get(attribute) for each in model.source.section("actuator")}
        there = [name for name in there if name not in taken] or there
    own = [each for each in (element.get("name"), element.parent.get("name") if element.parent else "") if each]
    like = [name for word in own for name in there if name in word or word in name]
    like += [name for word in own for name in nearest(word, there)]
    return list(dict.fromkeys([*like, *(there if len(there) == 1 else [])]))[:3]


def _child(model: ReaderModel, element: Element, tag: str) -> Iterator[Suspect]:
    """An element of a URDF that has to be inside of another."""
    owner = f' of {element.parent.tag} "{element.parent.get("name")}"' if element.parent is not None else ""
    says = f"<{element.tag}>{owner if element.tag != 'joint' else ''} needs a{'n' * (tag[0] in 'aeiou')} <{tag}>"
    if tag in ("mass", "inertia"):
        yield ball_in(element, tag, says)
    elif tag in ("parent", "child"):
        for name in _free_links(model, element, tag):
            edits = (insert(element, f'<{tag} link="{name}"/>'),)
            yield mends(element, edits, f"{says}: {name!r} fits.", attribute=tag, now="nothing", value=name)
        yield advised(element, f"{says}, which names a link.")
    else:
        yield advised(element, f"{says}.")


def _free_links(model: ReaderModel, joint: Element, tag: str) -> list[str]:
    """The links that a joint without parent may hang on, or that no other joint leads to."""
    assert model.source is not None
    links = [each.get("name") for each in model.source.root.children if each.tag == "link"]
    children = {each.get("link") for each in model.source.elements("child")}
    parents = {each.get("link") for each in model.source.elements("parent")}
    other = joint.first("child" if tag == "parent" else "parent")
    own = other.get("link") if other is not None else ""
    if tag == "parent" and own:  # the root is one of many, and a chain ends where nothing hangs on it
        ends = [name for name in links if name not in parents and name != own]
        return nearest(own, ends)[:1] if len(links) > 2 else [name for name in links if name != own]
    return [name for name in links if name not in children and name != own][:2]


def _one_of(model: ReaderModel, element: Element, names: list[str]) -> Iterator[Suspect]:
    """One of several ways in which something can be said."""
    says = f"<{element.tag}> says what it is between by {' or '.join(names)}."
    if "anchor" in names and ("body1" in element.attributes or "body2" in element.attributes):
        edits = [set_attribute(element, "anchor", "0 0 0")] if not element.get("anchor") else []
        edits += (
            [set_attribute(element, "body1", element.get("body2")), remove_attribute(element, "body2")]
            if not element.get("body1")
            else []
        )
        yield mends(
            element,
            edits,
            "The anchor is the point of body1 that is held, in its frame; its origin is put in.",
            attribute="anchor",
            now="nothing",
            value="0 0 0",
        )
    lacking = [name for name in names if name not in element.attributes]
    for name in lacking:
        yield from (
            _put(element, name, value, f"{says} {value!r} is put in.") for value in _names(model, element, name)[:1]
        )
    yield advised(element, says)


def _name(model: ReaderModel, element: Element, attribute: str) -> Iterator[Suspect]:
    """A name that nothing else has."""
    assert model.source is not None
    taken = {each.get(attribute) for each in model.source.root.walk()}
    base = "part" if attribute == "class" else element.tag
    value = next(name for name in (base, *(f"{base}_{n}" for n in range(2, 10_000))) if name not in taken)
    yield _put(element, attribute, value, f"What refers to a {element.tag} does so by its {attribute}.")


def _target(model: ReaderModel, element: Element) -> Iterator[Suspect]:
    """The joint or tendon that an actuator may be meant to drive."""
    for kind in ("joint", "tendon"):
        for value in _names(model, element, kind)[:1]:
            yield _put(element, kind, value, f"An actuator drives a joint, tendon, site or body; {value!r} fits.")
    yield advised(element, 'An actuator drives a joint, tendon, site or body: write which, as joint="elbow".')
