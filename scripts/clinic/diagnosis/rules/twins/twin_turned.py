"""A part is turned unlike its twin, left and right, so that all that hangs on it points elsewhere.

The `quat` or `euler` of a shoulder or a hip is copied from the other side, where its mirror image is meant. Each link
below sits right on its parent, and the whole limb hangs askew.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.08 0.05"/>
          <body name="left_upper" pos="0 0.12 0.05" euler="30 0 0">
            <joint name="left_shoulder" axis="0 1 0" range="-90 90"/>
            <geom type="capsule" fromto="0 0 -0.03 0 0.02 -0.2" size="0.025"/>
            <body name="left_lower" pos="0 0.03 -0.25">
              <joint name="left_elbow" axis="0 1 0" range="-90 0"/>
              <geom type="capsule" fromto="0 0 -0.03 0 0.02 -0.2" size="0.02"/>
              <body name="left_hand" pos="0 0.02 -0.25">
                <joint name="left_wrist" axis="0 1 0" range="-60 60"/>
                <geom type="box" pos="0 0.02 -0.03" size="0.02 0.01 0.02"/>
              </body>
            </body>
          </body>
          <body name="right_upper" pos="0 -0.12 0.05" euler="30 0 0">
            <joint name="right_shoulder" axis="0 1 0" range="-90 90"/>
            <geom type="capsule" fromto="0 0 -0.03 0 -0.02 -0.2" size="0.025"/>
            <body name="right_lower" pos="0 -0.03 -0.25">
              <joint name="right_elbow" axis="0 1 0" range="-90 0"/>
              <geom type="capsule" fromto="0 0 -0.03 0 -0.02 -0.2" size="0.02"/>
              <body name="right_hand" pos="0 -0.02 -0.25">
                <joint name="right_wrist" axis="0 1 0" range="-60 60"/>
                <geom type="box" pos="0 -0.02 -0.03" size="0.02 0.01 0.02"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <body name="right_upper" pos="0 -0.12 0.05" euler="30 0 0">
    +       <body name="right_upper" pos="0 -0.12 0.05" euler="-30 0 0">

The number: bodies, centres of mass and joints of the limb that are not where the image of the other side has them;
told where the mirrored turn of one body mends at least four of five, and three at least.

When it is wrong: two sides that are meant to differ, and happen to do so by a mirrored turn.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.probes.twins import Twins, twins
from clinic.diagnosis.probes.vector import Vector, dot, of_quaternion, sub, times, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.twins._pair import EITHER
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import ORIENTATIONS
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A limb that is turned unlike its twin"
FAMILIES = ("drifts", "jumps-at-start", "wrong-numbers")
UNPLANTED = "no pair of limbs in the bench's healthy models is written with a turn of its own"

LEAST, LEFT, TURNED = 3, 0.2, 1e-3  # so many astray; the share that may stay so; what tells a turn from none
ALONG = 0.999  # cosine of the angle between axles that lie alike
FEW = 8  # pairs that are looked at, of those that are astray
MIRRORS = ((1, 1, -1, -1), (1, -1, 1, -1), (1, -1, -1, 1))  # a turn seen in a mirror across x, y or z


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The turn of a limb's first body that, mirrored, brings the limb to where its twin has it."""
    of = model.simulation
    for left, right in _turned(of)[:FEW]:
        before = _astray(of, left)
        found = [
            (body, twin, turn)
            for body, twin in ((right, left), (left, right))
            for turn in _mirrored(of, twin)
            if _differs(turn, of.row("body_quat", body, 4)) and _with(of, body, turn, left) <= LEFT * before
        ]
        if any(_rolled_on(of, body, turn) for body, _, turn in found):
            continue
        if found:
            odd = _inward(of, left, right)
            told = [each for each in found if each[0] == odd] or found
            either = len({body for body, *_ in told}) > 1
            yield _suspect(model, *told[0], left, EITHER * either)
            return


