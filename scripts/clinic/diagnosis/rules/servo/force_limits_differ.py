"""A joint gives less force than the actuator's own limit says.

`forcerange` limits an actuator, and `actuatorfrcrange` all that actuators do to a joint. The smaller of the two holds,
without a word: whoever raises `forcerange` finds that nothing changes.

Bad:

    <mujoco>
      <worldbody>
        <body name="shin" pos="0 0 1">
          <joint name="knee" axis="0 1 0" actuatorfrcrange="-1 1"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="0.2"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="knee" forcerange="-3 3" ctrlrange="-3 3"/>
      </actuator>
    </mujoco>

Good:

    -       <joint name="knee" axis="0 1 0" actuatorfrcrange="-1 1"/>
    +       <joint name="knee" axis="0 1 0" actuatorfrcrange="-3 3"/>

The number: the upper end of `forcerange`, times the gear, over that of `actuatorfrcrange`; told above 1.2. In 286 of
289 healthy models it is less, or one of the two is left out.

When it is wrong: the joint's limit is that of the real gear, and the actuator's a leftover.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A joint's force limit below its actuator's"
FAMILIES = ("stuck", "sags", "slow")
UNPLANTED = "nearly no healthy model has both limits"

TIMES = 1.2


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The joints that clamp the force of their actuator, all together."""
    of = model.simulation
    found = {joint: actuator for actuator, joint in _pairs(of) if _times(of, actuator, joint) > TIMES}
    if not found:
        return
    joint, actuator = max(found.items(), key=lambda pair: _times(of, pair[1], pair[0]))
    (low, high), force = of.row("jnt_actfrcrange", joint, 2), _force(of, actuator)
    unit = "N" if of.unit(joint) == "m" else "N m"
    yield Suspect(
        tuple(of.name("joint", each) for each in found),
        "actuatorfrcrange",
        f"{low:g} {high:g}",
        f"{-force:g} {force:g}",
        (),
        Probe("an actuator's force limit, times that of its joint", "", _most, tuple(found.items()), dynamic=False),
        TIMES,
        f"{of.name('actuator', actuator)} may give {force:.3g} {unit}, and its joint takes {high:.3g} {unit} of it.",
        "at most 1.2 in 286 of 289 healthy models",
    )


def _pairs(of: Simulation) -> Iterator[tuple[int, int]]:
    """Actuators with a force limit on joints with one."""
    for actuator, limited in enumerate(of.model("actuator_forcelimited")):
        joint = of.driven_joint(actuator)
        if limited and joint is not None and of.model("jnt_actfrclimited")[joint]:
            yield actuator, joint


def _force(of: Simulation, actuator: int) -> float:
    return of.row("actuator_forcerange", actuator, 2)[1] * abs(of.gear(actuator))


def _times(of: Simulation, actuator: int, joint: int) -> float:
    high = of.row("jnt_actfrcrange", joint, 2)[1]
    return _force(of, actuator) / high if high > 0 else 0.0


def _most(of: Simulation, *pairs: tuple[int, int]) -> float:
    return max(_times(of, actuator, joint) for joint, actuator in pairs)
