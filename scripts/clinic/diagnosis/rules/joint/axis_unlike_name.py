"""Slides whose axes are exchanged: the one called x goes along y. Or a lift that goes sideways.

A planar base, a table, a crane of three slides: two names or two axes were exchanged. The command to go forward goes
sideways. A base that is to yaw rolls over.

Bad:

    <mujoco>
      <worldbody>
        <body name="base">
          <joint name="base_x" type="slide" axis="0 1 0"/>
          <joint name="base_y" type="slide" axis="1 0 0"/>
          <joint name="base_yaw" axis="0 0 1"/>
          <geom type="box" size="0.2 0.1 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="base_x" type="slide" axis="0 1 0"/>
    -       <joint name="base_y" type="slide" axis="1 0 0"/>
    +       <joint name="base_x" type="slide" axis="1 0 0"/>
    +       <joint name="base_y" type="slide" axis="0 1 0"/>

The number: the angle in degrees between a slide and the axis that its name says: x, forward; y, side, lateral; z,
vertical. More than 60, both in the world and as it is written, where two slides and more are called so; of 289 healthy
models none has such a slide. Models whose y is up are left alone. A slide called a lift or an elevator, and the one
hinge that yaws a rolling base, a waist, a chest or a head, are told as far from the vertical, each by itself. So is a
pendulum or a pole that nothing drives, whose axis goes along the rod through its centre of mass, or is that of the
slides that carry it. And so is the one hinge of an elbow, a knee or a finger's joint, `ip`, `pip` or `dip`, whose axis
goes through the next joint or, of a last link, through its centre of mass: it twists, and does not bend.

When it is wrong: a frame whose x is not forward.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.vector import Vector, cross, dot, norm, sub, times, transpose, unit, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "A joint along another axis than its name says"
FAMILIES = ("drifts", "stuck", "wrong-numbers")
UNPLANTED = "which way a name points, only names tell, and most healthy slides say none"

AXES = {"x": 0, "forward": 0, "y": 1, "side": 1, "lateral": 1, "z": 2, "vertical": 2}
ENDING = re.compile(r"(?:root|base|trans|slider?|[^a-z][tr])([xyz])$")
FAR = 60.0  # degrees
TRUNK = "torso|waist|chest|head|neck|pelvis"
UPRIGHT = {HINGE: re.compile(rf"(?i)(?:{TRUNK})_?yaw"), SLIDE: re.compile("(?i)(?:lift|elevator)(?!_?door)")}
PENDULUM = re.compile("(?i)pendul|(?<![a-z])pole(?![a-z])")
BENDS = re.compile(r"(?i)elbow|knee|(?<![a-z])[pd]?ip(?![a-z])")
TURNS = re.compile(r"(?i)roll|pitch|yaw|twist|turn|pron|supin|rot|(?<![a-z])[xyz](?![a-z])")
FLAT, OFF = 1e-4, 0.05  # m; sine of an angle
BASE = re.compile("(?i)(?:base|chassis)_?yaw")  # of what rolls: an arm's base may hang on a wall


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The slides of a model that go along another axis than they are called after, all together."""
    of = model.simulation
    of.begin()
    yield from _lying(model)
    yield from _idle(model)
    yield from _twisting(model)
    slides = [joint for joint in range(of.count("joint")) if of.joint_type(joint) == SLIDE]
    said = {joint: axis for joint in slides if (axis := _said(of.engine.name("joint", joint))) is not None}
    upright = abs(of.model("opt.gravity")[1]) <= abs(of.model("opt.gravity")[2])
    found = [joint for joint in said if _off(of, joint, said[joint]) > FAR]
    swapped = all(_along(of, joint) + said[joint] == 3 and said[joint] for joint in found)  # y is up
    if not found or len(said) < 2 or not upright or swapped:
        return
    other = [of.name("joint", joint) for joint in found]
    axes = {joint: " ".join("1" if axis == said[joint] else "0" for axis in range(3)) for joint in found}
    yield Suspect(
        tuple(other),
        "axis",
        written(of.row("jnt_axis", found[0], 3)),
        axes[found[0]],
        model.set_each("joint", "axis", axes),
        Probe("angle to the axis of the name", "degrees", _at_start, (found[0], said[found[0]]), dynamic=False),
        FAR,
        f"{other[0]} goes along {'xyz'[_along(of, found[0])]}.",
        "the axis that the name says",
    )


