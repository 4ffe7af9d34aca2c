"""A foot, a wheel or a finger has no geom that collides.

What a robot stands on or grasps with is seen, and passes through everything: its collision geom was forgotten, or the
geoms that are there belong to a class for looks alone.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="car" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03"/>
          <body name="left_wheel" pos="0 0.15 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0" contype="0" conaffinity="0"/>
          </body>
          <body name="right_wheel" pos="0 -0.15 0">
            <joint axis="0 1 0"/>
            <geom type="cylinder" size="0.1 0.02" euler="90 0 0" contype="0" conaffinity="0"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

            <body name="left_wheel" pos="0 0.15 0">
              <joint axis="0 1 0"/>
    -         <geom type="cylinder" size="0.1 0.02" euler="90 0 0" contype="0" conaffinity="0"/>
    +         <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>

            <body name="right_wheel" pos="0 -0.15 0">
              <joint axis="0 1 0"/>
    -         <geom type="cylinder" size="0.1 0.02" euler="90 0 0" contype="0" conaffinity="0"/>
    +         <geom type="cylinder" size="0.1 0.02" euler="90 0 0"/>

The number: bodies that are called a wheel, caster, tyre, foot, finger, pad, jaw or claw, that have geoms and none which
collides, nor has what hangs on them, while other parts of the same robot collide.

So is, where a body is free, a geom that is no plane, stands still and is called a floor, ground, terrain, table, step,
stair, ramp, wall, obstacle or barrier, has masks of zero, and has nothing that stands still and collides around it or
in its body. One of a tray that moves is told, by its class too, where another geom of the body collides, and not around
it.

And so are all fingers, pads, jaws and claws whose masks have no bit in common with those of any free body.

When it is wrong: parts that another geom stands in for, such as a sphere of the calf for the foot.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from clinic.diagnosis.engine import CONTACTS_OFF, PLANE
from clinic.diagnosis.probes.shape import boxes, clear, collides, in_pairs, masks_told, pair_of, root_of, solid
from clinic.diagnosis.probes.vector import Vector
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A foot, wheel or finger that touches nothing"
FAMILIES = ("falls-through", "slips", "drifts")
AFLOAT = True
UNPLANTED = "only names say what a part is for"

FINGER = "finger|fingertip|pad|jaw|claw"
GRIP, PART = (
    re.compile(rf"(?<![a-z])[lr]?({names})s?(?![a-z])", re.IGNORECASE)
    for names in (FINGER, f"wheel|caster|castor|tyre|tire|foot|feet|paw|{FINGER}")
)

GROUND = re.compile(
    r"(?<![a-z])(floor|ground|terrain|table|step|stair|ramp|wall|obstacle|barrier)s?(?![a-z])", re.IGNORECASE
)
SEEN = re.compile(r"visual|(?<![a-z])vis(?![a-z])|light|marker|line|goal|target|shadow", re.IGNORECASE)
THIN = 0.01  # m
CASTER = re.compile(r"caster|castor", re.IGNORECASE)


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The parts by name that do not collide, all together."""
    of = model.simulation
    yield from _ground(model)
    yield from _fingers(model)
    yield from _walls(model)
    found = _bare(of)
    if not found:
        return
    geoms = [geom for body in found for geom in of.geoms_of(body)]
    probe = how_many("feet, wheels and fingers without a geom that collides", _bare)
    names = (*(of.name("body", body) for body in found), *(of.name("geom", geom) for geom in geoms))
    says = f"{of.name('body', found[0])} has no geom that can touch anything, and other parts of the robot have."
    masks = masks_told(of, geoms[0])
    yield Suspect(names, "contype, conaffinity", masks, "1, 1", (), probe, 0, says, "a geom that collides")


def _fingers(model: ReaderModel) -> Iterator[Suspect]:
    """Fingers that collide, and with none of what is free to be held, all together."""
    of = model.simulation
    missing = _missing(of)
    if not missing:
        return
    fingers, held = list(missing), next(iter(missing.values()))
    types, affinities = (int(of.model(f"geom_{mask}")[held]) for mask in ("contype", "conaffinity"))
    attribute, bits = ("conaffinity", types) if types else ("contype", affinities)
    value = str(bits | int(of.model(f"geom_{attribute}")[fingers[0]]))
    now = f"{int(of.model(f'geom_{attribute}')[fingers[0]])}"
    names, edits = tuple(of.name("geom", geom) for geom in fingers), model.set("geom", fingers, attribute, value)
    says = f"No finger has a bit in common with {of.name('geom', held)}, which is free to be held."
    probe = how_many("geoms of fingers that touch nothing free", _missing)
    yield Suspect(names, attribute, now, value, edits, probe, 0, says, "a bit in common")


def _missing(of: Simulation) -> dict[int, int]:
    """The geoms of fingers, where none of them touches anything free beside them, with the first that is."""
    owner, names, bodies = root_of(of), of.names("body"), [int(body) for body in of.model("geom_bodyid")]
    solids = [geom for geom in range(of.count("geom")) if solid(of, geom) and owner[bodies[geom]]]
    fingers = [geom for geom in solids if GRIP.search(names[bodies[geom]])]
    robots = {owner[bodies[geom]] for geom in fingers}
    held = [geom for geom in solids if owner[bodies[geom]] in of.free_bodies and owner[bodies[geom]] not in robots]
    meet = any(collides(of, a, b) or pair_of(of, a, b) is not None for a in fingers for b in held)
    return {} if meet or not held else dict.fromkeys(fingers, held[0])


