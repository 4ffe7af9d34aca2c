"""A tendon goes through other points than its twin on the other side.

Where one muscle or cable is called like another but for its side, its path is too: `left_back` becomes `right_back`.
With one site taken from the front, or from the other leg, it pulls the wrong way on one side.

Bad:

    <mujoco>
      <worldbody>
        <body name="pelvis" pos="0 0 1">
          <geom type="box" size="0.05 0.1 0.05"/>
          <site name="left_front" pos="0.05 0.1 0"/>
          <site name="left_back" pos="-0.05 0.1 0"/>
          <site name="right_front" pos="0.05 -0.1 0"/>
          <site name="right_back" pos="-0.05 -0.1 0"/>
          <body name="left_thigh" pos="0 0.1 -0.05">
            <joint name="left_hip" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
            <site name="left_knee" pos="-0.03 0 -0.3"/>
          </body>
          <body name="right_thigh" pos="0 -0.1 -0.05">
            <joint name="right_hip" axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
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

The number: the points of a tendon that are not called like those of its twin, at most half of its path. Points that
have no twin of their own are not counted.

When it is wrong: a body that is not the same on both sides.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.tendons import path
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A tendon's path unlike that of the other side"
FAMILIES = ("wrong-numbers", "drifts", "stuck")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "no healthy model of the bench has tendons on two sides"

Point = tuple[str, int]  # a site or geom, or a joint, by kind and number


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Tendons in pairs whose paths differ in half of their points at most."""
    of = model.simulation
    used = [point for tendon in range(of.count("tendon")) for point in path(of, tendon)]
    for left, right in by_name(of, "tendon"):
        odd = _odd(of, left, right)
        for place, (one, other) in odd.items():
            wrong, now, value = right, other, _twin(of, one)
            if used.count(other) < used.count(one):  # what only this one goes through is likelier meant
                wrong, now, value = left, one, _twin(of, other)
            assert value is not None
            element = model.element("tendon", wrong)
            parts = [each for each in element.children if each.tag == now[0]] if element is not None else []
            written = [each for each in parts if each.get(now[0]) == of.names(now[0])[now[1]]]
            edits = tuple(set_attribute(each, now[0], of.names(value[0])[value[1]]) for each in written[:1])
            probe = Probe("points of a tendon unlike those of its twin", "", _count, (left, right), dynamic=False)
            names = (of.name("tendon", wrong), of.name("tendon", left + right - wrong), of.name(*now))
            says = f"Its point {place + 1} is {of.name(*now)}, and {of.name(*value)} would be like its twin's."
            yield Suspect(
                names, now[0], of.names(now[0])[now[1]], of.names(value[0])[value[1]], edits, probe, 0.5, says,
                "the twin of each point",
            )  # fmt: skip


def _count(of: Simulation, left: int, right: int) -> float:
    return float(len(_odd(of, left, right)))


def _odd(of: Simulation, left: int, right: int) -> dict[int, tuple[Point, Point]]:
    """Where in two paths the points are not twins, though each has one: by place, the left's and the right's."""
    one, other = path(of, left), path(of, right)
    if len(one) != len(other):
        return {}
    pairs = {place: pair for place, pair in enumerate(zip(one, other, strict=True)) if _twin(of, pair[0]) != pair[1]}
    known = {place: pair for place, pair in pairs.items() if _twin(of, pair[0]) and _twin(of, pair[1])}
    return known if 0 < 2 * len(pairs) <= len(one) else {}


def _twin(of: Simulation, point: Point) -> Point | None:
    """The twin of a point by its name."""
    kind, index = point
    return next(((kind, left + right - index) for left, right in by_name(of, kind) if index in (left, right)), None)
