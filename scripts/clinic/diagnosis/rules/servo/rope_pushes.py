"""A motor on a rope can do nothing but push it.

The length of a spatial tendon grows under a positive force: a winch pulls with a negative one. With a control range
of positive numbers, or a `gear` with the wrong sign, the finger opens where it should close, and a cable robot pushes
its platform away.

Bad:

    <mujoco>
      <worldbody>
        <site name="winch" pos="0 0 2"/>
        <body name="weight" pos="0 0 1">
          <joint type="slide" axis="0 0 1"/>
          <geom type="sphere" size="0.05" mass="1"/>
          <site name="eye" pos="0 0 0.05"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope">
          <site site="winch"/>
          <site site="eye"/>
        </spatial>
      </tendon>
      <actuator>
        <motor tendon="rope" ctrlrange="0 50"/>
      </actuator>
    </mujoco>

Good:

    -     <motor tendon="rope" ctrlrange="0 50"/>
    +     <motor tendon="rope" ctrlrange="0 50" gear="-1"/>

The number: the most that the motor pushes over its control range in N, at least ten times what it can pull. Of servos
of length it is their `forcerange`. Muscles are left alone: they never push.

When it is wrong: a tendon that stands for a piston.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import BIAS_NONE, GAIN_FIXED, GAIN_MUSCLE
from clinic.diagnosis.probes.tendons import joints_of, pulled
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A motor that pushes a rope"
FAMILIES = ("drifts", "stuck")
UNPLANTED = "a tendon may stand for a piston"

MOST = 10.0  # times what it pulls
PISTON = re.compile(r"(?i)piston|cylinder|hydraul|pneum|strut|linear")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Motors on spatial tendons that push and do not pull."""
    of = model.simulation
    for each in range(of.count("actuator")):
        push, pull = _forces(of, each)
        tendon = int(of.model("actuator_trnid")[2 * each])
        if push <= 0 or push < MOST * pull or PISTON.search(of.name("tendon", tendon) + of.name("actuator", each)):
            continue
        attribute, now, value = "gear", f"{of.gear(each):g}", f"{-of.gear(each):g}"
        if not _is_motor(of, each):
            low, high = of.row("actuator_forcerange", each, 2)
            attribute, now, value = "forcerange", written((low, high)), written((0.0 - high, 0.0 - low))
        yield Suspect(
            (of.name("actuator", each), of.name("tendon", tendon)),
            attribute,
            now,
            value,
            model.set("actuator", [each], attribute, value),
            Probe("the most that a motor pushes a rope", "N", _pushes, (each,), dynamic=False),
            1e-9,
            f"{of.name('actuator', each)} pushes the ends of {of.name('tendon', tendon)} apart with up to "
            f"{push:.3g} N, and pulls with {pull:.3g} N at most.",
            "a negative force, which pulls",
        )


def _pushes(of: Simulation, actuator: int) -> float:
    push, pull = _forces(of, actuator)
    return push if push >= MOST * pull else 0.0


def _is_motor(of: Simulation, actuator: int) -> bool:
    return of.actuator_types(actuator)[:2] == (GAIN_FIXED, BIAS_NONE)


def _forces(of: Simulation, actuator: int) -> tuple[float, float]:
    """The most that an actuator on a spatial tendon pushes and pulls in N, by its limits; zeros for another one."""
    tendon = pulled(of).get(actuator)
    field, factor = ("ctrl", of.gain(actuator)[0]) if _is_motor(of, actuator) else ("force", 1.0)
    if tendon is None or joints_of(of, tendon) or of.actuator_types(actuator)[0] == GAIN_MUSCLE:
        return 0.0, 0.0
    if not of.model(f"actuator_{field}limited")[actuator]:
        return 0.0, 0.0
    forces = [factor * of.gear(actuator) * end for end in of.row(f"actuator_{field}range", actuator, 2)]
    return max(0.0, *forces), max(0.0, *(-force for force in forces))
