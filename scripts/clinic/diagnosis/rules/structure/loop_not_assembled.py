"""A loop is not closed where the model starts, and snaps together in the first steps.

An equality pulls what it holds together from wherever it begins. One of two sites, or a `<weld>` with its own
`relpose`, says where that is: when the links do not meet there, the first step begins with a blow, and the mechanism
may lock in the wrong branch.

Bad:

    <mujoco>
      <worldbody>
        <body name="crank" pos="0 0 1">
          <joint axis="0 1 0" damping="0.5"/>
          <geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.02"/>
          <site name="pin" pos="0.2 0 0"/>
        </body>
        <body name="rocker" pos="0.5 0 1">
          <joint axis="0 1 0" damping="0.5"/>
          <geom type="capsule" fromto="0 0 0 -0.25 0 0" size="0.02"/>
          <site name="hole" pos="-0.4 0 0"/>
        </body>
      </worldbody>
      <equality>
        <connect site1="pin" site2="hole"/>
      </equality>
    </mujoco>

Good:

    -       <site name="hole" pos="-0.4 0 0"/>
    +       <site name="hole" pos="-0.3 0 0"/>

The number: how far apart the two places are at the start that an equality holds together, as a share of the model's
extent; below 1 % is well. The second site is moved to where the first one is, or `relpose` is left out, so that the
start counts as assembled. But where all but a thousandth of the gap goes once two numbers in the `pos` of one site or
body of the loop are exchanged, or one there or in its orientation has another sign, or once a body without an
orientation is turned about its own hinge, or the equality holds the one other site that is in the place of one end,
that is the edit; of several the one that makes the model smallest, a turn last. From a keyframe it is a hint.

When it is wrong: something that is to be pulled in. Bodies that are moved by `mocap` are left out, but for a weld with
a `relpose` of its own that puts the other body more than 10 % of the extent away.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.equalities import CONNECT, WELD, by_mocap, ends, gap, held, kind_of, sited
from clinic.diagnosis.probes.vector import (
    Vector,
    across,
    cross,
    dot,
    flipped,
    norm,
    numbers,
    slips,
    sub,
    times,
    transpose,
    unit,
    written,
)
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.structure.equality_copied import copied_ends
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import ORIENTATIONS
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A loop that is not closed at the start"
FAMILIES = ("jumps-at-start", "explodes", "stuck")
CASE = "linkage-jumps-at-start"
UNPLANTED = "the healthy models connect and weld nothing but what is moved by mocap"

CLOSED, MANY, LONG = 1e-3, 3, 12  # of the gap; loops that are open; bodies of a loop
LEFT_OUT = "left out"
APART, PUSHED = 0.01, 0.1  # of the model's extent; where mocap moves one of the two


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Connections and welds that hold together what is apart."""
    of = model.simulation
    copied = {each for each, _ in copied_ends(of)}
    for each in range(of.count("equality")):
        apart, pulled = _gap(of, each), by_mocap(of, each)
        if (
            each in copied
            or apart <= (PUSHED if pulled else APART)
            or (pulled and not model.value("equality", each, "relpose"))
        ):
            continue
        edits = _edits(model, each) if of.begin_with.key < 0 else ()
        kind, attribute, now = ("site", "pos", "") if sited(of, each) else ("body", "relpose", "")
        names = tuple(of.name(kind, it) for it in held(of, each))
        far = 1000 * apart * of.extent
        says = f"They are {far:.3g} mm apart at the start, and are to be in one place."
        if edits and sited(of, each) and (slip := _slip(model, each)) is not None:
            odd, attribute, now, edits = slip
            says = f"{names[0]} and {names[1]} are {far:.3g} mm apart at the start; with this value they meet."
            names = tuple(dict.fromkeys((odd, *names)))
        probe = Probe("gap that an equality has to close at the start", "of the extent", _gap, (each,), dynamic=False)
        value = edits[-1].value if edits else ""
        yield Suspect(names, attribute, now, value, edits, probe, APART, says, "closed at the start")


