"""Two joints of one body turn about the same line, or slide along the same direction.

Two corners of a mouth, two ends of a door: one hinge turns about the line through both. A second one on that line adds
no motion, only a number that nothing determines. Where neither has armature, MuJoCo warns that the inertia matrix is
too close to singular.

Bad:

    <mujoco>
      <worldbody>
        <body name="door" pos="0 0 1">
          <joint name="hinge_low" axis="0 0 1" pos="0 0 -0.4"/>
          <joint name="hinge_high" axis="0 0 1" pos="0 0 0.4"/>
          <geom type="box" size="0.3 0.02 0.5" pos="0.3 0 0" mass="5"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="hinge_high" axis="0 0 1" pos="0 0 0.4"/>

The number: joints of a body that move it as one before them does: hinges whose axes lie within 1 % of the model's size
on one line, and slides that are parallel. Three links and more of a chain, each with one hinge, that all turn about one
line are told as a hint: the chain twists and does not bend. Where no axis is written, z is the axis, along the links.
Two rings, one on the other, are told where their names say two of the turns roll, pitch and yaw.

When it is wrong: two motors on one shaft, each with an armature of its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.key import rekeyed
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.probes.vector import Vector, cross, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "Joints that turn about one line"
FAMILIES = ("explodes", "drifts")
LEVEL = "cause"
UNPLANTED = "a second joint on the line of the first is a fault at every strength"

LINKS = 3
AXES = {"roll": 0, "pitch": 1, "tilt": 1, "yaw": 2, "pan": 2}
TURNS = re.compile(rf"(?i)(?<![a-z])({'|'.join(AXES)})(?![a-z])")
ALONG = 0.5  # of a unit vector
NEAR, PARALLEL = 0.01, 0.001  # of the model's extent; the sine of an angle


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints that move their bodies as one before them, and the hinges of a chain on one line, all together."""
    yield from _twisted(model)
    yield from _rings(model)
    of, source = model.simulation, model.source
    again = _again(of)
    if not again:
        return
    places = [model.element("joint", joint) for joint in again]
    edits = tuple(delete(each) for each in places if each is not None) if all(places) and source else ()
    edits += rekeyed(model, taken=again) if edits else ()
    singular = model.measured(_singular()) > 0
    probe = _singular() if singular else how_many("joints that move a body as another", _again)
    names = tuple(of.name("joint", joint) for pair in again.items() for joint in pair)
    what = "turns about the line" if of.joint_type(next(iter(again))) == HINGE else "slides along the direction"
    says, value = f"{names[0]} {what} of {names[1]}.", f"without {names[0]}"
    yield Suspect(names, "", "", value, edits, probe, 0.0, says, level="cause" if singular else "hint")


def _twisted(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges of a chain that only twists: balls are meant where nobody wrote their axes and nothing drives them."""
    of = model.simulation
    if not (found := _in_line(of)):
        return
    bare = all(model.value("joint", joint, "axis") is None and joint not in of.drivers for joint in found)
    edits = model.set("joint", found, "type", "ball") if bare and not model.urdf else ()
    names = tuple(of.name("joint", joint) for joint in found)
    says = f"{len(found)} links of a chain turn about one line, that of {names[0]}: it twists and does not bend."
    attribute, now, value = ("type", "hinge", "ball") if bare else ("axis", "along the chain", "across it")
    probe = how_many("hinges of a chain on one line", _in_line)
    yield Suspect(names, attribute, now, value, edits, probe, 0, says, "a chain that bends", level="hint")


def _rings(model: ReaderModel) -> Iterator[Suspect]:
    """The pairs of hinges on one line whose names say two turns; the odd one gets the axis that its name says."""
    of = model.simulation
    for pair in _gimbals(of):
        axes = {joint: of.row("jnt_axis", joint, 3) for joint in pair}
        odd, said = next(
            (each for each in _said(of, *pair).items() if abs(axes[each[0]][each[1]]) < ALONG), (pair[0], -1)
        )
        names = tuple(of.name("joint", joint) for joint in sorted(pair, key=lambda joint: joint != odd))
        value = written([float(i == said) for i in range(3)]) if said >= 0 else ""
        says = f"{of.name('joint', pair[0])} turns about the line of {of.name('joint', pair[1])}, on which it hangs."
        probe = how_many("hinges on the line of another that is called another turn", _gimbals)
        edits = model.set("joint", [odd], "axis", value) if value else ()
        yield Suspect(names, "axis", written(axes[odd]), value, edits, probe, 0, says, "two axes", level="hint")


def _said(of: Simulation, *joints: int) -> dict[int, int]:
    """The axis that a joint is called after, of those that are called after one."""
    found = {joint: TURNS.findall(of.names("joint")[joint]) for joint in joints}
    return {joint: AXES[words[0].lower()] for joint, words in found.items() if len(words) == 1}


def _gimbals(of: Simulation) -> list[tuple[int, int]]:
    """The hinges that are called after another turn than the one that they hang on, and lie on its line; with it."""
    of.begin()
    near, made = NEAR * of.extent, []
    for joint in range(of.count("joint")):
        body = of.body_of("joint", joint)
        above = of.joints_of(of.parent(body))
        if len(above) == len(of.joints_of(body)) == 1:
            pair = joint, above[0]
            hinges = all(of.joint_type(each) == HINGE for each in pair)
            if hinges and len({*_said(of, *pair).values()}) == len(pair) and _same_line(of, *pair, near):
                made.append(pair)
    return made


def _in_line(of: Simulation) -> list[int]:
    """The hinges of three links and more that hang on each other, each with this joint alone, on one line."""
    of.begin()
    chains: dict[int, list[int]] = {}
    for body in of.moving_bodies:
        joints, above = of.joints_of(body), chains.get(of.parent(body), [])
        if len(joints) == 1 and of.joint_type(joints[0]) == HINGE:
            on_line = above and _same_line(of, joints[0], above[-1], NEAR * norm(_apart(of, joints[0], above[-1])))
            chains[body] = [*(above if on_line else []), joints[0]]
    return sorted({joint for chain in chains.values() if len(chain) >= LINKS for joint in chain})


def _same_line(of: Simulation, joint: int, other: int, near: float) -> bool:
    """Whether a joint has the axis of another one, and is nearer to it than `near`, in m; a slide wherever it is."""
    axis = of.axis(joint)
    parallel = norm(cross(axis, of.axis(other))) < PARALLEL
    return parallel and (of.joint_type(joint) == SLIDE or norm(cross(axis, _apart(of, joint, other))) < near)


def _apart(of: Simulation, joint: int, other: int) -> Vector:
    return sub(of.data_row("xanchor", joint, 3), of.data_row("xanchor", other, 3))


def _again(of: Simulation) -> dict[int, int]:
    """The joints that move their bodies as one before them, with that."""
    of.begin()
    near, made = NEAR * of.extent, dict[int, int]()
    for body in of.moving_bodies:
        joints = [joint for joint in of.joints_of(body) if joint in of.scalar_joints]
        for place, joint in enumerate(joints):
            for other in joints[:place]:
                if of.joint_type(joint) == of.joint_type(other) and _same_line(of, joint, other, near):
                    made.setdefault(joint, other)
    return made


def _singular() -> Probe:
    return Probe("warnings that the inertia matrix is singular", "", _warned)


def _warned(of: Simulation) -> float:
    return float(let_go(of).warnings.get("INERTIA", 0))
