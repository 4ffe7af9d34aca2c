"""Contacts so soft that things sink in.

A contact is a damped spring: `solref` has its time constant and damping ratio, `solimp` how much of it acts. With
`solref="0.2 1"` on both geoms a box of 10 cm sinks in by 5 mm in place of 0.1 mm, with `solimp="0.1 0.95 0.1"` by 22
mm.

Bad:

    <mujoco>
      <worldbody>
        <geom name="floor" type="plane" size="1 1 0.1"/>
        <body name="box" pos="0 0 0.05">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05" solref="1 1"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="box" type="box" size="0.05 0.05 0.05" solref="1 1"/>
    +       <geom name="box" type="box" size="0.05 0.05 0.05"/>

The number: the deepest contact 2 s after letting go as a share of the thinner geom's thickness; below 0.05 is well.
With the default values a box at rest sinks in by 0.1 mm. With `--symptom sinks` the first number of `solimp` is looked
at, by which a contact begins: that of feet which are to be soft is often 0.015.

When it is wrong: a cushion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

from clinic.diagnosis.probes.touch import Deciding, depth, edits_of, names_of, resting, with_like
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect

TITLE = "Contacts too soft"
FAMILIES = ("sinks", "falls-through", "slips")
LEVEL = "hint"

MOST = 0.05  # of the thinner geom's thickness
TIME, SOFT = 0.02, 400.0  # s, MuJoCo's default; 1/s2 of a negative solref
COLUMNS = {"solref": 2, "solimp": 5}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """`solref` and `solimp`, where they are softer than the default, of what decides deep contacts."""
    simulation = model.simulation
    if model.measured(depth()) <= MOST:
        return
    rests = [decides for _, decides in resting(simulation)]
    weak = partial(_weak, 0 if model.symptom == FAMILIES[0] else 1)
    for attribute, value, softness in (("solref", "0.02 1", _slow), ("solimp", "0.9 0.95 0.001", weak)):
        soft = [_soft_ones(each, partial(softness, simulation, each.kind)) for each in rests]
        soft = [each for each in soft if each.elements]
        if soft:
            excess, kind, worst = max(
                (softness(simulation, each.kind, i), each.kind, i) for each in soft for i in each.elements
            )
            soft = with_like(simulation, soft, partial(_softer, simulation, softness))
            row = simulation.row(f"{kind}_{attribute}", worst, COLUMNS[attribute])
            now = " ".join(f"{each:g}" for each in row[: len(value.split())])
            says = f"{attribute} {now} lets the contact give way; MuJoCo's default is {value}."
            edits = edits_of(model, soft, attribute, value)
            yield Suspect(
                names_of(simulation, soft), attribute, now, value, edits, depth(), MOST, says,
                f"{value}, MuJoCo's default", excess=excess,
            )  # fmt: skip


def _soft_ones(each: Deciding, softness: Callable[[int], float]) -> Deciding:
    return replace(each, elements=tuple(index for index in each.elements if softness(index) > 1))


def _softer(simulation: Simulation, softness: Callable[[Simulation, str, int], float], geom: int) -> bool:
    return softness(simulation, "geom", geom) > 1


def _slow(simulation: Simulation, kind: str, index: int) -> float:
    """How many times longer the time constant is than 1.5 default ones, or softer the stiffness of a negative one."""
    time, damping = simulation.row(f"{kind}_solref", index, 2)
    return time * damping / (1.5 * TIME) if time > 0 else SOFT / max(-time, 1e-9)


def _weak(number: int, simulation: Simulation, kind: str, index: int) -> float:
    """How many times smaller than a half an impedance is: 0 that of a contact which only begins, 1 the largest."""
    return 0.5 / max(simulation.row(f"{kind}_solimp", index, 5)[number], 1e-3)
