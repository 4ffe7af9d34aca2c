"""The rotors of a drone cannot turn it about its vertical by themselves.

Each rotor pushes up and, by its drag, turns the drone the other way round. Two turn to the left and two to the right,
those that are diagonal alike. Where the two on one side turn alike, yaw comes with roll or with pitch, and where all
do, with lift: no controller can take the one without the other.

Bad:

    <mujoco>
      <worldbody>
        <body name="drone" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.02" mass="0.5"/>
          <site name="one" pos="-0.1 -0.1 0"/>
          <site name="two" pos="-0.1 0.1 0"/>
          <site name="three" pos="0.1 0.1 0"/>
          <site name="four" pos="0.1 -0.1 0"/>
        </body>
      </worldbody>
      <actuator>
        <motor name="one" site="one" gear="0 0 1 0 0 -0.02"/>
        <motor name="two" site="two" gear="0 0 1 0 0 0.02"/>
        <motor name="three" site="three" gear="0 0 1 0 0 0.02"/>
        <motor name="four" site="four" gear="0 0 1 0 0 -0.02"/>
      </actuator>
    </mujoco>

Good:

    -     <motor name="three" site="three" gear="0 0 1 0 0 0.02"/>
    +     <motor name="three" site="three" gear="0 0 1 0 0 -0.02"/>
    -     <motor name="four" site="four" gear="0 0 1 0 0 -0.02"/>
    +     <motor name="four" site="four" gear="0 0 1 0 0 0.02"/>

The number: the volume that thrust and the torques about the drone's three axes span, each made as long as 1; four
rotors that are arranged well have 1, and those that cannot be told apart 0. Suspected is less than a hundredth.

A rotor that turns on a hinge of its own must hand its drag on to the drone: through the hinge's damping. About a hinge
with neither damping nor friction the torque makes the rotor ever faster, and the drone feels nothing of it.

When it is wrong: a drone that turns by other means. Only the drone itself tells which way its rotors turn: a hint.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.probes.rotors import forces, rotors
from clinic.diagnosis.probes.vector import across, dot, norm, times
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect, how_many, rounded

TITLE = "Rotors that cannot yaw alone"
FAMILIES = ("drifts", "stuck", "wrong-numbers")
UNPLANTED = "only one of the healthy models flies"

ROTORS, LEAST = 4, 0.01
SIDES = "Those on one side turn alike, so that yaw comes with roll or pitch."
ALONG, SPIN = 0.9, 500.0  # cosine; rad/s, at which damping hands the whole torque on


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Four motors at sites of one free body, with thrust and drag, whose effects are not independent."""
    of = model.simulation
    yield from _loose(model)
    for body in of.free_bodies:
        found = rotors(of, body)
        if len(found) != ROTORS or _spanned(of, body) >= LEAST:
            continue
        gears = [of.row("actuator_gear", each.actuator, 6) for each in found]
        if not all(gear[5] for gear in gears):
            continue
        edits: tuple[Edit, ...] = ()
        around = sorted(found, key=lambda each: math.atan2(each.place[1], each.place[0]))
        for each, gear in zip(found, gears, strict=True):
            yaw = abs(gear[5]) * (-1) ** (around.index(each) + 1)
            edits += model.set("actuator", [each.actuator], "gear", " ".join(f"{x:g}" for x in (*gear[:5], yaw)))
        probe = Probe("how little the rotors' effects are independent", "", _alike, (body,), dynamic=False)
        names = tuple(of.name("actuator", each.actuator) for each in found)
        same = len({gear[5] > 0 for gear in gears}) == 1
        says = "All turn alike, so that yaw comes with lift." if same else SIDES
        now = ", ".join(f"{gear[5]:+g}" for gear in gears)
        yield Suspect(names, "gear", now, "diagonal ones alike", edits, probe, 1 - LEAST, says, "diagonal rotors alike")


def _loose(model: ReaderModel) -> Iterator[Suspect]:
    """The hinges about which a rotor's drag does nothing but spin it."""
    of = model.simulation
    hinges = _freely_turned(of)
    if not hinges:
        return
    inertia, torque = (max(each) for each in zip(*hinges.values(), strict=True))
    probe = how_many("rotors whose torque turns nothing but themselves", _freely_turned)
    edits = model.set("joint", list(hinges), "damping", rounded(torque / SPIN))
    names = tuple(of.name("joint", joint) for joint in hinges)
    says = (
        f"Its torque of {torque:.3g} N m is about the axis of {names[0]}, which has no damping: it spins an inertia of "
    )
    says += f"{inertia:.2g} kg m2 ever faster, and never reaches the body."
    value = rounded(torque / SPIN)
    yield Suspect(names, "damping", "0", value, edits, probe, 0, says, f"{torque:.3g} N m at {SPIN:g} rad/s")


@kept
def _freely_turned(of: Simulation) -> dict[int, tuple[float, float]]:
    """By hinge without damping, friction and limits about which a rotor's drag is: its inertia, and the torque."""
    sites, bodies, made = of.model("actuator_trnid"), of.model("site_bodyid"), dict[int, tuple[float, float]]()
    limited = of.model("actuator_ctrllimited")
    found = [each for body in of.free_bodies for each in rotors(of, body) if norm(each.drag)]
    ends = [
        max(of.row("actuator_ctrlrange", each.actuator, 2), key=abs) if limited[each.actuator] else 1.0
        for each in found
    ]
    for each, force in zip(found, forces(of, found, ends) if found else (), strict=True):
        site = int(sites[2 * each.actuator])
        drag = times(of.data_row("site_xmat", site, 9), of.row("actuator_gear", each.actuator, 6)[3:])
        for joint in of.joints_of(int(bodies[site])):
            dof = of.dof(joint)
            held = of.model("dof_damping")[dof] or of.model("dof_frictionloss")[dof] or of.model("jnt_stiffness")[joint]
            if of.continuous(joint) and not held and (along := abs(dot(of.axis(joint), drag))) > ALONG * norm(drag):
                made[joint] = of.mass_diagonal[dof], along * abs(force)
    return made


def _spanned(of: Simulation, body: int) -> float:
    """The volume that thrust and the three torques span."""
    columns = [(norm(each.push), *each.torque) for each in rotors(of, body)]
    rows = [[column[k] for column in columns] for k in range(4)]
    volume = 1.0
    for k, row in enumerate(rows):  # what is left of each once the earlier ones are taken out
        left: Sequence[float] = [x / norm(row) for x in row] if norm(row) else row
        for other in rows[:k]:
            left = across(left, other)
        volume *= norm(left)
        rows[k] = [x / norm(left) for x in left] if norm(left) else list(left)
    return volume


def _alike(of: Simulation, body: int) -> float:
    return 1 - _spanned(of, body)
