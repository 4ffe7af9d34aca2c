"""Loops and couplings leave a driven joint no way to go.

One connection too much, the wrong body, a `weld` where a pin is meant, a pin with another axis than the others of a
planar linkage, or a pin that was forgotten: what is connected is a frame, not a mechanism. The motor pulls at it, and
the constraints, which are soft, creak.

Bad:

    <mujoco>
      <worldbody>
        <body name="crank" pos="0 0 0.2">
          <joint name="crank" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.1" size="0.01" contype="0"/>
          <body name="coupler" pos="0 0 0.1">
            <joint name="pin" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0.1" size="0.01" contype="0"/>
          </body>
        </body>
        <body name="rocker" pos="0.3 0 0.2">
          <joint name="rocker"/>
          <geom type="capsule" fromto="0 0 0 0 0 0.2" size="0.01" contype="0"/>
        </body>
      </worldbody>
      <equality>
        <connect body1="coupler" body2="rocker" anchor="0.3 0 0.1"/>
      </equality>
      <actuator>
        <motor joint="crank" ctrlrange="-5 5"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="rocker"/>
    +       <joint name="rocker" axis="0 1 0"/>

The number: of how fast a driven joint would tear the connections open if it moved alone, the share that no motion of
all the other joints takes away; 0 in a mechanism, 1 where nothing else gives way. More than 0.1. At the start, by small
motions of one joint after the other. Where all hinges are parallel, and one of the loop's bodies has no joint, and with
a hinge like the others all of them move, that is the edit. And where one weld holds a body that three connections and
more hold too, and the loops leave fewer motions than there are motors, but not with a connection in its place, the weld
is told.

When it is wrong: a joint that an equality locks for a while, until code sets it free. What a mocap body pulls is left
alone.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit, insert, replace
from clinic.diagnosis.engine import BALL, FREE, HINGE
from clinic.diagnosis.probes import tendons
from clinic.diagnosis.probes.equalities import (
    CONNECT,
    COUPLED,
    WELD,
    by_mocap,
    ends,
    frames,
    held,
    kind_of,
    off_course,
    sited,
)
from clinic.diagnosis.probes.vector import across, dot, sub, times, transpose, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import WIDTH, Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A mechanism that its loops lock"
FAMILIES = ("stuck", "drifts")
UNPLANTED = "the healthy models have few loops"

MOST, SMALL = 0.1, 1e-3  # shares of how fast a joint tears at the connections
PARALLEL, ACROSS = 0.999, 0.9  # cosines of the angles between hinges
STEP = 1e-5  # rad, m
LARGE, FEW, PINS = 80, 12, 3  # degrees of freedom; equalities that are tried; connections beside a weld
Column = tuple[float, ...]


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Driven joints that connections hold, all together."""
    of = model.simulation
    if not any(of.model("eq_active0")) or of.count("dof") > LARGE:
        return
    welded = [*_among_pins(model)]
    yield from welded
    if welded:
        return
    stuck = {joint: share for joint in _driven(of) if (share := _held(of, joint)) > MOST}
    if not stuck:
        return
    worst = max(stuck, key=lambda joint: stuck[joint])
    names = [of.name("joint", joint) for joint in sorted(stuck, key=lambda joint: -stuck[joint])]
    probe = Probe("what no other joint takes away of a joint's pull at the connections", "", _most, tuple(stuck))
    active = [each for each, on in enumerate(of.model("eq_active0")) if on][:FEW]
    holds = [
        each
        for each in active
        if (edits := model.set("equality", [each], "active", "false")) and model.measured(probe, edits) <= MOST
    ]
    says = f"{names[0]} is driven, and no motion of the other joints lets it move: of its pull at the equalities "
    says += f"{100 * stuck[worst]:.0f} % is left."
    if holds:
        says += f" Without {' or '.join(of.name('equality', each) for each in holds[:3])} it would."
    odd, edits = _across(model), tuple[Edit, ...]()
    if odd is not None:
        edits = model.set("joint", [odd], "axis", written(_others_axis(of, odd)))
        if edits and model.measured(probe, edits) <= MOST:
            says += f" {of.name('joint', odd)} turns about another axis than all other hinges."
        else:
            odd, edits = None, ()
    if odd is None and (pinned := _without_pin(model, holds, probe)) is not None:
        body, edits = pinned
        name = of.name("body", body)
        says += f" {name} has no joint, and with a hinge like the others the loop moves."
        told = (name, *names, *(of.name("equality", each) for each in holds))
        value = edits[0].value
        yield Suspect(told, "joint", "", value, edits, probe, MOST, says, "a loop that moves", level="hint")
        return
    yield Suspect(
        (*names, *(of.name("equality", each) for each in holds), *([] if odd is None else [of.name("joint", odd)])),
        "equality" if odd is None else "axis",
        "" if odd is None else model.value("joint", odd, "axis") or "",
        "the bodies, anchors and axes of its loop" if not edits else edits[0].value,
        edits,
        probe,
        MOST,
        says,
        "a loop that moves",
        at=model.element("equality", holds[0]) if holds else None,
    )


