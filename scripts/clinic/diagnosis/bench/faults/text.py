"""Texts that MuJoCo refuses."""

from __future__ import annotations

from random import Random

from clinic.diagnosis.bench.faults import DOES_NOT_COMPILE, Fault, between, kind, pick, text_of, written
from clinic.diagnosis.edit import delete, insert, remove_attribute, replace, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element

OLD = (
    ("option", "collision", "all"),
    ("option", "apirate", "100"),
    ("option", "mpr_iterations", "50"),
    ("compiler", "coordinate", "global"),
    ("compiler", "convexhull", "true"),
    ("compiler", "exactmeshinertia", "true"),
    ("size", "nkeyframes", "1"),
)


def _elements(model: ReaderModel, *tags: str) -> list[Element]:
    assert model.source is not None
    return list(model.source.elements(*tags))


@kind("unknown-attribute", harms=DOES_NOT_COMPILE)
def attribute_of_an_older_release(model: ReaderModel, random: Random) -> Fault | None:
    """An attribute of `<option>` or `<compiler>` that newer releases do not know."""
    tag, name, value = random.choice(OLD)
    return Fault(model.option(name, value, tag=tag), (), name)


@kind("unknown-attribute", harms=DOES_NOT_COMPILE)
def attribute_misspelt(model: ReaderModel, random: Random) -> Fault | None:
    """An attribute with two letters swapped, one doubled or one left out."""
    found = [(e, name) for e in _elements(model, "geom", "joint", "body", "motor", "position") for name in e.attributes]
    found = [(element, name) for element, name in found if len(name) > 3 and name != "class"]
    element, name = pick(random, found)
    at = random.randrange(1, len(name) - 1)
    swapped = name[:at] + name[at + 1] + name[at] + name[at + 2 :]
    wrong = random.choice((swapped, name[:at] + name[at] + name[at:], name[:at] + name[at + 1 :]))
    if wrong == name:
        return None
    return Fault((remove_attribute(element, name), set_attribute(element, wrong, element.get(name))), (), wrong)


@kind("unknown-element", harms=DOES_NOT_COMPILE)
def element_misspelt(model: ReaderModel, random: Random) -> Fault | None:
    """An element's name misspelt, or another format's."""
    other = {"geom": "geometry", "joint": "hinge", "site": "sites", "motor": "moter", "camera": "cam", "light": "lamp"}
    found = [element for element in _elements(model, *other) if element.empty]
    element = pick(random, found)
    wrong = other[element.tag]
    xml = model.text_of(element).replace(f"<{element.tag}", f"<{wrong}", 1)
    return Fault((replace(element, xml),), (), wrong)


@kind("misplaced-joint", "unknown-element", harms=DOES_NOT_COMPILE)
def element_in_the_wrong_place(model: ReaderModel, random: Random) -> Fault | None:
    """A geom outside of `<worldbody>`, or a joint in the world."""
    assert model.source is not None
    worlds = _elements(model, "worldbody")
    if not worlds or random.random() < 0.5:
        return Fault((insert(model.source.root, '<geom size="0.1"/>'),), (), "geom")
    return Fault((insert(worlds[0], '<joint axis="0 0 1"/>'),), (), "joint")


@kind("missing-file", harms=DOES_NOT_COMPILE)
def file_missing(model: ReaderModel, random: Random) -> Fault | None:
    """A mesh, texture or height field that is not where the text says."""
    found = [element for element in _elements(model, "mesh", "texture", "hfield") if element.get("file")]
    element = pick(random, found)
    old = element.get("file")
    stem, dot, ending = old.rpartition(".")
    new = random.choice((f"meshes/nowhere/{old}", f"{stem}_v2{dot}{ending}", f"{stem.upper()}{dot}{ending}"))
    return Fault((set_attribute(element, "file", new),), (), "file") if new != old else None


@kind("repeated-name", harms=DOES_NOT_COMPILE)
def name_twice(model: ReaderModel, random: Random) -> Fault | None:
    """Two elements of a kind with one name."""
    of = random.choice(("geom", "body", "joint", "site"))
    names = [(i, name) for i, name in enumerate(model.simulation.names(of)) if name]
    names = [(i, name) for i, name in names if model.element(of, i) is not None and (of != "body" or i)]
    if len(names) < 2:
        return None
    (i, _), (_, name) = random.sample(names, 2)
    element = model.element(of, i)
    assert element is not None
    return Fault((set_attribute(element, "name", name),), (), "name")


