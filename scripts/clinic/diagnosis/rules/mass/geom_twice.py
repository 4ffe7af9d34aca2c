"""A geom stands twice in its body.

Copied and not changed: the body weighs twice as much, and nothing of it can be seen.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm" pos="0 0 1">
          <joint axis="0 1 0" range="-90 90"/>
          <geom type="box" size="0.05 0.02 0.04"/>
          <geom type="box" size="0.05 0.02 0.04"/>
        </body>
      </worldbody>
    </mujoco>

Good:

            <geom type="box" size="0.05 0.02 0.04"/>
    -       <geom type="box" size="0.05 0.02 0.04"/>

The number: the body's mass, and without the copy. Geoms count as the same when type, size, place, mesh, masks and color
are. Of two that are called left and right the one is told whose y is on the other side.

When it is wrong: two layers that are meant; more than two copies in a model are.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import delete
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.probes.matter import mass_of
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.tendons import path
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A geom stands twice"
FAMILIES = ("wrong-mass", "sags", "drifts")
AFLOAT = True

MORE = 1.05
FIELDS = {"type": 1, "size": 3, "pos": 3, "quat": 4, "dataid": 1, "contype": 1, "conaffinity": 1, "group": 1, "rgba": 4}
MANY = 2  # so many are no slip


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Bodies that a second copy of a geom makes heavier."""
    of = model.simulation
    copies = [(body, *pair) for body in range(1, of.count("body")) for pair in _copies(of, body)]
    for body, geom, first in copies if len(copies) <= MANY else ():
        if {geom, first} in map(set, by_name(of, "geom")):
            yield from _twins(model, geom, first)
            continue
        element = model.element("geom", geom)
        edits = (delete(element),) if element is not None else ()
        without = model.with_edits(edits)
        if isinstance(without, CompileError):
            continue
        rest = without.model("body_mass")[body]
        yield Suspect(
            (of.name("geom", geom), of.name("body", body)),
            "",
            "",
            f"without {of.name('geom', geom)}",
            edits,
            mass_of((body,)),
            MORE * rest if edits else 0.0,
            f"It has the type, the size and the place of {of.name('geom', first)}.",
            "one geom in one place",
            share=0.95,
            level="cause" if body in of.moving_bodies else "hint",
        )


def _twins(model: ReaderModel, *pair: int) -> Iterator[Suspect]:
    """A left and a right geom in one place: the one that is on the other side than it is called, x being ahead."""
    of = model.simulation
    left, right = next(each for each in by_name(of, "geom") if set(each) == set(pair))
    x, y, z = of.row("geom_pos", left, 3)
    wrong, twin = (left, right) if y < 0 else (right, left)
    value, name = written((x, -y, z)), of.name("geom", wrong)
    edits = model.set_each("geom", "pos", {wrong: value}) if y else ()
    probe = how_many("geoms that stand twice in a body", _copies, of.body_of("geom", wrong))
    says = f"It has the place of {of.name('geom', twin)}: a left and a right one stand on two sides."
    yield Suspect(
        (name, of.name("geom", twin)), "pos", written((x, y, z)), value, edits, probe, 0, says,
        "the mirror image of its twin", level="hint",
    )  # fmt: skip


def _copies(of: Simulation, body: int) -> list[tuple[int, int]]:
    """Geoms of a body that are like one before them, and that one."""
    made = []
    first: dict[tuple[float, ...], int] = {}
    wraps = {index for tendon in range(of.count("tendon")) for kind, index in path(of, tendon) if kind == "geom"}
    for geom in of.geoms_of(body):
        key = tuple(round(x, 6) for name, width in FIELDS.items() for x in of.row(f"geom_{name}", geom, width))
        if first.setdefault(key, geom) != geom and not {geom, first[key]} & wraps:  # each tendon has its own
            made.append((geom, first[key]))
    return made
