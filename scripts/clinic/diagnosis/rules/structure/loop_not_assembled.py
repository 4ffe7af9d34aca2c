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
          <site name="hole" pos="-0.3 0 0"/>
        </body>
      </worldbody>
      <equality>
        <connect site1="pin" site2="hole"/>
      </equality>
    </mujoco>

The number: how far apart the two places are at the start that an equality holds together, as a share of the model's
extent; below 1 % is well. The second site is moved to where the first one is, or `relpose` is left out, so that the
start counts as assembled. From a keyframe it is a hint.

When it is wrong: something that is to be pulled in. Bodies that are moved by `mocap` are left out, but for a weld with
a `relpose` of its own that puts the other body more than 10 % of the extent away.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.vector import Vector, add, norm, sub, times, transpose, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A loop that is not closed at the start"
FAMILIES = ("jumps-at-start", "explodes", "stuck")
SINCE = "0.1"
CASE = "linkage-jumps-at-start"
LEVEL = "hint"
UNPLANTED = "the healthy models connect and weld nothing but what is moved by mocap"

CONNECT, WELD = 0, 1  # mjtEq
SITE = 6  # mjtObj
APART, PUSHED = 0.01, 0.1  # of the model's extent; where mocap moves one of the two


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Connections and welds that hold together what is apart."""
    of = model.simulation
    for each in range(of.count("equality")):
        gap, pulled = _gap(of, each), _mocap(of, each)
        if gap <= (PUSHED if pulled else APART) or (pulled and not model.value("equality", each, "relpose")):
            continue
        edits = _edits(model, each) if of.begin_with.key < 0 else ()
        sited = int(of.model("eq_objtype")[each]) == SITE
        kind = "site" if sited else "body"
        names = tuple(of.name(kind, int(of.model(f"eq_obj{side}id")[each])) for side in (1, 2))
        says = (
            f"They are {1000 * gap * of.model('stat.extent')[0]:.3g} mm apart at the start, and are to be in one place."
        )
        yield Suspect(
            names, "pos" if sited else "relpose", "", edits[0].value if edits else "", edits,
            Probe("gap that an equality has to close at the start", "of the extent", _gap, (each,), dynamic=False),
            APART, says, "closed at the start",
        )  # fmt: skip


def _ends(simulation: Simulation, each: int) -> tuple[Vector, Vector] | None:
    """The two places in m that an active connection or weld holds together; None for another one."""
    kind, ids = int(simulation.model("eq_type")[each]), [int(simulation.model(f"eq_obj{i}id")[each]) for i in (1, 2)]
    if kind not in (CONNECT, WELD) or not simulation.model("eq_active0")[each]:
        return None
    if int(simulation.model("eq_objtype")[each]) == SITE:
        ends = [simulation.data_row("site_xpos", site, 3) for site in ids]
    else:
        data = simulation.equality_data(each)
        anchors = (data[:3], data[3:6]) if kind == CONNECT else (data[3:6], data[:3])
        frames = [(simulation.data_row("xpos", body, 3), simulation.data_row("xmat", body, 9)) for body in ids]
        ends = [add(place, times(turn, anchor)) for (place, turn), anchor in zip(frames, anchors, strict=True)]
    return ends[0], ends[1]


def _mocap(simulation: Simulation, each: int) -> bool:
    """Whether mocap moves one of the two bodies of an equality."""
    ids = [int(simulation.model(f"eq_obj{i}id")[each]) for i in (1, 2)]
    if int(simulation.model("eq_objtype")[each]) == SITE:
        ids = [int(simulation.model("site_bodyid")[site]) for site in ids]
    return int(simulation.model("eq_type")[each]) in (CONNECT, WELD) and any(
        simulation.model("body_mocapid")[body] >= 0 for body in ids
    )


def _gap(simulation: Simulation, each: int) -> float:
    simulation.begin()
    ends = _ends(simulation, each)
    return norm(sub(*ends)) / simulation.model("stat.extent")[0] if ends else 0.0


def _edits(model: ReaderModel, each: int) -> tuple[Edit, ...]:
    of = model.simulation
    if int(of.model("eq_objtype")[each]) != SITE:
        return model.remove("equality", [each], "relpose")
    ends, site = _ends(of, each), int(of.model("eq_obj2id")[each])
    assert ends is not None
    body = int(of.model("site_bodyid")[site])
    seen = sub(ends[0], of.data_row("xpos", body, 3))
    return model.set("site", [site], "pos", written(times(transpose(of.data_row("xmat", body, 9)), seen)))
