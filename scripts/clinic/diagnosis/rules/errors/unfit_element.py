"""Something that does not fit what it belongs to: a sensor on a joint of the wrong kind, a box in a tendon's path.

The names are right and the values too, and yet the two do not go together: `jointpos` reads hinges and slides, a tendon
wraps around spheres and cylinders alone, `refsite` goes with `site`.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="shoulder" type="ball"/>
          <geom name="link" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
      <sensor>
        <jointpos name="angle" joint="shoulder"/>
      </sensor>
    </mujoco>

Good:

    -     <jointpos name="angle" joint="shoulder"/>
    +     <ballquat name="angle" joint="shoulder"/>

The number: none; the text compiles with the edit.

When it is wrong: where nothing fits, the part is taken out, and what it was meant to do is lost.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete, insert, remove_attribute, replace, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import meant, mends, sentence, told
from clinic.diagnosis.rules.errors._remedy import Remedy, advised, remedied
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect

TITLE = "Something that does not fit what it belongs to"
FAMILIES = ("will-not-compile",)
LEVEL = "cause"
UNPLANTED = "what does not fit was written so by hand; a healthy model has other ways to be spoilt"

TABLE = (
    Remedy(
        "path cannot be empty|at least two objects",
        "A spatial tendon goes through two sites at least, a fixed one through joints; this one is taken out.",
        ("delete",),
    ),
    Remedy(
        "pulley divisor",
        "A pulley divides the force among as many branches as its divisor says.",
        ("divisor=2", "pulley/divisor=2"),
    ),
    Remedy("needs a neighbor that is not a pulley", "After each <pulley> come two sites at least.", ("pulley/delete",)),
    Remedy(
        "geom wrapping not supported by tendon armature", "armature goes with a path of sites alone.", ("-armature",)
    ),
    Remedy(
        "tendon must be limited", "It reads how far a tendon is beyond its range: give the tendon a range.", ("delete",)
    ),
    Remedy(
        "only HINGE and SLIDE",
        "An equation between joints is of hinges and slides; a ball is held by weld or connect.",
        ("delete",),
    ),
    Remedy("refsite can only be used", "refsite is the frame of a force at a site.", ("-refsite",)),
    Remedy(
        "cranklength and slidersite", "They go with cranksite in the place of joint.", ("-cranklength;-slidersite",)
    ),
    Remedy(
        "missing base site for slider-crank", "A crank pulls from its slidersite, whose z axis is the cylinder's.", ()
    ),
    Remedy(
        "(damping|armature) requires joint",
        "damping and armature go with joint or tendon.",
        ("-{0}", "-damping;-armature"),
    ),
    Remedy(
        "World body cannot have inertia", "The world does not move: the <inertial> belongs into a <body>.", ("delete",)
    ),
    Remedy(
        "mujoco.elasticity.cable",
        "The cable is gone since MuJoCo 4.0; a <flexcomp> of dim 1 takes its place.",
    ),
    Remedy(
        r"plugin (\S+) not found|unrecognized plugin '([^']+)'",
        "Load the library that holds it with mujoco.mj_loadPluginLibrary before the model.",
    ),
    Remedy(
        "unrecognized name '([^']+)' for plugin instance",
        "An <instance name={0!r}> belongs into the <plugin> of <extension>.",
    ),
    Remedy("cannot attach: element (\\S+) already exists", "Each copy needs a prefix of its own.", ("prefix=second_",)),
    Remedy("File is required", "A flexcomp of this type takes its points from a file: write file=, as OBJ or GMSH."),
    Remedy(
        "could not find model|unknown model|[Mm]odel '([^']*)' not found",
        "<attach> names a <model> of the <asset>, by its name there.",
    ),
    Remedy(
        "Touch sensor requires|sensor requires",
        "A touch sensor feels the geoms of its site's body: the body needs one that collides.",
        ("delete",),
    ),
    Remedy(
        "URDF body not found",
        "The joints of the URDF go in a circle: one of them must lead away from a link that is no child.",
    ),
)
KIND = re.compile(r"joint must be (slide or hinge|ball|limited) in sensor")
BALL = {"jointpos": "ballquat", "jointvel": "ballangvel"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What fits in its place, or the part taken out."""
    said = sentence(model)
    if model.source is None:
        return
    yield from remedied(model, TABLE)
    if found := KIND.match(said):
        for sensor in meant(model)[:1]:
            yield from _sensor(model, sensor, found[1], said)
    elif found := re.search(r"(?:geom|joint) '([^']*)' in tendon (\d+), wrap \d+|geom at pos \d+ not bracketed", said):
        number = int(found[2] or -1)
        tendons = list(model.source.section("tendon"))[number : number + 1] if found[2] else []
        for element in tendons or meant(model):
            yield from _wrap(element, found[1], said)
    elif "Lengthrange computation did not converge" in said or "lengthrange" in said.lower():
        yield from _muscle(model, said)
    elif "direct child of replicate" in said:
        for element in meant(model)[:1]:
            yield from _replicated(model, element)
    elif "inertia should be specified in the mesh asset" in said:
        for geom in [each for each in meant(model, "geom") if "shellinertia" in each.attributes][:1]:
            yield from _shell(model, geom, said)
    elif "has more values than" in said and (size := re.search(r"than (nuser_\w+)", said)):
        for each in [one for one in model.source.elements("size") if size[1] in one.attributes]:
            says = f"{said}. <size> says how many numbers user may have; with -1 MuJoCo counts them."
            yield mends(
                each, (set_attribute(each, size[1], "-1"),), says, attribute=size[1], now=each.get(size[1]), value="-1"
            )
    elif "out of memory" in said:
        for each in [one for one in model.source.elements("size") if {"memory", "nstack"} & {*one.attributes}]:
            old = [name for name in ("memory", "nstack", "njmax", "nconmax") if name in each.attributes]
            says = f"{said}. Without it MuJoCo takes as much as the model needs."
            edits = [remove_attribute(each, name) for name in old]
            yield mends(each, edits, says, attribute=old[0], now=each.get(old[0]), value="nothing")
    elif "no flex vertices" in said:
        for flex in list(model.source.elements("flexcomp")):
            says = f"{said}. A flex below a body that moves hangs on it by a <pin>; its first point is pinned."
            yield mends(flex, (insert(flex, '<pin id="0"/>'),), says, value='<pin id="0"/>')
    elif "Include element cannot have children" in said:
        for element in meant(model, "include"):
            says = "An <include> is empty: what stood in it is taken out."
            xml = f'<include file="{element.get("file")}"/>'
            yield mends(element, (replace(element, xml),), says, value="empty")
    elif "unrecognized element" in said:
        yield from _include(model)


