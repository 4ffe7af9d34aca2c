"""A flag or a group of `<option>` switches a part of the model off.

Flags are set for a test and forgotten: without `actuation` no motor does anything, without `limit` no joint stops,
without `equality` loops are open. `override` takes `o_friction` and `o_solref` of `<option>` for every contact,
whatever the geoms have, and without `filterparent` each link collides with the one that it hangs on. A loop or a
coupling with `active="false"` holds nothing.

Bad:

    <mujoco>
      <option>
        <flag actuation="disable"/>
      </option>
      <worldbody>
        <body pos="0 0 1">
          <joint name="hinge" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02"/>
        </body>
      </worldbody>
      <actuator>
        <motor joint="hinge" ctrlrange="-5 5"/>
      </actuator>
    </mujoco>

Good:

    -   <option>
    -     <flag actuation="disable"/>
    -   </option>

The number: how many actuators, limits, loops or pairs the model has of what is switched off. Equality constraints count
where their parts stand at the start as if they held, to 1 mm or mrad. MuJoCo takes the place of two bodies from the
start where no `relpose` is written: of these count those within one mechanism, and connections of two chains that are
fixed to the world.

When it is wrong: a model in which the code switches things on, or an actuator group that is chosen at run time.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.probes.equalities import CONNECT, COUPLED, by_mocap, gap, held, kind_of, sited
from clinic.diagnosis.probes.shape import collides, root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A flag switches it off"
FAMILIES = ("stuck", "passes-limit", "drifts", "sags", "slips")
LEVEL = "hint"

GROUPS = 31
FITS = 1e-3  # m, rad


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Flags in force for which the model has something to switch off."""
    if model.source is None or model.urdf:
        return
    of = model.simulation
    for flag, (usual, number, what) in _flags(of).items():
        for element in model.source.elements("flag"):
            if number and element.get(flag) == {"enable": "disable", "disable": "enable"}[usual]:
                yield _suspect(element, flag, element.get(flag) or "", number, f"The flag {flag} {what}", usual)
    for element in model.source.elements("option"):
        off = {int(word) for word in (element.get("actuatorgroupdisable") or "").split() if word.isdecimal()}
        idle = sum(min(int(group), GROUPS) in off for group in of.model("actuator_group"))
        if idle:
            found = sorted({int(group) for group in of.model("actuator_group")} & off)
            groups = f"Group {found[0]} is" if len(found) == 1 else f"Groups {', '.join(map(str, found))} are"
            says = f"{groups} switched off, and so {idle} of {of.count('actuator')} actuators."
            yield _suspect(element, "actuatorgroupdisable", " ".join(map(str, sorted(off))), idle, says, "left out")
    yield from _inactive(model)


def _inactive(model: ReaderModel) -> Iterator[Suspect]:
    """Equality constraints that are off and fit."""
    of = model.simulation
    of.begin()
    for each, active in enumerate(of.model("eq_active0")):
        apart, edits = gap(of, each), model.set("equality", [each], "active", "true")
        if active or by_mocap(of, each) or apart is None or apart > FITS or not _placed(model, each):
            continue
        what = of.name("equality", each)
        kind = "joint" if kind_of(of, each) == COUPLED else "site" if sited(of, each) else "body"
        ties = tuple(of.name(kind, it) for it in held(of, each) if it >= 0)
        says = f"{what} is off from the start, and its parts stand as if it held them."
        probe = counted("equality constraints that are off and fit", 1)
        yield Suspect((what, *ties), "active", "false", "true", edits, probe, 0, says, "true", level="hint")


def _placed(model: ReaderModel, each: int) -> bool:
    """Whether it is said where the parts belong: MuJoCo takes the places of two bodies from the start if it is not.

    Two bodies of one mechanism are a loop; of two mechanisms one may hold the other now and then.
    """
    of = model.simulation
    if kind_of(of, each) == COUPLED or sited(of, each) or model.value("equality", each, "relpose"):
        return True
    one, other = (root_of(of)[body] for body in held(of, each))
    linkage = kind_of(of, each) == CONNECT and one and other and not {one, other} & set(of.free_bodies)
    return one == other or bool(linkage)


def _suspect(element: Element, attribute: str, now: str, number: int, says: str, value: str) -> Suspect:
    edits = (remove_attribute(element, attribute),)
    probe = counted("parts of the model that it concerns", number)
    return Suspect((f"the flag {attribute}",), attribute, now, value, edits, probe, 0, says, f"{value}", level="hint")


def _flags(of: Simulation) -> dict[str, tuple[str, int, str]]:
    """What each flag usually is, how many parts of the model it concerns, and what it does to them now."""
    limits = sum(map(bool, of.model("jnt_limited")))
    springs = sum(stiffness > 0 for stiffness in of.model("jnt_stiffness"))
    friction = sum(loss > 0 for loss in of.model("dof_frictionloss"))
    motors, loops, parents = of.count("actuator"), of.count("equality"), _parents(of)
    return {
        "actuation": ("enable", motors, f"is disabled: no actuator does anything ({motors} of them)."),
        "limit": ("enable", limits, f"is disabled: no range stops its joint ({limits} of them)."),
        "equality": ("enable", loops, f"is disabled: no equality constraint holds ({loops} of them)."),
        "spring": ("enable", springs, f"is disabled: no spring of a joint pulls ({springs} of them)."),
        "frictionloss": ("enable", friction, f"is disabled: no dry friction holds a joint ({friction} of them)."),
        "filterparent": ("enable", parents, f"is disabled: links collide with what they hang on ({parents} of them)."),
        "override": ("disable", of.count("geom"), "is enabled: every contact has what `<option>` says in o_friction, "
                     "o_solref, o_solimp and o_margin, in place of what its geoms have."),
    }  # fmt: skip


def _parents(of: Simulation) -> int:
    """How many bodies have geoms that may collide with those of their parent."""
    return sum(
        any(collides(of, one, other) for one in of.geoms_of(body) for other in of.geoms_of(of.parent(body)))
        for body in of.moving_bodies
        if of.parent(body) in of.moving_bodies
    )
