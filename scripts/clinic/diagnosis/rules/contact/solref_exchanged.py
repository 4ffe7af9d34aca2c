"""The time constant and the damping ratio of a `solref` are exchanged.

The first number of `solref`, `solreflimit` and `solreffriction` is a time constant in s, the second one a damping
ratio. Exchanged, `0.01 1` becomes `1 0.01`: as stiff as before, for the stiffness takes the product of both, and with a
hundredth of the damping. What lands on such a contact bounces, what hangs on such a limit or rope rings on. Of the
`solreffriction` of a `<pair>` only the time constant acts, with elliptic cones alone: things creep 100 times as fast.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 0.15">
          <freejoint/>
          <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" solref="1 0.01"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" solref="1 0.01"/>
    +       <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" solref="0.01 1"/>

The number: the time constant, in which an oscillation dies down to a third; told from 0.3 s on, where the damping ratio
is at most 0.1 and at least 0.001, so that both are usual ones in the other order. None of 385 healthy models has such a
pair: what is meant to bounce has a short time constant beside a small ratio, or negative numbers.

When it is wrong: something that is meant to swing for seconds on its contact or its limit.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A time constant and a damping ratio exchanged"
FAMILIES = ("oscillates", "jumps-at-start", "sinks")
UNPLANTED = "the two numbers tell it, whatever the model does"

SLOW, LIGHT = 0.3, (0.001, 0.1)  # s; damping ratio
WHERE = (
    ("geom", "geom_solref", "solref"),
    ("pair", "pair_solref", "solref"),
    ("pair", "pair_solreffriction", "solreffriction"),
    ("joint", "jnt_solref", "solreflimit"),
    ("tendon", "tendon_solref_lim", "solreflimit"),
    ("equality", "eq_solref", "solref"),
)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The elements of a kind with such a pair of numbers, all together."""
    of = model.simulation
    for kind, field, attribute in WHERE:
        if not (found := _exchanged(of, kind, field)):
            continue
        row = of.row(field, found[0], 2)
        values = {each: written(of.row(field, each, 2)[::-1]) for each in found}
        yield Suspect(
            tuple(of.name(kind, each) for each in found),
            attribute,
            written(row),
            values[found[0]],
            model.set_each(kind, attribute, values),
            how_many("pairs of numbers that are exchanged", _exchanged, kind, field),
            0,
            f"With elliptic cones a time constant of {row[0]:g} s lets things creep."
            if attribute == "solreffriction"
            else f"A damping ratio of {row[1]:g} lets it ring for {row[0]:g} s, its time constant.",
            "0.02 1, MuJoCo's default",
        )


def _exchanged(of: Simulation, kind: str, field: str) -> list[int]:
    """The elements whose time constant and damping ratio are usual in the other order alone."""
    rows = [of.row(field, each, 2) for each in range(of.count(kind))]
    return [each for each, (time, ratio) in enumerate(rows) if time >= SLOW and LIGHT[0] <= ratio <= LIGHT[1]]