def _sensor(model: ReaderModel, sensor: Element, kind: str, said: str) -> Iterator[Suspect]:
    """The sensor for the other kind of joint."""
    assert model.source is not None
    back = {value: key for key, value in BALL.items()}
    tag = {"ball": back, "slide or hinge": BALL}.get(kind, {}).get(sensor.tag)
    joint = next((each for each in model.source.elements("joint") if each.get("name") == sensor.get("joint")), None)
    if tag:
        says = f"{said}: <{tag}> is for the others."
        yield mends(sensor, (replace(sensor, _renamed(model, sensor, tag)),), says, value=f"<{tag}>")
    if kind == "limited" and joint is not None:
        says = f"{said}: it reads how far a joint is beyond its range, and {told(joint)} has none."
        yield mends(sensor, (delete(sensor),), says, value="removed")
    else:
        says = f"{said}. {told(joint) if joint else 'The joint'} is of another type."
        yield mends(sensor, (delete(sensor),), says, value="removed")


def _renamed(model: ReaderModel, element: Element, tag: str) -> str:
    ends = rf"^<{element.tag}\b|</{element.tag}(?=\s*>$)"
    return re.sub(ends, lambda found: found[0].replace(element.tag, tag), model.text_of(element))


def _wrap(tendon: Element, name: str | None, said: str) -> Iterator[Suspect]:
    """The part of a tendon's path that cannot be there, taken out."""
    owner = tendon if tendon.tag in ("spatial", "fixed") else tendon.parent
    for each in owner.children if owner is not None and owner.tag in ("spatial", "fixed") else ():
        if (each.tag, each.get(each.tag)) in (("geom", name), ("joint", name)) or (name is None and each.tag == "geom"):
            needs = "hinges and slides" if each.tag == "joint" else "a sphere or cylinder between two sites"
            says = f"{said}. A tendon takes {needs}; this part of the path is taken out."
            yield mends(each, (delete(each),), says, value="removed")


