"""One finger's tendon is unlike those of the other fingers.

The fixed tendons of a hand are copied from finger to finger. One that keeps the name of another finger's joint moves
that finger; one that lost the sign of a coefficient adds where the others take away.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm">
          <geom type="box" size="0.04 0.01 0.04"/>
          <body name="FF" pos="0.03 0 0.05">
            <joint name="FFJ2" axis="1 0 0" range="0 90"/>
            <geom type="capsule" fromto="0 0 0.01 0 0 0.03" size="0.008"/>
            <body pos="0 0 0.04">
              <joint name="FFJ1" axis="1 0 0" range="0 90"/>
              <geom type="capsule" fromto="0 0 0.01 0 0 0.03" size="0.008"/>
            </body>
          </body>
          <body name="MF">
            <joint name="MFJ2" axis="1 0 0" range="0 90"/>
            <geom type="capsule" fromto="0 0 0.05 0 0 0.07" size="0.008"/>
            <body pos="0 0 0.08">
              <joint name="MFJ1" axis="1 0 0" range="0 90"/>
              <geom type="capsule" fromto="0 0 0.01 0 0 0.03" size="0.008"/>
            </body>
          </body>
          <body name="RF" pos="-0.03 0 0.05">
            <joint name="RFJ2" axis="1 0 0" range="0 90"/>
            <geom type="capsule" fromto="0 0 0.01 0 0 0.03" size="0.008"/>
            <body pos="0 0 0.04">
              <joint name="RFJ1" axis="1 0 0" range="0 90"/>
              <geom type="capsule" fromto="0 0 0.01 0 0 0.03" size="0.008"/>
            </body>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="FFJ0">
          <joint joint="FFJ2" coef="1"/>
          <joint joint="FFJ1" coef="1"/>
        </fixed>
        <fixed name="MFJ0">
          <joint joint="MFJ2" coef="1"/>
          <joint joint="MFJ1" coef="1"/>
        </fixed>
        <fixed name="RFJ0">
          <joint joint="RFJ2" coef="1"/>
          <joint joint="MFJ1" coef="1"/>
        </fixed>
      </tendon>
    </mujoco>

Good:

            <joint joint="RFJ2" coef="1"/>
    -       <joint joint="MFJ1" coef="1"/>
    +       <joint joint="RFJ1" coef="1"/>

The number: of three fixed tendons and more whose names differ by a finger or a number alone, and of which all but one
have the same coefficients over joints as far from each other in the tree, how many stand apart.

And of two whose names differ in one word, each over a left and a right joint with as large coefficients, how many add
the joints where the other takes one from the other. The one that adds is told where it is called a bar against roll.

Of spatial tendons, three and more that go through sites in places of the same numbers, all but one agree in every site,
and the one has in a single site another sign, or two numbers exchanged: its cable runs over the other side of the
finger. And of two ropes of one length between the same two bodies, by how much the upper ends of their ranges differ;
more than 2 %: a load hangs on the shorter alone.

When it is wrong: a finger that is meant to be coupled in another way.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from itertools import combinations

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.siblings import WHICH
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.tendons import joints_of, path
from clinic.diagnosis.probes.vector import dot, slips, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A finger's tendon unlike the others'"
FAMILIES = ("stuck", "drifts", "wrong-numbers")
UNPLANTED = "few healthy models have three tendons that are alike"

BAR = re.compile(r"(?i)anti.?roll|sway|stabili")
ENOUGH, LIKE, PARALLEL = 3, 1e-3, 0.95
SAME, UNEQUAL = 1e-6, 0.02  # m; of the longer rope

Shape = tuple[tuple[int | None, float], ...]  # of each joint: how far above the first it is, and its coefficient


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each tendon that stands apart from two others or more."""
    of = model.simulation
    for tendon, others in _odd(of).items():
        own, usual = _shape(of, tendon), _shape(of, others[0])
        which = next(k for k, pair in enumerate(zip(own, usual, strict=True)) if _apart(*pair))
        joint = joints_of(of, tendon)[which][0]
        name, told = of.name("tendon", tendon), ", ".join(of.name("tendon", each) for each in others[:3])
        probe = how_many("tendons that stand apart from their siblings", _odd)
        if own[which][0] == usual[which][0]:
            attribute, now, value = "coef", f"{own[which][1]:g}", f"{usual[which][1]:g}"
            says = f"Its coefficient of {of.name('joint', joint)} is {now}; {told} agree in {value}."
        else:
            attribute, now, value = "joint", of.names("joint")[joint], _meant(of, tendon, others[0], which)
            says = f"It goes to {of.name('joint', joint)}, which is of another branch; {told} go to joints of one."
        edits = _edits(model, tendon, which, attribute, value)
        yield Suspect((name,), attribute, now, value, edits, probe, 0, says, "tendons alike")
    for adds, takes in _opposed(of):
        coefficient, names = joints_of(of, adds)[1][1], (of.name("tendon", adds), of.name("tendon", takes))
        says = f"{names[0]} adds the motions of left and right, and {names[1]} takes one from the other."
        bar = BAR.search(of.names("tendon")[adds])
        value = f"{-coefficient:g}" if bar else "the same sign in both"
        edits = _edits(model, adds, 1, "coef", value) if bar else ()
        probe = how_many("pairs of tendons of which one adds and one takes away", _opposed)
        yield Suspect(names, "coef", f"{coefficient:g}", value, edits, probe, 0, says, "tendons alike")

    yield from _slipped(model)
    for (longer, shorter), (most, least) in _unequal(of).items():
        names = of.name("tendon", longer), of.name("tendon", shorter)
        says = f"{names[0]} and {names[1]} are ropes of one length between the same bodies, and may be {most:g} and "
        says += f"{least:g} m long: the load hangs on the shorter alone. Nothing here tells which of the two is wrong."
        value = written(of.row("tendon_range", shorter, 2))
        edits, now = model.set("tendon", [longer], "range", value), written(of.row("tendon_range", longer, 2))
        probe = how_many("pairs of ropes with unequal ranges", _unequal)
        yield Suspect(names, "range", now, value, edits, probe, 0, says, "ropes alike")