@kind("malformed-number", harms=DOES_NOT_COMPILE)
def number_malformed(model: ReaderModel, random: Random) -> Fault | None:
    """A number with a second point, a comma, a unit or a letter."""
    attributes = ("pos", "size", "axis", "mass", "range", "damping")
    found = [(e, n) for e in _elements(model, "geom", "joint", "body", "inertial") for n in attributes if e.get(n)]
    element, name = pick(random, found)
    words = element.get(name).split()
    at = random.randrange(len(words))
    words[at] = random.choice(("0..1", "0.1.2", "1,0", "0.1m", "O.1", "1e", "--1"))
    return Fault((set_attribute(element, name, " ".join(words)),), (), name)


@kind("malformed-xml", harms=DOES_NOT_COMPILE)
def tag_not_closed(model: ReaderModel, random: Random) -> Fault | None:
    """An element that is not closed, or a quotation mark that is missing."""
    found = [element for element in _elements(model, "geom", "joint") if element.empty and element.attributes]
    element = pick(random, found)
    xml = model.text_of(element)
    wrong = xml[: xml.rindex("/")] + ">" if random.random() < 0.5 else xml.replace('"', "", 1)
    return Fault((replace(element, wrong),), (), "")


@kind("unknown-reference", harms=DOES_NOT_COMPILE)
def name_unknown(model: ReaderModel, random: Random) -> Fault | None:
    """An actuator, sensor or exclusion that names what is not there."""
    found = []
    for name in ("joint", "site", "body1", "tendon", "objname"):
        for tag in ("actuator", "sensor", "contact", "equality"):
            assert model.source is not None
            found += [(element, name) for element in model.source.section(tag) if element.get(name)]
    element, name = pick(random, found)
    old = element.get(name)
    return Fault(
        (
            set_attribute(
                element,
                name,
                random.choice((old + "_joint", old.upper() + "0", old[:-1] + "-")),
            ),
        ),
        (),
        name,
    )


@kind("massless-body", "invalid-inertia", harms=DOES_NOT_COMPILE)
def body_without_mass(model: ReaderModel, random: Random) -> Fault | None:
    """A moving body that lost its geoms and its `<inertial>`."""
    simulation = model.simulation
    leaves = set(written(model, "body")) - {int(parent) for parent in simulation.model("body_parentid")}
    bodies = [b for b in simulation.moving_bodies if b in leaves and simulation.joints_of(b)]
    element = model.element("body", pick(random, bodies))
    assert element is not None
    gone = [each for each in element.children if each.tag in ("geom", "inertial")]
    return Fault(tuple(delete(each) for each in gone), (), "mass") if gone else None


@kind("invalid-value", harms=DOES_NOT_COMPILE)
def value_invalid(model: ReaderModel, random: Random) -> Fault | None:
    """A size or an axis of zero, a type that MuJoCo does not know."""
    found = [(e, n) for e in _elements(model, "geom", "joint") for n in ("size", "axis", "type") if e.get(n)]
    element, name = pick(random, found)
    words = element.get(name).split()
    value = words[0][0] + words[0] if name == "type" else " ".join("0" for _ in words)
    return Fault((set_attribute(element, name, value),), (), name)


@kind("invalid-inertia", harms=DOES_NOT_COMPILE)
def inertia_impossible(model: ReaderModel, random: Random) -> Fault | None:
    """A body's inertia with a negative moment, or with one above the sum of the others by 1.2 to 1,000 times."""
    simulation = model.simulation
    bodies = [b for b in written(model, "body") if b and simulation.model("body_mass")[b] > 0]
    body = pick(random, bodies)
    moments = list(simulation.row("body_inertia", body, 3))
    at = random.randrange(3)
    largest = (sum(moments) - moments[at]) * between(random, 1.2, 1000)
    moments[at] = random.choice((-moments[at], largest))
    element = model.element("body", body)
    assert element is not None
    old = element.first("inertial")
    place = text_of(*simulation.row("body_ipos", body, 3))
    xml = (
        f'<inertial pos="{place}" mass="{simulation.model("body_mass")[body]:.6g}" diaginertia="{text_of(*moments)}"/>'
    )
    return Fault((*((delete(old),) if old else ()), insert(element, xml)), (), "diaginertia")


@kind("keyframe-size", harms=DOES_NOT_COMPILE)
def key_too_long(model: ReaderModel, random: Random) -> Fault | None:
    """A keyframe with 1 to 7 more numbers than there are positions."""
    positions = list(model.simulation.model("qpos0"))
    values = text_of(*positions, *[0.0] * random.randint(1, 7))
    return Fault(model.add("keyframe", f'<key name="planted" qpos="{values}"/>'), (), "qpos")