def _lying(model: ReaderModel) -> Iterator[Suspect]:
    """Lifts that go sideways, and a base, a waist or a head that yaws about a level axis."""
    of = model.simulation
    if abs(of.model("opt.gravity")[2]) <= math.hypot(*of.model("opt.gravity")[:2]):
        return
    for joint, name in enumerate(of.names("joint")):
        kind = of.joint_type(joint)
        body = of.body_of("joint", joint)
        alone = sum(of.joint_type(each) == kind for each in of.joints_of(body)) == 1  # no ball of three hinges
        rolls = BASE.search(name) and any(of.joint_type(each) == SLIDE for each in _joints_up_from(of, body))
        said = rolls or (kind in UPRIGHT and UPRIGHT[kind].search(name))
        if alone and said and _tilt(of, joint) > FAR:
            up = tuple(round(x, 6) + 0.0 for x in times(transpose(of.data_row("xmat", body, 9)), (0.0, 0.0, 1.0)))
            value, edits = written(up), model.set("joint", [joint], "axis", written(up))
            says = f"Its axis is {_tilt(of, joint):.0f} degrees off the vertical at the zero pose."
            probe = Probe("angle of the axis to the vertical", "degrees", _tilt, (joint,), dynamic=False)
            now = written(of.row("jnt_axis", joint, 3))
            yield Suspect((of.name("joint", joint),), "axis", now, value, edits, probe, FAR, says, "upright")


def _idle(model: ReaderModel) -> Iterator[Suspect]:
    """Pendulums and poles that neither gravity nor what they hang on can swing."""
    of = model.simulation
    for joint, why in _still(of).items():
        value = _across(of, joint)
        names = (of.name("joint", joint), of.name("body", of.body_of("joint", joint)))
        probe = how_many("pendulums that nothing can swing", _still)
        now, edits = written(of.row("jnt_axis", joint, 3)), model.set("joint", [joint], "axis", value) if value else ()
        yield Suspect(
            names, "axis", now, value or "another one", edits, probe, 0, f"{names[0]} {why}.", "across the rod"
        )


def _twisting(model: ReaderModel) -> Iterator[Suspect]:
    """Elbows, knees and fingers that turn about their own length."""
    of = model.simulation
    if found := _twisted(of):
        first = of.row("jnt_axis", found[0], 3)
        names, probe = tuple(of.name("joint", each) for each in found), how_many("joints that twist", _twisted)
        says = f"The axis of {names[0]} goes along what it moves: it twists that, and does not bend."
        yield Suspect(names, "axis", written(first), "across the link", (), probe, 0, says, "across the link")


def _twisted(of: Simulation) -> list[int]:
    """The hinges called after a joint that bends, each alone on its body, whose axis goes along that."""
    of.as_written()
    welds, mass, made = of.model("body_weldid"), of.model("body_mass"), []
    for joint, name in enumerate(of.names("joint")):
        body = of.body_of("joint", joint)
        called = BENDS.search(name) and not TURNS.search(name)
        if not called or of.joint_type(joint) != HINGE or len(of.joints_of(body)) > 1:
            continue
        one = [each for each in of.below(body) if welds[each] == body]
        next_ones = [other for each in one for child in of.children.get(each, []) for other in of.joints_of(child)]
        ends = [of.data_row("xanchor", each, 3) for each in next_ones]
        ends = ends or [of.data_row("xipos", each, 3) for each in one if mass[each] > 0]
        ways = [sub(end, of.data_row("xanchor", joint, 3)) for end in ends]
        if all(norm(way) > FLAT and norm(cross(of.axis(joint), way)) < OFF * norm(way) for way in ways):
            made.append(joint)
    return made


