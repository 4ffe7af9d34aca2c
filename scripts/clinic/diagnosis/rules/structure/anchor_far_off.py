"""A connection's anchor lies far from both of its bodies.

The anchor of a `<connect>` is written in the frame of its first body. Written in the world's, it lies somewhere in the
air: the bodies are held to each other by a long invisible rod, and swing about a point where nothing is.

Bad:

    <mujoco>
      <worldbody>
        <body name="rod" pos="0.5 0 1">
          <freejoint/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
        </body>
        <body name="wall" pos="0.75 0 1">
          <geom type="box" size="0.02 0.05 0.05"/>
        </body>
      </worldbody>
      <equality>
        <connect body1="rod" body2="wall" anchor="0.72 0 1"/>
      </equality>
    </mujoco>

Good:

    -     <connect body1="rod" body2="wall" anchor="0.72 0 1"/>
    +     <connect body1="rod" body2="wall" anchor="0.22 0 0"/>

The number: the distance of the anchor from the nearer of the two bodies over that body's own size; more than 0.3, or
than 3 where it is on the line between the two, or where one of them is the world. Of 289 healthy models 12 connect
bodies, and all have 0. Where the same numbers, read as a place in the world, lie on a body, the edit is that place in
the first body's frame. An anchor on one body is told too where the other is more than 3 times its size away from it:
the two did not meet at the start, and the second is held by a place in the air. Or where it is more than 0.25 times the
size of a body away, and on both once a slip is undone: a sign or two numbers of the anchor, a place short of the rod's
end, the next link in place of this one, a sign in `euler` or `pos` of a body of the loop. Of 9 healthy models with such
anchors the most is 0.2.

When it is wrong: a rod that was left out of the drawing on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HFIELD, PLANE
from clinic.diagnosis.probes.equalities import CONNECT, ends, held, kind_of, sited
from clinic.diagnosis.probes.pins import from_ends, off, rod_ends
from clinic.diagnosis.probes.vector import Vector, norm, slips, sub, times, transpose, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "An anchor far from what it connects"
FAMILIES = ("drifts", "jumps-at-start", "explodes", "stuck", "wrong-numbers")
UNPLANTED = "the 81 models of the bench connect nothing by an anchor"

STRAIGHT = 1.02
FAR, AWAY = 0.3, 3.0  # times the body's size; the same for a rod or a string that is not drawn
OFF, ON, LONG = 0.25, 0.05, 12  # times the body's size; bodies of a loop
TRIES = 40  # slips that are compiled


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Connections of bodies whose anchor is in the air."""
    of = model.simulation
    for each in range(of.count("equality")):
        far = [*_in_the_air(model, each)]
        slip = [] if any(one.edits for one in far) else [*_slipped(model, each)]
        yield from slip or far or _phantom(of, each)


def _in_the_air(model: ReaderModel, each: int) -> Iterator[Suspect]:
    """A connection whose anchor is far from both bodies."""
    of, bodies = model.simulation, held(model.simulation, each)
    if (far := _far(of, each)) <= FAR:
        return
    most = AWAY if 0 in bodies or _between(of, each, bodies) else FAR
    if far <= most:
        return
    edits = _from_world(model, each, bodies)
    yield Suspect(
        tuple(of.name("body", body) for body in bodies),
        "anchor",
        written(_anchor(of, each)),
        edits[0].value if edits else "",
        edits,
        Probe("distance of an anchor from the nearer body", "times its size", _far, (each,), dynamic=False),
        most,
        f"The anchor is {far:.3g} times the size of the nearer body away from it; it is in the frame of the first.",
        "on one of the two bodies",
    )


def _phantom(of: Simulation, each: int) -> Iterator[Suspect]:
    """A connection that holds one body by a place that is far from all of it: the two did not meet at the start."""
    if (farther := _farther(of, each)) <= AWAY:
        return
    point = ends(of, each)[0]
    bodies = sorted(held(of, each), key=lambda body: _apart(of, point, (body,)), reverse=True)
    names = tuple(of.name("body", body) for body in bodies)
    probe = Probe("distance of an anchor from the farther body", "times its size", _farther, (each,), dynamic=False)
    says = f"At the start the anchor is {farther:.3g} times the size of {names[0]} away from it: the connection "
    says += f"keeps them so far apart. Put {names[0]} where it is to be held, or {names[1]} there."
    now = written(_anchor(of, each))
    yield Suspect(names, "anchor", now, "where both are", (), probe, AWAY, says, "on both bodies at the start")


