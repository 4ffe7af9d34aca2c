"""A compiled model to try things with: arrays by row, names, and runs of it that are bounded in steps."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property, wraps
from typing import TypeVar, TypeVarTuple

from clinic.diagnosis.engine import BALL, FREE, HINGE, SLIDE, TRN_IN_PARENT, Compiled
from clinic.diagnosis.start import Start

WIDTH = {FREE: (7, 6), BALL: (4, 3), SLIDE: (1, 1), HINGE: (1, 1)}  # of a joint in qpos and qvel
BODIES = {"joint": "jnt_bodyid", "geom": "geom_bodyid", "site": "site_bodyid", "camera": "cam_bodyid"}
ENDLESS = (-math.inf, math.inf)  # in place of the range of a joint without one
UNSTABLE = ("BADQPOS", "BADQVEL", "BADQACC")
Made = TypeVar("Made")
Of = TypeVarTuple("Of")


class Simulation:
    """One compiled text. Fields of the model are read once."""

    def __init__(self, compiled: Compiled, start: Start) -> None:
        self.engine, self.begin_with = compiled, start
        self._fields: dict[str, Sequence[float]] = {}
        self._counts: dict[str, int] = {}
        self._names: dict[str, list[str]] = {}
        self.kept: dict[object, object] = {}  # what probes share: a run that several of them look at

    def count(self, kind: str) -> int:
        """How many elements of a kind there are."""
        if kind not in self._counts:
            self._counts[kind] = self.engine.count(kind)
        return self._counts[kind]

    def names(self, kind: str) -> list[str]:
        """The names of a kind's elements, empty for unnamed ones."""
        if kind not in self._names:
            self._names[kind] = [self.engine.name(kind, i) for i in range(self.count(kind))]
        return self._names[kind]

    def name(self, kind: str, index: int) -> str:
        """`joint "wrist"`; without a name `joint of body "hand"`, or `joint 2 of 3 of body "hand"`."""
        if index < 0:
            return f"no {kind}"
        if kind == "body" and index == 0:
            return "the world"
        if name := self.engine.name(kind, index):
            return f'{kind} "{name}"'
        if kind in BODIES and kind != "camera":
            owners = self.model(BODIES[kind])
            alike = [each for each, owner in enumerate(owners) if owner == owners[index]]
            which = f" {alike.index(index) + 1} of {len(alike)}" if len(alike) > 1 else ""
            return f"{kind}{which} of {self.name('body', int(owners[index]))}"
        return f"{kind} {index}"

    def model(self, field: str) -> Sequence[float]:
        """A field of mjModel, flat; derived values are those of the compilation."""
        if field not in self._fields:
            self._fields[field] = self.engine.model(field)
        return self._fields[field]

    def row(self, field: str, index: int, width: int) -> tuple[float, ...]:
        """Row `index` of a model's field."""
        return tuple(self.model(field)[width * index : width * (index + 1)])

    def equality_data(self, each: int) -> tuple[float, ...]:
        """The row of `eq_data` of an equality, whose width differs between releases."""
        return self._wide_row("eq_data", each, "equality")

    def gain(self, actuator: int) -> tuple[float, ...]:
        """The row of `actuator_gainprm` of an actuator."""
        return self._wide_row("actuator_gainprm", actuator, "actuator")

    def bias(self, actuator: int) -> tuple[float, ...]:
        """The row of `actuator_biasprm` of an actuator."""
        return self._wide_row("actuator_biasprm", actuator, "actuator")

    def _wide_row(self, field: str, index: int, kind: str) -> tuple[float, ...]:
        return self.row(field, index, len(self.model(field)) // self.count(kind))

    def data(self, field: str) -> Sequence[float]:
        """A field of mjData, flat, as it is now."""
        return self.engine.data(field)

    def data_row(self, field: str, index: int, width: int) -> tuple[float, ...]:
        """Row `index` of a field of mjData, as it is now."""
        return tuple(self.data(field)[width * index : width * (index + 1)])

    @property
    def timestep(self) -> float:
        """In s."""
        return self.model("opt.timestep")[0]

    @property
    def gravity(self) -> float:
        """Its strength in m/s2, whatever the flags say."""
        return math.hypot(*self.model("opt.gravity"))

    @property
    def in_fluid(self) -> bool:
        """Whether the medium has a density or a viscosity."""
        return any(self.model(f"opt.{what}")[0] for what in ("density", "viscosity"))

    @property
    def extent(self) -> float:
        """What MuJoCo takes for the size of the model, or somebody wrote, in m."""
        return self.model("stat.extent")[0]

    def begin(self, *, forward: bool = True) -> None:
        """Back to the start that the reader chose; controls are the keyframe's and the reader's."""
        self.engine.reset(self.begin_with.key)
        self._drive(self.begin_with.ctrl)
        self._drive(next((controls for _, controls in self.begin_with.series), {}))
        if forward:
            self.engine.forward()

    def as_written(self) -> None:
        """To the pose in which the file has its bodies: each joint at its `ref`, whatever the start is."""
        self.engine.reset(-1)
        self.engine.forward()

    def steps(self, seconds: float, most: int = 4000) -> int:
        """How many steps `seconds` are; fewer for a large model, so that no run takes long."""
        size = max(1, self.count("dof")) * max(1.0, self.count("geom") / 50)
        return max(10, min(math.ceil(seconds / self.timestep), most, int(most * 25 / max(25, size))))

    def run(self, seconds: float, samples: int = 50) -> Iterator[float]:
        """Steps on from where the state is, and stops about `samples` times; gives the time in s since the call."""
        total = self.steps(seconds)
        each = max(1, total // samples)
        for done in range(each, total + 1, each):
            for _, controls in [row for row in self.begin_with.series if row[0] <= (done - each) * self.timestep][-1:]:
                self._drive(controls)
            self.engine.step(each)
            yield done * self.timestep

    def begin_from(self, start: Start) -> Start:
        """Takes a start that the model has, and gives it with its keyframe's number.

        Raises:
            StartError: If the model lacks what the start names.
        """
        self.begin_with = start.resolved(self.names("key"), self.names("actuator"))
        return self.begin_with

    def _drive(self, controls: Mapping[str, float]) -> None:
        names = self.names("actuator") if controls else []
        for name, value in controls.items():
            if name in names:
                self.engine.write("ctrl", [value], names.index(name))

    @cached_property
    def mass_diagonal(self) -> list[float]:
        """The diagonal of the mass matrix at the start."""
        self.begin()
        return self.engine.mass_diagonal()

    @cached_property
    def dof_joints(self) -> list[int]:
        """The joint of each degree of freedom."""
        return [int(joint) for joint in self.model("dof_jntid")]

    @cached_property
    def scalar_joints(self) -> list[int]:
        """The hinges and slides."""
        return [joint for joint, kind in enumerate(self.model("jnt_type")) if int(kind) in (HINGE, SLIDE)]

    @cached_property
    def ranges(self) -> dict[int, tuple[float, float]]:
        """The ranges of those hinges and slides that have one, in rad or m."""
        ends = {joint: self.row("jnt_range", joint, 2) for joint in self.scalar_joints}
        return {joint: (low, high) for joint, (low, high) in ends.items() if self.model("jnt_limited")[joint]}

    @cached_property
    def moving_bodies(self) -> list[int]:
        """Bodies that some joint moves."""
        parents, joints = self.model("body_parentid"), self.model("body_jntnum")
        moves = [False] * self.count("body")
        for body in range(1, self.count("body")):
            moves[body] = bool(joints[body]) or moves[int(parents[body])]
        return [body for body, each in enumerate(moves) if each]

    @cached_property
    def free_bodies(self) -> list[int]:
        """Bodies with a free joint."""
        kinds, bodies = self.model("jnt_type"), self.model("jnt_bodyid")
        return [int(bodies[joint]) for joint, kind in enumerate(kinds) if int(kind) == FREE]

    @cached_property
    def moving_mass(self) -> float:
        """The mass in kg of the bodies that some joint moves."""
        return sum(self.model("body_mass")[body] for body in self.moving_bodies)

    @cached_property
    def children(self) -> dict[int, list[int]]:
        """The bodies that hang on each body, the world too, that has some."""
        made: dict[int, list[int]] = {}
        for body in range(1, self.count("body")):
            made.setdefault(self.parent(body), []).append(body)
        return made

    def parent(self, body: int) -> int:
        """The body that a body hangs on."""
        return int(self.model("body_parentid")[body])

    def below(self, body: int) -> list[int]:
        """A body and all that hangs on it."""
        return [each for each in range(body, self.count("body")) if body in self.ancestors(each)]

    def ancestors(self, body: int) -> list[int]:
        """A body, the one that it hangs on, and so on up to the world."""
        made = [body]
        while made[-1]:
            made.append(self.parent(made[-1]))
        return made

    def joints_of(self, body: int) -> list[int]:
        """The joints of a body."""
        first, count = int(self.model("body_jntadr")[body]), int(self.model("body_jntnum")[body])
        return list(range(first, first + count))

    def geoms_of(self, body: int) -> list[int]:
        """The geoms of a body."""
        first, count = int(self.model("body_geomadr")[body]), int(self.model("body_geomnum")[body])
        return list(range(first, first + count))

    def joint_type(self, joint: int) -> int:
        """FREE, BALL, SLIDE or HINGE."""
        return int(self.model("jnt_type")[joint])

    def unit(self, joint: int) -> str:
        """Of a joint's position."""
        return "m" if self.joint_type(joint) == SLIDE else "rad"

    def continuous(self, joint: int) -> bool:
        """Whether a joint is a hinge without limits, as a wheel's."""
        return self.joint_type(joint) == HINGE and not self.model("jnt_limited")[joint]

    def axis(self, joint: int) -> tuple[float, ...]:
        """The direction of a hinge or slide in the world, as it is now."""
        return self.data_row("xaxis", joint, 3)

    def body_of(self, kind: str, index: int) -> int:
        """The body that a joint, geom, site or camera is of; of a body its parent."""
        return self.parent(index) if kind == "body" else int(self.model(BODIES[kind])[index])

    def gear(self, actuator: int) -> float:
        """The first number of an actuator's gear: for a joint or tendon all of it."""
        return self.model("actuator_gear")[6 * actuator]

    def actuator_types(self, actuator: int) -> tuple[int, ...]:
        """Of an actuator's gain, bias and dynamics: mjtGain, mjtBias and mjtDyn."""
        return tuple(int(self.model(f"actuator_{of}type")[actuator]) for of in ("gain", "bias", "dyn"))

    def is_motor(self, actuator: int) -> bool:
        """Whether an actuator's control is its force, but for a factor."""
        return not any(self.actuator_types(actuator))

    def place(self, joint: int) -> int:
        """Where a joint begins in qpos."""
        return int(self.model("jnt_qposadr")[joint])

    def put(self, joint: int, position: float) -> None:
        """Puts a hinge or slide elsewhere, in rad or m; what follows from it is not computed."""
        self.engine.write("qpos", [position], self.place(joint))

    def position(self, joint: int) -> float:
        """The angle in rad or the way in m of a hinge or slide, as it is now."""
        return self.data("qpos")[self.place(joint)]

    def dof(self, joint: int) -> int:
        """The first degree of freedom of a joint."""
        return int(self.model("jnt_dofadr")[joint])

    def driven_joint(self, actuator: int) -> int | None:
        """The hinge or slide that an actuator drives directly; None for another transmission."""
        if int(self.model("actuator_trntype")[actuator]) > TRN_IN_PARENT:
            return None
        joint = int(self.model("actuator_trnid")[2 * actuator])
        return joint if joint in self.scalar_joints else None

    @cached_property
    def drivers(self) -> dict[int, list[int]]:
        """The hinges and slides that actuators drive directly, and the actuators of each."""
        made: dict[int, list[int]] = {}
        for actuator in range(self.count("actuator")):
            if (joint := self.driven_joint(actuator)) is not None:
                made.setdefault(joint, []).append(actuator)
        return made

    def unstable(self) -> bool:
        """Whether the simulation went to infinity since the last `begin`."""
        found = self.engine.warnings()
        return any(found.get(kind) for kind in UNSTABLE)


def kept(make: Callable[[Simulation, *Of], Made]) -> Callable[[Simulation, *Of], Made]:
    """Lets a function run once for a simulation and its other arguments: what it gave is kept with the simulation."""

    @wraps(make)
    def once(of: Simulation, *rest: *Of) -> Made:
        key = (make, *rest)
        if key not in of.kept:
            of.kept[key] = make(of, *rest)
        return of.kept[key]  # type: ignore[return-value]

    return once
