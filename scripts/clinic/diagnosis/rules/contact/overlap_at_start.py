"""Something begins inside of something else, and is thrown out.

A free body whose `pos`, or whose place in a keyframe, lies within the floor, a table or another body is pushed out by
the contact's spring. With default contacts a box that is 2 cm deep rises within 0.1 s, one of 15 cm leaps by 30 cm.
`size` of a box is half of its edge, a common reason; a radius in another unit is one too.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="box">
          <freejoint/>
          <geom name="box" type="box" size="0.05 0.05 0.05"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    -     <body name="box">
    +     <body name="box" pos="0 0 0.05">

The number: the deepest overlap at the start as a share of how far the thing reaches from its own origin; below 0.05 is
well. Below 0.35 it is a cause only where something leaves so fast that it would fly higher than it was deep: default
contacts push out gently up to about 50 mm.

A base that is fixed to the world is pushed by nothing. A hint tells of one that carries joints, all of them above a
plane, and has more than 0.6 of its height below; of 260 healthy models the deepest has 0.5. It tells, too, of a
mechanism that slides on the world and has a geom with more than 0.6 of its thickness in a plane, where no keyframe
raises it.

When it is wrong: code that puts everything into its place after the reset. Bodies that all begin at the origin look
like that and are left alone; where a mechanism that is fixed to the world takes part, or a robot that begins outside of
its joints' ranges, there is only a hint.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.engine import BOX, CAPSULE, CYLINDER, FREE, PLANE, SPHERE, Contact
from clinic.diagnosis.probes.hulls import closed_holes
from clinic.diagnosis.probes.overlap import at_start, buried, sunk_by_half
from clinic.diagnosis.probes.run import beginning
from clinic.diagnosis.probes.shape import box, boxes, falling, geoms_of_tree, root_of, thickness
from clinic.diagnosis.probes.vector import sub, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.start import Start
from clinic.diagnosis.suspect import Level, Probe, Suspect

TITLE = "Something begins inside of something else"
FAMILIES = ("jumps-at-start", "sinks", "explodes")
CASE = "stacked-boxes-fly-apart"

MOST, DEEP = 0.05, 0.35
SUNK = 0.6  # of the height
RESTS, LEVEL_AXIS = 0.1, 0.1  # of a tenth of the radius; cosine of its angle to the vertical
HALF, TENTH = " The size of a box is half of its edge.", " With a tenth of the radius it stands on it."


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Whatever is buried deepest, raised until it is free; the upper one of two bodies; or smaller, where that fits."""
    simulation = model.simulation
    yield from _foundered(model)
    deep = any(share > MOST for share, _ in buried(simulation).values())
    holes = closed_holes(simulation) if deep else {}
    found = {root: each for root, each in buried(simulation, holes).items() if each[0] > MOST}
    yield from _hung_low(model, found)
    if not found or (model.start.key < 0 and simulation.count("key")):
        return  # where there are keyframes, what begins is begun from one
    raised = _lifts(simulation, found)
    edits = tuple(edit for root, lift in raised.items() for edit in _raised_alike(model, root, lift + 1e-4 * lift))
    names = tuple(simulation.name("body", root) for root in raised)
    depth = max(-contact.distance for _, contact in found.values())
    lifted = ", ".join(f"{each:.3g} m higher" for each in raised.values())
    says = f"It begins {1000 * depth:.3g} mm inside of what it touches."
    if names:
        geoms = tuple(simulation.name("geom", geom) for _, contact in found.values() for geom in contact.geoms)
        stuck = model.measured(at_start(), edits) > MOST
        halved = _halved(model, found, all_of_them=stuck)
        if stuck and not halved and (alone := _alone(model, found)):
            halved, crate = alone
            geoms = (crate, *(each for each in dict.fromkeys(geoms) if each != crate))
        smaller, why = (tenth, TENTH) if (tenth := _tenth(model, found)) else (halved, HALF)
        if smaller and model.measured(at_start(), smaller) <= MOST:
            yield Suspect(geoms, "size", "", smaller[0].value, smaller, at_start(), MOST, says + why, excess=2.0)
        elif not edits or model.measured(at_start(), edits) > MOST:
            if not _trees(simulation, found) - {0} <= set(simulation.free_bodies):
                return
            yield Suspect((*names, *geoms), "pos", "", "clear of what it is in", (), at_start(), MOST, says)
        else:
            posed = any(_posed(simulation, root) for root in _trees(simulation, found))
            harms = any(share > DEEP for share, _ in found.values()) or _thrown(simulation, raised, depth)
            level: Level = "cause" if harms and not posed else "hint"
            yield Suspect((*names, *geoms), "pos", "", lifted, edits, at_start(), MOST, says, excess=2.0, level=level)


