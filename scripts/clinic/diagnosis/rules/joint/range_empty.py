"""A joint's range is a point, or its ends are exchanged.

MuJoCo takes `range="0 0"`, and `range="1.5 -1.5"`, for a joint without limits, and says nothing. The joint then turns
through its neighbours.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="90 -90"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

The number: 1 where nothing pushes the joint back from beyond its range. A point becomes the control range of the
joint's position servo, or the range of its twin; where it has neither, it is a hint.

When it is wrong: a range of a default class that is taken back on purpose; `limited="false"` says that.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.servo import alone, servos
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A range without any extent"
FAMILIES = ("passes-limit", "stuck")
SINCE = "0.1"
LEVEL = "hint"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges and slides with a written range that ends before it begins."""
    simulation = model.simulation
    for joint in range(simulation.count("joint")):
        text = (model.value("joint", joint, "range") or "").split()
        if simulation.joint_type(joint) not in (HINGE, SLIDE) or simulation.model("jnt_limited")[joint]:
            continue
        if len(text) != 2 or float(text[0]) < float(text[1]) or model.value("joint", joint, "limited") == "false":
            continue
        edits = _edits(model, joint, text)
        what = "a point" if float(text[0]) == float(text[1]) else "written from its upper end to its lower"
        yield Suspect(
            (simulation.name("joint", joint),),
            "range",
            " ".join(text),
            edits[0].value if edits else "",
            edits,
            Probe("1 where nothing pushes the joint back from beyond its range", "", _free, (joint,), dynamic=False),
            0.5,
            f"Its range is {what}, and MuJoCo takes that for none.",
            "the lower end first",
        )


def _edits(model: ReaderModel, joint: int, text: list[str]) -> tuple[Edit, ...]:
    if float(text[0]) > float(text[1]):
        return model.set("joint", [joint], "range", f"{text[1]} {text[0]}")
    simulation = model.simulation
    scale = 1 / model.angle_unit if simulation.joint_type(joint) == HINGE else 1.0
    twin = twins(simulation).partner("joint", joint)
    targets = [each.targets for each in servos(simulation) if each.joint == joint and each.targets]
    if twin is not None and simulation.model("jnt_limited")[twin]:
        low, high = simulation.row("jnt_range", twin, 2)
        left = min(joint, twin) if (min(joint, twin), max(joint, twin)) in twins(simulation).pairs["joint"] else None
        if left is not None and twins(simulation).joint_sign(left, joint + twin - left)[0] < 0:
            low, high = -high, -low
    elif targets:
        low, high = targets[0]
    else:
        return ()
    return model.set("joint", [joint], "range", f"{low * scale:.4g} {high * scale:.4g}")


def _free(simulation: Simulation, joint: int) -> float:
    low, high = sorted(simulation.row("jnt_range", joint, 2))
    with alone(simulation, limp=True):
        simulation.begin(forward=False)
        place = int(simulation.model("jnt_qposadr")[joint])
        simulation.engine.write("qpos", [high + 0.1 * max(high - low, 0.1)], place)
        simulation.engine.forward()
        return float(simulation.data("qfrc_constraint")[simulation.dof(joint)] >= 0)
