"""Motors drive light joints without damping, friction or armature: a controller in code shakes them.

With `<motor>` the gains stand in the code that computes the torques. How large they may be depends on the joints: one
that has nothing but the inertia of a light link does not bear the derivative gain of a real wrist or ankle. The model
by itself shows nothing.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper_arm">
          <joint name="shoulder" axis="0 1 0" range="-120 120"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03" mass="1"/>
          <body name="forearm" pos="0.3 0 0">
            <joint name="elbow" axis="0 1 0" range="-120 120"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02" mass="0.5"/>
            <body name="hand" pos="0.2 0 0">
              <joint name="wrist" axis="1 0 0" range="-90 90"/>
              <geom type="box" size="0.04 0.02 0.02" mass="0.2"/>
            </body>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="shoulder"/>
        <motor joint="elbow"/>
        <motor joint="wrist"/>
      </actuator>
    </mujoco>

Good:

      <mujoco>
    +   <default>
    +     <joint damping="0.05" armature="0.01" frictionloss="0.1"/>
    +   </default>

The number: the derivative gain that the lightest joint bears, 2 M / h with its inertia M and the timestep h, below
1 N m s/rad (an explicit damper is stable below h kd / M = 2). Told where three motors and more drive hinges with
ranges, of which none has damping, friction or armature, in no fluid. Of the healthy robots with motors none is so.
With `--symptom oscillates` all hinges and slides are told that have neither damping nor friction and no servo, in no
fluid; the edit lets their speed fall to a third in a second.

When it is wrong: torques that come from a policy without any gains.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import HINGE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.servo.no_armature import ROTOR
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many, rounded

TITLE = "Motors on joints that nothing damps"
FAMILIES = ("oscillates", "explodes", "drifts")
UNPLANTED = "the harm shows under a controller in code alone"

ENOUGH, LEAST = 3, 1.0  # motors; N m s/rad


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The driven joints of a robot of which none has damping, friction or armature, together."""
    of = model.simulation
    if model.symptom == FAMILIES[0] and _loose(of):
        yield _undamped(model)
        return
    joints = _bare(of)
    if len(joints) < ENOUGH:
        return
    lightest = min(joints, key=lambda joint: of.mass_diagonal[of.dof(joint)])
    inertia = of.mass_diagonal[of.dof(lightest)]
    says = f"Of {len(joints)} driven joints none has damping, friction or armature. "
    says += f"With its inertia of {inertia:.2g} kg m2 {of.name('joint', lightest)} bears "
    says += f"a derivative gain of {2 * inertia / of.timestep:.2g} N m s/rad; in code it is often more."
    yield Suspect(
        tuple(of.name("joint", joint) for joint in (lightest, *(each for each in joints if each != lightest))),
        "armature",
        "0",
        f"{ROTOR:g}",
        model.set("joint", joints, "armature", f"{ROTOR:g}"),
        Probe("what a derivative gain of 1 N m s/rad is of the most that a joint bears", "", _share, dynamic=False),
        1 / LEAST,
        says,
        "damping, friction or armature on some joint, as all healthy robots with motors have",
    )


def _undamped(model: ReaderModel) -> Suspect:
    """The joints that nothing damps, each to be damped by its own inertia a second."""
    of = model.simulation
    found = {joint: rounded(of.mass_diagonal[of.dof(joint)]) for joint in _loose(of)}
    names = tuple(of.name("joint", each) for each in found)
    edits = tuple(edit for each, value in found.items() for edit in model.set("joint", [each], "damping", value))
    says = f"Nothing takes energy out of {names[0]}: it has neither damping nor friction."
    probe, healthy = how_many("joints that nothing damps", _loose), "what the real joint has"
    return Suspect(names, "damping", "0", next(iter(found.values())), edits, probe, 0, says, healthy, level="hint")


def _share(of: Simulation) -> float:
    """The timestep over twice the least inertia of the bare joints, in rad/(N m s)."""
    return max((of.timestep / (2 * of.mass_diagonal[of.dof(joint)]) for joint in _bare(of)), default=0.0)


def _bare(of: Simulation) -> list[int]:
    """The hinges that motors drive; none where one has damping, friction, armature, or no range, or in a fluid."""
    actuators = range(of.count("actuator"))
    hinges = [joint for joint in of.drivers if of.joint_type(joint) == HINGE]
    fields = ("dof_damping", "dof_armature", "dof_frictionloss")
    held = any(of.model(field)[of.dof(joint)] for joint in hinges for field in fields)
    motors = all(of.actuator_types(each)[:2] == (0, 0) for each in actuators)
    ranged = [joint for joint in hinges if joint in of.ranges]  # a rotor turns round, as a wheel does
    return [] if held or not motors or of.in_fluid or len(ranged) < len(hinges) else hinges


def _loose(of: Simulation) -> list[int]:
    """The hinges and slides that carry something, with neither damping, friction nor a servo; none in a fluid."""
    fields = [of.model(field) for field in ("dof_damping", "dof_frictionloss")]
    served = {of.driven_joint(each) for each in range(of.count("actuator")) if not of.is_motor(each)}
    free = [each for each in of.scalar_joints if each not in served]
    return [] if of.in_fluid else [each for each in free if not any(field[of.dof(each)] for field in fields)]
