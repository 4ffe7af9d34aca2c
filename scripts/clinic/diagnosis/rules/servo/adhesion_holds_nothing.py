"""An adhesion pulls at a body that touches nothing, or by less than the weight of what it is to lift.

`<adhesion>` pulls at the contacts of the geoms of its `body`, and of no other body: a flange whose cup is a body of its
own has none. The force is `gain` times the control, in N.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="flange" pos="0 0 0.2">
          <joint type="slide" axis="0 0 1" range="-0.15 0" damping="5"/>
          <geom type="cylinder" size="0.03 0.005" contype="0" conaffinity="0"/>
          <body name="cup" pos="0 0 -0.02">
            <geom type="cylinder" size="0.01 0.015" mass="0.05"/>
          </body>
        </body>
        <body name="chip" pos="0 0 0.0101">
          <freejoint/>
          <geom type="box" size="0.02 0.02 0.01" mass="0.04"/>
        </body>
      </worldbody>
      <actuator>
        <adhesion body="flange" ctrlrange="0 1" gain="10"/>
      </actuator>
    </mujoco>

Good:

    -     <adhesion body="flange" ctrlrange="0 1" gain="10"/>
    +     <adhesion body="cup" ctrlrange="0 1" gain="10"/>

The number: geoms of the body that can touch something; and, where it is no part of what is free to move, the weight of
the lightest free body over the greatest force of all adhesions together, which is below 1 where something is lifted.

When it is wrong: an adhesion that adds to the grip of fingers, or holds back what slides.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import TRN_BODY
from clinic.diagnosis.probes.shape import in_pairs, root_of, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "An adhesion that holds nothing"
FAMILIES = ("slips", "falls-through")
UNPLANTED = "few healthy models have an adhesion"

LIFTS = 5.0  # times the weight


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each adhesion of a body that touches nothing, and those that are too weak, all together."""
    of = model.simulation
    for actuator in _adhesions(of):
        if _untouched(of, actuator):
            body = _body(of, actuator)
            near = next((each for each in of.below(body) if of.names("body")[each] and _touches(of, each)), None)
            value = of.names("body")[near] if near else ""
            edits = model.set("actuator", [actuator], "body", value) if near else ()
            says = f"It pulls at contacts of {of.name('body', body)}, no geom of which can touch anything."
            probe = Probe("1 where its body can touch nothing", "", _untouched, (actuator,), dynamic=False)
            name = of.name("actuator", actuator)
            yield Suspect((name,), "body", of.names("body")[body], value, edits, probe, 0.5, says, "what touches")
    found = [each for each in _adhesions(of) if root_of(of)[_body(of, each)] not in of.free_bodies]
    if not found or (heavy := _heavy(of)) <= 1:
        return
    gain = of.gain(found[0])[0]
    lightest = min(of.free_bodies, key=lambda body: of.model("body_subtreemass")[body])
    value = rounded(LIFTS * heavy * gain)
    edits = model.set("actuator", found, "gain", value)
    says = (
        f"{of.name('body', lightest)} is the lightest free body; it weighs {heavy:.3g} times what all adhesions pull."
    )
    probe = Probe("weight of the lightest free body over the adhesion", "", _heavy, dynamic=False)
    names = tuple(of.name("actuator", each) for each in found)
    yield Suspect(names, "gain", f"{gain:g}", value, edits, probe, 1, says, "well above the weight")


def _adhesions(of: Simulation) -> list[int]:
    return [each for each, kind in enumerate(of.model("actuator_trntype")) if int(kind) == TRN_BODY]


def _body(of: Simulation, actuator: int) -> int:
    return int(of.model("actuator_trnid")[2 * actuator])


def _touches(of: Simulation, body: int) -> bool:
    return any(solid(of, geom) or geom in in_pairs(of) for geom in of.geoms_of(body))


def _untouched(of: Simulation, actuator: int) -> float:
    return float(not _touches(of, _body(of, actuator)))


def _heavy(of: Simulation) -> float:
    """The weight of the lightest free body over what all adhesions pull with that do not ride on a free body."""
    free, roots = of.free_bodies, root_of(of)
    pulls = sum(
        of.gain(each)[0] * of.row("actuator_ctrlrange", each, 2)[1]
        for each in _adhesions(of)
        if roots[_body(of, each)] not in free
    )
    weights = [of.model("body_subtreemass")[body] * of.gravity for body in free]
    return min(weights) / pulls if weights and pulls > 0 else 0.0
