"""The solver stops before it has found the contact forces.

`iterations` of `<option>` is 100 and `tolerance` 1e-8 unless a model says otherwise. After one or two iterations, which
is what models for fast learning have, the forces may be far from those of the constraints: feet sink, loops open,
stacks creep. In this example one iteration of Newton, the default, is as good as 100.

Bad:

    <mujoco>
      <option iterations="1" solver="PGS"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 0.1"><freejoint/><geom type="box" size="0.1 0.1 0.1" mass="1"/></body>
        <body pos="0 0 0.3"><freejoint/><geom type="box" size="0.1 0.1 0.1" mass="5"/></body>
        <body pos="0 0 0.5"><freejoint/><geom type="box" size="0.1 0.1 0.1" mass="50"/></body>
      </worldbody>
    </mujoco>

Good:

    -   <option iterations="1" solver="PGS"/>
    +   <option iterations="100" solver="PGS"/>

The number: the fastest joint after letting go and under command, above 20 rad/s, and how deep contacts are, above 0.005
of the model's extent; told where MuJoCo's own iterations and tolerance bring it to half or less.

When it is wrong: a model for learning, whose makers traded that for speed.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.drive import commanded, pressed_in
from clinic.diagnosis.probes.run import fastest, sunk
from clinic.diagnosis.probes.solver import USUAL, early, patient
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "The solver stops too early"
FAMILIES = ("explodes", "sinks", "oscillates", "slips", "drifts")
LEVEL = "hint"

FAST, DEEP, HALF = 20.0, 0.005, 0.5  # rad/s; of the extent; of the symptom that may be left


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The solver's options, where its usual ones calm the model."""
    if model.source is None or model.urdf:
        return
    now, edits = early(model), patient(model)
    if not edits:
        return
    first = next(iter(now))
    for probe, limit in ((fastest(), FAST), (commanded(), FAST), (sunk(), DEEP), (pressed_in(), DEEP)):
        before = model.measured(probe)
        if before > limit and model.measured(probe, edits) <= HALF * before:
            says = f"With MuJoCo's own {' and '.join(now)} the same motion is calm."
            names, value = tuple(f"the solver's {name}" for name in now), f"{USUAL[first]:g}"
            yield Suspect(
                names, first, f"{now[first]:g}", value, edits, probe, limit, says,
                "100 iterations and a tolerance of 1e-8, as MuJoCo has them", share=HALF, excess=10.0,
            )  # fmt: skip
            return
