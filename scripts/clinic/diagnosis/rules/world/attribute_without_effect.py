"""An attribute is written, and what would read it is off or missing: it has no effect.

`biasprm` needs a `biastype` such as `affine`: without it a `<general>` is a motor, its control a force. `lengthrange`
scales the length of a muscle, and nothing else reads it; `<position>` with a `ctrlrange` holds a length. `springref`
needs a `stiffness`. `fluidcoef` needs a `fluidshape`, and that a `density` or a `viscosity` of `<option>`. The
`friction` of a geom that decides by its `priority` needs a `condim` above 1. On a free body none of whose geoms
collides, a `friction` needs a `contype`. `forcelimited="false"` switches a `forcerange` off, and `ctrllimited="false"`
a `ctrlrange`.

Bad:

    <mujoco>
      <worldbody>
        <site name="wall"/>
        <body pos="1 0 0">
          <joint type="slide" axis="1 0 0" damping="5"/>
          <geom type="box" size="0.1 0.1 0.1"/>
          <site name="load"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope">
          <site site="wall"/>
          <site site="load"/>
        </spatial>
      </tendon>
      <actuator>
        <general tendon="rope" lengthrange="0.5 1"/>
      </actuator>
    </mujoco>

Good:

    -     <general tendon="rope" lengthrange="0.5 1"/>
    +     <position tendon="rope" ctrlrange="0.5 1" kp="100" dampratio="1"/>

The number: how many elements have the attribute, with another value than MuJoCo's own, and not what it needs.

When it is wrong: a number that your own code reads, a spring or a limit that it switches on.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import BIAS_NONE, GAIN_MUSCLE
from clinic.diagnosis.probes.shape import FLUID, in_pairs, solid
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "An attribute that has no effect"
FAMILIES = ("stuck", "drifts", "wrong-numbers", "sags")
UNPLANTED = "what was meant by it, only intent knows"


class Idle(NamedTuple):
    """An attribute without effect.

    Attributes:
        kind: Of the elements that have it.
        attribute: As it is written.
        needs: The attribute that it needs, and what that would have to be.
        says: Why it has no effect.
    """

    kind: str
    attribute: str
    needs: tuple[str, str]
    says: str


NOTHING = 0.05  # of friction, as people write who want none
IDLE = {
    Idle("actuator", "biasprm", ("biastype", "affine"), "Without biastype it is not read, and the control is a force."),
    Idle("actuator", "lengthrange", ("", ""), "It is no muscle, and nothing else reads its lengthrange."),
    Idle("actuator", "forcerange", ("forcelimited", "true"), "forcelimited says false: its force has no limit."),
    Idle("actuator", "ctrlrange", ("ctrllimited", "true"), "ctrllimited says false: it takes any control."),
    Idle("joint", "springref", ("stiffness", "above 0"), "Without stiffness there is no spring."),
    Idle("geom", "friction", ("condim", "3"), "With condim 1, which decides here, a contact has no friction."),
    Idle("geom", "friction", ("contype", "1"), "It is of a free body that touches nothing: its class has contype 0."),
    Idle("geom", "fluidcoef", ("fluidshape", "ellipsoid"), "Without fluidshape its coefficients are not read."),
    Idle("geom", "fluidshape", ("", "density or viscosity of <option>"), "There is no fluid: both are 0 in <option>."),
}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The attributes that have no effect, all of one kind together."""
    of = model.simulation
    if model.source is None or model.urdf:
        return
    for idle in sorted(IDLE):
        found = [each for each in range(of.count(idle.kind)) if _without_effect(model, idle, each)]
        if not found:
            continue
        needed, value = idle.needs
        edits: tuple[Edit, ...] = ()
        if value.isalnum():
            edits = model.set(idle.kind, found, needed, value)
        probe = counted("attributes without effect", len(found))
        names = tuple(of.name(idle.kind, each) for each in found)
        now = model.value(idle.kind, found[0], needed if edits else idle.attribute) or "left out" * bool(edits)
        at = model.element(idle.kind, found[0])
        healthy = f"with {needed} {value}".strip() if value else "left out"
        attribute = needed if edits else idle.attribute
        yield Suspect(names, attribute, now, value, edits, probe, 0, idle.says, healthy, level="hint", at=at)


def _without_effect(model: ReaderModel, idle: Idle, each: int) -> bool:
    written = model.value(idle.kind, each, idle.attribute)
    if idle.needs[0] == "contype":
        return _untouched(model, each)
    if written is None or not any(word.strip("0.-+") for word in written.split()) or written == "none":
        return False
    return not _read(model.simulation, idle.attribute, each)


def _read(of: Simulation, attribute: str, each: int) -> bool:
    """Whether something reads an attribute."""
    match attribute:
        case "biasprm":
            return int(of.model("actuator_biastype")[each]) != BIAS_NONE
        case "lengthrange":
            return any(of.model(f"actuator_{what}type")[each] >= GAIN_MUSCLE for what in ("gain", "bias"))
        case "forcerange" | "ctrlrange":
            low, high = of.row(f"actuator_{attribute}", each, 2)
            return bool(of.model(f"actuator_{attribute.removesuffix('range')}limited")[each]) or low >= high
        case "springref":
            return bool(of.model("jnt_stiffness")[each]) or any(of.model("tendon_stiffness"))
        case "friction":
            return not _slick(of, each)
        case "fluidcoef":
            return bool(of.model("geom_fluid")[FLUID * each])
        case _:
            return of.in_fluid


def _untouched(model: ReaderModel, geom: int) -> bool:
    """Whether a geom with a friction of its own gets masks of 0 from its class, on a free body that touches nothing."""
    of, element = model.simulation, model.element("geom", geom)
    body, paired = of.body_of("geom", geom), in_pairs(of)
    if element is None or "friction" not in element.attributes or body not in of.free_bodies:
        return False
    every = [each for below in of.below(body) for each in of.geoms_of(below)]
    bare = not any(solid(of, each) or each in paired for each in every)
    return bare and not {"contype", "conaffinity"} & element.attributes.keys()


def _slick(of: Simulation, geom: int) -> bool:
    """Whether a geom decides by its priority that its contacts have no friction, and its own says that it has."""
    decides = of.model("geom_priority")[geom] > 0 and of.model("geom_condim")[geom] == 1
    return solid(of, geom) and decides and of.row("geom_friction", geom, 3)[0] > NOTHING