def _slipped(model: ReaderModel) -> Iterator[Suspect]:
    """The sites that are in another place than those of the other tendons, by a sign or two numbers exchanged."""
    of = model.simulation
    for (tendon, site), (others, usual) in _astray(of).items():
        names = of.name("site", site), of.name("tendon", tendon)
        now, value = written(of.row("site_pos", site, 3)), written(usual)
        told = " and ".join(of.name("tendon", each) for each in others[:2])
        says = f"{names[1]} goes through {names[0]} at {now}, where {told} have {value}, and else are alike."
        probe = how_many("sites of a tendon unlike those of its siblings", _astray)
        yield Suspect(
            names, "pos", now, value, model.set("site", [site], "pos", value), probe, 0, says, "tendons alike"
        )


def _astray(of: Simulation) -> dict[tuple[int, int], tuple[list[int], tuple[float, ...]]]:
    """By tendon and site: the tendons that agree, and where that site has its place in them."""
    paths = {tendon: path(of, tendon) for tendon in range(of.count("tendon"))}
    sites = {each: [site for _, site in line] for each, line in paths.items() if {k for k, _ in line} == {"site"}}
    places = {each: [of.row("site_pos", site, 3) for site in line] for each, line in sites.items() if len(line) > 2}
    made = {}
    for tendon, own in places.items():
        like = [each for each in places if each != tendon and len(places[each]) == len(own)]
        odd = {each: [k for k, pair in enumerate(zip(own, places[each], strict=True)) if _far(*pair)] for each in like}
        for which in {each[0] for each in odd.values() if len(each) == 1}:
            agree = [each for each, some in odd.items() if some == [which] and not {*sites[each]} & {*sites[tendon]}]
            usual = places[agree[0]][which]
            alike = all(not _far(places[each][which], usual) for each in agree)
            slip = any(not _far(own[which], each) for each in slips(usual))
            changed = [axis for axis in range(3) if abs(own[which][axis] - usual[axis]) > SAME]
            sided = all(
                any(k != which and point[axis] * usual[axis] > 0 for k, point in enumerate(own)) for axis in changed
            )
            if len(agree) >= ENOUGH - 1 and alike and slip and sided:
                made[tendon, sites[tendon][which]] = agree, usual
    return made


def _far(one: Sequence[float], other: Sequence[float]) -> bool:
    return math.dist(one, other) > SAME


def _unequal(of: Simulation) -> dict[tuple[int, int], tuple[float, float]]:
    """The pairs of ropes of one length between the same bodies, the longer first, with the upper ends of their ranges.

    Ropes go through sites alone.
    """
    made = {}
    for pair in combinations([each for each, on in enumerate(of.model("tendon_limited")) if on], 2):
        lines = [path(of, each) for each in pair]
        if any({kind for kind, _ in line} != {"site"} for line in lines):
            continue
        bodies = [[of.body_of("site", site) for _, site in line] for line in lines]
        lengths = [of.model("tendon_length0")[each] for each in pair]
        (low, high), (other_low, other_high) = (of.row("tendon_range", each, 2) for each in pair)
        same = bodies[0] == bodies[1] and low == other_low and abs(lengths[0] - lengths[1]) <= LIKE * max(lengths)
        if same and abs(high - other_high) > UNEQUAL * max(high, other_high):
            longer = pair if high > other_high else pair[::-1]
            made[longer[0], longer[1]] = max(high, other_high), min(high, other_high)
    return made