def _among_pins(model: ReaderModel) -> Iterator[Suspect]:
    """The one weld to a body among connections, where it leaves fewer motions than there are motors."""
    of, motors = model.simulation, len(_driven(model.simulation))
    active = [each for each, on in enumerate(of.model("eq_active0")) if on and not by_mocap(of, each)]
    welds = [each for each in active if kind_of(of, each) == WELD]
    pins = [each for each in active if kind_of(of, each) == CONNECT]
    if len(welds) != 1 or (element := model.element("equality", welds[0])) is None:
        return
    (weld,) = welds
    like = [each for each in pins if sited(of, each) == sited(of, weld) and {*held(of, each)} & {*held(of, weld)} - {0}]
    probe = Probe("motors less the motions that the loops leave", "", _short_of, dynamic=False)
    if len(like) < PINS or model.measured(probe) <= 0:
        return
    xml = re.sub(r"""\s(?:relpose|torquescale|anchor)\s*=\s*("[^"]*"|'[^']*')""", "", model.text_of(element))
    anchor = "" if sited(of, weld) else f' anchor="{model.value("equality", like[0], "anchor") or "0 0 0"}"'
    edits = (replace(element, re.sub(r"^<weld\b", f"<connect{anchor}", xml)),)
    if model.measured(probe, edits) > 0:
        return
    name, others = of.name("equality", weld), ", ".join(of.name("equality", each) for each in like[:3])
    says = f"{name} is a weld, and {others} are connections to the same body. The loops leave {motors} motors "
    says += f"{motors - int(model.measured(probe))} motions; with a connection, as many as there are motors, or more."
    yield Suspect((name,), "weld", "weld", "connect", edits, probe, 0, says, "a motion for each motor", level="hint")


def _short_of(of: Simulation) -> float:
    """How many motors there are more than motions that the loops leave."""
    return len(_driven(of)) - (of.count("dof") - len(_spanned(_columns(of))))


def _without_pin(model: ReaderModel, holds: Sequence[int], probe: Probe) -> tuple[int, tuple[Edit, ...]] | None:
    """The one body of the loops that has no joint, where a hinge like all others lets them move, with the edit."""
    of, found = model.simulation, dict[int, tuple[Edit, ...]]()
    of.begin()
    axes = [of.axis(joint) for joint in range(of.count("joint")) if of.joint_type(joint) == HINGE]
    if len(axes) < 2 or any(abs(dot(axes[0], each)) < PARALLEL for each in axes):
        return None
    for each in holds:
        bodies = [of.body_of("site", one) if sited(of, each) else max(one, 0) for one in held(of, each)]
        lines = [of.ancestors(body) for body in bodies]
        for body in (body for body in (*lines[0], *lines[1]) if not (body in lines[0] and body in lines[1])):
            element = model.element("body", body)
            if element is not None and not of.joints_of(body) and body not in found:
                axis = times(transpose(of.data_row("xmat", body, 9)), axes[0])
                edits = (insert(element, f'<joint type="hinge" axis="{written([round(x, 6) for x in axis])}"/>'),)
                if model.measured(probe, edits) <= MOST:
                    found[body] = edits
    return next(iter(found.items())) if len(found) == 1 else None


def _across(model: ReaderModel) -> int | None:
    """The one hinge that is not parallel to the others, of which there are two at least; else None."""
    of = model.simulation
    of.begin()
    hinges = [joint for joint in range(of.count("joint")) if of.joint_type(joint) == HINGE]
    axes = {joint: of.axis(joint) for joint in hinges}
    for odd in hinges:
        others = [axes[joint] for joint in hinges if joint != odd]
        if len(others) > 1 and all(abs(dot(others[0], each)) > PARALLEL for each in others):
            return odd if abs(dot(axes[odd], others[0])) < ACROSS else None
    return None


