"""A URDF has an element that MuJoCo does not read.

URDF places a joint by `<origin>`. With a `<pose>`, which is SDF, in its place, what hangs on the joint stays at its
parent's origin; with `<limits>` for `<limit>` the joint has no range. MuJoCo passes over such elements without a word.

Bad:

    <robot name="rover">
      <link name="base"/>
      <link name="mast">
        <inertial><origin xyz="0 0 0.1"/><mass value="1"/>
          <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.0005"/></inertial>
      </link>
      <joint name="turn" type="revolute">
        <parent link="base"/><child link="mast"/><axis xyz="0 0 1"/>
        <pose>0.1 0 0.3 0 0 0</pose>
        <limit lower="-1" upper="1" effort="20" velocity="3"/>
      </joint>
    </robot>

Good:

    -     <pose>0.1 0 0.3 0 0 0</pose>
    +     <origin xyz="0.1 0 0.3" rpy="0 0 0"/>

The number: how many such elements stand in joints, and in the inertials, visuals and collisions of links. A `<mimic>`
that names a joint which is not there is passed over, too, with a warning.

When it is wrong: an element of another program, which reads it.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Source
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "An element that is passed over"
FAMILIES = ("jumps-at-start", "wrong-mass", "camera")
UNPLANTED = "only URDF has such elements, and the healthy models are MJCF"

INSIDE = {
    "joint": "origin parent child axis calibration dynamics limit mimic safety_controller disable_collision",
    "inertial": "origin mass inertia",
    "visual": "origin geometry material",
    "collision": "origin geometry verbose contact_coefficients material",  # which only colours it
}
MEANT = {"pose": "origin", "limits": "limit", "dynamic": "dynamics", "axes": "axis"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """What stands in joints and parts of links and is none of URDF's elements, by its tag."""
    if model.source is None or not model.urdf:
        return
    yield from _mimics(model.source)
    found: dict[str, list[str]] = {}
    for each in model.source.root.walk():
        holder = each.parent
        if holder is None or holder.tag not in INSIDE or holder.parent is None:
            continue
        if holder.parent.tag in ("robot", "link") and each.tag not in INSIDE[holder.tag].split():
            name = holder.get("name") or holder.parent.get("name")
            found.setdefault(each.tag, []).append(f'{holder.tag} "{name}"')
    for tag, holders in found.items():
        meant = f"<{MEANT[tag]}>" if tag in MEANT else "removed"
        says = f"URDF has no <{tag}> there, and it is passed over."
        probe = counted("elements that are passed over", len(holders))
        yield Suspect(tuple(holders), tag, f"<{tag}>", meant, (), probe, len(holders) - 0.5, says, "none")


def _mimics(source: Source) -> Iterator[Suspect]:
    """Joints that mimic none of the file's joints."""
    joints = [each for each in source.root.children if each.tag == "joint"]
    names = {each.get("name") for each in joints}
    for joint in joints:
        mimic = joint.first("mimic")
        if mimic is None or mimic.get("joint") in names:
            continue
        now, near = mimic.get("joint"), difflib.get_close_matches(mimic.get("joint"), names - {joint.get("name")}, 1, 0)
        says = f"No joint is called {now!r}: nothing leads it, and it moves by itself."
        edits = tuple(set_attribute(mimic, "joint", name) for name in near)
        told, probe = f'joint "{joint.get("name")}"', counted("followers without a leader", 1)
        yield Suspect((told,), "joint", now, near[0] if near else "", edits, probe, 0.5, says, "a joint of the file")
