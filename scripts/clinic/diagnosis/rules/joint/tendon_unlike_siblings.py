"""One finger's tendon is unlike those of the other fingers.

The fixed tendons of a hand are copied from finger to finger. One that keeps the name of another finger's joint moves
that finger; one that lost the sign of a coefficient adds where the others take away.

Bad:

    <mujoco>
      <worldbody>
        <body name="palm">
          <geom type="box" size="0.04 0.01 0.04"/>
          <body name="FF" pos="0.03 0 0.04">
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
          <body name="RF" pos="-0.03 0 0.04">
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

When it is wrong: a finger that is meant to be coupled in another way.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.siblings import WHICH
from clinic.diagnosis.probes.tendons import joints_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A finger's tendon unlike the others'"
FAMILIES = ("stuck", "drifts", "wrong-numbers")
SINCE = "0.1"
LEVEL = "hint"
UNPLANTED = "few healthy models have three tendons that are alike"

ENOUGH, LIKE = 3, 1e-3

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
