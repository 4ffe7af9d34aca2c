"""All muscles of a joint turn it the same way.

A muscle pulls and cannot push: to go to and fro a joint needs one on either side of its axis. A site with the wrong
sign, or the insertion of another muscle, puts the extensor among the flexors, and the joint goes to one end and stays.

Bad:

    <mujoco>
      <worldbody>
        <site name="front" pos="0.03 0 1.2"/>
        <site name="back" pos="0.03 0.01 1.2"/>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 -1 0" range="0 120"/>
          <geom type="capsule" fromto="0 0 -0.02 0 0 -0.24" size="0.016" mass="0.9"/>
          <site name="radius" pos="0.025 0 -0.03"/>
          <site name="olecranon" pos="0.025 0 -0.04"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="biceps"><site site="front"/><site site="radius"/></spatial>
        <spatial name="triceps"><site site="back"/><site site="olecranon"/></spatial>
      </tendon>
      <actuator>
        <muscle name="biceps" tendon="biceps"/>
        <muscle name="triceps" tendon="triceps"/>
      </actuator>
    </mujoco>

Good:

    -       <site name="olecranon" pos="0.025 0 -0.04"/>
    +       <site name="olecranon" pos="-0.025 0 -0.04"/>

    -     <site name="back" pos="0.03 0.01 1.2"/>
    +     <site name="back" pos="-0.03 0.01 1.2"/>

The number: hinges with a range, and without a spring, another actuator and an equality, on which two muscles and more
have a lever arm of more than 1 mm, all to the same side, at the start and in 16 poses drawn over all ranges.

When it is wrong: a joint that its weight is to bring back. So it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import GAIN_MUSCLE, HINGE
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.load import poses
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "Muscles that all pull a joint one way"
FAMILIES = ("stuck", "passes-limit")
UNPLANTED = "the bench's healthy models have hardly any muscles"

LEAST, STEP = 1e-3, 1e-3  # m, rad


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each joint that nothing pulls back, with its muscles."""
    of = model.simulation
    for joint, muscles in _one_way(of).items():
        names = [of.name("actuator", each) for each in muscles]
        says = (
            f"{names[0]} and {len(names) - 1} more turn it the same way, and nothing turns it back: muscles only pull."
        )
        probe = how_many("joints that all muscles turn one way", _one_way)
        told = (of.name("joint", joint), *names)
        yield Suspect(told, "tendon", names[0], "one on either side", (), probe, 0, says, "0", level="hint")


@kept
def _one_way(of: Simulation) -> dict[int, list[int]]:
    """By hinge that goes one way alone: the muscles that turn it."""
    muscles = [each for each, kind in enumerate(of.model("actuator_gaintype")) if int(kind) == GAIN_MUSCLE]
    if len(muscles) < 2:
        return {}
    others = {of.driven_joint(each) for each in range(of.count("actuator")) if each not in muscles}
    held = others | {joint for _, (*two, _) in couplings(of) for joint in two}
    hinges = [joint for joint in of.ranges if of.joint_type(joint) == HINGE and joint not in held]
    arms = _arms(of, [joint for joint in hinges if not of.model("jnt_stiffness")[joint]])
    made = {}
    for joint, over_poses in arms.items():
        acting = [each for each in muscles if max(abs(arm[each]) for arm in over_poses) > LEAST]
        signs = {arm[each] > 0 for each in acting for arm in over_poses if abs(arm[each]) > LEAST / 10}
        if len(acting) > 1 and len(signs) == 1:
            made[joint] = acting
    return made


def _arms(of: Simulation, hinges: list[int]) -> dict[int, list[list[float]]]:
    """By hinge and pose: how much longer each actuator becomes as the hinge turns, in m/rad."""
    made: dict[int, list[list[float]]] = {joint: [] for joint in hinges}
    for pose in poses(of):
        begun = _lengths(of, pose)
        for joint, arms in made.items():
            turned = [*pose]
            turned[of.place(joint)] += STEP
            arms.append([(after - before) / STEP for before, after in zip(begun, _lengths(of, turned), strict=True)])
    return made


def _lengths(of: Simulation, pose: list[float]) -> list[float]:
    of.begin(forward=False)
    of.engine.write("qpos", pose)
    of.engine.forward()
    return list(of.data("actuator_length"))
