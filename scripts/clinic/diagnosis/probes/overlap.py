"""What overlaps at the start."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator

from clinic.diagnosis.engine import BOX, CYLINDER, HINGE, PLANE, Contact
from clinic.diagnosis.probes.equalities import tied
from clinic.diagnosis.probes.load import poses
from clinic.diagnosis.probes.run import State, beginning, state
from clinic.diagnosis.probes.shape import falling, geoms_of_tree, root_of, roots, solid, thickness
from clinic.diagnosis.probes.vector import at
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import probe

LIMBS = 3  # that make a walker
OFTEN = 0.2  # of the poses
LINKS = 3  # bodies further apart in the tree are no relatives
NEAR, LOOSE, UPRIGHT = 0.01, 0.06, 0.999  # of the half height, for what stands still and for what may fall
FALLS = 0.003  # m that what may fall is put above what it stands on


@kept
def _within(simulation: Simulation) -> State:
    """The start with each hinge and slide inside of its range."""
    simulation.begin()
    for joint, (low, high) in simulation.ranges.items():
        simulation.put(joint, min(max(simulation.position(joint), low), high))
    simulation.engine.forward()
    return state(simulation)


def _outside(simulation: Simulation) -> set[int]:
    """The bodies with a joint that starts outside of its range."""
    before, after = beginning(simulation).qpos, _within(simulation).qpos
    joints = range(simulation.count("joint"))
    places = [int(each) for each in simulation.model("jnt_qposadr")]
    return {simulation.body_of("joint", j) for j in joints if before[places[j]] != after[places[j]]}


def relatives(simulation: Simulation) -> list[tuple[int, int, Contact]]:
    """Bodies of one mechanism, or held together, that overlap at the start inside of the joints' ranges, by contact."""
    bodies, owner, falls = simulation.model("geom_bodyid"), root_of(simulation), falling(simulation)
    made = []
    for contact in _within(simulation).contacts:
        one, other = (int(bodies[geom]) for geom in contact.geoms)
        lines = simulation.ancestors(one), simulation.ancestors(other)
        common = next(body for body in lines[0] if body in lines[1])
        links = lines[0].index(common) + lines[1].index(common)
        same = owner[one] == owner[other]
        rail = links == 1 and common == 0 and not _turns(simulation, max(one, other))  # a cart and its rail
        based = common in (one, other) or (common and 0 in (owner[one], owner[other]))  # also a part of the same base
        bolted = not same and not rail and based and not {owner[one], owner[other]} & set(falls)
        siblings = (
            not same and links == 2 and owner[one] and owner[other] and not {owner[one], owner[other]} & set(falls)
        )
        if contact.distance < -thickness(simulation, contact.geoms[0]) / 10 and links > LINKS and (same or bolted):
            return []  # folded up: nobody starts like that
        moved = any(body in _outside(simulation) for line in lines for body in line[: line.index(common)])
        # two links at the end of their range often touch; a parent and its child by design do not
        near = links <= (1 if moved else LINKS) and (same or bolted or siblings)
        if contact.distance < 0 and (near or frozenset((one, other)) in tied(simulation)):
            made.append((one, other, contact))
    return made


@kept
def often(simulation: Simulation, most: float) -> set[tuple[int, int]]:
    """The pairs of bodies that overlap by more than a share of the thinner geom in a fifth of the poses, or in more."""
    bodies, drawn, count = simulation.model("geom_bodyid"), poses(simulation), Counter[tuple[int, int]]()
    for pose in drawn:
        simulation.begin(forward=False)
        simulation.engine.write("qpos", pose)
        simulation.engine.forward()
        count.update(
            {
                (min(pair), max(pair))
                for contact in state(simulation).contacts
                if -contact.distance > most * min(thickness(simulation, geom) for geom in contact.geoms)
                and (pair := [int(bodies[geom]) for geom in contact.geoms])
            }
        )
    return {pair for pair, times in count.items() if times >= OFTEN * len(drawn)}


def _turns(simulation: Simulation, body: int) -> bool:
    """Whether a body has hinges alone."""
    kinds = [simulation.joint_type(joint) for joint in simulation.joints_of(body)]
    return bool(kinds) and all(kind == HINGE for kind in kinds)


@probe("deepest overlap of relatives at the start", "of the geom's thickness", dynamic=False)
def of_relatives(simulation: Simulation) -> float:
    """The deepest overlap of relatives at the start, as a share of the thinner geom's thickness."""
    made = 0.0
    for _, _, contact in relatives(simulation):
        thick = min(thickness(simulation, geom) for geom in contact.geoms)
        if contact.force > 0 and thick > 0:
            made = max(made, -contact.distance / thick)
    return made


