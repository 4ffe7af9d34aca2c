"""Joint ranges in degrees are read as radians, or the other way.

MJCF takes angles in degrees unless `<compiler angle="radian"/>` says otherwise. A range of 2.5 becomes 0.04 rad, and
the joint is stuck; or a range of 90 becomes 14 turns, and the joint has no limit.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="0 2.5" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="elbow"/>
      </actuator>
    </mujoco>

Good:

      <mujoco>
    +   <compiler angle="radian"/>

The number: ranges under 0.12 rad (7 degrees) or over 25 rad (4 turns), of more than half of the hinges that have a
range, or of the only one; or of a few, where the number as it is written is a usual angle in the other unit. Of 1296
hinges with a range in 65 healthy models 89 % have one of 0.3 to 6.5 rad, 5 % one below 0.12 rad, and none one over 25
rad.

When it is wrong: flexures, and screws of many turns. A model without anything fixed, not even a floor, is a part for
another model, which says in what unit angles are: then it is a hint, as it is of all ranges of a URDF.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.joint.hinge_for_slide import unlike_slides
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Ranges in degrees read as radians, or the other way"
FAMILIES = ("stuck", "passes-limit", "jumps-at-start", "explodes")
CASE = "elbow-will-not-bend"

NARROW, WIDE = 0.12, 25.0  # rad
DEGREE = math.pi / 180


def _spans(simulation: Simulation) -> dict[int, float]:
    """The widths of the ranges of the hinges that have one, in rad."""
    ranged = {joint: high - low for joint, (low, high) in simulation.ranges.items() if high > low}
    hinges = [joint for joint in ranged if simulation.joint_type(joint) == HINGE]
    return {joint: ranged[joint] for joint in hinges if joint not in unlike_slides(simulation)}


def _off(simulation: Simulation, joints: tuple[int, ...]) -> float:
    """How many times the narrowest or widest of the ranges is beyond a usual one."""
    spans = _spans(simulation)
    return max((max(0.3 / spans[each], spans[each] / 6.5) for each in joints if each in spans), default=0.0)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The unit of all angles where it is most ranges, else that of the few."""
    simulation, spans = model.simulation, _spans(model.simulation)
    for few, factor, unit in (
        ([joint for joint, span in spans.items() if span < NARROW], 1 / DEGREE, "radian"),
        ([joint for joint, span in spans.items() if span > WIDE], DEGREE, "degree"),
    ):
        meant = [joint for joint in few if 0.3 <= spans[joint] * factor <= 12.7]
        if not meant:
            continue
        most = len(meant) == len(few) and (2 * len(few) > len(spans) or len(spans) == 1)
        others = max(_angles(model), default=0.0)  # what is right in the unit that the file says stays right
        most = most and not (others > 2 * math.pi if unit == "radian" else 0 < others <= 2 * math.pi)
        in_degrees = model.angle_unit != 1.0
        if most and unit == ("degree" if in_degrees else "radian"):
            continue  # it is in that unit already
        if not most and unit == "radian" and (not in_degrees or any(_round(model, each) for each in meant)):
            continue  # a narrow range in whole degrees is one
        of_file = most and not model.urdf  # MuJoCo reads URDF in radians, whatever its <compiler> says
        edits: tuple[Edit, ...] = model.option("angle", unit, "compiler") if of_file else ()
        ranges = {
            joint: " ".join(f"{each * factor / model.angle_unit:.4g}" for each in simulation.row("jnt_range", joint, 2))
            for joint in meant
        }
        edits += () if of_file else model.set_each("joint", "range", ranges)
        low, high = simulation.row("jnt_range", meant[0], 2)
        now = {"radian": "degree", "degree": "radian"}[unit]
        if not of_file:
            now = f"{low / model.angle_unit:g} {high / model.angle_unit:g}"
        yield Suspect(
            tuple(simulation.name("joint", each) for each in meant),
            "angle" if of_file else "range",
            now,
            unit if of_file else ranges[meant[0]],
            edits,
            Probe(
                "times a range is narrower than 0.3 rad or wider than 6.5 rad", "", _off, (tuple(meant),), dynamic=False
            ),
            2.0,
            f"The range of {simulation.name('joint', meant[0])} is {low:.3g} to {high:.3g} rad"
            + (f", as of {len(meant) - 1} more" if len(meant) > 1 else "")
            + f"; read in {unit}s it is {low * factor:.3g} to {high * factor:.3g} rad.",
            "0.3 to 6.5 rad",
            level="hint" if most and (model.urdf or not simulation.geoms_of(0)) else "cause",
        )


def _angles(model: ReaderModel) -> list[float]:
    """The sizes of the angles of all orientations as they are written, but for those that are 0."""
    texts = [each.get("euler") or "" for each in model.source.root.walk()] if model.source else []
    return [abs(float(number)) for text in texts for number in text.split() if _number(number) and float(number)]


def _number(text: str) -> bool:
    return text.lstrip("-").replace(".", "", 1).isdigit()


def _round(model: ReaderModel, joint: int) -> bool:
    """Whether a range is written in whole degrees."""
    written = model.value("joint", joint, "range") or ""
    return all(each.lstrip("-").replace(".0", "").isdigit() for each in written.split())
