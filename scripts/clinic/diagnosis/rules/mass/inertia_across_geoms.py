"""The principal axes of the inertia lie across those of the geoms.

`diaginertia` without the `quat` that turns it, or its numbers in another order: a long link is then heavy to spin about
its own axis and light to swing.

Bad:

    <mujoco>
      <worldbody>
        <body name="link" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0 0 0.2" mass="1" diaginertia="0.0002 0.0135 0.0135"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.4" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <inertial pos="0 0 0.2" mass="1" diaginertia="0.0002 0.0135 0.0135"/>
    +       <inertial pos="0 0 0.2" mass="1" diaginertia="0.0135 0.0135 0.0002"/>

The number: the inertia about the longest axis of the geoms, where the mean of the three is 1; more than 1 is told. A
thin rod has 0 about its axis and 1.5 across. Of 249 long bodies of healthy robots, whose geoms have at most 0.3, none
has more than 0.9. Where the geoms have up to 0.5, more than 1.2 is told of a trunk, and of a body whose `diaginertia`
alone lacks the `quat` that the others' have. What makes whole turns, as wheels do, is the other way round: where the
geoms have more than 1.25 about their own axis, less than 0.9 is a hint; so it is where the body has the very numbers of
its geoms, and about another axis.

When it is wrong: a long cover around a flat motor; a hand, whose motor lies across it. In four of 160 models of other
people that had another fault a hand or a finger was so: a hint.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.inertia import inertial, set_inertial
from clinic.diagnosis.probes.matter import Matter, across, explicit, flat
from clinic.diagnosis.probes.vector import dot, norm
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import ENDLESS
from clinic.diagnosis.source import ORIENTATIONS
from clinic.diagnosis.suspect import Suspect

TITLE = "The inertia lies across the body"
FAMILIES = ("drifts", "oscillates", "wrong-mass", "wrong-numbers")
AFLOAT = True
LEVEL = "hint"

LONG, LIMIT = 0.3, 1.0
STOUT, ACROSS, OTHERS = 0.5, 1.2, 3
FLAT, OFF, ALONG, SAME = 1.25, 1.1, 0.95, 0.01


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Long bodies that are heavy to spin about their long axis, and wheels that are light about their own."""
    wheels = {}
    for body, found in explicit(model):
        moments = model.simulation.row("body_inertia", body, 3)
        geoms, own = found.along
        disk = found.flat[0] > FLAT and min(moments) < 0.7 * max(moments)
        same = found.flat[0] > OFF and abs(3 * max(moments) / sum(moments) - found.flat[0]) < SAME
        if (disk or same) and found.flat[1] < 1 / OFF and _rolls(model, body, found):
            wheels[body] = found.flat, _turned(model, body, found)
        stout = (
            LONG < geoms < STOUT
            and own > ACROSS
            and (body in model.simulation.free_bodies or _turn_left_out(model, body))
        )
        if (geoms > LONG and not stout) or own <= LIMIT or min(moments) > 0.6 * max(moments):
            continue
        yield Suspect(
            (model.simulation.name("body", body),),
            "inertial",
            _quat(model, body),
            "axes of the geoms",
            _turned(model, body, found),
            across(body),
            LIMIT,
            f"Its geoms are long: their inertia about the long axis is {geoms:.2g} of the mean, its own {own:.2g}.",
            "below 1: at most 0.9 in 249 long bodies of healthy robots",
            excess=own,
        )
    if wheels:
        geoms, own = min((each for each, _ in wheels.values()), key=lambda each: each[1])
        yield Suspect(
            tuple(model.simulation.name("body", body) for body in wheels),
            "inertial",
            _quat(model, next(iter(wheels))),
            "axes of the geoms",
            tuple(edit for _, edits in wheels.values() for edit in edits),
            flat(*wheels),
            OFF,
            f"Its geoms are flat: their inertia about their own axis is {geoms:.3g} of the mean, its own {own:.2g}.",
            "a disk has 1.5, a wheel as wide as its radius 1.2",
            level="hint",
        )


def _quat(model: ReaderModel, body: int) -> str:
    element = inertial(model, body)
    return "quat " + ((element.get("quat") if element is not None else "") or "left out")


def _turn_left_out(model: ReaderModel, body: int) -> bool:
    """Whether `diaginertia` stands without the turn that it has in nearly all other bodies."""
    of = model.simulation
    written = [each for one in range(1, of.count("body")) if (each := inertial(model, one)) is not None]
    turned = [any(each.get(name) for name in ORIENTATIONS) for each in written if each.get("diaginertia")]
    own = inertial(model, body)
    bare = own is not None and bool(own.get("diaginertia")) and not any(own.get(name) for name in ORIENTATIONS)
    return bare and sum(turned) >= max(OTHERS, 0.7 * len(turned))


def _rolls(model: ReaderModel, body: int, found: Matter) -> bool:
    """Whether it makes a whole turn about the axis across which its geoms are flat, as wheels and flanges do."""
    of = model.simulation
    return any(
        of.joint_type(joint) == HINGE
        and _way(of.ranges.get(joint, ENDLESS)) > math.tau
        and abs(dot(of.row("jnt_axis", joint, 3), found.short)) > ALONG
        for joint in of.joints_of(body)
    )


def _way(range_: tuple[float, ...]) -> float:
    return range_[1] - range_[0]


def _turned(model: ReaderModel, body: int, found: Matter) -> tuple[Edit, ...]:
    """The edits that give a body as much inertia as it has, about the axes of its geoms."""
    scale = norm(found.about) / norm(found.solid)
    return tuple(set_inertial(model, body, found.mass, found.centre, tuple(scale * x for x in found.solid)))
