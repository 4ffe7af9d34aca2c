"""A part of the right side hangs on the left side, or the other way round.

In a URDF each joint names its parent. Copied from the other side, the name of the parent stays: both wheels hang on
the left steering hinge, and the right one carries nothing.

Bad:

    <robot name="car">
      <link name="base"/>
      <joint name="left_steering" type="revolute">
        <parent link="base"/>
        <child link="left_hinge"/>
        <origin xyz="0.3 0.1 0"/>
        <axis xyz="0 0 1"/>
        <limit lower="-0.5" upper="0.5" effort="10" velocity="10"/>
      </joint>
      <joint name="right_steering" type="revolute">
        <parent link="base"/>
        <child link="right_hinge"/>
        <origin xyz="0.3 -0.1 0"/>
        <axis xyz="0 0 1"/>
        <limit lower="-0.5" upper="0.5" effort="10" velocity="10"/>
      </joint>
      <joint name="left_axle" type="continuous">
        <parent link="left_hinge"/>
        <child link="left_wheel"/>
        <axis xyz="0 1 0"/>
      </joint>
      <joint name="right_axle" type="continuous">
        <parent link="left_hinge"/>
        <child link="right_wheel"/>
        <axis xyz="0 1 0"/>
      </joint>
      <link name="left_hinge">
        <inertial><mass value="0.2"/><inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial>
      </link>
      <link name="right_hinge">
        <inertial><mass value="0.2"/><inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial>
      </link>
      <link name="left_wheel">
        <inertial><mass value="0.4"/><inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial>
      </link>
      <link name="right_wheel">
        <inertial><mass value="0.4"/><inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial>
      </link>
    </robot>

Good:

        <joint name="right_axle" type="continuous">
    -     <parent link="left_hinge"/>
    +     <parent link="right_hinge"/>

The number: parts of one side that hang on a part of the other, beside their own twins, where the part that they are
named after carries nothing of the kind. And the one of a pair that hangs a link higher than its twin, beside the link
that it should hang on, where that carries nothing: a closing tag that stands too early.

When it is wrong: names that do not mean sides.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A part that hangs on the other side"
FAMILIES = ("drifts", "stuck", "jumps-at-start")
UNPLANTED = "no edit of one number hangs a part elsewhere"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each part that hangs on the twin of what it should hang on."""
    of = model.simulation
    for body, (parent, meant) in _astray(of).items():
        names = of.name("body", body), of.name("body", parent)
        value = of.names("body")[meant]
        says = f"{names[0]} hangs on {names[1]}, as its twin does; {of.name('body', meant)} carries nothing like it."
        probe = how_many("parts that hang on the other side", _astray)
        edits = _edits(model, of.names("body")[body], value)
        yield Suspect(names, "parent", of.names("body")[parent], value, edits, probe, 0, says, "each on its own side")
    for body, meant in _too_high(of).items():
        names, value = (of.name("body", body), of.name("body", of.parent(body))), of.names("body")[meant]
        says = f"Its twin hangs one link lower; {of.name('body', meant)}, beside it, carries nothing."
        probe, edits = (
            how_many("parts a link higher than their twins", _too_high),
            _edits(model, of.names("body")[body], value),
        )
        yield Suspect(names, "parent", of.names("body")[of.parent(body)], value, edits, probe, 0, says, "as its twin")


def _astray(of: Simulation) -> dict[int, tuple[int, int]]:
    """The parts beside their twins on one side, with what they hang on and its twin, which carries less by two."""
    pairs = twins(of).pairs["body"]
    carried = {body: len(of.children.get(body, [])) for body in range(of.count("body"))}
    beside = {body: pair for pair in pairs for body in pair}
    made = {}
    for left, right in pairs:
        parent = of.parent(left)
        pair = beside.get(parent)
        if pair is None or of.parent(right) != parent:
            continue
        meant = pair[1] if parent == pair[0] else pair[0]
        if carried[parent] - carried[meant] == 2:
            made[right if parent == pair[0] else left] = (parent, meant)
    return made


def _too_high(of: Simulation) -> dict[int, int]:
    """The parts that hang beside the twin of what their own twin hangs on, by that, which carries nothing."""
    pairs = by_name(of, "body")
    twin = {one: other for pair in pairs for one, other in (pair, pair[::-1])}
    made = {}
    for body, other in twin.items():
        meant = twin.get(of.parent(other))
        if meant is None or meant == of.parent(body) or of.parent(meant) != of.parent(body) or of.children.get(meant):
            continue
        if of.joints_of(body) and twin.get(of.parent(body), of.parent(body)) == of.parent(of.parent(other)):
            made[body] = meant
    return made


def _edits(model: ReaderModel, child: str, parent: str) -> tuple[Edit, ...]:
    """The edit of the joint's `<parent>` in a URDF; what is nested in MJCF is moved by hand."""
    if model.source is None or not model.urdf:
        return ()
    for joint in model.source.elements("joint"):
        ends = joint.first("parent"), joint.first("child")
        if ends[0] is not None and ends[1] is not None and ends[1].get("link") == child:
            return (set_attribute(ends[0], "link", parent),)
    return ()
