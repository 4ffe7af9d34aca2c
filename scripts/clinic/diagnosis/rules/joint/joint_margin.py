"""A limit pushes long before it is reached: a large `margin` of a joint or a tendon.

`margin` is subtracted from the distance to the limit: the limit pushes as if it stood that far inside of the range. A
hinge with a range to 60 degrees and a margin of 0.5 rad stops at 31 degrees, and no motor brings it further without
pressing it in. `margin` of a hinge is in rad whatever the unit of angles is: 5 for 5 degrees is 286.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" range="-60 60" margin="0.5"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint name="elbow" axis="0 1 0" range="-60 60" margin="0.5"/>
    +       <joint name="elbow" axis="0 1 0" range="-60 60" margin="0.01"/>

The number: the share of its range by which a joint that is at rest is away from its upper limit and pushed back from
it, without gravity, contacts, springs and actuators, in steps of 2.5 %; of a tendon the margin over the
range. Above 10 % is told. MuJoCo's manual, XML reference, `margin` of joint and of tendon.

When it is wrong: a range that is written as wide as the hardware and made narrower by the margin.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.servo import alone
from clinic.diagnosis.probes.tendons import joints_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A limit that pushes before it is reached"
FAMILIES = ("stuck", "sags")
UNPLANTED = "no healthy model has a margin of limits above 10 % of the range"

MOST = 0.1  # of the range
POINTS = 40


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Hinges and slides whose limits push inside of the range, all together; tendons with such a margin."""
    of = model.simulation
    for kind in ("joint", "tendon"):
        wide = {each: share for each, share in _wide(of, kind).items() if share > MOST}
        if not wide:
            continue
        worst = max(wide, key=lambda each: wide[each])
        low, high = of.row(f"{_short(kind)}_range", worst, 2)
        margin = of.model(f"{_short(kind)}_margin")[worst]
        unit = f" {of.unit(worst)}" if kind == "joint" else "" if joints_of(of, worst) else " m"
        says = f"{of.name(kind, worst)} is pushed back {margin:.3g}{unit} before its limit; its range is "
        says += f"{high - low:.3g}{unit} wide."
        yield Suspect(
            tuple(of.name(kind, each) for each in wide),
            "margin",
            f"{margin:g}",
            "0",
            model.set(kind, tuple(wide), "margin", "0"),
            Probe("share of the range from which a limit pushes", "", _most, (kind, tuple(wide)), dynamic=False),
            MOST,
            says,
            "0, MuJoCo's default",
        )


def _short(kind: str) -> str:
    return "jnt" if kind == "joint" else kind


def _wide(of: Simulation, kind: str) -> dict[int, float]:
    """The share of the range from which the limits of elements with a margin push."""
    made, margins = {}, of.model(f"{_short(kind)}_margin")
    for each, limited in enumerate(of.model(f"{_short(kind)}_limited")):
        low, high = of.row(f"{_short(kind)}_range", each, 2)
        if not limited or not margins[each] > MOST / 2 * (high - low):
            continue
        if kind == "tendon":
            made[each] = margins[each] / max(high - low, 1e-9)
        elif each in of.scalar_joints:
            made[each] = _pushed(of, each, low, high)
    return made


def _pushed(of: Simulation, joint: int, low: float, high: float) -> float:
    """The largest share of the range, to a half, by which a joint is off its upper limit and pushed back."""
    farthest = 0.0
    with alone(of, limp=True):
        for point in range(1, POINTS // 2):
            of.begin(forward=False)
            of.put(joint, high - point / POINTS * (high - low))
            of.engine.forward()
            if of.data("qfrc_constraint")[of.dof(joint)] >= 0:
                break
            farthest = point / POINTS
    return farthest


def _most(of: Simulation, kind: str, found: tuple[int, ...]) -> float:
    return max(_wide(of, kind).get(each, 0.0) for each in found)
