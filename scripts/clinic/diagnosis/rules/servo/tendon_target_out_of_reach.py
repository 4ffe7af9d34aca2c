"""A servo on a tendon is told lengths that the tendon cannot have.

The control of a position servo on a tendon is a length in m, or for a fixed tendon the sum of the coefficients times
the joints. A control range of 0 to 255 from the gripper's protocol, an angle, or a way from the start in place of the
length, sends it to an end and leaves it there.

Bad:

    <mujoco>
      <option integrator="implicitfast"/>
      <worldbody>
        <body pos="0 0 1">
          <geom type="box" size="0.05 0.05 0.02"/>
          <body pos="0 0.02 0.05">
            <joint name="left" type="slide" axis="0 1 0" range="0 0.04" damping="5"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
          <body pos="0 -0.02 0.05">
            <joint name="right" type="slide" axis="0 -1 0" range="0 0.04" damping="5"/>
            <geom type="box" size="0.01 0.005 0.02"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="split">
          <joint joint="left" coef="0.5"/>
          <joint joint="right" coef="0.5"/>
        </fixed>
      </tendon>
      <actuator>
        <position tendon="split" kp="100" kv="5" forcerange="-5 5" ctrlrange="0 255"/>
      </actuator>
    </mujoco>

Good:

    -     <position tendon="split" kp="100" kv="5" forcerange="-5 5" ctrlrange="0 255"/>
    +     <position tendon="split" kp="100" kv="5" forcerange="-5 5" ctrlrange="0 0.04"/>

The number: the share of the targets that the tendon cannot reach while its joints are within their ranges; more than
two thirds. Of a spatial tendon the reach is that of 64 poses, and a fifth more at each end. Targets that take the
tendon less than a twentieth of its way are told too: a range of 0 to 1 beside a gain for 0 to 255.

When it is wrong: targets beyond the reach as a way to command a force.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes import tendons
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A servo whose tendon cannot be as long as it is told"
FAMILIES = ("stuck", "passes-limit", "jumps-at-start")
UNPLANTED = "few healthy models have servos on tendons"

MOST, SPARE, LEAST = 2 / 3, 0.2, 0.05


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos on tendons that are mostly told what cannot be, or next to nothing, each by itself."""
    of = model.simulation
    for each in range(of.count("actuator")):
        targets, reach = tendons.targets(of, each), _reach(of, each)
        if targets is None or reach is None:
            continue
        (low, high), (least, most) = targets, reach
        tendon = of.name("tendon", int(of.model("actuator_trnid")[2 * each]))
        says = f"Targets from {low:.3g} to {high:.3g} for {tendon}, whose length goes from {least:.3g} to {most:.3g}."
        if _beyond(of, each) > MOST:
            probe = Probe(
                "share of a servo's targets that its tendon cannot reach", "", _beyond, (each,), dynamic=False
            )
            limit = MOST
        elif _unused(of, each) > 1 - LEAST:
            probe = Probe("share of a tendon's way that its servo cannot take", "", _unused, (each,), dynamic=False)
            limit = 1 - LEAST
        else:
            continue
        offset, scale = tendons.servo(of, each) or (0.0, 1.0)
        now = " ".join(f"{x:g}" for x in of.row("actuator_ctrlrange", each, 2))
        value = " ".join(f"{x + 0.0:.4g}" for x in sorted((x - offset) / scale for x in reach))
        edits, names = model.set("actuator", [each], "ctrlrange", value), (of.name("actuator", each), tendon)
        yield Suspect(names, "ctrlrange", now, value, edits, probe, limit, says, "lengths that the tendon can have")


def _reach(of: Simulation, actuator: int) -> tuple[float, float] | None:
    """What the tendon of a servo can reach, with what poses between may have missed; None where it has no ends."""
    if tendons.servo(of, actuator) is None:
        return None
    tendon = int(of.model("actuator_trnid")[2 * actuator])
    found = tendons.reach(of, tendon)
    if found is None or found[1] <= found[0]:
        return None
    spare = 0.0 if tendons.joints_of(of, tendon) else SPARE * (found[1] - found[0])
    return found[0] - spare, found[1] + spare


def _within(of: Simulation, actuator: int) -> tuple[float, float, float]:
    """How much of a servo's targets its tendon can reach, how wide the targets are, and how wide the reach."""
    targets, reach = tendons.targets(of, actuator), _reach(of, actuator)
    if targets is None or reach is None or targets[1] <= targets[0]:
        return 1.0, 1.0, 1.0
    both = min(targets[1], reach[1]) - max(targets[0], reach[0])
    return max(0.0, both), targets[1] - targets[0], reach[1] - reach[0]


def _beyond(of: Simulation, actuator: int) -> float:
    both, told, _ = _within(of, actuator)
    return 1.0 - both / told


def _unused(of: Simulation, actuator: int) -> float:
    both, _, way = _within(of, actuator)
    return 1.0 - both / way
