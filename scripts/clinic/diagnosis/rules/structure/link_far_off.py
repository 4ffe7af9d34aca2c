"""A link lies far from what it hangs on: its position is in millimetres or centimetres.

The meshes were scaled and the places of the joints were not, or one number of one body lacks its point.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="box" pos="0 0 0.15" size="0.03 0.03 0.15"/>
          <body name="fore" pos="0 0 300">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0 0 0.3" size="0.03"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <body name="fore" pos="0 0 300">
    +       <body name="fore" pos="0 0 0.3">

The number: how far a body with a joint is from the body that it hangs on, in radii of the largest geom of its
mechanism, or in 2.5 radii of the largest geom of the two bodies, where that is less; more than 20, and than 2 m.

When it is wrong: a carriage on a long cable that is not drawn, or a planet.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import HFIELD, PLANE
from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.probes.vector import norm, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A link far from what it hangs on"
FAMILIES = ("sags", "jumps-at-start", "wrong-numbers")
UNPLANTED = "where a link belongs, only a drawing tells"

FAR, METRES, BESIDE = 20.0, 2.0, 0.4  # what two bodies count for beside the whole mechanism


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All bodies with a joint that are far from their parent."""
    of = model.simulation
    found = [body for body in _hung(model) if _apart(of, body) > FAR and norm(of.row("body_pos", body, 3)) > METRES]
    if not found:
        return
    place = of.row("body_pos", found[0], 3)
    scaled = 1e-3 if max(map(abs, place)) > 20 else 1e-2
    edits = tuple(
        edit for body in found for edit in model.placed(body, [scaled * x for x in of.row("body_pos", body, 3)])
    )
    names = tuple(of.name("body", body) for body in found)
    says = f"It is {norm(place):.3g} m from what it hangs on, {_apart(of, found[0]):.0f} times the size of the parts."
    probe = Probe("distance from what it hangs on", "of the size of the parts", _farthest, tuple(found), dynamic=False)
    value = written([scaled * x for x in place])
    yield Suspect(names, "pos", written(place), value, edits, probe, FAR, says, "below 20")


def _hung(model: ReaderModel) -> list[int]:
    """The bodies with joints that hang on another body; in a URDF, whose root is the world, all."""
    of, urdf = model.simulation, model.urdf
    return [body for body in of.moving_bodies if of.joints_of(body) and (urdf or of.parent(body))]


def _apart(of: Simulation, body: int) -> float:
    """How far a body is from its parent, in sizes of its mechanism or of the two bodies."""
    owner, bodies, kinds = root_of(of), of.model("geom_bodyid"), of.model("geom_type")
    whole, parent, pair = [0.0], of.parent(body), dict[int, float]()
    for geom, radius in enumerate(of.model("geom_rbound")):
        on = int(bodies[geom])
        if int(kinds[geom]) in (PLANE, HFIELD):
            continue
        if owner[on] in (0, owner[body]):
            whole.append(radius)
        if on in (body, parent):
            pair[on] = max(pair.get(on, 0.0), radius)
    far, largest = norm(of.row("body_pos", body, 3)), max(whole)
    near = max(pair.values()) / BESIDE if len(pair) == 2 else math.inf
    return far / min(largest, near) if largest > 0 else 0.0


def _farthest(of: Simulation, *bodies: int) -> float:
    return max(_apart(of, body) for body in bodies)
