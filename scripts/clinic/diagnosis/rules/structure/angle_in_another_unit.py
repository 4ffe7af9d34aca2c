"""An angle of a body, geom, site or camera is in degrees where the model reads radians, or the other way.

`<compiler angle="radian"/>` is for all of `euler`, `axisangle` and the `range` of hinges and balls: 90 is then 14 turns
and a bit. Without it 1.5708 are 1.6 degrees.

Bad:

    <mujoco>
      <compiler angle="radian"/>
      <worldbody>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.05" mass="2"/>
          <site name="lidar" pos="0.2 0 0" euler="0 90 45"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <site name="lidar" pos="0.2 0 0" euler="0 90 45"/>
    +       <site name="lidar" pos="0.2 0 0" euler="0 1.5708 0.7854"/>

The number: elements with an angle of more than a turn in radians, in URDF an `rpy`, which has no other unit; or whose
angles in degrees are all multiples of a quarter of pi. Of 289 healthy models none has one of the first kind.

When it is wrong: a part that is turned by 1.57 degrees.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "An angle in another unit"
FAMILIES = ("wrong-numbers", "camera", "jumps-at-start", "sensor-reads-zero")
UNPLANTED = "which turn a part should have, only a drawing tells"

TURNED = ("body", "geom", "site", "camera", "frame", "inertial", "replicate")
TURN, CLOSE = 2 * math.pi, 0.002  # rad


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All angles of the other unit, together."""
    if model.source is None:
        return
    radians = model.angle_unit == 1.0
    turned = ("origin",) if model.urdf else TURNED
    found = {each: angles for each in model.source.elements(*turned) if (angles := _angles(each, radians))}
    if not found:
        return
    edits = tuple(edit for each, angles in found.items() for edit in _edits(each, angles, radians))
    first = edits[0]
    now = next(iter(found)).get(first.attribute)
    said = "radians: it is more than a turn" if radians else "degrees: it is a multiple of a quarter of pi"
    yield Suspect(
        tuple(_name(each) for each in found),
        first.attribute,
        now,
        first.value,
        edits,
        counted("angles in another unit", len(found)),
        0.5,
        f"{first.attribute} {now} is read in {said}.",
        "none",
    )


def _angles(each: Element, radians: bool) -> dict[str, list[float]]:
    """The angles that are written in an element and belong to the other unit, with what stands beside them."""
    made = {}
    for name, first in (("euler", 0), ("axisangle", 3), ("rpy", 0)):
        try:
            numbers = [float(text) for text in each.get(name).split()]
        except ValueError:
            continue
        angles = [abs(number) for number in numbers[first:] if abs(number) > CLOSE]
        if angles and (_many_turns(angles) if radians else _parts_of_pi(angles)):
            made[name] = numbers
    return made


def _many_turns(angles: list[float]) -> bool:
    return max(angles) > TURN + CLOSE


def _parts_of_pi(angles: list[float]) -> bool:
    quarter = math.pi / 4
    return all(angle < TURN and abs(angle - quarter * round(angle / quarter)) < CLOSE for angle in angles)


def _edits(each: Element, angles: dict[str, list[float]], radians: bool) -> Iterator[Edit]:
    times = math.pi / 180 if radians else 180 / math.pi
    for name, numbers in angles.items():
        first = 3 if name == "axisangle" else 0
        kept, turned = numbers[:first], [number * times for number in numbers[first:]]
        yield set_attribute(each, name, " ".join(f"{x:.5g}" for x in [*kept, *turned]))


def _name(each: Element) -> str:
    if each.tag == "origin":  # of a joint, or of a visual, a collision or an inertial of a link
        each = next((outer for outer in each.around() if outer.get("name")), each)
    name = each.get("name")
    return f'{each.tag} "{name}"' if name else f"<{each.tag}> of line {each.line}"
