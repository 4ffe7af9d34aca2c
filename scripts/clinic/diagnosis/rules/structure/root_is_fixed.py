"""The wheels turn, or the legs move, and the robot stays.

The body that carries the wheels has no joint, so it is part of the world. So is the root link of a URDF.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="cart" pos="0 0 0.1">
          <geom type="box" size="0.2 0.1 0.03"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint name="left_wheel" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
          <body name="right_wheel" pos="0 -0.15 0">
            <joint name="right_wheel" axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

          <body name="cart" pos="0 0 0.1">
    +       <freejoint/>

The number: wheels that touch the floor, below a body that nothing can move. A wheel is a hinge without limits whose
round geom has its middle on the axis. Legs are two limbs and more of a body in the air whose ends are within 15 % of
its height of the floor; in MJCF also two and more of which two parts are called so (hip and knee, thigh and shin, ...).
And a body that carries links with joints and a gyro or a velocimeter, which read 0 on it for ever, in a file with a
world.

Keyframes get the seven numbers of the place where the body stands.

When it is wrong: a test bench with rollers, or a robot on a stand.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.engine import CYLINDER, ELLIPSOID, SPHERE
from clinic.diagnosis.probes.key import freed
from clinic.diagnosis.probes.shape import plane_heights, root_of, solid
from clinic.diagnosis.probes.vector import across, norm, sub
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "The robot is fixed to the world"
FAMILIES = ("stuck",)
LEVEL = "hint"

MOTION = (2, 3)  # mjtSensor: velocimeter, gyro
LEG = re.compile(r"(?<![a-z])[lr]?(hip|thigh|knee|calf|shin|ankle|leg|foot|femur|tibia)(?![a-z])", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The body without a joint that carries wheels on the floor, or legs."""
    urdf = model.urdf  # each has a fixed root: MuJoCo makes it the world
    of = model.simulation
    wheels = _limbs(of, not urdf)
    roots = {of.ancestors(body)[-2] for body in wheels}
    if not roots:
        yield from _measured(model)
    if len(roots) != 1:
        return
    root = roots.pop()
    edits = () if urdf else freed(model, [root])
    says = f"{len(wheels)} wheels or legs hang on it, and no joint lets it move."
    probe = how_many("wheels and legs of a fixed body", _limbs, not urdf)
    yield Suspect((of.name("body", root),), "freejoint", "left out", "<freejoint/>", edits, probe, 1.5, says, "none")


def _measured(model: ReaderModel) -> Iterator[Suspect]:
    """The one body with links on joints whose motion is measured, where nothing can move it."""
    of = model.simulation
    for root, sensor in _still(of).items() if len(_still(of)) == 1 else ():
        says = f"{of.name('sensor', sensor)} measures how fast it moves, and no joint lets it move."
        probe, edits = how_many("bodies whose motion is measured and that are fixed", _still), freed(model, [root])
        yield Suspect((of.name("body", root),), "freejoint", "left out", "<freejoint/>", edits, probe, 0, says, "none")


def _still(of: Simulation) -> dict[int, int]:
    """The bodies of the world that carry what moves and a gyro or a velocimeter, by the first of these."""
    moving, made = set(of.moving_bodies), dict[int, int]()
    scene = any(int(body) == 0 for body in of.model("geom_bodyid"))  # else it is a part that a scene takes in
    for sensor, kind in enumerate(of.model("sensor_type") if scene else ()):
        body = of.body_of("site", int(of.model("sensor_objid")[sensor])) if int(kind) in MOTION else 0
        if body and body not in moving and moving & set(of.below(root := of.ancestors(body)[-2])):
            made.setdefault(root, sensor)
    return made


def _feet(of: Simulation) -> list[int]:
    """Bodies that are the first to move on their way from the world, of limbs that reach down to the floor."""
    of.begin()
    owner, heights, floors = root_of(of), of.data("xpos")[2::3], plane_heights(of)
    lowest: dict[int, float] = {}
    for body in of.moving_bodies if len(floors) == 1 else ():
        first = owner[body]
        low = min((of.data("geom_xpos")[3 * geom + 2] for geom in of.geoms_of(body)), default=float("inf"))
        lowest[first] = min(low, lowest.get(first, float("inf")))
    made = []
    for first, low in lowest.items():
        root = of.parent(first)
        height = heights[root] - max(floors)
        own = [of.data("geom_xpos")[3 * geom + 2] for geom in of.geoms_of(root) if solid(of, geom)]
        in_air = bool(own) and root > 0 and min(own) - max(floors) > 0.4 * height
        if in_air and of.parent(root) == 0 and 0 <= low - max(floors) < 0.15 * height:
            made.append(first)
    return made


def _limbs(of: Simulation, by_name: bool) -> list[int]:
    found = (find(of) for find in (_wheels, _feet, *([_called_legs] if by_name else [])))
    return next((limbs for limbs in found if len(limbs) > 1), [])


def _called_legs(of: Simulation) -> list[int]:
    """The limbs of a fixed body that has two legs and more, by two words for parts of them that stand twice."""
    moving = set(of.moving_bodies)
    names, joints = of.names("body"), of.names("joint")
    limbs: dict[int, set[int]] = {}
    legs: dict[tuple[int, str], list[int]] = {}
    for body in of.moving_bodies:
        above = of.ancestors(body)[:-1]
        root = above[-1]
        if root in moving:
            continue
        limbs.setdefault(root, set()).add(next(each for each in reversed(above) if each in moving))
        called = [names[body], *(joints[joint] for joint in of.joints_of(body))]
        called += [names[each] for each in above[:-1] if each not in moving]
        for leg in {found.group().lower() for name in called for found in LEG.finditer(name)}:
            before = legs.setdefault((root, leg), [])
            if not set(above) & set(before):
                before.append(body)
    words: dict[int, int] = {}
    for (root, _), some in legs.items():
        words[root] = words.get(root, 0) + (len(some) > 1)
    found = [limbs[root] for root, count in words.items() if count > 1 and len(limbs[root]) > 1]
    return sorted(found[0]) if found else []


def _wheels(of: Simulation) -> list[int]:
    """Bodies of wheels that are the first to move on their way from the world, and reach the floor."""
    of.begin()
    kinds, moving, floors = of.model("geom_type"), set(of.moving_bodies), plane_heights(of)
    made = []
    for joint in range(of.count("joint")) if floors else ():
        body = of.body_of("joint", joint)
        if not of.continuous(joint) or of.parent(body) in moving or len(of.joints_of(body)) > 1:
            continue
        axis, anchor = of.axis(joint), of.data_row("xanchor", joint, 3)
        for geom in of.geoms_of(body):
            off = sub(of.data_row("geom_xpos", geom, 3), anchor)
            radius = of.row("geom_size", geom, 3)[0]
            beside = norm(across(off, axis))
            low = of.data_row("geom_xpos", geom, 3)[2] - radius - max(floors)
            round_ = int(kinds[geom]) in (SPHERE, CYLINDER, ELLIPSOID)
            if round_ and abs(axis[2]) < 0.3 and beside < 0.05 * radius and -0.3 * radius < low < 0.1 * radius:
                made.append(body)
                break
    return made
