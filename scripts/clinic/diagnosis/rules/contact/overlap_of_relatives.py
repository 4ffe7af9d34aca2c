"""Parts of one mechanism overlap at the start, and throw each other.

MuJoCo does not let a body collide with its parent, unless the parent is fixed to the world: then it does. Grandparents
and siblings do, where their masks match. Where their geoms overlap by design, an `<exclude>` is missing.

Bad:

    <mujoco>
      <worldbody>
        <body name="base">
          <geom type="sphere" size="0.1"/>
          <body name="arm" pos="0.1 0 0">
            <joint axis="0 1 0" damping="1"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

        </worldbody>
    +   <contact>
    +     <exclude body1="base" body2="arm"/>
    +   </contact>

The number: the deepest overlap at the start of bodies at most 3 links apart, as a share of the thinner geom's
thickness; below 0.1 is well. They do so too in a fifth of 17 poses over the ranges of all joints: two fingers that are
closed at 0, and the wrist of an arm that lies in its forearm at 0 alone, do it in 1 or 2. Of a left and a right finger
that are in each other when closed, one that is nearer to the middle is told as a hint. The first or last of three links
in a row, called alike but for a number, is put as far from the next as these are apart, where that ends the overlap. So
is one of four and more that is out of their step, between its neighbours, however little it overlaps. MuJoCo's manual,
Computation, Collision detection: the filter of parents.

When it is wrong: a geom that is too large, where the edit hides it; or a part without the free joint that it gets
elsewhere. So a body with three limbs and more that is fixed in an empty world, and that no exclude names, is left
alone. A joint that starts outside of its range, which is another fault, is looked at inside.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.arms import longest_row
from clinic.diagnosis.probes.overlap import legged, of_relatives, often, relatives
from clinic.diagnosis.probes.shape import root_of, roots, thickness
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.vector import Vector, add, norm, sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Parts that overlap at the start"
FAMILIES = ("jumps-at-start", "stuck", "explodes")
LEVEL = "hint"
CASE = "joint-snaps-at-start"

SAME, STEP = 1e-5, 0.02  # m; of a step
ROW, NUMBER = 3, re.compile(r"_?\d+$")  # links that are called alike but for their number
MOST, ARM = 0.1, 5  # hinges in a row of an arm


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All pairs of relatives that overlap, excluded together."""
    simulation = model.simulation
    yield from _lopsided(model)
    uneven = [*_uneven_rows(model)]
    yield from uneven
    if uneven:
        return
    if model.measured(of_relatives()) <= MOST or legged(model):
        return
    names = ["world", *simulation.names("body")[1:]]
    deep: dict[tuple[int, int], float] = {}
    for one, other, contact in relatives(simulation):
        thick = min(thickness(simulation, geom) for geom in contact.geoms)
        pair = (min(one, other), max(one, other))
        if contact.force > 0 and -contact.distance > MOST * thick and pair in often(simulation, MOST):
            deep[pair] = max(deep.get(pair, 0.0), -contact.distance)
    xml = "".join(f'<exclude body1="{names[one]}" body2="{names[other]}"/>' for one, other in deep)
    named = all(names[body] for pair in deep for body in pair)
    bodies = tuple(simulation.name("body", body) for pair in sorted(deep, key=deep.__getitem__)[::-1] for body in pair)
    based = model.urdf and any(0 in pair for pair in deep)
    if not deep or (based and (len(roots(simulation)) > 1 or longest_row(simulation) < ARM)):
        return  # what a URDF has for a base is often carried by something else, but for that of a single arm
    owner = root_of(simulation)
    static = any(not owner[one] and not owner[simulation.parent(other)] for one, other in deep)
    says = f"They overlap by {1000 * max(deep.values()):.3g} mm" + (
        "; the parent is fixed to the world, so that the filter of parents does not apply." if static else "."
    )
    if (moved := _out_of_row(model, deep)) is not None:
        yield moved
        return
    edits = model.add("contact", xml) if named else ()
    value = f"{len(deep)} excluded" if len(deep) > 1 else "excluded"
    yield Suspect(tuple(dict.fromkeys(bodies)), "exclude", "none", value, edits, of_relatives(), MOST, says, excess=2.0)


def _lopsided(model: ReaderModel) -> Iterator[Suspect]:
    """Two fingers that close into each other, the one nearer to the middle put as far off it as its twin."""
    of = model.simulation
    for near, far in _unlike(of):
        place, twin = of.row("body_pos", near, 3), of.row("body_pos", far, 3)
        mirrored = [a if abs(a - b) < SAME else -b for a, b in zip(place, twin, strict=True)]
        probe = Probe("depth of two fingers in each other", "m", _depth, (near, far), dynamic=False)
        edits = model.placed(near, mirrored)
        if not edits or model.measured(probe, edits) > SAME:
            continue
        names = of.name("body", near), of.name("body", far)
        says = f"They are {1000 * _depth(of, near, far):.2g} mm in each other, and it is nearer to the middle."
        value = written(mirrored)
        yield Suspect(names, "pos", written(place), value, edits, probe, SAME, says, "the mirror image", level="hint")