def _ground(model: ReaderModel) -> Iterator[Suspect]:
    """What is called a floor, a table or a step and cannot be touched, all together."""
    of = model.simulation
    if int(of.model("opt.disableflags")[0]) & CONTACTS_OFF or not of.free_bodies:
        return
    found = _untouched(of)
    if not found:
        return
    names = tuple(of.name("geom", geom) for geom in found)
    says = f"{names[0]} touches nothing, and nothing in its place does."
    masks = masks_told(of, found[0])
    edits = model.set("geom", found, "contype", "1") + model.set("geom", found, "conaffinity", "1")
    probe = how_many("floors, tables and steps that nothing touches", _untouched)
    yield Suspect(names, "contype, conaffinity", masks, "1, 1", edits, probe, 0, says, "a geom that collides")


def _walls(model: ReaderModel) -> Iterator[Suspect]:
    """What is called a wall, by its name or class, of a tray that moves, and cannot be touched, all together."""
    of = model.simulation
    elements = {geom: model.element("geom", geom) for geom in range(of.count("geom"))} if of.free_bodies else {}
    classes = {geom: each.get("class") for geom, each in elements.items() if each is not None}
    called = {geom: f"{of.names('geom')[geom]} {name}" for geom, name in classes.items()}
    named = tuple(geom for geom, name in called.items() if GROUND.search(name) and not SEEN.search(name))
    found = _passed(of, *named)
    if not found:
        return
    names, masks = tuple(of.name("geom", geom) for geom in found), masks_told(of, found[0])
    edits = model.set("geom", found, "contype", "1") + model.set("geom", found, "conaffinity", "1")
    says = f"{names[0]} is called a wall and touches nothing, and another geom of its body does."
    probe = how_many("walls that nothing touches", _passed, *named)
    yield Suspect(names, "contype, conaffinity", masks, "1, 1", edits, probe, 0, says, "a geom that collides")


def _passed(of: Simulation, *geoms: int) -> list[int]:
    """Those of some geoms that collide with nothing, on a moving body of which another geom does."""
    of.begin()
    bodies, every, paired = of.model("geom_bodyid"), boxes(of, range(of.count("geom"))), in_pairs(of)
    made = []
    for geom in (each for each in geoms if not solid(of, each) and each not in paired):
        body = int(bodies[geom])
        mates = [each for each in of.geoms_of(body) if solid(of, each)]
        tray = body in of.moving_bodies and body not in of.free_bodies and mates
        if tray and not any(_around(of, every, each, geom) for each in mates):
            made.append(geom)
    return made


def _untouched(of: Simulation) -> list[int]:
    of.begin()
    bodies, moving, kinds = of.model("geom_bodyid"), set(of.moving_bodies), of.model("geom_type")
    still = [
        geom for geom, body in enumerate(bodies) if int(body) not in moving and of.model("body_mocapid")[int(body)] < 0
    ]
    paired = in_pairs(of)
    solids = [geom for geom in still if solid(of, geom) or geom in paired]
    geoms, names, every = of.names("geom"), of.names("body"), boxes(of, still)
    found = []
    for geom in still:
        called = f"{geoms[geom]} {names[int(bodies[geom])] if bodies[geom] else ''}"
        if geom in solids or int(kinds[geom]) == PLANE or not GROUND.search(called) or SEEN.search(called):
            continue
        mates = [each for each in solids if bodies[geom] and bodies[each] == bodies[geom]]
        clear = of.row("geom_rgba", geom, 4)[3] < 1
        if not clear and not mates and not any(_around(of, every, each, geom) for each in solids):
            found.append(geom)
    return found


def _around(of: Simulation, every: Mapping[int, tuple[Vector, Vector]], solid_: int, geom: int) -> bool:
    """Whether something that collides reaches into the box around a geom; a plane does where it is not far below."""
    (there, extent), (place, half) = (every[each] for each in (solid_, geom))
    if int(of.model("geom_type")[solid_]) == PLANE:
        return abs(place[2] + half[2] - of.data_row("geom_xpos", solid_, 3)[2]) < THIN
    return all(abs(a - b) < c + d - THIN for a, b, c, d in zip(place, there, half, extent, strict=True))


def _bare(of: Simulation) -> list[int]:
    """The parts that should touch something, and cannot."""
    owner, names = root_of(of), of.names("body")
    touches = {body for body in range(1, of.count("body")) if any(solid(of, geom) for geom in of.geoms_of(body))}
    paired = {of.body_of("geom", geom) for geom in in_pairs(of)}
    carriers = {above for body in touches | paired for above in of.ancestors(body)[1:-1]}
    near = touches | paired | carriers
    robots = {owner[body] for body in touches if owner[body]}
    welds = of.model("body_weldid")
    stiff = {int(welds[body]) for body in touches}  # a pad is often the skin of what it is fixed to; a caster is not
    parts = [body for body in of.moving_bodies if PART.search(names[body])]
    parts = [body for body in parts if not all(clear(of, geom) for geom in of.geoms_of(body))]
    parts = [body for body in parts if int(welds[body]) not in stiff or CASTER.search(names[body])]
    return [body for body in parts if body not in near and owner[body] in robots]