def _muscle(model: ReaderModel, said: str) -> Iterator[Suspect]:
    """A range for the joint that a muscle turns without end."""
    assert model.source is not None
    number = int(next(iter(re.findall(r"actuator (\d+)", said)), "0"))
    actuators = list(model.source.section("actuator"))
    actuator = actuators[number] if number < len(actuators) else None
    if actuator is None:
        return
    name = actuator.get("joint")
    joint = next((each for each in model.source.elements("joint") if name and each.get("name") == name), None)
    advice = "a muscle needs the least and the greatest length of what it pulls"
    if joint is not None and model.source.value(joint, "range") is None:
        slides = model.source.value(joint, "type") == "slide"
        value = "-0.1 0.1" if slides else "-90 90" if model.angle_unit < 1 else "-1.57 1.57"
        edits = [set_attribute(joint, "range", value), set_attribute(joint, "limited", "true")]
        says = f"{told(joint)} has no range, and {advice}: {value} is put in."
        yield mends(joint, edits, says, attribute="range", now="nothing", value=value)
    yield advised(
        actuator,
        f"{advice.capitalize()}: give the joints that it moves a range, or write lengthrange, in m or rad.",
        "lengthrange",
    )


def _replicated(model: ReaderModel, joint: Element) -> Iterator[Suspect]:
    """What is copied, in the place of the copies."""
    outer = next((each for each in joint.around() if each.tag == "replicate"), None)
    if outer is not None:
        text = model.texts[outer.file].encode()[outer.head_end : outer.end].decode()
        inner = text[: text.rfind("</")].strip()
        says = "<replicate> copies bodies and geoms: a joint stands in the <body> that is copied. Here it stands once."
        yield mends(outer, (replace(outer, inner),), says, attribute="count", now=outer.get("count"), value="once")


def _shell(model: ReaderModel, geom: Element, said: str) -> Iterator[Suspect]:
    """The shell's inertia, told to the mesh in the place of the geom."""
    assert model.source is not None
    taken = [remove_attribute(geom, "shellinertia")]
    meshes = [each for each in model.source.elements("mesh") if each.get("name") == geom.get("mesh")]
    edits = [*taken, *(set_attribute(each, "inertia", "shell") for each in meshes)]
    says = f'{said}, as inertia="shell".'
    yield mends(geom, edits, says, attribute="shellinertia", now=geom.get("shellinertia"), value="left out")


def _include(model: ReaderModel) -> Iterator[Suspect]:
    """A whole model that is included inside of a section, included at the top."""
    assert model.source is not None
    root = model.source.root
    for file, include in model.source.included.items():
        inner = [
            each for each in root.walk() if each.file == file and each.tag == "worldbody" and each.parent is not root
        ]
        if inner and include.file == model.source.main:
            says = f"{file} is a whole model, with a <worldbody> of its own: it is included directly below <mujoco>."
            edits = (delete(include), insert(root, f'<include file="{file}"/>'))
            yield mends(include, edits, says, attribute="file", now=file, value="moved below <mujoco>")
