"""The actuators stand in another order than the joints: left and right are exchanged.

`ctrl` is in the order of the actuators, `qpos` in that of the joints. A policy that takes them for the same
moves the right leg by what was meant for the left one.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <freejoint/>
          <geom size="0.1"/>
          <body pos="0.2 0.1 0">
            <joint name="FL" axis="0 1 0" damping="1"/>
            <geom size="0.03"/>
          </body>
          <body pos="0.2 -0.1 0">
            <joint name="FR" axis="0 1 0" damping="1"/>
            <geom size="0.03"/>
          </body>
          <body pos="-0.2 0.1 0">
            <joint name="RL" axis="0 1 0" damping="1"/>
            <geom size="0.03"/>
          </body>
          <body pos="-0.2 -0.1 0">
            <joint name="RR" axis="0 1 0" damping="1"/>
            <geom size="0.03"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="FR"/>
        <motor joint="FL"/>
        <motor joint="RR"/>
        <motor joint="RL"/>
      </actuator>
    </mujoco>

Good:

    -     <motor joint="FR"/>
    -     <motor joint="FL"/>
    -     <motor joint="RR"/>
    -     <motor joint="RL"/>
    +     <motor joint="FL"/>
    +     <motor joint="FR"/>
    +     <motor joint="RL"/>
    +     <motor joint="RR"/>

The number: how many actuators do not drive the joint of the same place. Told of free robots where exchanging left and
right puts all of them in order.

When it is wrong: programs that go by names; so it is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "The actuators are in another order than the joints"
FAMILIES = ("drifts", "wrong-numbers")
UNPLANTED = "a model has one order, and only names tell that another was meant"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All actuators, where left and right of them are exchanged."""
    of = model.simulation
    driven = _driven(of)
    if len(driven) < 4 or not of.free_bodies or driven == sorted(driven):
        return
    found = twins(of)
    swapped = [partner if (partner := found.partner("joint", joint)) is not None else joint for joint in driven]
    if swapped != sorted(driven):
        return
    names = tuple(of.name("actuator", index) for index in range(of.count("actuator")))
    probe = Probe("actuators that do not stand where their joint does", "", _astray, dynamic=False)
    order = " ".join(of.engine.name("joint", joint) for joint in driven[:8])
    says = f"They drive {order} ...; the joints stand in the order " + " ".join(
        of.engine.name("joint", joint) for joint in sorted(driven)[:8]
    )
    yield Suspect(names, "order", order, "that of the joints", (), probe, 0.5, says, "one order")


def _driven(of: Simulation) -> list[int]:
    found = [of.driven_joint(actuator) for actuator in range(of.count("actuator"))]
    joints = [joint for joint in found if joint is not None]
    return joints if len(set(joints)) == len(found) else []


def _astray(simulation: Simulation) -> float:
    driven = _driven(simulation)
    return float(sum(a != b for a, b in zip(driven, sorted(driven), strict=True)))
