"""A tendon goes through other points than its twin on the other side.

Where one muscle or cable is called like another but for its side, its path is too: `left_back` becomes `right_back`.
With one site taken from the front, or from the other leg, it pulls the wrong way on one side.

Bad:

    <mujoco>
      <worldbody>
        <body name="pelvis" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.05 0.1 0.05"/>
          <site name="left_front" pos="0.05 0.1 0"/>
          <site name="left_back" pos="-0.05 0.1 0"/>
          <site name="right_front" pos="0.05 -0.1 0"/>
          <site name="right_back" pos="-0.05 -0.1 0"/>
          <body name="left_thigh" pos="0 0.1 -0.05">
            <joint name="left_hip" axis="0 1 0" range="-60 60"/>
            <geom type="capsule" fromto="0 0 -0.05 0 0 -0.3" size="0.03"/>
            <site name="left_knee" pos="-0.03 0 -0.3"/>
          </body>
          <body name="right_thigh" pos="0 -0.1 -0.05">
            <joint name="right_hip" axis="0 1 0" range="-60 60"/>
            <geom type="capsule" fromto="0 0 -0.05 0 0 -0.3" size="0.03"/>
            <site name="right_knee" pos="-0.03 0 -0.3"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <spatial name="left_hamstring">
          <site site="left_back"/>
          <site site="left_knee"/>
        </spatial>
        <spatial name="right_hamstring">
          <site site="right_front"/>
          <site site="right_knee"/>
        </spatial>
      </tendon>
    </mujoco>

Good:

    -       <site site="right_front"/>
    +       <site site="right_back"/>

The number: the points of a tendon that are not called like those of its twin, at most half of its path. What both go
through, and points without a twin, are not counted. The tendon is told that has a point of the other side, or else the
one whose point the other tendons go through less.

When it is wrong: a body that is not the same on both sides.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.sides import by_name, sided
from clinic.diagnosis.probes.tendons import path
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._pair import EITHER
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A tendon's path unlike that of the other side"
FAMILIES = ("wrong-numbers", "drifts", "stuck")
UNPLANTED = "no healthy model of the bench has tendons on two sides"

Point = tuple[str, int]  # a site or geom by kind and number


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Spatial tendons in pairs whose paths differ in half of their points at most."""
    of = model.simulation
    for left, right in by_name(of, "tendon"):
        odd = _odd(of, left, right)
        if not odd:
            continue
        wrong = _wrong_one(of, left, right, odd)
        told = right if wrong is None else wrong
        now, beside = next(((one, other) if told == left else (other, one)) for one, other in odd.values())
        value = _twin(of, beside)
        edits = () if wrong is None else _edits(model, wrong, odd.values(), wrong == left)
        probe = how_many("points of a tendon unlike those of its twin", _odd, left, right)
        names = (of.name("tendon", told), of.name("tendon", left + right - told), of.name(*now))
        says = f"It goes through {of.name(*now)}, and its twin through {of.name(*beside)}."
        says += EITHER * (wrong is None)
        texts = of.names(now[0])[now[1]], of.names(value[0])[value[1]]
        yield Suspect(names, now[0], *texts, edits, probe, 0.5, says, "the twin of each point")


def _wrong_one(of: Simulation, left: int, right: int, odd: dict[int, tuple[Point, Point]]) -> int | None:
    """Which tendon has a point of the other side; else the one whose odd points are used less; None for a tie."""
    across = [
        sum(sided(of, kind)[index][0] != own for kind, index in points)
        for own, points in zip(("left", "right"), zip(*odd.values(), strict=True), strict=True)
    ]
    used = [point for tendon in range(of.count("tendon")) for point in path(of, tendon)]
    less = [-sum(used.count(pair[side]) for pair in odd.values()) for side in (0, 1)]
    scores = across if across[0] != across[1] else less
    return None if scores[0] == scores[1] else left if scores[0] > scores[1] else right


def _edits(model: ReaderModel, tendon: int, odd: Iterable[tuple[Point, Point]], of_left: bool) -> tuple[Edit, ...]:
    """The points of a path replaced by the twins of the other's."""
    of, element, made = model.simulation, model.element("tendon", tendon), list[Edit]()
    for one, other in odd:
        (kind, wrong), beside = (one, other) if of_left else (other, one)
        right = _twin(of, beside)
        parts = [each for each in element.children if each.get(kind) == of.names(kind)[wrong]] if element else []
        if len(parts) == 1 and parts[0].tag == kind:
            made.append(set_attribute(parts[0], kind, of.names(right[0])[right[1]]))
    return tuple(made)


def _odd(of: Simulation, left: int, right: int) -> dict[int, tuple[Point, Point]]:
    """Where in two paths the points are not twins, though each has one: by place, the left's and the right's."""
    one, other = path(of, left), path(of, right)
    if len(one) != len(other) or "joint" in {kind for kind, _ in (*one, *other)}:
        return {}
    made = {}
    for place, (a, b) in enumerate(zip(one, other, strict=True)):
        known = all(index in sided(of, kind) for kind, index in (a, b))
        if known and a[0] == b[0] and _twin(of, a) != b:
            made[place] = (a, b)
    return made if 2 * len(made) <= len(one) else {}


def _twin(of: Simulation, point: Point) -> Point:
    """The twin of a point that has one by its name."""
    kind, index = point
    return kind, sided(of, kind)[index][1]
