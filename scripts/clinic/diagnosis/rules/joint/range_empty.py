"""A joint's range is a point, or its ends are exchanged.

MuJoCo takes `range="0 0"`, and `range="1.5 -1.5"`, for a joint without limits, and says nothing: nothing stops the
joint. With `limited="true"` it is an error.

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

    -       <joint name="elbow" axis="0 1 0" range="90 -90"/>
    +       <joint name="elbow" axis="0 1 0" range="-90 90"/>

In URDF a `<limit>` that has no lower and upper, or none at all, is the same, where another joint has a range.

The number: 1 where nothing pushes the joint back from beyond its range. A point becomes the range of the joint's twin,
or the control range of its position servo; where it has neither, it is a hint.

When it is wrong: a range of a default class that is taken back on purpose; `limited="false"` says that.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.probes.limits import unstopped
from clinic.diagnosis.probes.servo import servos
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A range without any extent"
FAMILIES = ("passes-limit", "stuck")
LEVEL = "hint"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges and slides with a written range that ends before it begins."""
    yield from _urdf(model)
    simulation = model.simulation
    for joint in simulation.scalar_joints:
        text = (model.value("joint", joint, "range") or "").split()
        if joint in simulation.ranges or len(text) != 2:
            continue
        if float(text[0]) < float(text[1]) or model.value("joint", joint, "limited") == "false":
            continue
        edits = _edits(model, joint, text)
        what = "a point" if float(text[0]) == float(text[1]) else "written from its upper end to its lower"
        yield Suspect(
            (simulation.name("joint", joint),),
            "range",
            " ".join(text),
            edits[0].value if edits else "",
            edits,
            unstopped([joint], "the joint"),
            0.5,
            f"Its range is {what}, and MuJoCo takes that for none.",
            "the lower end first",
        )


def _urdf(model: ReaderModel) -> Iterator[Suspect]:
    """Revolute and prismatic joints of a URDF without an upper limit above the lower one, by what is wrong."""
    found: dict[str, list[Element]] = {}
    root = model.source.root if model.source is not None and model.urdf else None
    for joint in root.children if root is not None else ():
        if joint.tag != "joint" or joint.get("type") not in ("revolute", "prismatic"):
            continue
        limit = joint.first("limit")
        low, high = (float(limit.get(name) or "0") if limit is not None else 0.0 for name in ("lower", "upper"))
        if limit is None or not {"lower", "upper"} & set(limit.attributes):
            if not is_wheel(joint.get("name")):
                found.setdefault("left out", []).append(joint)
        elif low >= high:
            found.setdefault("a point" if low == high else "written from its upper end to its lower", []).append(joint)
        else:
            found.setdefault("", [])
    if "" not in found:
        found.pop("left out", None)  # a pendulum that is meant to turn, in the words of another type
    found.pop("", None)
    for what, joints in found.items():
        limit = joints[0].first("limit")
        now = f"{limit.get('lower')} {limit.get('upper')}".strip() if limit is not None else "left out"
        says = f"Its range is {what}, and MuJoCo takes that for none: it goes without end, as a continuous joint does."
        edits: tuple[Edit, ...] = ()
        if what.startswith("written"):
            limits = [each for joint in joints if (each := joint.first("limit")) is not None]
            edits = tuple(
                set_attribute(each, end, each.get(other))
                for each in limits
                for end, other in (("lower", "upper"), ("upper", "lower"))
            )
        names = tuple(f'joint "{joint.get("name")}"' for joint in joints)
        probe = counted("joints whose range is none", len(joints))
        healthy = 'lower below upper, or type="continuous"'
        yield Suspect(names, "limit", now, " ".join(each.value for each in edits[:2]), edits, probe, 0.5, says, healthy)


def _edits(model: ReaderModel, joint: int, text: list[str]) -> tuple[Edit, ...]:
    if float(text[0]) > float(text[1]):
        return model.set("joint", [joint], "range", f"{text[1]} {text[0]}")
    simulation = model.simulation
    scale = 1 / model.angle_unit if simulation.joint_type(joint) == HINGE else 1.0
    twin = twins(simulation).partner("joint", joint)
    targets = [each.targets for each in servos(simulation) if each.joint == joint and each.targets]
    if twin is not None and twin in simulation.ranges:
        low, high = simulation.ranges[twin]
        left = min(joint, twin) if (min(joint, twin), max(joint, twin)) in twins(simulation).pairs["joint"] else None
        if left is not None and twins(simulation).joint_sign(left, joint + twin - left)[0] < 0:
            low, high = -high, -low
    elif targets:
        low, high = targets[0]
    else:
        return ()
    return model.set("joint", [joint], "range", f"{low * scale:.4g} {high * scale:.4g}")