def _slipped(model: ReaderModel, each: int) -> Iterator[Suspect]:
    """A connection that is off one of its bodies, and on both once a slip of the pen is undone."""
    of = model.simulation
    probe = Probe("distance of an anchor from a body", "times its size", off, (each,), dynamic=False)
    if (far := off(of, each)) <= OFF or not of.model("eq_active0")[each]:
        return
    ends_ = Probe("distance of an anchor from the ends of the rods", "m", from_ends, (each,), dynamic=False)
    met = [slip for slip in islice(_slips(model, each), TRIES) if slip[-1] and model.measured(probe, slip[-1]) <= ON]
    if not met:
        return
    name, attribute, now, value, edits = min(met, key=lambda slip: round(model.measured(ends_, slip[-1]), 6))
    names = tuple(of.name("body", body) for body in held(of, each))
    says = f"The anchor of {names[0]} and {names[1]} is {far:.2g} times the size of one of them away from it, and "
    says += f"with {attribute} {value} of {name} on both."
    told = tuple(dict.fromkeys((name, *names)))
    yield Suspect(told, attribute, now, value, edits, probe, OFF, says, "on both bodies at the start", level="hint")


def _slips(model: ReaderModel, each: int) -> Iterator[tuple[str, str, str, str, tuple[Edit, ...]]]:
    """What a slip may have been: the name of an element, an attribute, its value, another one, and the edits."""
    of, (one, other) = model.simulation, held(model.simulation, each)
    anchor, equality = _anchor(of, each), of.name("equality", each)
    for place in dict.fromkeys((*slips(anchor), *rod_ends(of, one))):
        edits = model.set("equality", [each], "anchor", written(place))
        yield equality, "anchor", written(anchor), written(place), edits
    bodies = of.names("body")
    for body in (of.parent(other), *of.children.get(other, [])) if other else ():
        if body and body != one and bodies[body]:
            edits = model.set("equality", [each], "body2", bodies[body])
            yield equality, "body2", bodies[other], bodies[body], edits
    lines = of.ancestors(one), of.ancestors(other)
    for body in [body for body in (*lines[0], *lines[1]) if not (body in lines[0] and body in lines[1])][:LONG]:
        for attribute in ("euler", "pos"):
            now = model.value("body", body, attribute) or ""
            for at, number in enumerate(numbers := now.split()):
                turned = number[1:] if number[0] == "-" else f"-{number}"
                value = " ".join([*numbers[:at], turned, *numbers[at + 1 :]])
                if float(number):
                    yield of.name("body", body), attribute, now, value, model.set("body", [body], attribute, value)


def _anchor(simulation: Simulation, each: int) -> Vector:
    return simulation.equality_data(each)[:3]


def _distances(of: Simulation, each: int) -> list[float]:
    """How far the anchor is at the start from each body that it holds, as in `_apart`; none where it holds sites."""
    if kind_of(of, each) != CONNECT or sited(of, each):
        return []
    of.begin()
    return [_apart(of, ends(of, each)[0], (body,)) for body in held(of, each) if body]


def _far(of: Simulation, each: int) -> float:
    return min(_distances(of, each), default=0.0)


def _farther(of: Simulation, each: int) -> float:
    return max(_distances(of, each), default=0.0)


def _between(of: Simulation, each: int, bodies: tuple[int, int]) -> bool:
    """Whether the anchor is on the line from one body to the other: on a rod that is not drawn."""
    of.begin()
    point, (one, other) = ends(of, each)[0], (of.data_row("xipos", body, 3) for body in bodies)
    return norm(sub(point, one)) + norm(sub(point, other)) < STRAIGHT * norm(sub(one, other))


def _apart(simulation: Simulation, point: Vector, bodies: tuple[int, ...]) -> float:
    """How far a point is from the nearest of some bodies, over that body's size; 0 where one has no geoms."""
    found, kinds = [], simulation.model("geom_type")
    for body in bodies:
        geoms = [geom for geom in simulation.geoms_of(body) if kinds[geom] not in (PLANE, HFIELD)]
        if body == 0:
            continue
        if not geoms:
            return 0.0
        reach = sum(simulation.model("geom_rbound")[geom] for geom in geoms)
        gaps = [
            norm(sub(point, simulation.data_row("geom_xpos", geom, 3))) - simulation.model("geom_rbound")[geom]
            for geom in geoms
        ]
        found.append(max(0.0, min(gaps)) / max(reach, 1e-9))
    return min(found, default=0.0)


def _from_world(model: ReaderModel, each: int, bodies: tuple[int, int]) -> tuple[Edit, ...]:
    """The anchor's numbers, read as a place in the world, in the frame of the first body."""
    of, point = model.simulation, _anchor(model.simulation, each)
    of.begin()
    if _apart(of, point, bodies) > 0.5:
        return ()
    turn, place = of.data_row("xmat", bodies[0], 9), of.data_row("xpos", bodies[0], 3)
    return model.set("equality", [each], "anchor", written(times(transpose(turn), sub(point, place))))
