"""A coefficient of friction that no two materials have.

With the elliptic cone `friction="1000 1000 1000"` holds a thing on a slope of 75 degrees, and hides what is wrong with
a grasp. With the pyramidal one it makes contacts so soft that the thing sinks or slides all the same.

Bad:

    <mujoco>
      <option cone="elliptic"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body pos="0 0 0.1">
          <freejoint/>
          <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" friction="1000 1000 1000"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <geom name="box" type="box" size="0.1 0.1 0.1" mass="2" friction="1000 1000 1000"/>
    +       <geom name="box" type="box" size="0.1 0.1 0.1" mass="2"/>

The number: the largest coefficient of sliding friction; rubber on concrete has about 1, and none of 208 files of robots
has more than 10. Told are those above 20. Where `condim` is 6, so is a third coefficient above 0.05 m: it is the arm
with which a contact brakes what rolls. And so is a third one of ten times the second and more: the two are taken for
exchanged, for the order is sliding, torsional, rolling. Where `condim` is 4 or 6, the second coefficient may be read as
the diameter of the patch that touches (MuJoCo's manual, Computation, Contact): told is one of more than five times the
size of what rests on a plane, which cannot pivot there.

When it is wrong: something that stands for glue.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import PLANE
from clinic.diagnosis.probes.shape import solid
from clinic.diagnosis.probes.touch import resting
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, how_many

TITLE = "Friction beyond any material"
FAMILIES = ("slips", "sinks", "rolls-on", "stuck")
UNPLANTED = "what it does is planted as friction-too-high"

MOST = 20.0
ARM, TIMES = 0.05, 10  # m; of the torsional friction
PATCH = 5.0  # times the size of what rests
TURNS = 3  # the dimensions of a contact that does not resist turning on the spot


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms with such a coefficient, all together."""
    of = model.simulation
    rough = tuple(geom for geom in range(of.count("geom")) if solid(of, geom) and _most(of, geom) > MOST)
    if not rough:
        yield from _rolling(model)
        yield from _in_order(model)
        yield from _turning(model)
        return
    now = " ".join(f"{x:g}" for x in of.row("geom_friction", rough[0], 3))
    probe = Probe("coefficient of friction", "", _most, rough, dynamic=False)
    values = {geom: _plain(*of.row("geom_friction", geom, 3)) for geom in rough}
    edits = model.set_each("geom", "friction", values)
    says = "Rubber on concrete has about 1."
    names = tuple(of.name("geom", geom) for geom in rough)
    yield Suspect(names, "friction", now, values[rough[0]], edits, probe, MOST, says, "1, MuJoCo's default")


def _plain(_: float, torsional: float, rolling: float) -> str:
    """The friction of MuJoCo's default, with the other two numbers as they are where they may be meant."""
    return written((1.0, torsional if torsional < 1 else 0.005, rolling if rolling <= ARM else 0.0001))


def _rolling(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms that a contact holds against rolling as a hook would: the third coefficient is an arm, in m."""
    of = model.simulation
    stuck = tuple(geom for geom in range(of.count("geom")) if solid(of, geom) and _arm(of, geom) > ARM)
    if stuck:
        row = of.row("geom_friction", stuck[0], 3)
        value = written((*row[:2], 0.0001))
        probe = Probe("arm of the rolling friction", "m", _arm, stuck, dynamic=False)
        says = (
            f"The third coefficient of friction is an arm in m: each newton of the contact brakes with {row[2]:g} N m."
        )
        names, edits = tuple(of.name("geom", geom) for geom in stuck), model.set("geom", stuck, "friction", value)
        yield Suspect(names, "friction", written(row), value, edits, probe, ARM, says, "0.0001 m, MuJoCo's default")


def _in_order(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms whose torsional and rolling friction stand in each other's place."""
    of = model.simulation
    if not (found := [geom for geom in _exchanged(of) if _arm(of, geom) <= ARM]):
        return
    values = {geom: written([of.row("geom_friction", geom, 3)[i] for i in (0, 2, 1)]) for geom in found}
    _, torsional, rolling = of.row("geom_friction", found[0], 3)
    says = f"The second number is torsional, {torsional:g} m, and the third one brakes its rolling, with {rolling:g} m."
    edits = model.set_each("geom", "friction", values)
    names, now = tuple(of.name("geom", geom) for geom in found), written(of.row("geom_friction", found[0], 3))
    probe = how_many("geoms that resist rolling far more than turning", _exchanged)
    yield Suspect(names, "friction", now, values[found[0]], edits, probe, 0, says, "1 0.005 0.0001, MuJoCo's default")


def _turning(model: ReaderModel) -> Iterator[Suspect]:
    """The geoms that a contact holds against turning on the spot as if they touched far beyond their own size."""
    of = model.simulation
    share, geom, other = max(_patches(of), default=(0.0, 0, 0))
    if share <= PATCH:
        return
    row, size = of.row("geom_friction", geom, 3), 2 * of.model("geom_rbound")[other]
    rows = {each: of.row("geom_friction", each, 3) for each in range(of.count("geom")) if solid(of, each)}
    values = {each: written([slide, 0.005, roll]) for each, (slide, turn, roll) in rows.items() if turn > PATCH * size}
    names = tuple(of.name("geom", each) for each in sorted(values, key=lambda each: each != geom))
    says = f"The second coefficient of friction is a patch of {row[1]:g} m, under {of.name('geom', other)}, "
    says += f"which is {size:.2g} m across."
    probe = Probe("widest patch of a contact on a plane", "times the size of what rests there", _widest)
    edits = model.set_each("geom", "friction", values)
    yield Suspect(names, "friction", written(row), values[geom], edits, probe, PATCH, says, "0.005 m, the default")


def _widest(of: Simulation) -> float:
    return max(_patches(of), default=(0.0,))[0]


def _patches(of: Simulation) -> list[tuple[float, int, int]]:
    """Of contacts on planes that resist turning on the spot: the patch over the size of what rests, and both geoms.

    The first is one that decides the friction, the second the one that rests.
    """
    made = []
    for contact, decides in resting(of):
        other, *more = (geom for geom in contact.geoms if int(of.model("geom_type")[geom]) != PLANE)
        if decides.kind == "geom" and decides.dim > TURNS and not more:
            size, turning = 2 * of.model("geom_rbound")[other], of.model("geom_friction")[1::3]
            made += [(turning[geom] / size, geom, other) for geom in decides.elements]
    return made


def _exchanged(of: Simulation) -> list[int]:
    """The geoms whose contacts resist rolling far more than turning on the spot."""
    made = []
    for geom, condim in enumerate(of.model("geom_condim")):
        _, torsional, rolling = of.row("geom_friction", geom, 3)
        if condim > 4 and solid(of, geom) and rolling >= TIMES * torsional > 0:
            made.append(geom)
    return made


def _arm(of: Simulation, *geoms: int) -> float:
    """The coefficient against rolling in m, of geoms whose contacts have it."""
    return max(of.model("geom_friction")[3 * geom + 2] * (of.model("geom_condim")[geom] > 4) for geom in geoms)


def _most(of: Simulation, *geoms: int) -> float:
    return max(of.model("geom_friction")[3 * geom] for geom in geoms)
