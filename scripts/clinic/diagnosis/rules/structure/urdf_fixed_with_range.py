"""A joint of a URDF is fixed, and has a range to move in.

The joint was fixed for a test, or a program wrote it so, and kept its axis, its limits and its friction. What hangs on
it does not move, and nothing in MuJoCo says why.

Bad:

    <robot name="arm">
      <link name="base"/>
      <link name="fore">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>
        </inertial>
      </link>
      <joint name="elbow" type="fixed">
        <parent link="base"/>
        <child link="fore"/>
        <axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="20" velocity="2"/>
      </joint>
    </robot>

Good:

    -   <joint name="elbow" type="fixed">
    +   <joint name="elbow" type="revolute">

The number: fixed joints with a range that is not a point and an effort above 0. One is told; more of them were made by
the program that wrote the file. And two or more wheels that are fixed, where no joint is continuous, and they have an
axis or nothing else moves; the fork and the wheel of a caster, both fixed and each with its axis; and what is called
fixed, and floats.

When it is wrong: a joint that is locked on purpose and may be freed again.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element, Source
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A fixed joint with a range"
FAMILIES = ("stuck",)
UNPLANTED = "the healthy models that faults are planted in are MJCF"

WHEEL = re.compile(r"(?i)wheel(?!.*(cover|mount|guard|encoder|hub))(?<!caster_wheel)(?<!steering_wheel)")
CASTER = re.compile(r"(?i)cast[eo]r(?!.*(base|mount))")
FIXED = re.compile("(?i)(?<![a-z])fix(ed)?(?![a-z])")
SLIDES = re.compile("(?i)slid|prism|lift|finger")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joint of a URDF that is alone so, and wheels that are all so."""
    if model.source is None or not model.urdf:
        return
    yield from _called_fixed(model.source)
    all_joints = [each for each in model.source.root.children if each.tag == "joint"]
    joints = [each for each in all_joints if each.get("type") == "fixed"]
    ranged = [each for each in joints if _range(each)]
    if len(ranged) == 1:
        low, high = _range(ranged[0]) or (0.0, 0.0)
        value = "prismatic" if SLIDES.search(ranged[0].get("name")) else "revolute"
        yield _fixed(ranged, value, f"It is fixed, and its limit is {low:g} to {high:g}.")
    wheels = [each for each in joints if WHEEL.search(each.get("name"))]
    held = wheels if len(joints) == len(all_joints) else [each for each in wheels if _turns(each)]
    if len(held) > 1 and not any(each.get("type") == "continuous" for each in all_joints):
        yield _fixed(held, "continuous", "All wheels are fixed, and no joint is continuous.")
    casters = [each for each in joints if CASTER.search(each.get("name")) and _turns(each)]
    if len(casters) > 1:
        yield _fixed(casters, "continuous", "A caster is fixed, and has axes to turn about.")


def _called_fixed(source: Source) -> Iterator[Suspect]:
    """A joint that is called fixed, and floats."""
    for each in source.root.children:
        if each.tag == "joint" and each.get("type") == "floating" and FIXED.search(each.get("name")):
            says = "It is called fixed, and floats: what hangs on it falls."
            probe, edits = counted("joints called fixed that float", 1), (set_attribute(each, "type", "fixed"),)
            name = f'joint "{each.get("name")}"'
            yield Suspect((name,), "type", "floating", "fixed", edits, probe, 0.5, says, "fixed", at=each)


def _fixed(joints: list[Element], value: str, says: str) -> Suspect:
    names = tuple(f'joint "{each.get("name")}"' for each in joints)
    edits = tuple(set_attribute(each, "type", value) for each in joints)
    probe = counted("fixed joints with a range or an axis", len(joints))
    return Suspect(names, "type", "fixed", value, edits, probe, 0.5, says, "none", at=joints[0])


def _turns(joint: Element) -> bool:
    """Whether an axis is written for a joint that it could turn about."""
    axis = joint.first("axis")
    return axis is not None and bool(axis.get("xyz").strip("0. \t\n-+"))


def _range(joint: Element) -> tuple[float, float] | None:
    """The range that is written for a joint whose effort is not 0; None without."""
    limit = joint.first("limit")
    try:
        low, high, effort = (float(limit.get(name) or "0") if limit else 0.0 for name in ("lower", "upper", "effort"))
    except ValueError:
        return None
    return (low, high) if high - low > 1e-3 and effort > 0 and joint.first("axis") else None