def _others_axis(of: Simulation, odd: int) -> Column:
    """The axis of the other hinges in the frame of a joint's body."""
    of.begin()
    other = next(each for each in range(of.count("joint")) if each != odd and of.joint_type(each) == HINGE)
    body = of.body_of("joint", odd)
    axis = times(transpose(of.data_row("xmat", body, 9)), of.axis(other))
    return tuple(round(x, 6) + 0.0 for x in axis)


def _driven(of: Simulation) -> list[int]:
    """The hinges and slides that actuators drive, themselves or by a fixed tendon."""
    found = list(of.drivers)
    found += [joint for tendon in tendons.pulled(of).values() for joint, _ in tendons.joints_of(of, tendon)]
    return list(dict.fromkeys(found))


def _most(of: Simulation, *joints: int) -> float:
    return max(_held(of, joint) for joint in joints)


def _held(of: Simulation, joint: int) -> float:
    """What is left of a joint's column once all others are taken out of it, as a share of it."""
    columns = _columns(of)
    dof = of.dof(joint)
    own = columns[dof]
    size = math.hypot(*own)
    if size < SMALL:
        return 0.0
    spanned = _spanned([column for each, column in enumerate(columns) if each != dof])
    return math.hypot(*_without(own, spanned)) / size


def _spanned(columns: Sequence[Column]) -> list[Column]:
    """Directions at right angles to each other that span some columns."""
    made: list[Column] = []
    for column in columns:
        left = _without(column, made)
        rest = math.hypot(*left)
        if rest > SMALL * max(math.hypot(*column), 1e-6):
            made.append(tuple(x / rest for x in left))
    return made


def _without(column: Column, directions: Sequence[Column]) -> Column:
    """A column without its parts along directions of length 1; twice, for what rounding leaves."""
    for direction in (*directions, *directions):
        column = across(column, direction)
    return column


@kept
def _columns(of: Simulation) -> list[Column]:
    """How fast each degree of freedom opens the connections; translations alone of a free joint, none of a ball."""
    of.begin()
    rest, start = _gaps(of), list(of.data("qpos"))
    made: list[Column] = [(0.0,) * len(rest)] * of.count("dof")
    for joint in range(of.count("joint")):
        kind, place = of.joint_type(joint), of.place(joint)
        for each in range(WIDTH[kind][1]):
            of.engine.write("qpos", _moved(start[place : place + WIDTH[kind][0]], kind, each), place)
            of.engine.forward()
            made[of.dof(joint) + each] = tuple((x - y) / STEP for x, y in zip(_gaps(of), rest, strict=True))
            of.engine.write("qpos", start, 0)
    return made


def _moved(position: Sequence[float], kind: int, each: int) -> list[float]:
    """A joint's position after a small motion in one of its degrees of freedom."""
    made = list(position)
    if kind == BALL or (kind == FREE and each > 2):
        first, axis = (0, each) if kind == BALL else (3, each - 3)
        w, x, y, z = made[first : first + 4]
        turned = ((-x, w, z, -y), (-y, -z, w, x), (-z, y, -x, w))[axis]
        made[first : first + 4] = [a + 0.5 * STEP * b for a, b in zip((w, x, y, z), turned, strict=True)]
    else:
        made[each] += STEP
    return made


def _gaps(of: Simulation) -> Column:
    """How far apart, and turned, is what the active equalities hold together."""
    made: list[float] = []
    for each, active in enumerate(of.model("eq_active0")):
        if not active or by_mocap(of, each):
            continue
        kind = kind_of(of, each)
        made += [off_course(of, each)] if kind == COUPLED else _apart(of, each) if kind in (CONNECT, WELD) else []
        made += _turned(of, each) if kind == WELD else []
    return tuple(made)


def _apart(of: Simulation, each: int) -> Sequence[float]:
    """From one place that is to be held to the other, in the axes of the body that both hang on."""
    bodies = [of.body_of("site", one) if sited(of, each) else max(one, 0) for one in held(of, each)]
    common = next(body for body in of.ancestors(bodies[0]) if body in of.ancestors(bodies[1]))
    return times(transpose(of.data_row("xmat", common, 9)), sub(*ends(of, each)))


def _turned(of: Simulation, each: int) -> list[float]:
    """The cosines between the axes of both; a turn weighs as much as the way that it moves the far end."""
    one, other = (transpose(axes) for _, axes in frames(of, each))
    size = max(of.extent, 1e-6)
    columns = [(one[3 * i : 3 * i + 3], other[3 * j : 3 * j + 3]) for i in range(3) for j in range(3)]
    return [size * 0.5 * dot(a, b) for a, b in columns]