def tree_extent(simulation: Simulation, root: int) -> float:
    """How far a tree reaches from its root's place at the start in m."""
    now = beginning(simulation)
    place, radii = at(now.xpos, root), simulation.model("geom_rbound")
    far = [math.dist(at(now.geom_xpos, geom), place) + radii[geom] for geom in geoms_of_tree(simulation, root)]
    return max(far, default=0.0)


def buried(simulation: Simulation, holes: Collection[tuple[int, int]] = ()) -> dict[int, tuple[float, Contact]]:
    """For each tree that can fall its deepest overlap at the start with something else, as a share of its extent.

    Pairs of geoms in `holes` are passed over, and bodies that an equality holds together: these are relatives.
    """
    bodies, owner = simulation.model("geom_bodyid"), root_of(simulation)
    made: dict[int, tuple[float, Contact]] = {}
    falls = falling(simulation)
    for contact in beginning(simulation).contacts:
        pair = frozenset(int(bodies[geom]) for geom in contact.geoms)
        if contact.geoms in holes or pair in tied(simulation):
            continue
        trees = {owner[int(bodies[geom])] for geom in contact.geoms}
        for root in trees & set(falls) if len(trees) > 1 else ():
            share = -contact.distance / max(tree_extent(simulation, root), 1e-9)
            if contact.force > 0 and share > made.get(root, (0.0, contact))[0]:
                made[root] = (share, contact)
    return made


@probe("deepest overlap at the start", "of its extent", dynamic=False)
def at_start(simulation: Simulation) -> float:
    """The deepest overlap at the start of something that can fall, as a share of its extent."""
    return max((share for share, _ in buried(simulation).values()), default=0.0)


def legged(model: ReaderModel) -> bool:
    """Whether it is fixed in an empty world, has three limbs or more, and no exclude names what they hang on."""
    simulation = model.simulation
    empty = not any(int(body) == 0 for body in simulation.model("geom_bodyid"))
    excludes = [each for each in (model.source.section("contact") if model.source else ()) if each.tag == "exclude"]
    told = {each.get(side) for each in excludes for side in ("body1", "body2")}
    minded = any(simulation.names("body")[body] in told for body in _parents(model))
    return empty and not minded and len(roots(simulation)) >= LIMBS


def _parents(model: ReaderModel) -> set[int]:
    """The fixed bodies on which what moves hangs."""
    of = model.simulation
    return {body for root in roots(of) for body in of.ancestors(root) if body not in (0, root)}


def sunk_by_half(of: Simulation, geom: int, over: float = FALLS) -> bool:
    """Whether a geom's middle is half its half height above what is below it; by `over` m more where it may fall."""
    kind, height = int(of.model("geom_type")[geom]), of.row("geom_size", geom, 3)
    half = height[1] if kind == CYLINDER else height[2]
    if kind not in (BOX, CYLINDER) or not solid(of, geom) or of.data_row("geom_xmat", geom, 9)[8] < UPRIGHT:
        return False
    body = of.body_of("geom", geom)
    moves = body in of.moving_bodies
    if moves and (body not in of.free_bodies or len(of.geoms_of(body)) != 1):
        return False
    wrong = LOOSE * half if moves else NEAR * half
    return any(-wrong < above - half / 2 < wrong + over * moves for above in _above(of, geom, body))


def _above(of: Simulation, geom: int, body: int) -> Iterator[float]:
    """How high the middle of a geom is above the planes and the boxes below it that stand still."""
    kinds, bodies, moving = of.model("geom_type"), of.model("geom_bodyid"), of.moving_bodies
    place = of.data_row("geom_xpos", geom, 3)
    for other, kind in enumerate(kinds):
        if int(kind) not in (PLANE, BOX) or other == geom or not solid(of, other) or int(bodies[other]) in moving:
            continue
        there, up = of.data_row("geom_xpos", other, 3), of.data_row("geom_xmat", other, 9)[8]
        if up < UPRIGHT or (int(bodies[other]) == body and body):
            continue
        sizes = of.row("geom_size", other, 3)
        if int(kind) == PLANE:
            yield place[2] - there[2]
        elif body in moving and all(abs(place[axis] - there[axis]) < sizes[axis] for axis in (0, 1)):
            yield place[2] - there[2] - sizes[2]
