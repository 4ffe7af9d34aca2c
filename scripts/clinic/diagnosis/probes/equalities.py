"""What an equality constraint holds together, and how far apart that is as the state is now."""

from __future__ import annotations

from clinic.diagnosis.engine import OBJ_SITE
from clinic.diagnosis.probes.vector import Vector, add, norm, sub, times
from clinic.diagnosis.simulation import Simulation, kept

CONNECT, WELD, COUPLED, TIED = range(4)  # mjtEq; COUPLED of two joints, TIED of two tendons

Frame = tuple[Vector, Vector]  # where it is in the world, and its axes


def kind_of(of: Simulation, each: int) -> int:
    """CONNECT, WELD, COUPLED, or another kind."""
    return int(of.model("eq_type")[each])


def sited(of: Simulation, each: int) -> bool:
    """Whether two sites are held together, in place of two bodies."""
    return int(of.model("eq_objtype")[each]) == OBJ_SITE


def held(of: Simulation, each: int) -> tuple[int, int]:
    """The two bodies, sites or joints; -1 for none."""
    return int(of.model("eq_obj1id")[each]), int(of.model("eq_obj2id")[each])


@kept
def tied(of: Simulation) -> set[frozenset[int]]:
    """The pairs of bodies that a connection or a weld holds together from the start."""
    made = set()
    for each, active in enumerate(of.model("eq_active0")):
        if active and kind_of(of, each) in (CONNECT, WELD):
            made.add(frozenset(of.body_of("site", one) if sited(of, each) else max(one, 0) for one in held(of, each)))
    return made


def by_mocap(of: Simulation, each: int) -> bool:
    """Whether what is connected or welded hangs on a mocap body, which code moves."""
    if kind_of(of, each) not in (CONNECT, WELD):
        return False
    bodies = [of.body_of("site", one) if sited(of, each) else one for one in held(of, each) if one >= 0]
    return any(of.model("body_mocapid")[int(of.model("body_weldid")[body])] >= 0 for body in bodies)


def frames(of: Simulation, each: int) -> tuple[Frame, Frame]:
    """The frames of the two bodies or sites of a connection or a weld."""
    place, turn = ("site_xpos", "site_xmat") if sited(of, each) else ("xpos", "xmat")
    one, other = ((of.data_row(place, it, 3), of.data_row(turn, it, 9)) for it in held(of, each))
    return one, other


def ends(of: Simulation, each: int) -> tuple[Vector, Vector]:
    """The two places in m that a connection or a weld holds together."""
    data = of.equality_data(each)
    anchors = (data[:3], data[3:6]) if kind_of(of, each) == CONNECT else (data[3:6], data[:3])
    if sited(of, each):
        anchors = ((0.0,) * 3,) * 2
    one, other = (add(at, times(turn, a)) for (at, turn), a in zip(frames(of, each), anchors, strict=True))
    return one, other


def off_course(of: Simulation, each: int) -> float:
    """How far the follower of a coupling is from where its leader wants it, in rad or m."""
    places, qpos0 = of.model("jnt_qposadr"), of.model("qpos0")
    ways = [of.position(joint) - qpos0[int(places[joint])] for joint in held(of, each) if joint >= 0]
    factors = of.equality_data(each)[:5]
    led = sum(factor * ways[1] ** power for power, factor in enumerate(factors)) if len(ways) > 1 else factors[0]
    return ways[0] - led


def gap(of: Simulation, each: int) -> float | None:
    """How far apart it is what a constraint holds together, in m or rad; None for what is no connection or coupling."""
    if kind_of(of, each) == COUPLED:
        return abs(off_course(of, each))
    return norm(sub(*ends(of, each))) if kind_of(of, each) in (CONNECT, WELD) else None