def _uneven_rows(model: ReaderModel) -> Iterator[Suspect]:
    """The links that overlap another one of their even row, each put into the middle of its neighbours."""
    of = model.simulation
    for body, (other, middle) in _uneven(of).items():
        probe = Probe("depth of two links in each other", "m", _depth, (body, other), dynamic=False)
        edits, now = model.placed(body, middle), of.row("body_pos", body, 3)
        if not edits or model.measured(probe, edits) > SAME:
            continue
        deep = f"{1000 * _depth(of, body, other):.2g} mm"
        says = (
            f"It is {deep} inside of {of.name('body', other)}; between its neighbours all of its row are as far apart."
        )
        names, value = (of.name("body", body), of.name("body", other)), written(middle)
        yield Suspect(names, "pos", written(now), value, edits, probe, SAME, says, "in an even row")


def _uneven(of: Simulation) -> dict[int, tuple[int, Vector]]:
    """The one link of a row, of those called alike but for a number, that is out of its step and in another one."""
    names, rows, made = of.names("body"), dict[tuple[int, str], list[int]](), dict[int, tuple[int, Vector]]()
    for body in of.moving_bodies:
        if (stem := NUMBER.sub("", names[body])) != names[body] and of.joints_of(body):
            rows.setdefault((of.parent(body), stem), []).append(body)
    for row in rows.values():
        places = [of.row("body_pos", body, 3) for body in row]
        if len(row) <= ROW or _even(places):
            continue
        for at in range(1, len(row) - 1):
            middle = tuple((a + b) / 2 for a, b in zip(places[at - 1], places[at + 1], strict=True))
            beside = [row[at + step] for step in (-1, 1) if _depth(of, row[at], row[at + step]) > 0]
            if beside and _even([*places[:at], middle, *places[at + 1 :]]):
                made[row[at]] = beside[0], middle
    return made


def _even(places: Sequence[Vector]) -> bool:
    steps = [sub(b, a) for a, b in pairwise(places)]
    return all(norm(sub(step, steps[0])) < STEP * norm(steps[0]) for step in steps)


def _unlike(of: Simulation) -> list[tuple[int, int]]:
    """The left and right slides of one body that overlap at the start, on two sides, not as far; near first."""
    pairs = [frozenset(of.body_of("joint", each) for each in pair) for pair in by_name(of, "joint")]
    pairs += [frozenset(pair) for pair in by_name(of, "body")]
    made = []
    for one, other, _ in relatives(of):
        joints = [of.joint_type(joint) for body in (one, other) for joint in of.joints_of(body)]
        places = of.row("body_pos", one, 3), of.row("body_pos", other, 3)
        apart = [(a, b) for a, b in zip(*places, strict=True) if abs(a - b) > SAME]
        parents = {of.parent(body) for body in (one, other)}
        if frozenset((one, other)) not in pairs or joints != [SLIDE, SLIDE] or len(parents) > 1 or len(apart) != 1:
            continue
        a, b = apart[0]
        if a * b < 0 and abs(a + b) > SAME:
            made.append((one, other) if abs(a) < abs(b) else (other, one))
    return list(dict.fromkeys(made))


def _depth(of: Simulation, *pair: int) -> float:
    return max((-contact.distance for one, other, contact in relatives(of) if {one, other} == {*pair}), default=0.0)


def _out_of_row(model: ReaderModel, deep: Iterable[tuple[int, int]]) -> Suspect | None:
    """The link of a row of like ones that overlaps for its place, put as far from the last as these are apart."""
    of, names = model.simulation, model.simulation.names("body")
    for body in {each for pair in deep for each in pair if each}:
        stem = NUMBER.sub("", names[body])
        row = [each for each in of.children.get(of.parent(body), []) if NUMBER.sub("", names[each]) == stem]
        if not stem or len(row) < ROW or stem == names[body] or body not in (row[0], row[-1]):
            continue
        inner = row[1:] if body == row[0] else row[-2::-1]
        places = [of.row("body_pos", each, 3) for each in inner]
        place = add(places[0], sub(places[0], places[1]))
        now, edits = of.row("body_pos", body, 3), model.placed(body, place)
        if norm(sub(place, now)) < SAME or not edits or model.measured(of_relatives(), edits) > MOST:
            continue
        says = f"It overlaps another link, and is {norm(sub(now, places[0])):.3g} m from {of.name('body', inner[0])}; "
        says += f"the others are {norm(sub(places[0], places[1])):.3g} m apart, and there it touches nothing."
        name, probe = (of.name("body", body),), of_relatives()
        return Suspect(name, "pos", written(now), written(place), edits, probe, MOST, says, "in a row", excess=2.0)
    return None
