"""A muscle's `lengthrange` is not the range of its tendon's length.

A muscle's force hangs on its length as a share of `lengthrange`. With that of another muscle, or of the model before
it was scaled, it works outside of its curve: it is weak at one end of the joint's range and gives nothing beyond.

Bad:

    <mujoco>
      <worldbody>
        <site name="origin" pos="0 0 1.4"/>
        <geom type="capsule" fromto="0 0 1.08 0 0 1.4" size="0.03"/>
        <body name="forearm" pos="0 0 1">
          <joint name="elbow" axis="0 -1 0" range="0 120"/>
          <geom type="capsule" fromto="0 0 -0.04 0 0 -0.25" size="0.02"/>
          <site name="insertion" pos="0.02 0 -0.05"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="biceps"><site site="origin"/><site site="insertion"/></spatial>
      </tendon>
      <actuator>
        <muscle name="biceps" tendon="biceps" force="100" lengthrange="0.2 0.34"/>
      </actuator>
    </mujoco>

Good:

    -     <muscle name="biceps" tendon="biceps" force="100" lengthrange="0.2 0.34"/>
    +     <muscle name="biceps" tendon="biceps" force="100" lengthrange="0.359 0.451"/>

The number: how far the tendon's length goes out of `lengthrange` at either end, in widths of it, over 64 poses of all
joints; from 0.2 on, where half of the model's muscles have less than a third of that. Left out, MuJoCo finds the range
itself, by simulating: its manual, Modeling, Length range.

When it is wrong: joints that are never meant to come to the ends of their ranges.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import GAIN_MUSCLE
from clinic.diagnosis.probes.tendons import pulled, reach
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A muscle whose length range is another's"
FAMILIES = ("stuck", "sags", "wrong-numbers")
UNPLANTED = "the healthy models of the bench have no muscles with a length range of their own"

LIMIT, USUAL = 0.2, 1 / 3


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each muscle whose tendon goes far out of its length range, where those of the others hardly do."""
    of = model.simulation
    muscles = [
        each for each in range(of.count("actuator")) if int(of.model("actuator_gaintype")[each]) == GAIN_MUSCLE
        and model.value("actuator", each, "lengthrange") is not None
    ]  # fmt: skip
    beyond = {each: _beyond(of, each) for each in muscles}
    usual = sorted(beyond.values())[len(beyond) // 2] if len(beyond) > 1 else 0.0
    for each, most in beyond.items():
        if most < LIMIT or usual > USUAL * most:
            continue
        low, high = _lengths(of, each) or (0.0, 0.0)
        now, value = model.value("actuator", each, "lengthrange") or "", f"{low:.4g} {high:.4g}"
        edits = model.set("actuator", [each], "lengthrange", value)
        says = f"Over the ranges of all joints its length goes from {low:.4g} to {high:.4g} m, out of its {now}."
        probe = Probe("length out of lengthrange", "of its width", _beyond, (each,), dynamic=False)
        yield Suspect((of.name("actuator", each),), "lengthrange", now, value, edits, probe, LIMIT, says, "below 0.2")


def _lengths(of: Simulation, actuator: int) -> tuple[float, float] | None:
    """The ends of a muscle's length in m, where a tendon makes it and its joints have ranges."""
    tendon, gear = pulled(of).get(actuator), of.gear(actuator)
    found = reach(of, tendon) if tendon is not None else None
    ends = sorted(gear * each for each in found) if found else []
    return (ends[0], ends[1]) if ends and ends[1] > ends[0] else None


def _beyond(of: Simulation, actuator: int) -> float:
    low, high = of.row("actuator_lengthrange", actuator, 2)
    found = _lengths(of, actuator)
    return max(low - found[0], found[1] - high, 0.0) / (high - low) if found and high > low else 0.0