def _slip(model: ReaderModel, each: int) -> tuple[str, str, str, tuple[Edit, ...]] | None:
    """What of a loop closes it by a slip of the pen undone: its name, the attribute, its value and the edits."""
    of, ends_ = model.simulation, held(model.simulation, each)
    bodies = [of.body_of("site", it) for it in ends_]
    if len(_apart(of)) > MANY or model.urdf:
        return None
    lines = [of.ancestors(body) for body in bodies]
    loop = [body for body in (*lines[0], *lines[1]) if not (body in lines[0] and body in lines[1])][:LONG]
    tries = []
    for kind, index in (*(("site", it) for it in ends_), *(("body", body) for body in loop)):
        place, element = of.row(f"{kind}_pos", index, 3), model.element(kind, index)
        written_ = slips(place) if element is not None and element.get("pos") else ()
        tries += [(kind, index, "pos", written(place), written(value)) for value in written_]
    for body in loop:
        element = model.element("body", body)
        said = {} if element is None else {name: element.get(name) for name in ORIENTATIONS if element.get(name)}
        for name, now in said.items():
            tries += [("body", body, name, now, value) for value in _signs(now)]
        if element is not None and not said and (turn := _turn(of, each, body)):
            tries.append(("body", body, "quat", LEFT_OUT, written(turn)))
    for side in (0, 1):
        if meant := _in_place(of, each, side):
            tries.append(("equality", each, f"site{side + 1}", of.names("site")[ends_[side]], meant))
    most = model.measured(_all_gaps()) - (1 - CLOSED) * _gap(of, each)
    found = []
    for kind, index, attribute, now, value in tries:
        edits = model.set(kind, [index], attribute, value)
        if edits and model.measured(_all_gaps(), edits) <= most:
            found.append((of.name(kind, index), attribute, now, edits))
    written_ones = [each for each in found if each[2] != LEFT_OUT]  # a turn closes what is as far from its hinge, too
    return min(written_ones or found, key=lambda each: round(model.measured(_extent(), each[-1]), 6), default=None)


def _signs(text: str) -> list[str]:
    """An orientation with another sign of one of its numbers; none where it is no row of numbers."""
    row = numbers(text)
    return [written(flipped(row, at)) for at, number in enumerate(row) if number]


def _in_place(of: Simulation, each: int, side: int) -> str:
    """The name of the one site on another body that is where an equality's other end is; empty for none or several."""
    of.begin()
    there, body = ends(of, each)[1 - side], of.body_of("site", held(of, each)[1 - side])
    near = CLOSED * _gap(of, each) * of.extent
    found = [
        site
        for site in range(of.count("site"))
        if of.body_of("site", site) != body and norm(sub(of.data_row("site_xpos", site, 3), there)) <= near
    ]
    return of.names("site")[found[0]] if len(found) == 1 else ""


def _turn(of: Simulation, each: int, body: int) -> Vector:
    """The quaternion about a body's one hinge that brings one end of an equality nearest to the other; else nothing."""
    joints = of.joints_of(body)
    if len(joints) != 1 or of.joint_type(joints[0]) != HINGE:
        return ()
    of.begin()
    axis, anchor = of.axis(joints[0]), of.data_row("xanchor", joints[0], 3)
    mine = next(i for i, it in enumerate(held(of, each)) if body in of.ancestors(of.body_of("site", it)))
    ways = [sub(end, anchor) for end in ends(of, each)]
    own, other = (unit(across(way, axis)) for way in (ways[mine], ways[1 - mine]))
    angle = math.atan2(dot(axis, cross(own, other)), dot(own, other))
    return (math.cos(angle / 2), *(math.sin(angle / 2) * x for x in of.row("jnt_axis", joints[0], 3)))


def _all_gaps() -> Probe:
    return Probe("all gaps that equalities have to close at the start", "of the extent", _gaps, dynamic=False)


def _extent() -> Probe:
    return Probe("size of the model", "m", _size, dynamic=False)


def _size(of: Simulation) -> float:
    return of.extent


def _gaps(of: Simulation) -> float:
    return sum(_gap(of, each) for each in range(of.count("equality")))


def _apart(of: Simulation) -> list[int]:
    return [each for each in range(of.count("equality")) if _gap(of, each) > APART]


def _gap(simulation: Simulation, each: int) -> float:
    simulation.begin()
    if kind_of(simulation, each) not in (CONNECT, WELD) or not simulation.model("eq_active0")[each]:
        return 0.0
    return (gap(simulation, each) or 0.0) / simulation.extent


def _edits(model: ReaderModel, each: int) -> tuple[Edit, ...]:
    of = model.simulation
    if not sited(of, each):
        return model.remove("equality", [each], "relpose")
    site = held(of, each)[1]
    body = of.body_of("site", site)
    seen = sub(ends(of, each)[0], of.data_row("xpos", body, 3))
    return model.set("site", [site], "pos", written(times(transpose(of.data_row("xmat", body, 9)), seen)))
