"""Two tendons with a motor each move the same two joints in the same proportion.

The belts of a CoreXY, the cables of a wrist or a differential add two joints and take one from the other. Where the
second line has the signs of the first, or both turned, both motors do the same: the joints go together, and nothing
holds the one against the other.

Bad:

    <mujoco>
      <worldbody>
        <body name="bridge" pos="0 0 1">
          <joint name="y" type="slide" axis="0 1 0" range="-0.2 0.2"/>
          <geom type="box" size="0.2 0.02 0.02"/>
          <body name="head">
            <joint name="x" type="slide" axis="1 0 0" range="-0.2 0.2"/>
            <geom type="box" size="0.03 0.03 0.03"/>
          </body>
        </body>
      </worldbody>
      <tendon>
        <fixed name="belt_a">
          <joint joint="x" coef="1"/>
          <joint joint="y" coef="1"/>
        </fixed>
        <fixed name="belt_b">
          <joint joint="x" coef="-1"/>
          <joint joint="y" coef="-1"/>
        </fixed>
      </tendon>
      <actuator>
        <position tendon="belt_a" kp="2000" kv="60"/>
        <position tendon="belt_b" kp="2000" kv="60"/>
      </actuator>
    </mujoco>

Good:

    -       <joint joint="y" coef="-1"/>
    +       <joint joint="y" coef="1"/>

The number: pairs of fixed tendons over the same two joints whose coefficients are in one proportion, where each has an
actuator that pushes as well as it pulls, and nothing else drives or couples the joints.

When it is wrong: two motors on one shaft.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import combinations

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import DYN_MUSCLE
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.tendons import joints_of, pulled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "Two tendons that do the same"
FAMILIES = ("drifts", "sags", "stuck")
UNPLANTED = "few healthy models drive two joints by two tendons"

SAME = 1e-3  # of the product of two coefficients


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each pair of driven tendons that move two joints in one proportion."""
    of = model.simulation
    for pair in _parallel(of):
        names = tuple(of.name("tendon", tendon) for tendon in reversed(pair))
        joints = joints_of(of, pair[1])
        now, value = f"{joints[1][1]:g}", f"{-joints[1][1]:g}"
        element = model.element("tendon", pair[1])
        parts = [part for part in element.children if part.tag == "joint"] if element is not None else []
        edits = (set_attribute(parts[1], "coef", value),) if len(parts) == len(joints) else ()
        one, other = (of.name("joint", joint) for joint, _ in joints)
        says = f"Both move {one} and {other} in the proportion {joints[0][1]:g} to {now}; no motor moves them apart."
        probe = how_many("pairs of driven tendons that move two joints in one proportion", _parallel)
        yield Suspect(names, "coef", now, value, edits, probe, 0, says, "one sum and one difference")


def _parallel(of: Simulation) -> list[tuple[int, int]]:
    pulls, coupled = pulled(of), {joint for _, (*pair, _) in couplings(of) for joint in pair}
    over = {tendon: joints_of(of, tendon) for actuator, tendon in pulls.items() if _both_ways(of, actuator)}
    busy = Counter(joint for tendon in set(pulls.values()) for joint, _ in joints_of(of, tendon))
    made = []
    for one, other in combinations(sorted(over), 2):
        first, second = dict(over[one]), dict(over[other])
        if len(first) != 2 or first.keys() != second.keys() or any(joint in of.drivers for joint in first):
            continue
        (a, b), (c, d) = first.values(), (second[joint] for joint in first)
        same = all((a, b, c, d)) and abs(a * d - b * c) <= SAME * abs(a * d)
        if same and not coupled & first.keys() and all(busy[joint] == 2 for joint in first):
            made.append((one, other))
    return made


def _both_ways(of: Simulation, actuator: int) -> bool:
    """Whether an actuator pushes and pulls: a servo, or a motor whose control has both signs."""
    low, high = of.row("actuator_ctrlrange", actuator, 2)
    free = not of.model("actuator_ctrllimited")[actuator] or low < 0 < high
    return int(of.model("actuator_dyntype")[actuator]) != DYN_MUSCLE and (free or of.bias(actuator)[1] < 0)