def _thrown(of: Simulation, roots: Collection[int], depth: float) -> bool:
    """Whether one of them is pushed out so fast that it would fly higher than it was deep."""
    of.begin()
    before, earlier, most = {root: of.data_row("subtree_com", root, 3) for root in roots}, 0.0, 0.0
    for time in of.run(0.3):
        of.engine.forward()
        for root in roots:
            after = of.data_row("subtree_com", root, 3)
            x, y, z = (each / (time - earlier) for each in sub(after, before[root]))
            most, before[root] = max(most, math.hypot(x, y, max(0.0, z))), after
        earlier = time
    return most**2 > 2 * of.gravity * depth


def _hung_low(model: ReaderModel, told: Collection[int]) -> Iterator[Suspect]:
    """What slides on the world and has a link in a floor, raised until that is free; where no keyframe puts it up."""
    of = model.simulation
    if of.count("key"):
        return
    for root, (share, deep, geom) in _in_floor(of).items():
        if root in told or share <= SUNK:
            continue
        x, y, z = of.row("body_pos", root, 3)
        probe = Probe("share of a geom's thickness that is in the floor", "", _deepest, (root,), dynamic=False)
        link, place = of.name("body", of.body_of("geom", geom)), (x, y, round(z + deep, 4))
        says = f"{link} on it begins {1000 * deep:.3g} mm in the floor, {100 * share:.0f} % of its thickness."
        names, edits = (of.name("body", root), of.name("geom", geom)), model.placed(root, place)
        yield Suspect(
            names, "pos", written((x, y, z)), written(place), edits, probe, SUNK, says, "above the floor", level="hint"
        )


def _in_floor(of: Simulation) -> dict[int, tuple[float, float, int]]:
    """By root that falls along a slide: the greatest share of a geom's thickness in a plane, how deep in m, it."""
    bodies, owner, kinds = of.model("geom_bodyid"), root_of(of), of.model("geom_type")
    made: dict[int, tuple[float, float, int]] = {}
    slides = [root for root in falling(of) if root not in of.free_bodies]
    for contact in beginning(of).contacts:
        plane, geom = sorted(contact.geoms, key=lambda each: int(kinds[each]) != PLANE)
        root = owner[int(bodies[geom])]
        if int(kinds[plane]) == PLANE and not owner[int(bodies[plane])] and root in slides and contact.force > 0:
            share = -contact.distance / thickness(of, geom)
            made[root] = max(made.get(root, (0.0, 0.0, geom)), (share, -contact.distance, geom))
    return made


def _deepest(of: Simulation, root: int) -> float:
    return _in_floor(of).get(root, (0.0, 0.0, 0))[0]


def _foundered(model: ReaderModel) -> Iterator[Suspect]:
    """The bases of the world that are in the floor for the most part, raised until they stand on it."""
    of = model.simulation
    for body, (share, deep) in _sunk(of).items():
        x, y, z = of.row("body_pos", body, 3)
        place = (x, y, z + deep)
        probe = Probe("share of a base's height below the floor", "", _share, (body,), dynamic=False)
        says = f"It is fixed to the world, and {100 * share:.0f} % of its height are below the floor."
        names, now, edits = (of.name("body", body),), written((x, y, z)), model.placed(body, place)
        value = edits[0].value if edits else written(place)
        yield Suspect(names, "pos", now, value, edits, probe, SUNK, says, "on the floor", level="hint")


def _share(of: Simulation, body: int) -> float:
    return _sunk(of).get(body, (0.0, 0.0))[0]


