"""Two fingers that are coupled move the same way, so that the gap between them never changes.

The factor of the coupling and the axes of two slides belong together: with opposite axes it is 1, with the same axis
-1. With one of the signs wrong a gripper carries its fingers to and fro, and grasps nothing.

Bad:

    <mujoco>
      <worldbody>
        <body name="left" pos="0.03 0 1">
          <joint name="left" type="slide" axis="1 0 0" range="0 0.04"/>
          <geom type="box" size="0.01 0.01 0.04"/>
        </body>
        <body name="right" pos="-0.03 0 1">
          <joint name="right" type="slide" axis="1 0 0" range="0 0.04"/>
          <geom type="box" size="0.01 0.01 0.04"/>
        </body>
      </worldbody>
      <equality>
        <joint joint1="left" joint2="right"/>
      </equality>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="left" pos="0.03 0 1">
          <joint name="left" type="slide" axis="1 0 0" range="0 0.04"/>
          <geom type="box" size="0.01 0.01 0.04"/>
        </body>
        <body name="right" pos="-0.03 0 1">
          <joint name="right" type="slide" axis="-1 0 0" range="0 0.04"/>
          <geom type="box" size="0.01 0.01 0.04"/>
        </body>
      </worldbody>
      <equality>
        <joint joint1="left" joint2="right"/>
      </equality>
    </mujoco>

The number: how far the two move the same way, as a share of how far they move; 0 for fingers that close, 1 for two that
keep their distance. The axis is turned where the coupling leads within the range, and else the factor. Two slides that
nothing couples are compared too, where they have one range and are on both sides of the body that carries them.

When it is wrong: a telescope, whose stages follow each other; they do not hang on one body.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.vector import add, dot, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.joint.follower_out_of_range import couplings, lost
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Fingers that move the same way"
FAMILIES = ("stuck", "slips")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "no healthy model has two slides that are coupled"

MOST, ACROSS = 0.9, 0.8


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Slides of one body that do not change their distance, coupled or not."""
    yield from _uncoupled(model)
    of = model.simulation
    parents, bodies = of.model("body_parentid"), of.model("jnt_bodyid")
    for each, coupling in couplings(of):
        follower, leader, factors = coupling
        hang = {parents[int(bodies[joint])] for joint in (follower, leader)}
        kinds = {of.joint_type(joint) for joint in (follower, leader)}
        if len(hang) > 1 or kinds != {SLIDE} or _together(of, each) <= MOST:
            continue
        element, joint = model.element("equality", each), model.element("joint", follower)
        if element is None or joint is None:
            continue
        turned = written([-x for x in of.row("jnt_axis", follower, 3)])
        coefficients = written([factors[0], *(-x for x in factors[1:])])
        within = lost(of, (coupling,)) <= 0.5
        edit = set_attribute(joint, "axis", turned) if within else set_attribute(element, "polycoef", coefficients)
        yield Suspect(
            tuple(of.name("joint", joint) for joint in (follower, leader)),
            edit.attribute,
            "",
            edit.value,
            (edit,),
            Probe("share of their way that two fingers go together", "", _together, (each,), dynamic=False),
            MOST,
            f"{of.name('joint', follower)} goes where {of.name('joint', leader)} goes: the gap never changes.",
            "fingers that close",
        )


def _uncoupled(model: ReaderModel) -> Iterator[Suspect]:
    """Two slides of one body with one range, on both sides of it, that go the same way."""
    of = model.simulation
    of.begin()
    parents, bodies = of.model("body_parentid"), of.model("jnt_bodyid")
    led = {follower for _, (follower, _, _) in couplings(of)} | {leader for _, (_, leader, _) in couplings(of)}
    slides = [j for j in range(of.count("joint")) if of.joint_type(j) == SLIDE and of.model("jnt_limited")[j]]
    by_parent: dict[int, list[int]] = {}
    for joint in slides:
        if joint not in led and len(of.joints_of(int(bodies[joint]))) == 1:
            by_parent.setdefault(int(parents[int(bodies[joint])]), []).append(joint)
    for parent, two in by_parent.items():
        if len(two) != 2 or parent == 0 or _parallel(of, *two) <= MOST:
            continue
        turned = written([-x for x in of.row("jnt_axis", two[1], 3)])
        probe = Probe("share of their way that two fingers go together", "", _parallel, tuple(two), dynamic=False)
        names = tuple(of.name("joint", joint) for joint in two)
        says = f"{names[1]} goes where {names[0]} goes at equal controls: the gap never changes."
        edits = model.set("joint", [two[1]], "axis", turned)
        now = written(of.row("jnt_axis", two[1], 3))
        yield Suspect(names, "axis", now, turned, edits, probe, MOST, says, "fingers that close")


def _parallel(simulation: Simulation, one: int, other: int) -> float:
    """The cosine between two slides of one range that lie on both sides along their axes; 0 for others."""
    simulation.begin()
    ways = [simulation.data_row("xaxis", joint, 3) for joint in (one, other)]
    places = [simulation.data_row("xipos", int(simulation.model("jnt_bodyid")[joint]), 3) for joint in (one, other)]
    between = sub(*places)
    alike = simulation.row("jnt_range", one, 2) == simulation.row("jnt_range", other, 2)
    beside = abs(dot(between, ways[0])) > ACROSS * norm(between)
    return dot(*ways) if alike and beside else 0.0


def _together(simulation: Simulation, equality: int) -> float:
    follower, leader, factors = next(found for each, found in couplings(simulation) if each == equality)
    simulation.begin()
    ways = [simulation.data_row("xaxis", joint, 3) for joint in (follower, leader)]
    own = tuple(factors[1] * x for x in ways[0])
    return norm(add(own, ways[1])) / max(norm(add(own, ways[1])) + norm(sub(own, ways[1])), 1e-9)
