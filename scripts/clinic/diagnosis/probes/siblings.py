"""Elements that are alike but for a number or a finger in their names, about as deep: `finger_1` to `finger_3`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from clinic.diagnosis.probes.vector import apart, norm, sub
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe

WHICH = re.compile(
    r"\d+|(?i:(?:front|rear|hind)_?(?P<side>left|right))|(?:FF|MF|RF|LF)(?=J|[a-z_])|"
    r"(?<![a-z])(?:ff|mf|rf|lf)(?=[jJ]\d|[a-z_])|(?i:index|middle|ring|little|pinky)|"
    r"(?<![A-Za-z])(?:[fr][lr]|[FR][LR]|[hH][lrLR])(?![a-z])|(?i:front|rear|hind)"
)
FIELDS = {  # attribute: field, width of a row, columns compared
    "joint": {
        "damping": ("dof_damping", 1, (0,)),
        "armature": ("dof_armature", 1, (0,)),
        "frictionloss": ("dof_frictionloss", 1, (0,)),
        "stiffness": ("jnt_stiffness", 1, (0,)),
        "range": ("jnt_range", 2, (0, 1)),
        "axis": ("jnt_axis", 3, (0, 1, 2)),
    },
    "actuator": {
        "gear": ("actuator_gear", 6, (0,)),
        "gain": ("actuator_gainprm", 10, (0,)),
        "bias": ("actuator_biasprm", 10, (1, 2)),
        "ctrlrange": ("actuator_ctrlrange", 2, (0, 1)),
        "forcerange": ("actuator_forcerange", 2, (0, 1)),
    },
    "geom": {
        "size": ("geom_size", 3, (0, 1, 2)),
        "pos": ("geom_pos", 3, (0, 1, 2)),
        "friction": ("geom_friction", 3, (0,)),
        "condim": ("geom_condim", 1, (0,)),
        "contype": ("geom_contype", 1, (0,)),
        "conaffinity": ("geom_conaffinity", 1, (0,)),
    },
    "body": {
        "mass": ("body_mass", 1, (0,)),
        "center of mass": ("body_ipos", 3, (0, 1, 2)),
        "inertia": ("body_inertia", 3, (0, 1, 2)),
        "pos": ("body_pos", 3, (0, 1, 2)),
    },
}
LENGTHS = ("pos", "center of mass")
OF_THE_FRAME = (("geom", "pos"), ("body", "center of mass"))
UNLIKE, SOME, LIKE = 25.0, 8.0, 0.1  # %


@dataclass(frozen=True)
class Odd:
    """An element that differs from its siblings, which agree."""

    kind: str
    attribute: str
    index: int
    siblings: tuple[int, ...]
    unlike: float

    @property
    def little(self) -> bool:
        """Whether a little counts: the finger of a hand may have its centre of mass elsewhere by 8 %."""
        return self.attribute != "center of mass"

    @property
    def clear(self) -> bool:
        """Whether it is no matter of taste: the odd geom of four differs by up to 22 % in healthy models."""
        return self.unlike > (UNLIKE if self.attribute in (*LENGTHS, "size") or len(self.siblings) < 3 else SOME)


def groups(simulation: Simulation, kind: str) -> list[list[int]]:
    """Siblings of a kind, three at least; geoms are siblings where their bodies are, and have as many."""
    if kind == "geom":
        geoms = [[simulation.geoms_of(body) for body in bodies] for bodies in groups(simulation, "body")]
        return [list(row) for some in geoms if len({len(each) for each in some}) == 1 for row in zip(*some, strict=True)
                if len({simulation.model("geom_type")[geom] for geom in row}) == 1]  # fmt: skip
    made: dict[tuple[object, ...], list[tuple[int, int]]] = {}
    for index, name in enumerate(simulation.names(kind)):
        if kind == "body":
            for found in WHICH.finditer(name):
                key = (*_called(name, found), int(simulation.model("body_jntnum")[index]))
                made.setdefault(key, []).append((index, len(simulation.ancestors(index))))
            continue
        joint = index if kind == "joint" else simulation.driven_joint(index)
        if joint is None or (kind == "joint" and simulation.joint_type(joint) < 2):
            continue
        depth = len(simulation.ancestors(simulation.body_of("joint", joint)))
        for found in WHICH.finditer(name):
            key = (*_called(name, found), simulation.joint_type(joint))
            made.setdefault(key, []).append((index, depth))
    return [
        [index for index, _ in some]
        for some in made.values()
        if len(some) >= 3 and max(depth for _, depth in some) - min(depth for _, depth in some) <= 1
    ]


def _called(name: str, found: re.Match[str]) -> tuple[str, str, bool]:
    """What is left of a name; `rear_wheel` alone is none of `front_left_wheel` and `front_right_wheel`."""
    return name[: found.start()], name[found.end() :], found["side"] is not None


def odd_ones(simulation: Simulation, kind: str, more: float = UNLIKE) -> Iterator[Odd]:
    """The one of each group that differs by more than so many % where all others agree."""
    seen = set()
    least = 4 if kind in ("body", "geom") else 3  # the middle one of three is elsewhere
    for group in groups(simulation, kind):
        if len(group) < least:
            continue
        table = {name: {i: _row(simulation, kind, name, i) for i in group} for name in FIELDS[kind]}
        alike = _without_thumb(group, [rows for name, rows in table.items() if name != "inertia"])
        for attribute, rows in table.items():
            for index in alike:
                others = [each for each in alike if each != index]
                first = rows[others[0]]
                if any(_apart(rows[each], first) > LIKE for each in others) or (index, attribute) in seen:
                    continue
                if (kind, attribute) in OF_THE_FRAME and _turned(simulation, kind, index, others[0]):
                    continue
                if (unlike := _apart(rows[index], first)) > more:
                    seen.add((index, attribute))
                    yield Odd(kind, attribute, index, tuple(others), unlike)


def _turned(of: Simulation, kind: str, index: int, other: int) -> bool:
    """Whether a body is another one in a frame that is turned: all that is in it is as far from each other."""
    made = []
    for body in (each if kind == "body" else of.body_of(kind, each) for each in (index, other)):
        sites = [site for site in range(of.count("site")) if of.body_of("site", site) == body]
        held = (("geom_pos", of.geoms_of(body)), ("site_pos", sites), ("body_pos", of.children.get(body, [])))
        points = [of.row(field, each, 3) for field, some in held for each in some]
        pairs = combinations([(0.0, 0.0, 0.0), of.row("body_ipos", body, 3), *points], 2)
        made.append(tuple(norm(sub(one, another)) for one, another in pairs))
    return len(made[0]) == len(made[1]) > 1 and _apart(made[0], made[1]) <= LIKE


def _without_thumb(group: list[int], table: Sequence[Mapping[int, tuple[float, ...]]]) -> list[int]:
    """Five or more but for the one that is of another kind: which differs from most in two attributes, or more."""
    if len(group) < 5:
        return group

    def like(index: int, rows: Mapping[int, tuple[float, ...]]) -> int:
        return sum(_apart(rows[index], rows[other]) <= LIKE for other in group)

    most = [rows for rows in table if max(like(index, rows) for index in group) > len(group) / 2]
    apart = [index for index in group if sum(like(index, rows) < len(group) / 2 for rows in most) >= 2]
    return [index for index in group if index not in apart] if len(apart) == 1 else group


def _row(simulation: Simulation, kind: str, attribute: str, index: int) -> tuple[float, ...]:
    field, width, columns = FIELDS[kind][attribute]
    place = simulation.dof(index) if field.startswith("dof") else index
    row = simulation.row(field, place, width)
    row = tuple(sorted(row)) if attribute == "inertia" else row  # whatever its axes are called
    return tuple(abs(row[column]) if attribute in LENGTHS else row[column] for column in columns)  # mirrored or not


def swapped(one: str, other: str) -> bool:
    """Whether one of the numbers of two texts has the digits of the other in another order: 0.12 and 0.21."""
    pairs = zip(one.split(), other.split(), strict=False)
    try:
        differ = [
            (f"{abs(float(a)):.12g}", f"{abs(float(b)):.12g}") for a, b in pairs if float(a) ** 2 != float(b) ** 2
        ]
    except ValueError:
        return False
    return len(differ) == 1 and sorted(differ[0][0]) == sorted(differ[0][1]) and "e" not in differ[0][0]


def _apart(one: tuple[float, ...], other: tuple[float, ...]) -> float:
    wide = max(map(abs, (*one, *other)))
    pairs = zip(one, other, strict=True)
    return max(apart(a, b) if len(one) == 1 else 100 * abs(a - b) / max(wide, 1e-12) for a, b in pairs)


def _unlike(simulation: Simulation, kind: str, attribute: str, index: int, other: int) -> float:
    return _apart(_row(simulation, kind, attribute, index), _row(simulation, kind, attribute, other))


def unlike(odd: Odd) -> Probe:
    """How unlike an element is to its first sibling, in %."""
    of = (odd.kind, odd.attribute, odd.index, odd.siblings[0])
    return Probe(f"{odd.attribute} of {odd.kind} and siblings, unlike by", "%", _unlike, of, dynamic=False)


@kept
def of_a_row(simulation: Simulation) -> list[int]:
    """For each joint the first that is called like it but for numbers, and moves a body of the same mass: rollers."""
    first: dict[tuple[str, int, float], int] = {}
    bodies, masses = simulation.model("jnt_bodyid"), simulation.model("body_mass")
    made = []
    for joint, name in enumerate(simulation.names("joint")):
        mass = round(masses[int(bodies[joint])], 6)
        key = (re.sub(r"\d+", "", name) or str(joint), simulation.joint_type(joint), mass)
        made.append(first.setdefault(key, joint))
    return made