def _still(of: Simulation) -> dict[int, str]:
    """The free hinges of what is called a pendulum or a pole that nothing can swing, and why."""
    of.as_written()
    made = {}
    for joint in range(of.count("joint")):
        body = of.body_of("joint", joint)
        called = any(map(PENDULUM.search, (of.names("joint")[joint], of.names("body")[body])))
        held = joint in of.drivers or of.model("jnt_stiffness")[joint]
        if not called or held or of.joint_type(joint) != HINGE or len(of.joints_of(body)) > 1:
            continue
        axis, rod = of.axis(joint), _rod(of, joint)
        above = _joints_up_from(of, of.parent(body))
        slides = [of.axis(each) for each in above if of.joint_type(each) == SLIDE]
        if norm(rod) > FLAT and norm(cross(axis, rod)) < OFF * norm(rod):
            made[joint] = "turns it about its own length, through its centre of mass: it spins and does not swing"
        elif slides and len(slides) == len(above) and all(norm(cross(axis, each)) < OFF for each in slides):
            made[joint] = "has the axis of the slide that carries it, whose motion swings nothing about that"
    return made


def _rod(of: Simulation, joint: int) -> Vector:
    """From a hinge to the centre of mass of what it turns, at the zero pose."""
    return sub(of.data_row("subtree_com", of.body_of("joint", joint), 3), of.data_row("xanchor", joint, 3))


def _across(of: Simulation, joint: int) -> str:
    """The axis across a rod along which what carries it swings it; empty where nothing carries it."""
    of.as_written()
    body, rod = of.body_of("joint", joint), _rod(of, joint)
    above = _joints_up_from(of, of.parent(body))
    if not above:
        return ""
    axis = cross(of.axis(above[0]), rod)
    if of.joint_type(above[0]) == HINGE:  # an arm that carries it round: its radius
        way = sub(of.data_row("xanchor", joint, 3), of.data_row("xanchor", above[0], 3))
        axis = sub(way, [dot(way, rod) / dot(rod, rod) * x for x in rod])
    local = times(transpose(of.data_row("xmat", body, 9)), unit(axis))
    side = -1 if min(local, key=lambda x: -abs(x)) < 0 else 1
    return written([round(side * x, 4) + 0.0 for x in local]) if norm(axis) > FLAT else ""


def _joints_up_from(of: Simulation, body: int) -> list[int]:
    """The joints of a body and of all that it hangs on."""
    return [joint for each in of.ancestors(body) for joint in of.joints_of(each)]


def _tilt(of: Simulation, joint: int) -> float:
    """The angle of a joint's axis to the vertical in degrees, at the zero pose."""
    of.as_written()
    return math.degrees(math.acos(min(1.0, abs(of.axis(joint)[2]))))


def _said(name: str) -> int | None:
    """The axis that a joint is called after; None where it says none, or two."""
    tokens = re.findall(r"[a-z0-9]+", re.sub(r"(?<=[a-z])([XYZ])(?![a-z])", r"_\1", name).lower())
    found = [AXES[token] for token in tokens if token in AXES]
    if not found and (ending := ENDING.search(f"_{name.lower()}")):
        found = [AXES[ending.group(1)]]
    return found[0] if len(found) == 1 else None


def _off(of: Simulation, joint: int, axis: int) -> float:
    """The angle in degrees between a slide and an axis, of the world or of its own frame, whichever is less."""
    most = max(abs(of.axis(joint)[axis]), abs(of.row("jnt_axis", joint, 3)[axis]))
    return math.degrees(math.acos(min(1.0, most)))


def _at_start(of: Simulation, joint: int, axis: int) -> float:
    of.begin()
    return _off(of, joint, axis)


def _along(of: Simulation, joint: int) -> int:
    axis = of.row("jnt_axis", joint, 3)
    return max(range(3), key=lambda each: abs(axis[each]))