def _opposed(of: Simulation) -> list[tuple[int, int]]:
    """The pairs of tendons over left and right, called alike but for a word, of which the first alone adds the two."""
    made = []
    twins = {frozenset(pair) for pair in by_name(of, "joint")}
    over = {tendon: joints_of(of, tendon) for tendon in range(of.count("tendon"))}
    for pair in combinations([each for each, part in over.items() if frozenset(dict(part)) in twins], 2):
        words = [re.split(r"[_\W]+|(?<=[a-z])(?=[A-Z0-9])", of.names("tendon")[each]) for each in pair]
        same = dict(over[pair[0]]).keys() == dict(over[pair[1]]).keys()  # a differential has one of each
        if same or len(words[0]) != len(words[1]) or sum(a != b for a, b in zip(*words, strict=True)) != 1:
            continue
        sizes = [sorted(abs(coefficient) for _, coefficient in over[each]) for each in pair]
        adds = [_adds(of, over[each]) for each in pair]
        if sizes[0] == sizes[1] and adds[0] * adds[1] < 0:
            made.append(pair if adds[0] > 0 else (pair[1], pair[0]))
    return made


def _adds(of: Simulation, part: Sequence[tuple[int, float]]) -> float:
    """Above 0 where two parallel joints of one kind are added, below where one is taken from the other; else 0."""
    of.as_written()
    (one, first), (other, second) = part
    along = dot(*(of.axis(joint) for joint in (one, other)))
    same = of.joint_type(one) == of.joint_type(other) and abs(along) > PARALLEL
    return first * second * along if same else 0.0


def _odd(of: Simulation) -> dict[int, list[int]]:
    """The tendons that stand apart, with those that agree."""
    groups: dict[tuple[str, str, int], list[int]] = {}
    for tendon, name in enumerate(of.names("tendon")):
        for found in WHICH.finditer(name) if joints_of(of, tendon) else ():
            key = name[: found.start()], name[found.end() :], len(joints_of(of, tendon))
            groups.setdefault(key, []).append(tendon)
    made = {}
    for group in groups.values():
        for tendon in group if len(group) >= ENOUGH else ():
            others = [each for each in group if each != tendon]
            if any({*dict(joints_of(of, each))} == {*dict(joints_of(of, tendon))} for each in others):
                continue  # antagonists of the same joints
            usual = _shape(of, others[0])
            if all(_alike(_shape(of, each), usual) for each in others) and not _alike(_shape(of, tendon), usual):
                made[tendon] = others
    return made


def _shape(of: Simulation, tendon: int) -> Shape:
    parts = joints_of(of, tendon)
    bodies = [of.body_of("joint", joint) for joint, _ in parts]
    lines = [of.ancestors(body) for body in bodies]
    first = lines[0]
    steps = [line.index(bodies[0]) if bodies[0] in line else None for line in lines]
    above = [-first.index(body) if body in first else None for body in bodies]
    return tuple((up if up is not None else down, part[1]) for up, down, part in zip(steps, above, parts, strict=True))


def _alike(one: Shape, other: Shape) -> bool:
    return not any(_apart(a, b) for a, b in zip(one, other, strict=True))


def _apart(one: tuple[int | None, float], other: tuple[int | None, float]) -> bool:
    return one[0] != other[0] or abs(one[1] - other[1]) > LIKE * max(abs(one[1]), abs(other[1]))


def _meant(of: Simulation, tendon: int, sibling: int, which: int) -> str:
    """The joint that a tendon would go to if it were called as its sibling's is; empty where there is none."""
    names, joints = of.names("tendon"), of.names("joint")
    like = joints[joints_of(of, sibling)[which][0]]
    for one in WHICH.finditer(names[tendon]):
        for other in WHICH.finditer(names[sibling]):
            if (name := like.replace(other.group(), one.group())) in joints and name != like:
                return name
    return ""


def _edits(model: ReaderModel, tendon: int, which: int, attribute: str, value: str) -> tuple[Edit, ...]:
    element = model.element("tendon", tendon)
    parts = [each for each in element.children if each.tag == "joint"] if element is not None else []
    return (set_attribute(parts[which], attribute, value),) if value and which < len(parts) else ()
