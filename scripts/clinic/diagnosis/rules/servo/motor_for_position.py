"""A motor has the range of its joint as its control range.

`<motor>` takes a force, `<velocity>` a speed, `<position>` an angle. A control range that repeats the joint's range
says that angles are sent; as a torque in N m or a speed in rad/s they do not hold the joint there.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-120 10" damping="1"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="elbow" ctrlrange="-2.0944 0.17453"/>
      </actuator>
    </mujoco>

Good:

    -     <motor joint="elbow" ctrlrange="-2.0944 0.17453"/>
    +     <position joint="elbow" kp="100" ctrlrange="-2.0944 0.17453"/>

The number: how many motors and velocity servos have the range of their joint, to 1 %. Ranges to 1 and -1 are left out,
for they are those of scaled controls; where the model has no position servo all whole numbers are.

When it is wrong: a force that happens to be as large in N m as the angle in rad.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, replace
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A motor that is told angles"
FAMILIES = ("sags", "stuck", "drifts", "passes-limit")
UNPLANTED = "which unit a control has, only intent knows"

NEAR = 0.01  # of the range


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Motors whose controls have the range of their joints, all together."""
    of = model.simulation
    found = _told(of)
    if not found:
        return
    joint = of.driven_joint(found[0])
    ends = " ".join(f"{end:.4g}" for end in of.row("actuator_ctrlrange", found[0], 2))
    speed, hinge = of.bias(found[0])[2] != 0, of.joint_type(joint or 0) == HINGE
    unit = {(False, True): "N m", (False, False): "N", (True, True): "rad/s", (True, False): "m/s"}[speed, hinge]
    says = f"Its controls go from {ends.replace(' ', ' to ')}, the range of {of.name('joint', joint or 0)}, as {unit}."
    probe = how_many("motors whose control range is the range of the joint", _told)
    names = tuple(of.name("actuator", actuator) for actuator in found)
    edits = tuple(edit for actuator in found for edit in _as_servo(model, actuator))
    yield Suspect(names, "ctrlrange", ends, "<position>", edits, probe, 0, says, "<position> for angles")


def _as_servo(model: ReaderModel, actuator: int) -> tuple[Edit, ...]:
    """A `<position>` in the place of a motor whose class gives the gains of servos; none where that is not known."""
    element = model.element("actuator", actuator)
    if element is None or model.source is None or element.tag != "motor" or not element.get("class"):
        return ()
    alike = [each for each in model.source.section("actuator") if each.get("class") == element.get("class")]
    servos_of_class = [each for each in alike if each.tag == "position" and "kp" not in each.attributes]
    text = model.text_of(element).replace("<motor", "<position", 1)
    return (replace(element, text),) if element.empty and servos_of_class else ()


def _told(of: Simulation) -> list[int]:
    positions, made = {each.actuator for each in servos(of)}, []
    for actuator in range(of.count("actuator")):
        joint = of.driven_joint(actuator)
        limited = of.model("actuator_ctrllimited")[actuator]
        if actuator in positions or joint is None or not limited or joint not in of.ranges:
            continue
        ends, reach = of.row("actuator_ctrlrange", actuator, 2), of.ranges[joint]
        near = NEAR * (reach[1] - reach[0])
        alike = all(abs(one - other) <= near for one, other in zip(ends, reach, strict=True))
        round_ = all(end == round(end) for end in ends) if not positions else {*map(abs, ends)} <= {0.0, 1.0}
        if alike and not round_:
            made.append(actuator)
    return made
