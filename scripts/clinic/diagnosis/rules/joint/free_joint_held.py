"""A free joint has damping, dry friction, a spring or armature from the default for joints.

`<joint type="free"/>` takes what the default class gives to all joints: an object then falls as in syrup, stops in the
air, or hangs on a spring at the place where it began. `<freejoint/>` takes nothing of it.

Bad:

    <mujoco>
      <default>
        <joint damping="2" armature="0.1"/>
      </default>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="cube" pos="0 0 0.5">
          <joint type="free"/>
          <geom type="box" size="0.03 0.03 0.03" mass="0.2"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <joint type="free"/>
    +       <freejoint/>

The number: what the joint takes of the weight at the speed of a fall over half of the radius of its largest geom, or
one radius below its start; armature counts by its share of the mass that gravity then has to move. Below 0.1 is well.

When it is wrong: a floating base that stands in for a crane or for water.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.engine import FREE
from clinic.diagnosis.probes.shape import size
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A free joint with the damping of the others"
FAMILIES = ("stuck", "drifts", "slow", "sags")

MOST = 0.1  # of the weight
FIELDS = ("damping", "frictionloss", "stiffness", "armature")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Free joints that hold what hangs on them, all together."""
    of = model.simulation
    if not (taken := held(of)):
        return
    worst = max(taken, key=lambda joint: sum(taken[joint].values()))
    named = [name for name in FIELDS if any(parts[name] > MOST / 4 for parts in taken.values())]
    attribute = max(named, key=lambda name: taken[worst][name])
    edits = tuple(edit for name in named for joint in taken for edit in model.set("joint", [joint], name, "0"))
    now = of.model("jnt_stiffness")[worst] if attribute == "stiffness" else of.model(f"dof_{attribute}")[of.dof(worst)]
    yield Suspect(
        tuple(of.name("joint", joint) for joint in taken),
        attribute,
        f"{now:.3g}",
        "0",
        edits,
        Probe("what the free joint takes of the weight", "of the weight", _most, tuple(taken), dynamic=False),
        MOST,
        f"{of.name('joint', worst)} is free, and has {' and '.join(named)} of its own or of a default: "
        "<freejoint/> takes no defaults.",
        "nothing, as <freejoint/> has it",
    )


def held(of: Simulation) -> dict[int, dict[str, float]]:
    """The free joints that hold what hangs on them, and what they take of its weight by attribute."""
    if not of.gravity:
        return {}
    every = ((joint, _taken(of, joint)) for joint in range(of.count("joint")))
    return {joint: parts for joint, parts in every if sum(parts.values()) > MOST}


def _most(simulation: Simulation, *joints: int) -> float:
    return max(sum(_taken(simulation, joint).values()) for joint in joints)


def _taken(simulation: Simulation, joint: int) -> dict[str, float]:
    """What a free joint takes of the weight of all that hangs on it, by attribute; 0 for another joint."""
    if simulation.joint_type(joint) != FREE:
        return dict.fromkeys(FIELDS, 0.0)
    body, dof = simulation.body_of("joint", joint), simulation.dof(joint)
    mass, g = simulation.model("body_subtreemass")[body], simulation.gravity
    weight, far = max(mass * g, 1e-12), max(size(simulation, body), 1e-3)
    damping, friction, armature = (simulation.model(f"dof_{name}")[dof] for name in ("damping", *FIELDS[1::2]))
    stiffness = simulation.model("jnt_stiffness")[joint]
    return {
        "damping": damping * math.sqrt(g * far) / weight,
        "frictionloss": friction / weight,
        "stiffness": stiffness * far / weight,
        "armature": armature / max(mass + armature, 1e-12),
    }
