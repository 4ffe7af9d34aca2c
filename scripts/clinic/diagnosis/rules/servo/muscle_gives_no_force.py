"""A muscle gives next to no force, however it is excited.

Excitation adds the most to a muscle's force near its best length, and nothing below half of that and above 1.6 times
(`lmin` and `lmax`). `lengthrange`, in m, and `range`, in the muscle's own lengths, say where it is. With a
`lengthrange` of another tendon, a `range` in percent, a `force` of 0, a `forcerange` without negative forces, or a
control range that ends at a hundredth, it does not pull.

Bad:

    <mujoco>
      <worldbody>
        <site name="origin" pos="0.03 0 1.2"/>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 -1 0" range="0 90"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.24" size="0.016" mass="0.9"/>
          <site name="insertion" pos="0.02 0 -0.05"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="biceps">
          <site site="origin"/>
          <site site="insertion"/>
        </spatial>
      </tendon>
      <actuator>
        <muscle tendon="biceps" force="300" lengthrange="0.18 0.26" range="75 105"/>
      </actuator>
    </mujoco>

Good:

    -     <muscle tendon="biceps" force="300" lengthrange="0.18 0.26" range="75 105"/>
    +     <muscle tendon="biceps" force="300" lengthrange="0.18 0.26" range="0.75 1.05"/>

The number: the most that excitation adds to the muscle's force, at the start and at nine poses between the ends of all
ranges, as a share of its peak force; what is missing of that, above 0.9.

When it is wrong: a muscle that is to be paralysed.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import GAIN_MUSCLE
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A muscle that gives no force"
FAMILIES = ("stuck", "sags")
UNPLANTED = "a muscle may be paralysed on purpose"

LEAST = 0.9
SHARES = (0.0, 0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 1.0)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Muscles without force, all with the same reason together."""
    of = model.simulation
    for each, kind in enumerate(of.model("actuator_gaintype")):
        if int(kind) != GAIN_MUSCLE or _missing(of, each) <= LEAST:
            continue
        low, high = of.row("actuator_lengthrange", each, 2)
        force, length, most = _peak(of, each), _length(of, each), _excited(of, each)
        attribute, now, why = "lengthrange", f"{low:.4g} {high:.4g}", f"{length:.3g} long, and its lengthrange is"
        says = f"At the start it is {why} {now}: in none of ten poses does it give a tenth of its {force:.3g} N."
        if force <= 1e-9:
            attribute, now, says = "force", "0", "Its peak force is 0: leave it out, or give it in N."
        elif of.model("actuator_forcelimited")[each] and of.row("actuator_forcerange", each, 2)[0] > force * (
            LEAST - 1
        ):
            attribute, now = "forcerange", " ".join(f"{x:g}" for x in of.row("actuator_forcerange", each, 2))
            says = f"A muscle's force is negative, and its forcerange is {now}."
        elif most < 1.0 - LEAST:
            attribute, now = "ctrlrange", " ".join(f"{x:g}" for x in of.row("actuator_ctrlrange", each, 2))
            says = f"It is excited by {most:g} at most, of 1."
        elif low < length < high:
            attribute, now = "range", " ".join(f"{x:g}" for x in of.gain(each)[:2])
            least, longest = of.gain(each)[4:6]
            says = f"Its own lengths go over {now}, and it gives force from {least:g} to {longest:g}, most at 1."
        value = {"force": "left out", "ctrlrange": "0 1", "range": "0.75 1.05"}.get(attribute, "left out")
        written = model.value("actuator", each, attribute) is not None
        left = model.remove("actuator", [each], attribute)
        edits = model.set("actuator", [each], attribute, value) if value[0] == "0" else left
        yield Suspect(
            (of.name("actuator", each),),
            attribute,
            now,
            value,
            edits if written else (),
            Probe("what a muscle lacks of its peak force wherever it is", "", _missing, (each,), dynamic=False),
            LEAST,
            says,
            "a muscle near its best length, excited from 0 to 1",
        )


def _peak(of: Simulation, actuator: int) -> float:
    """In N; where `force` is negative, from `scale`."""
    force, scale = of.gain(actuator)[2:4]
    return force if force >= 0 else scale / max(of.model("actuator_acc0")[actuator], 1e-15)


def _excited(of: Simulation, actuator: int) -> float:
    limited = of.model("actuator_ctrllimited")[actuator]
    return min(1.0, of.row("actuator_ctrlrange", actuator, 2)[1]) if limited else 1.0


def _length(of: Simulation, actuator: int) -> float:
    of.begin()
    return of.data("actuator_length")[actuator]


@kept
def _missing(of: Simulation, actuator: int) -> float:
    """What excitation leaves of the peak force, where it gives the most."""
    peak = _peak(of, actuator)
    given = max(_given(of, actuator, share) for share in (None, *SHARES)) if peak > 1e-9 else 0.0
    return 1.0 - given / max(peak, 1e-9)


def _given(of: Simulation, actuator: int, share: float | None) -> float:
    """What full excitation adds to the force in N, in a pose between the ends of all ranges; at the start for None."""
    state = int(of.model("actuator_actadr")[actuator])
    of.begin(forward=False)
    if share is not None:
        for joint, (low, high) in of.ranges.items():
            of.put(joint, low + share * (high - low))
    of.engine.write("qvel", [0.0] * of.count("dof"))
    forces = []
    for excited in (0.0, _excited(of, actuator)):
        if state >= 0:
            of.engine.write("act", [excited], state)
        else:
            of.engine.write("ctrl", [excited], actuator)
        of.engine.forward()
        forces.append(of.data("actuator_force")[actuator])
    return forces[0] - forces[1]
