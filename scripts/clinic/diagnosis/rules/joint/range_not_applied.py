"""A joint has a range that is not applied.

`limited="false"`, or `<compiler autolimits="false"/>` without `limited="true"`, leaves a range without effect.

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

When it is wrong: a range that is kept for reference.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.limits import unstopped
from clinic.diagnosis.probes.wheels import is_wheel
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

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
    if not found:
        return
    low, high = simulation.row("jnt_range", found[0], 2)
    yield Suspect(
        tuple(simulation.name("joint", each) for each in found),
        "limited",
        "false",
        "true",
        model.set("joint", found, "limited", "true"),
        unstopped(found),
        0.5,
        f"The range of {simulation.name('joint', found[0])}, {low:.3g} to {high:.3g} {simulation.unit(found[0])}, "
        "has no effect.",
        'limited="auto", with autolimits',
    )


def _endless(of: Simulation) -> list[int]:
    """The driven hinges and slides for which no range is written, but for wheels."""
    driven = {of.driven_joint(each) for each in range(of.count("actuator"))}
    bare = [joint for joint in of.scalar_joints if joint in driven and not any(of.row("jnt_range", joint, 2))]
    names, bodies = of.names("joint"), of.names("body")
    return [each for each in bare if not is_wheel(names[each], bodies[of.body_of("joint", each)])]