def _sunk(of: Simulation) -> dict[int, tuple[float, float]]:
    """By base of the world in the floor, of which all joints are above: the share of its height, and how deep in m."""
    of.begin()
    kinds, moving, made = of.model("geom_type"), set(of.moving_bodies), dict[int, tuple[float, float]]()
    planes = [geom for geom, kind in enumerate(kinds) if int(kind) == PLANE and _level(of, geom)]
    floor = max((of.data_row("geom_xpos", geom, 3)[2] for geom in planes), default=-math.inf)
    for body in of.children.get(0, []) if planes else []:
        joints = [joint for each in of.below(body) for joint in of.joints_of(each)]
        shapes = boxes(of, [geom for geom in of.geoms_of(body) if int(kinds[geom]) != PLANE])
        above = all(of.data_row("xanchor", joint, 3)[2] > floor for joint in joints)
        if body in moving or not joints or not above or not shapes:
            continue
        low = min(place[2] - half[2] for place, half in shapes.values())
        high = max(place[2] + half[2] for place, half in shapes.values())
        if low < floor < high:
            made[body] = (floor - low) / (high - low), floor - low
    return {body: each for body, each in made.items() if each[0] > SUNK}


def _level(of: Simulation, plane: int) -> bool:
    return of.data_row("geom_xmat", plane, 9)[8] > 1 - LEVEL_AXIS


def _lifts(simulation: Simulation, found: Collection[int]) -> dict[int, float]:
    """By how much in m a mechanism has to be raised until it is out of what it is in; of two the upper one."""
    bodies, owner, kinds = simulation.model("geom_bodyid"), root_of(simulation), simulation.model("geom_type")
    start, raised = beginning(simulation), dict[int, float]()
    for root in found:
        for contact in start.contacts:
            trees = [owner[int(bodies[geom])] for geom in contact.geoms]
            if root not in trees or trees[0] == trees[1] or contact.distance >= 0:
                continue
            mine, theirs = contact.geoms if trees[0] == root else contact.geoms[::-1]
            if int(kinds[theirs]) == PLANE:
                lift = -contact.distance
            else:
                below, above = (box(simulation, start.geom_xpos, start.geom_xmat, geom) for geom in (theirs, mine))
                if owner[int(bodies[theirs])] in found and (below[0][2], theirs) > (above[0][2], mine):
                    continue
                lift = below[0][2] + below[1][2] - above[0][2] + above[1][2]
            raised[root] = max(raised.get(root, 0.0), lift)
    return raised


def _trees(simulation: Simulation, found: dict[int, tuple[float, Contact]]) -> set[int]:
    """The mechanisms that are buried, and those in which something is."""
    bodies, owner = simulation.model("geom_bodyid"), root_of(simulation)
    return {owner[int(bodies[geom])] for _, contact in found.values() for geom in contact.geoms}


def _posed(simulation: Simulation, root: int) -> bool:
    """Whether code must have another start for a mechanism: it hangs on the world, or begins outside of a range."""
    owner = root_of(simulation)
    turning = [joint for joint in simulation.scalar_joints if owner[simulation.body_of("joint", joint)] == root]
    if not root or not turning or simulation.begin_with.key >= 0:
        return False
    simulation.begin()
    ranges = {joint: ends for joint, ends in simulation.ranges.items() if joint in turning}
    outside = (not low - 1e-6 <= simulation.position(joint) <= high + 1e-6 for joint, (low, high) in ranges.items())
    return root not in simulation.free_bodies or any(outside)


def _halved(model: ReaderModel, roots: Iterable[int], all_of_them: bool) -> tuple[Edit, ...]:
    """Boxes of half the size, or those that would then stand on what they are in; nothing where another is buried."""
    simulation, sizes = model.simulation, dict[int, str]()
    for geom in (geom for root in roots for geom in geoms_of_tree(simulation, root)):
        if int(simulation.model("geom_type")[geom]) != BOX or not (
            all_of_them or sunk_by_half(simulation, geom, over=0)
        ):
            return ()
        sizes[geom] = " ".join(f"{each / 2:g}" for each in simulation.row("geom_size", geom, 3))
    return model.set_each("geom", "size", sizes)


