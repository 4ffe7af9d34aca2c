"""A loop is not closed where the model starts, and snaps together in the first steps.

An equality pulls what it holds together from wherever it begins. A `<connect>` of two sites, or a `<weld>` with its
own `relpose`, says where that is: when the links do not meet there, the first step begins with a blow, and the
mechanism may lock in the wrong branch.

Bad:

    <mujoco>
      <worldbody>
        <body name="crank" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.15 0 0" size="0.02"/>
          <site name="pin" pos="0.2 0 0"/>
        </body>
        <body name="rocker" pos="0.5 0 1">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 -0.25 0 0" size="0.02"/>
          <site name="hole" pos="-0.2 0 0"/>
        </body>
      </worldbody>
      <equality>
        <connect site1="pin" site2="hole"/>
      </equality>
    </mujoco>

Good:

    -       <site name="hole" pos="-0.2 0 0"/>
    +       <site name="hole" pos="-0.3 0 0"/>

The number: how far apart the two places are at the start that an equality holds together, as a share of the model's
extent; below 1 % is well. The second site is moved to where the first one is, or `relpose` is left out, so that the
start counts as assembled. From a keyframe it is a hint.

When it is wrong: something that is to be pulled in. Bodies that are moved by `mocap` are left out, but for a weld with
a `relpose` of its own that puts the other body more than 10 % of the extent away.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.equalities import CONNECT, WELD, by_mocap, ends, gap, held, kind_of, sited
from clinic.diagnosis.probes.vector import sub, times, transpose, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.structure.equality_copied import copied_ends
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A loop that is not closed at the start"
FAMILIES = ("jumps-at-start", "explodes", "stuck")
SINCE = "0.1"
CASE = "linkage-jumps-at-start"
LEVEL = "hint"
UNPLANTED = "the healthy models connect and weld nothing but what is moved by mocap"

APART, PUSHED = 0.01, 0.1  # of the model's extent; where mocap moves one of the two


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Connections and welds that hold together what is apart."""
    of = model.simulation
    copied = {each for each, _ in copied_ends(of)}
    for each in range(of.count("equality")):
        apart, pulled = _gap(of, each), by_mocap(of, each)
        if (
            each in copied
            or apart <= (PUSHED if pulled else APART)
            or (pulled and not model.value("equality", each, "relpose"))
        ):
            continue
        edits = _edits(model, each) if of.begin_with.key < 0 else ()
        kind = "site" if sited(of, each) else "body"
        names = tuple(of.name(kind, it) for it in held(of, each))
        far = 1000 * apart * of.model("stat.extent")[0]
        says = f"They are {far:.3g} mm apart at the start, and are to be in one place."
        yield Suspect(
            names, "pos" if sited(of, each) else "relpose", "", edits[0].value if edits else "", edits,
            Probe("gap that an equality has to close at the start", "of the extent", _gap, (each,), dynamic=False),
            APART, says, "closed at the start",
        )  # fmt: skip


def _gap(simulation: Simulation, each: int) -> float:
    simulation.begin()
    if kind_of(simulation, each) not in (CONNECT, WELD) or not simulation.model("eq_active0")[each]:
        return 0.0
    return (gap(simulation, each) or 0.0) / simulation.model("stat.extent")[0]


def _edits(model: ReaderModel, each: int) -> tuple[Edit, ...]:
    of = model.simulation
    if not sited(of, each):
        return model.remove("equality", [each], "relpose")
    site = held(of, each)[1]
    body = of.body_of("site", site)
    seen = sub(ends(of, each)[0], of.data_row("xpos", body, 3))
    return model.set("site", [site], "pos", written(times(transpose(of.data_row("xmat", body, 9)), seen)))