def _suspect(model: ReaderModel, body: int, twin: int, turn: Vector, left: int, either: str) -> Suspect:
    of, element = model.simulation, model.element("body", body)
    before = _astray(of, left)
    edits: tuple[Edit, ...] = ()
    if element is not None and not either and model.source is not None and not model.urdf:
        others = [name for name in ORIENTATIONS[1:] if element.get(name)]
        edits = (set_attribute(element, "quat", written(turn)), *(remove_attribute(element, name) for name in others))
    names = of.name("body", body), of.name("body", twin)
    says = (
        f"{before:.0f} bodies, centres of mass and joints are not where the image of the other side has them; with the "
    )
    says += f"turn of {names[1]} mirrored nearly all are.{either}"
    probe = Probe("bodies, centres of mass and joints unlike their twins", "", _astray, (left,), dynamic=False)
    now, value = written(of.row("body_quat", body, 4)), written(turn)
    return Suspect(names, "quat", now, value, edits, probe, LEFT * before, says, "two sides alike")


def _inward(of: Simulation, left: int, right: int) -> int | None:
    """The one of a pair that goes on to the other side of its parent than the limbs of all other pairs; else None."""
    found = twins(of)
    outward = {}
    for body in {each for pair in found.pairs["body"] for each in pair}:
        if (of.parent(body) == of.parent(left)) and (below := of.children.get(body)):
            place = found.at("xpos", body)
            ways = sub(found.at("xpos", below[0]), place), sub(place, found.at("xpos", of.parent(body)))
            outward[body] = dot(*ways) > 0
    others = {way for body, way in outward.items() if body not in (left, right)}
    odd = [body for body in (left, right) if body in outward and len(others) == 1 and outward[body] not in others]
    return odd[0] if len(odd) == 1 else None


def _turned(of: Simulation) -> list[tuple[int, int]]:
    """The pairs of astray bodies of which one is turned against its parent, those nearest to the root first."""
    pairs = [pair for pair in twins(of).pairs["body"] if pair[0] in twins(of).images]
    turned = [pair for pair in pairs if any(_differs(of.row("body_quat", each, 4), (1, 0, 0, 0)) for each in pair)]
    astray = [pair for pair in turned if _astray(of, pair[0]) >= LEAST]
    return sorted(astray, key=lambda pair: len(of.ancestors(pair[0])))


def _mirrored(of: Simulation, body: int) -> list[Vector]:
    """A body's turn as mirrors across the axes of its parent show it."""
    own = of.row("body_quat", body, 4)
    return [tuple(sign * x for sign, x in zip(mirror, own, strict=True)) for mirror in MIRRORS]


def _rolled_on(of: Simulation, body: int, turn: Vector) -> bool:
    """Whether another turn leaves a wheel's axle as it lies, so that the wheel would come there by rolling."""
    for joint in of.joints_of(body):
        turns = (of.row("body_quat", body, 4), turn)
        axles = [times(of_quaternion(each), of.row("jnt_axis", joint, 3)) for each in turns]
        if of.continuous(joint) and abs(dot(*axles)) > ALONG:
            return True
    return False


def _differs(one: Vector, other: Vector) -> bool:
    return min(max(abs(a - sign * b) for a, b in zip(one, other, strict=True)) for sign in (1, -1)) > TURNED


def _astray(of: Simulation, left: int) -> float:
    """How many places of bodies, centres of mass and joints of a limb are odd."""
    return _count(twins(of), left)


def _count(found: Twins, left: int) -> float:
    quantities = ("pos", "center of mass", "axis")
    places = [each for each in found.mirrored if each.kind in ("body", "joint") and each.quantity in quantities]
    return float(sum(each.odd and left in found.of.ancestors(found.bodies(each)[0]) for each in places))


def _with(of: Simulation, body: int, turn: Vector, left: int) -> float:
    """How many are astray with another turn of a body."""
    before = of.row("body_quat", body, 4)
    of.engine.write_model("body_quat", turn, 4 * body)
    try:
        return _count(Twins(of), left)
    finally:
        of.engine.write_model("body_quat", before, 4 * body)
