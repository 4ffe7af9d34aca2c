"""A joint has a range that is not applied.

`limited="false"` leaves a range without effect, and MuJoCo says nothing.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-30 30" limited="false"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" range="-30 30" limited="false"/>
    +       <joint name="elbow" axis="0 1 0" range="-30 30" limited="true"/>

The number: the joint is put a tenth of its range beyond a limit; 1 where nothing pushes it back.

A hinge whose range is a turn and more is left alone, and so are the joints of a body that goes about by a slide of ten
times the model's extent. With `--symptom passes-limit` a hint names the driven joints that have no range at all.

When it is wrong: a range that is kept for reference. Where the range is that of a default class, and the joint itself
has `limited="false"`, it may be taken back on purpose: then it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.limits import unstopped
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Suspect, how_many

TITLE = "A range that is not applied"
FAMILIES = ("passes-limit",)

TURN = 6.2  # rad
ROOM = 10.0  # times the model's extent


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges and slides with a range and without a limit, all together."""
    simulation = model.simulation
    found, bodies = [], simulation.model("jnt_bodyid")
    roaming = set()  # the whole robot goes about by a slide that is far longer than it
    for joint, limited in enumerate(simulation.model("jnt_limited")):
        low, high = simulation.row("jnt_range", joint, 2)
        kind = simulation.joint_type(joint)
        if kind == SLIDE and not limited and high - low > ROOM * simulation.extent:
            roaming.add(bodies[joint])
        span = (high - low) * (
            model.angle_unit if kind == HINGE else 0.0
        )  # of an unused range the numbers stay as written
        turns = TURN <= high - low <= 2.1 * TURN  # one or two, in rad whatever the unit
        if not limited and low < high and span < TURN and not turns and joint in simulation.scalar_joints:
            found.append(joint)
    found = [joint for joint in found if bodies[joint] not in roaming]
    if model.symptom == FAMILIES[0] and (endless := _endless(simulation)):
        names, probe = tuple(simulation.name("joint", each) for each in endless), how_many("such joints", _endless)
        says = f"{names[0]} is driven and has no range: nothing stops it."
        yield Suspect(names, "range", "left out", "", (), probe, 0, says, "the range of the real joint", level="hint")
    taken_back = [joint for joint in found if _taken_back(model, joint)]
    level: Level
    for joints, level in (([each for each in found if each not in taken_back], "cause"), (taken_back, "hint")):
        if not joints:
            continue
        low, high = simulation.row("jnt_range", joints[0], 2)
        degrees = simulation.joint_type(joints[0]) == HINGE and model.angle_unit != 1.0  # as written, for it is unused
        unit = "degrees" if degrees else simulation.unit(joints[0])
        names = tuple(simulation.name("joint", joint) for joint in joints)
        says = f"The range of {names[0]}, {low:.3g} to {high:.3g} {unit}, has no effect."
        healthy, edits = 'limited="auto", with autolimits', model.set("joint", joints, "limited", "true")
        yield Suspect(names, "limited", "false", "true", edits, unstopped(joints), 0.5, says, healthy, level=level)


def _taken_back(model: ReaderModel, joint: int) -> bool:
    """Whether a joint itself says that the range of its default class is not for it."""
    element = model.element("joint", joint)
    return element is not None and element.get("limited") == "false" and not element.get("range")


def _endless(of: Simulation) -> list[int]:
    """The driven hinges and slides for which no range is written, but for wheels."""
    driven = {of.driven_joint(each) for each in range(of.count("actuator"))}
    bare = [joint for joint in of.scalar_joints if joint in driven and not any(of.row("jnt_range", joint, 2))]
    names, bodies = of.names("joint"), of.names("body")
    return [each for each in bare if not is_wheel(names[each], bodies[of.body_of("joint", each)])]
