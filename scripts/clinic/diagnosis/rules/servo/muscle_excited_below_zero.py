"""A muscle's control range goes beyond 0 to 1.

A muscle takes an excitation from 0 to 1, and MuJoCo clips what it gets. With the range of a motor, -1 to 1, from a
default class that all actuators share, half of what a controller sends does nothing.

Bad:

    <mujoco>
      <default>
        <general ctrllimited="true" ctrlrange="-1 1"/>
      </default>
      <worldbody>
        <site name="origin" pos="0.05 0 1"/>
        <body pos="0 0 0.9">
          <joint name="elbow" axis="0 1 0" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
          <site name="insertion" pos="0.05 0 0"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="biceps">
          <site site="origin"/>
          <site site="insertion"/>
        </spatial>
      </tendon>
      <actuator>
        <muscle name="biceps" tendon="biceps" lengthrange="0.05 0.15"/>
      </actuator>
    </mujoco>

Good:

    -   <default>
    -     <general ctrllimited="true" ctrlrange="-1 1"/>
    -   </default>

    -     <muscle name="biceps" tendon="biceps" lengthrange="0.05 0.15"/>
    +     <muscle name="biceps" tendon="biceps" lengthrange="0.05 0.15" ctrllimited="true" ctrlrange="0 1"/>

The number: the share of the control range that lies outside of 0 to 1, where nothing changes; more than 5 %.

When it is wrong: a controller that maps its own range onto the muscle's.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import DYN_MUSCLE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A muscle's control range goes beyond 0 to 1"
FAMILIES = ("stuck", "wrong-numbers")
MINOR = True
UNPLANTED = "no healthy model has muscles with a range of their own"

IDLE = 0.05


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All muscles of which a part of the control range does nothing."""
    of = model.simulation
    muscles = [each for each, kind in enumerate(of.model("actuator_dyntype")) if kind == DYN_MUSCLE]
    found = [each for each in muscles if _idle(of, each) > IDLE]
    if found:
        low, high = of.row("actuator_ctrlrange", found[0], 2)
        yield Suspect(
            tuple(of.name("actuator", each) for each in found),
            "ctrlrange",
            f"{low:g} {high:g}",
            "0 1",
            model.set("actuator", found, "ctrlrange", "0 1"),
            Probe("share of a muscle's control range that does nothing", "", _idle, tuple(found), dynamic=False),
            IDLE,
            f"Controls from {low:g} to {high:g} for a muscle, which takes 0 to 1.",
            "0 to 1",
        )


def _idle(simulation: Simulation, *actuators: int) -> float:
    worst = 0.0
    for each in actuators:
        low, high = simulation.row("actuator_ctrlrange", each, 2)
        if simulation.model("actuator_ctrllimited")[each] and high > low:
            worst = max(worst, 1 - max(0.0, min(high, 1) - max(low, 0)) / (high - low))
    return worst