def _alone(model: ReaderModel, roots: Iterable[int]) -> tuple[tuple[Edit, ...], str] | None:
    """The one free body of one box of half the size with which nothing is buried, and its geom's name."""
    of, kinds = model.simulation, model.simulation.model("geom_type")
    free = [geoms[0] for root in roots if root in of.free_bodies and len(geoms := geoms_of_tree(of, root)) == 1]
    made = []
    for geom in (each for each in free if int(kinds[each]) == BOX):
        half = " ".join(f"{each / 2:g}" for each in of.row("geom_size", geom, 3))
        edits = model.set_each("geom", "size", {geom: half})
        made += [(edits, of.name("geom", geom))] if edits and model.measured(at_start(), edits) <= MOST else []
    return made[0] if len(made) == 1 else None


def _tenth(model: ReaderModel, roots: Collection[int]) -> tuple[Edit, ...]:
    """Round geoms with a tenth of their radius, where the middle of all is as high above the plane; else nothing."""
    of, start, depths = model.simulation, beginning(model.simulation), dict[int, float]()
    kinds, owner, bodies = of.model("geom_type"), root_of(of), of.model("geom_bodyid")
    for contact in start.contacts:
        plane, geom = sorted(contact.geoms, key=lambda each: int(kinds[each]) != PLANE)
        apart = owner[int(bodies[plane])] != (root := owner[int(bodies[geom])])
        if apart and root in roots and contact.distance < 0:
            level = abs(start.geom_xmat[9 * geom + 8]) < LEVEL_AXIS and int(kinds[geom]) in (CAPSULE, CYLINDER)
            if int(kinds[plane]) != PLANE or not (level or int(kinds[geom]) == SPHERE):
                return ()
            depths[geom] = max(depths.get(geom, 0.0), -contact.distance)
    tenths = {geom: of.model("geom_size")[3 * geom] / 10 for geom in depths}
    if any(abs(9 * tenths[geom] - depth) > RESTS * tenths[geom] for geom, depth in depths.items()):
        return ()
    sizes = {geom: (model.value("geom", geom, "size") or "").split() for geom in depths}
    return model.set_each("geom", "size", {each: " ".join([f"{tenths[each]:.6g}", *sizes[each][1:]]) for each in sizes})


def _raised(model: ReaderModel, root: int, lift: float) -> tuple[Edit, ...]:
    simulation, key = model.simulation, model.start.key
    joint = next(iter(simulation.joints_of(root)), -1)
    element = model.element("key", key)
    if key >= 0 and element is not None and "qpos" in element.attributes:  # one without begins as the model does
        at = simulation.place(joint) + 2
        qpos = element.get("qpos").split()
        if len(qpos) <= at or simulation.joint_type(joint) != FREE:
            return ()
        qpos[at] = f"{float(qpos[at]) + lift:.6g}"
        return (set_attribute(element, "qpos", " ".join(qpos)),)
    element = model.element("body", root)
    if element is None:
        return ()
    x, y, z = (element.get("pos") or "0 0 0").split()
    return (set_attribute(element, "pos", f"{x} {y} {float(z) + lift:.6g}"),)


def _raised_alike(model: ReaderModel, root: int, lift: float) -> tuple[Edit, ...]:
    """The same with every other keyframe, and the body's own place, where it is as low and buried too."""
    of, here, made = model.simulation, model.start.key, _raised(model, root, lift)
    others = [key for key in range(-1, of.count("key")) if made and here >= 0 and key != here]
    for key in [each for each in others if _height(of, root, each) == _height(of, root, here)]:
        other = ReaderModel(model.engine, model.texts, model.source, Start(key=key))
        made += _raised(other, root, lift) if buried(other.simulation).get(root, (0.0,))[0] > MOST else ()
    return tuple(dict.fromkeys(made))


def _height(of: Simulation, root: int, key: int) -> float:
    """How high a free body is at a keyframe; at the model's own start for -1."""
    of.engine.reset(key)
    return of.data("qpos")[of.place(of.joints_of(root)[0]) + 2]
