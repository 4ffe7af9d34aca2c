"""Gravity compensation is on some links of an arm and not on the others.

`gravcomp="1"` stands on a body, and is not inherited by what hangs on it. Where some links of an arm have it, the
joints still carry the others, and the arm sags. `actuatorgravcomp` on a joint says through what the compensation acts;
without `gravcomp` on any body there is none.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1" gravcomp="1">
          <joint axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>
          <body name="fore" pos="0.3 0 0">
            <joint axis="0 1 0"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/>
            <body name="wrist" pos="0.3 0 0" gravcomp="1">
              <joint axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02" mass="0.5"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -       <body name="fore" pos="0.3 0 0">
    +       <body name="fore" pos="0.3 0 0" gravcomp="1">

The number: the share of the moving mass of a mechanism on a fixed base that is not compensated; above 2 % is told. A
hint tells of a free body that has `gravcomp` of 0.9 and more where no other has any: it floats; of the one link of a
free robot that has it and hangs on joints without a motor and a spring; and of links without it, of less than 0.4 of
the mass, on a free robot that floats by it otherwise.

When it is wrong: an arm that is to feel what it holds.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.engine import FREE
from clinic.diagnosis.probes.shape import root_of, roots
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Gravity compensation on some links alone"
FAMILIES = ("sags", "drifts")
AFLOAT = True
LEVEL = "hint"

LEFT, FLOATS, LIGHT = 0.02, 0.9, 0.4  # of the mass; of gravity; of the mass


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Mechanisms of which a part is compensated; those whose joints say how, and no body that it is."""
    of, owner = model.simulation, root_of(model.simulation)
    masses, compensated = of.model("body_mass"), of.model("body_gravcomp")
    for root in roots(of):
        tree = [body for body, top in enumerate(owner) if top == root and masses[body] > 0]
        if any(of.joint_type(joint) == FREE for joint in of.joints_of(root)):
            yield from _floats(model, tree)
            yield from _hangs(model, tree)
            yield from _sinks(model, tree)
            continue
        bare = [body for body in tree if compensated[body] == 0]
        joints = [joint for body in tree for joint in of.joints_of(body)]
        asked = bool(joints) and all(of.model("jnt_actgravcomp")[joint] for joint in joints)
        if not bare or (len(bare) == len(tree) and not asked):
            continue
        some = [body for body in tree if body not in bare]
        inner = any(max(some, default=-1) > body for body in bare)
        value = f"{max((compensated[body] for body in some), default=1.0):g}"
        kilograms = sum(masses[body] for body in bare)
        says = f"{len(bare)} of {len(tree)} links have no gravcomp, {kilograms:.3g} kg in all."
        yield Suspect(
            tuple(of.name("body", body) for body in bare),
            "gravcomp",
            "0",
            value,
            model.set("body", bare, "gravcomp", value),
            Probe("share of the mass that nothing compensates", "", _left, tuple(tree), dynamic=False),
            LEFT,
            says + " All joints have actuatorgravcomp." * (not some),
            "all links of a mechanism, or none",
            level="cause" if not some or (inner and kilograms < sum(masses[body] for body in tree) / 2) else "hint",
        )


def _floats(model: ReaderModel, tree: list[int]) -> Iterator[Suspect]:
    """A free body that gravity does not pull, where others of the model are pulled."""
    of, compensated = model.simulation, model.simulation.model("body_gravcomp")
    pulled = [body for body in of.moving_bodies if body not in tree and of.model("body_mass")[body] > 0]
    if (
        tree
        and pulled
        and min(compensated[body] for body in tree) >= FLOATS
        and not any(compensated[b] for b in pulled)
    ):
        names, now = tuple(of.name("body", body) for body in tree), f"{compensated[tree[0]]:g}"
        probe = Probe("least of its gravity that is taken away", "", _least, tuple(tree), dynamic=False)
        says = f"Nothing pulls {names[0]} down: gravcomp takes its weight away, and no other body has any."
        edits = model.set("body", tree, "gravcomp", "0")
        yield Suspect(
            names, "gravcomp", now, "0", edits, probe, FLOATS - 0.01, says, "0 for what is to fall", level="hint"
        )


def _hangs(model: ReaderModel, tree: list[int]) -> Iterator[Suspect]:
    """The one link of a free robot that gravity does not pull, and that no motor holds."""
    of, compensated = model.simulation, model.simulation.model("body_gravcomp")
    light = [body for body in tree if compensated[body] >= FLOATS]
    if len(light) != 1 or any(compensated[body] for body in tree if body not in light):
        return
    lines = {joint for body in of.ancestors(light[0]) for joint in of.joints_of(body)}
    drivers = {*of.drivers} | {joint for joint in lines if of.model("jnt_stiffness")[joint]}
    hinges = {joint for joint in lines if of.joint_type(joint) != FREE}
    if not hinges or hinges & drivers or not of.gravity:
        return
    name, now = of.name("body", light[0]), f"{compensated[light[0]]:g}"
    says = f"Of {len(tree)} links it alone has gravcomp, and it hangs on joints that nothing drives: it has no weight."
    probe = Probe("share of its gravity that is taken away", "", _least, tuple(light), dynamic=False)
    edits = model.set("body", light, "gravcomp", "0")
    yield Suspect((name,), "gravcomp", now, "0", edits, probe, FLOATS - 0.01, says, "0 for what hangs", level="hint")


def _sinks(model: ReaderModel, tree: list[int]) -> Iterator[Suspect]:
    """The few links of what floats freely that gravity pulls, where nothing compensates them."""
    of, compensated = model.simulation, model.simulation.model("body_gravcomp")
    bare = [body for body in tree if not compensated[body]]
    probe = Probe("share of the mass that nothing compensates", "", _left, tuple(tree), dynamic=False)
    whole = all(abs(compensated[body] - 1) < LEFT for body in tree if body not in bare)
    if not bare or not whole or not 0 < model.measured(probe) < LIGHT or not of.gravity:
        return
    names, mass = tuple(of.name("body", body) for body in bare), sum(of.model("body_mass")[body] for body in bare)
    says = f"{len(bare)} of {len(tree)} links without gravcomp pull down, with {mass:.3g} kg, what floats otherwise."
    edits = model.set("body", bare, "gravcomp", "1")
    yield Suspect(names, "gravcomp", "0", "1", edits, probe, 0, says, "all of what floats, or none", level="hint")


def _least(simulation: Simulation, *bodies: int) -> float:
    return min(simulation.model("body_gravcomp")[body] for body in bodies)


def _left(simulation: Simulation, *bodies: int) -> float:
    masses, compensated = simulation.model("body_mass"), simulation.model("body_gravcomp")
    return sum(masses[body] for body in bodies if compensated[body] == 0) / sum(masses[body] for body in bodies)
