"""Pairs of elements, left and right, and how far each is from being the other's mirror image.

Pairs are found by name (`left_knee`, `knee_L`, `FL_hip`), then by place in the tree. Mirrored are they across the plane that
fits most of what hangs on both sides, or turned by half a turn, or shifted, whatever fits best.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from clinic.diagnosis.engine import BALL, FREE, HINGE, MESH, SLIDE
from clinic.diagnosis.probes.vector import (
    Vector,
    add,
    apart,
    diagonal,
    dot,
    norm,
    sub,
    times,
    transpose,
    turned,
    unit,
)
from clinic.diagnosis.simulation import Simulation

SIDES = {"l": "r", "fl": "fr", "hl": "hr", "bl": "br", "ml": "mr", "rl": "rr"} | {
    "lf": "rf", "lh": "rh", "lr": "rr", "lb": "rb", "lm": "rm"
}  # fmt: skip
WORDS = (("left", "right"), ("Left", "Right"), ("LEFT", "RIGHT"))
TOKEN = re.compile(r"[A-Z](?=[A-Z][a-z])|[A-Z]+(?![a-z])|[A-Z]?[a-z]+")
KINDS = ("body", "joint", "geom", "site", "camera", "actuator", "sensor")
FITS = 0.02  # of the size of what hangs on both sides: as far may a point be from its image


def right_of(name: str) -> Iterator[str]:
    """What the right twin of a left element may be called."""
    for left, right in WORDS:
        if left in name:
            yield name.replace(left, right)
    tokens = [found for found in TOKEN.finditer(name) if found.group().lower() in SIDES]
    for found in tokens:
        side = found.group()
        other = SIDES[side.lower()]
        other = other.upper() if side.isupper() else other.title() if side[0].isupper() else other
        yield name[: found.start()] + other + name[found.end() :]


@dataclass(frozen=True)
class Image:
    """How one side becomes the other: `matrix * point + offset`; `sign` is -1 for a reflection."""

    matrix: Vector
    offset: Vector
    sign: int

    def of(self, point: Vector) -> Vector:
        return add(times(self.matrix, point), self.offset)


@dataclass(frozen=True)
class Comparison:
    """One quantity of a pair: how unlike it is, and the number above which it is."""

    kind: str
    quantity: str
    left: int
    right: int
    unlike: float
    limit: float
    unit: str = "%"

    @property
    def odd(self) -> bool:
        return self.unlike > self.limit

    @property
    def clear(self) -> float:
        """The number above which it cannot be a matter of taste."""
        return {
            "axis sign": math.inf,
            "mass": 40.0,
            "inertia": 60.0,
            "range": 20.0,
            "axis": 20.0,
            "ctrlrange": 20.0,
            "forcerange": 40.0,
        }.get(self.quantity, 45.0 if self.unit == "%" and self.limit > 1 else 2 * self.limit)


class Twins:
    """The pairs of a model at its zero pose.

    Attributes:
        pairs: Left and right index, by kind.
        images: By the index of the left body, how the left side becomes the right.
        share: By the index of the left body, the share of its side's points that the image fits.
    """

    def __init__(self, simulation: Simulation) -> None:
        self.of = simulation
        simulation.engine.reset(-1)
        simulation.engine.forward()
        fields = ("xpos", "xmat", "xipos", "ximat", "xanchor", "xaxis", "geom_xpos", "geom_xmat", "site_xpos")
        self._data = {name: simulation.data(name) for name in (*fields, "cam_xpos", "cam_xmat")}
        self.pairs: dict[str, list[tuple[int, int]]] = {kind: _by_name(simulation, kind) for kind in KINDS}
        self._by_place()
        self.images: dict[int, Image] = {}
        self.share: dict[int, float] = {}
        self.size: dict[int, float] = {}
        self.common: dict[int, int] = {}
        self._find_images()
        self.comparisons = [each for each in self._compared() if math.isfinite(each.unlike)]

    def at(self, field: str, index: int, width: int = 3) -> Vector:
        return tuple(self._data[field][width * index : width * (index + 1)])

    def partner(self, kind: str, index: int) -> int | None:
        """The twin of an element; None for one without."""
        return next(
            (right if left == index else left for left, right in self.pairs[kind] if index in (left, right)), None
        )

    def image(self, left: int, side: int) -> Image:
        """The image that gives one side of the pair of a left body: itself, or its inverse for the left side."""
        image = self.images[left]
        if side != left:
            return image
        back = transpose(image.matrix)
        return Image(back, tuple(-x for x in times(back, image.offset)), image.sign)

    def group(self, each: Comparison) -> int:
        """The body that both sides of a comparison hang on; -1 for actuators and sensors."""
        owners = {"joint": "jnt_bodyid", "geom": "geom_bodyid", "site": "site_bodyid", "camera": "cam_bodyid"}
        if each.kind in ("actuator", "sensor"):
            return -1
        return self.common[each.left if each.kind == "body" else int(self.of.model(owners[each.kind])[each.left])]

    def bodies(self, each: Comparison) -> tuple[int, int]:
        """The bodies that a comparison is of; those of the joints that actuators drive."""
        owners = {"joint": "jnt_bodyid", "geom": "geom_bodyid", "site": "site_bodyid", "camera": "cam_bodyid"}
        pair = (each.left, each.right)
        if each.kind == "actuator":
            pair = tuple(joint if (joint := self.of.driven_joint(one)) is not None else -1 for one in pair)
        if each.kind in ("body", "sensor") or -1 in pair:
            return pair
        field = self.of.model(owners.get(each.kind, "jnt_bodyid"))
        return int(field[pair[0]]), int(field[pair[1]])

    def trusted(self, group: int, compared: list[Comparison]) -> bool:
        """Whether what hangs on a body on both sides is the other's image but for little."""
        fits = next((self.share[left] for left, body in self.common.items() if body == group), 1.0)
        return fits >= 0.85 and sum(each.odd for each in compared) <= max(2, 0.2 * len(compared))

    def interval_sign(self, each: Comparison) -> float:
        """Whether a range of the pair is the same on both sides (1) or mirrored (-1)."""
        if each.kind == "joint":
            return self.joint_sign(each.left, each.right)[0]
        joints = [self.of.driven_joint(actuator) or 0 for actuator in (each.left, each.right)]
        gears = [self.of.row("actuator_gear", actuator, 6)[0] for actuator in (each.left, each.right)]
        return self.joint_sign(joints[0], joints[1])[0] * math.copysign(1, gears[0] * gears[1])

    def joint_sign(self, left: int, right: int) -> tuple[float, float]:
        """Whether equal angles are mirror images (1) or opposite ones (-1), and the angle between the axes in degrees."""
        body = int(self.of.model("jnt_bodyid")[left])
        image = self.images[body]
        mirrored = times(image.matrix, self.at("xaxis", left))
        if self.of.joint_type(left) != SLIDE:
            mirrored = tuple(image.sign * x for x in mirrored)
        cosine = dot(mirrored, self.at("xaxis", right))
        return math.copysign(1, cosine), math.degrees(math.acos(min(1.0, abs(cosine))))

    def _by_place(self) -> None:
        of = self.of
        children: dict[int, list[int]] = {}
        for body in range(1, of.count("body")):
            children.setdefault(int(of.model("body_parentid")[body]), []).append(body)
        paired = {kind: {index for pair in self.pairs[kind] for index in pair} for kind in KINDS}

        def pair(kind: str, left: list[int], right: list[int]) -> None:
            left = [each for each in left if each not in paired[kind]]
            right = [each for each in right if each not in paired[kind]]
            if len(left) == len(right) and not set(left) & set(right):
                self.pairs[kind] += zip(left, right, strict=True)
                paired[kind] |= {*left, *right}

        for kind, owners in (("joint", "jnt_bodyid"), ("geom", "geom_bodyid")):
            for left, right in list(self.pairs[kind]):
                a, b = int(of.model(owners)[left]), int(of.model(owners)[right])
                if a != b:
                    pair("body", [a], [b])
        done = 0
        while done < len(self.pairs["body"]):
            left, right = self.pairs["body"][done]
            pair("body", children.get(left, []), children.get(right, []))
            pair("joint", of.joints_of(left), of.joints_of(right))
            pair("geom", of.geoms_of(left), of.geoms_of(right))
            done += 1

    def _ancestors(self, body: int) -> list[int]:
        made = [body]
        while made[-1]:
            made.append(int(self.of.model("body_parentid")[made[-1]]))
        return made

    def _find_images(self) -> None:
        groups: dict[int, list[tuple[int, int]]] = {}
        for left, right in self.pairs["body"]:
            above = set(self._ancestors(right))
            common = next(body for body in self._ancestors(left) if body in above)
            if common not in (left, right):
                groups.setdefault(common, []).append((left, right))
        for common, pairs in groups.items():
            points = self._points(pairs)
            size = max(
                max(norm(sub(p, points[0][0])) for p, _ in points),
                max(norm(sub(q, points[0][1])) for _, q in points),
                1e-4,
            )
            image, share = self._best(common, pairs, points, FITS * size)
            for left, _ in pairs:
                self.images[left], self.share[left], self.size[left], self.common[left] = image, share, size, common

    def _points(self, pairs: list[tuple[int, int]]) -> list[tuple[Vector, Vector]]:
        inside = {left for left, _ in pairs}
        made = [(self.at("xpos", left), self.at("xpos", right)) for left, right in pairs]
        made += [(self.at("xipos", left), self.at("xipos", right)) for left, right in pairs]
        for left, right in self.pairs["joint"]:
            if int(self.of.model("jnt_bodyid")[left]) in inside:
                made.append((self.at("xanchor", left), self.at("xanchor", right)))
        return made

    def _best(
        self, common: int, pairs: list[tuple[int, int]], points: list[tuple[Vector, Vector]], near: float
    ) -> tuple[Image, float]:
        frame = self.at("xmat", common, 9)
        axes = [tuple(frame[column + 3 * row] for row in range(3)) for column in range(3)]
        axes += [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
        axes += [unit(sub(self.at("xpos", left), self.at("xpos", right))) for left, right in pairs[:2]]
        still = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
        tried = [(_reflection(axis), -1, axis) for axis in axes]
        tried += [*((_half_turn(axis), 1, axis) for axis in axes[:6]), (still, 1, (0.0, 0.0, 0.0))]
        best, most = Image(still, (0.0, 0.0, 0.0), 1), -1.0
        for matrix, sign, normal in tried:
            offsets = [sub(right, times(matrix, left)) for left, right in points]
            offset = tuple(sorted(each[axis] for each in offsets)[len(offsets) // 2] for axis in range(3))
            along = dot(offset, normal)  # a reflection shifts along its normal, a turn across its axis
            offset = tuple(along * x for x in normal) if sign < 0 else add(offset, normal, -along)
            fit = sum(norm(sub(each, offset)) <= near for each in offsets) / len(points)
            if fit > most + (0.15 if sign > 0 and best.sign < 0 else 1e-9):
                best, most = Image(matrix, offset, sign), fit
        return best, most

    def _compared(self) -> Iterator[Comparison]:
        for left, right in self.pairs["body"]:
            if left in self.images:
                yield from self._bodies(left, right)
        for left, right in self.pairs["joint"]:
            if int(self.of.model("jnt_bodyid")[left]) in self.images:
                yield from self._joints(left, right)
        kinds, bodies = self.of.model("geom_type"), self.of.model("geom_bodyid")
        named = self.of.names("geom")
        unordered = {bodies[a] for a, b in self.pairs["geom"] if kinds[a] != kinds[b] and not (named[a] and named[b])}
        for left, right in self.pairs["geom"]:
            if int(bodies[left]) in self.images and bodies[left] not in unordered:
                yield from self._geoms(left, right)
        for left, right in self.pairs["site"]:
            if (body := int(self.of.model("site_bodyid")[left])) in self.images:
                unlike = self._offset(body, "site_xpos", left, right, int(self.of.model("site_bodyid")[right]))
                yield Comparison("site", "pos", left, right, unlike, FITS * self.size[body], "m")
        for left, right in self.pairs["camera"]:
            if (body := int(self.of.model("cam_bodyid")[left])) in self.images:
                yield from self._cameras(body, left, right)
        yield from self._signs()
        for left, right in self.pairs["actuator"]:
            yield from self._actuators(left, right)
        for left, right in self.pairs["sensor"]:
            yield from self._sensors(left, right)

    def _offset(self, body: int, field: str, left: int, right: int, other: int) -> float:
        """How far a point of the right body is from the image of its twin's, seen from their bodies' origins."""
        image = times(self.images[body].matrix, sub(self.at(field, left), self.at("xpos", body)))
        return norm(sub(image, sub(self.at(field, right), self.at("xpos", other))))

    def _alike(self, geom: int) -> list[int]:
        """The geoms of the same body that have its type and size: which is which needs no order."""
        of = self.of
        body, kind, size = (
            int(of.model("geom_bodyid")[geom]),
            of.model("geom_type")[geom],
            norm(of.row("geom_size", geom, 3)),
        )
        return [each for each in of.geoms_of(body)
                if of.model("geom_type")[each] == kind and apart(norm(of.row("geom_size", each, 3)), size) < 5]  # fmt: skip

    def _bodies(self, left: int, right: int) -> Iterator[Comparison]:
        of, image, size = self.of, self.images[left], self.size[left]
        parents = [int(of.model("body_parentid")[each]) for each in (left, right)]
        if parents[0] == parents[1]:
            unlike = norm(sub(image.of(self.at("xpos", left)), self.at("xpos", right)))
        else:
            here, there = (
                sub(self.at("xpos", b), self.at("xpos", p)) for b, p in zip((left, right), parents, strict=True)
            )
            unlike = norm(sub(times(image.matrix, here), there))
        yield Comparison("body", "pos", left, right, unlike, FITS * size, "m")
        masses = of.model("body_mass")[left], of.model("body_mass")[right]
        yield Comparison("body", "mass", left, right, apart(*masses), 10)
        if min(masses) > 1e-9:
            yield Comparison(
                "body",
                "center of mass",
                left,
                right,
                self._offset(left, "xipos", left, right, right),
                2 * FITS * size,
                "m",
            )
            tensors = [
                tuple(x / mass for x in self.tensor(body)) for body, mass in zip((left, right), masses, strict=True)
            ]
            difference = sub(turned(image.matrix, tensors[0]), tensors[1])
            yield Comparison(
                "body", "inertia", left, right, 100 * norm(difference) / max(norm(tensors[0]), norm(tensors[1])), 25
            )
        yield Comparison(
            "body", "gravcomp", left, right, apart(of.model("body_gravcomp")[left], of.model("body_gravcomp")[right]), 5
        )

    def tensor(self, body: int) -> Vector:
        """A body's inertia about its centre of mass in the world's axes, in kg m2."""
        return turned(self.at("ximat", body, 9), diagonal(self.of.row("body_inertia", body, 3)))

    def _joints(self, left: int, right: int) -> Iterator[Comparison]:
        of = self.of
        body = int(of.model("jnt_bodyid")[left])
        if of.joint_type(left) != of.joint_type(right):
            yield Comparison("joint", "type", left, right, 100, 1)
            return
        if of.joint_type(left) == FREE:
            return
        for quantity, field in (("stiffness", "jnt_stiffness"),):
            yield Comparison("joint", quantity, left, right, apart(of.model(field)[left], of.model(field)[right]), 30)
        for quantity in ("damping", "armature", "frictionloss"):
            field = of.model(f"dof_{quantity}")
            yield Comparison("joint", quantity, left, right, apart(field[of.dof(left)], field[of.dof(right)]), 30)
        other = int(of.model("jnt_bodyid")[right])
        yield Comparison(
            "joint", "pos", left, right, self._offset(body, "xanchor", left, right, other), FITS * self.size[body], "m"
        )
        limited = [bool(of.model("jnt_limited")[each]) for each in (left, right)]
        if of.joint_type(left) == BALL:
            return
        sign, angle = self.joint_sign(left, right)
        yield Comparison("joint", "axis", left, right, angle, 5, "degrees")
        if angle < 30:
            yield Comparison("joint", "limited", left, right, 100 * (limited[0] != limited[1]), 1)
            if all(limited):
                yield Comparison(
                    "joint",
                    "range",
                    left,
                    right,
                    _intervals(of.row("jnt_range", left, 2), of.row("jnt_range", right, 2), sign),
                    10,
                )

    def _signs(self) -> Iterator[Comparison]:
        """Joint axes against the habit of the model: those along the normal of the mirror, and those across it."""
        kinds = (SLIDE, HINGE)
        for common in set(self.common.values()):
            normals: dict[bool, list[tuple[int, int, float]]] = {True: [], False: []}
            for left, right in self.pairs["joint"]:
                body = int(self.of.model("jnt_bodyid")[left])
                if (
                    self.common.get(body) != common
                    or self.images[body].sign > 0
                    or self.of.joint_type(left) not in kinds
                ):
                    continue
                axis = self.at("xaxis", left)
                along = norm(add(times(self.images[body].matrix, axis), axis)) / 2  # 0 along the normal, 1 across it
                sign, angle = self.joint_sign(left, right)
                if (along < 0.3 or along > 0.85) and angle < 30 and self.of.joint_type(left) == HINGE:
                    normals[along < 0.3].append((left, right, sign))
            for found in normals.values():
                most = sum(sign for _, _, sign in found)
                for left, right, sign in found if abs(most) >= len(found) - 2 and len(found) >= 4 else ():
                    yield Comparison("joint", "axis sign", left, right, 100 * (sign * most < 0), 1)

    def _geoms(self, left: int, right: int) -> Iterator[Comparison]:
        of = self.of
        body, other = (int(of.model("geom_bodyid")[each]) for each in (left, right))
        size = self.size[body]
        if not any(of.model(field)[each] for field in ("geom_contype", "geom_conaffinity") for each in (left, right)):
            return
        kinds = of.model("geom_type")[left], of.model("geom_type")[right]
        yield Comparison("geom", "type", left, right, 100 * (kinds[0] != kinds[1]), 1)
        for quantity, field in (
            ("contype", "geom_contype"),
            ("conaffinity", "geom_conaffinity"),
            ("condim", "geom_condim"),
        ):
            yield Comparison("geom", quantity, left, right, 100 * (of.model(field)[left] != of.model(field)[right]), 1)
        frictions = [of.row("geom_friction", each, 3) for each in (left, right)]
        yield Comparison("geom", "friction", left, right, apart(frictions[0][0], frictions[1][0]), 5)
        if kinds[0] == kinds[1] != MESH:
            boxes = [of.row("geom_aabb", each, 6)[3:] for each in (left, right)]
            yield Comparison(
                "geom", "size", left, right, max(apart(a, b) for a, b in zip(*map(sorted, boxes), strict=True)), 10
            )
            nearest = min(self._offset(body, "geom_xpos", left, each, other) for each in self._alike(right))
            yield Comparison("geom", "pos", left, right, nearest, FITS * size, "m")
            if nearest < self._offset(body, "geom_xpos", left, right, other) - FITS * size:
                return
            shapes = [turned(self.at("geom_xmat", each, 9), diagonal(tuple(x * x for x in box)))
                      for each, box in zip((left, right), boxes, strict=True)]  # fmt: skip
            turn = sub(turned(self.images[body].matrix, shapes[0]), shapes[1])
            yield Comparison(
                "geom", "quat", left, right, 100 * norm(turn) / max(norm(shapes[0]), norm(shapes[1]), 1e-12), 20
            )

    def _cameras(self, body: int, left: int, right: int) -> Iterator[Comparison]:
        of = self.of
        other = int(of.model("cam_bodyid")[right])
        yield Comparison(
            "camera",
            "pos",
            left,
            right,
            self._offset(body, "cam_xpos", left, right, other),
            FITS * self.size[body],
            "m",
        )
        views = [tuple(self.at("cam_xmat", each, 9)[2::3]) for each in (left, right)]
        cosine = dot(times(self.images[body].matrix, views[0]), views[1])
        yield Comparison(
            "camera", "direction", left, right, math.degrees(math.acos(max(-1.0, min(1.0, cosine)))), 5, "degrees"
        )
        yield Comparison(
            "camera", "fovy", left, right, apart(of.model("cam_fovy")[left], of.model("cam_fovy")[right]), 5
        )

    def _actuators(self, left: int, right: int) -> Iterator[Comparison]:
        of = self.of
        joints = of.driven_joint(left), of.driven_joint(right)
        gears = of.row("actuator_gear", left, 6), of.row("actuator_gear", right, 6)
        yield Comparison("actuator", "gear", left, right, apart(norm(gears[0]), norm(gears[1])), 30)
        for quantity, field in (("gain", "actuator_gainprm"), ("bias", "actuator_biasprm")):
            width = len(of.model(field)) // max(1, of.count("actuator"))
            rows = of.row(field, left, width), of.row(field, right, width)
            yield Comparison(
                "actuator", quantity, left, right, max(apart(abs(a), abs(b)) for a, b in zip(*rows, strict=True)), 30
            )
        if joints[0] is None or joints[1] is None:
            return
        paired = self.partner("joint", joints[0])
        if paired is not None or joints[0] == joints[1] or self.partner("joint", joints[1]) is not None:
            yield Comparison("actuator", "joint", left, right, 100 * (paired != joints[1]), 1)
        if paired != joints[1] or int(of.model("jnt_bodyid")[joints[0]]) not in self.images:
            return
        for quantity in ("ctrl", "force"):
            limited = [bool(of.model(f"actuator_{quantity}limited")[each]) for each in (left, right)]
            if all(limited):
                same = Comparison("actuator", f"{quantity}range", left, right, 0.0, 10)
                rows = [of.row(f"actuator_{quantity}range", each, 2) for each in (left, right)]
                yield replace(same, unlike=_intervals(rows[0], rows[1], self.interval_sign(same)))

    def _sensors(self, left: int, right: int) -> Iterator[Comparison]:
        of = self.of
        if of.model("sensor_objtype")[left] != of.model("sensor_objtype")[right]:
            return
        kind = {1: "body", 2: "body", 3: "joint", 5: "geom", 6: "site", 7: "camera", 19: "actuator"}
        found = kind.get(int(of.model("sensor_objtype")[left]))
        targets = [int(of.model("sensor_objid")[each]) for each in (left, right)]
        partner = self.partner(found, targets[0]) if found else None
        if partner is not None or targets[0] == targets[1]:
            yield Comparison("sensor", "target", left, right, 100 * (partner != targets[1]), 1)


def _intervals(left: Vector, right: Vector, sign: float) -> float:
    """How unlike a range is to its twin's image, in % of the wider."""
    image = left if sign > 0 else (-left[1], -left[0])
    wide = max(left[1] - left[0], right[1] - right[0], 1e-9)
    return 100 * max(abs(a - b) for a, b in zip(image, right, strict=True)) / wide


def _reflection(axis: Vector) -> Vector:
    return tuple((i == j) - 2 * axis[i] * axis[j] for i in range(3) for j in range(3))


def _half_turn(axis: Vector) -> Vector:
    return tuple(2 * axis[i] * axis[j] - (i == j) for i in range(3) for j in range(3))


def _by_name(simulation: Simulation, kind: str) -> list[tuple[int, int]]:
    names = simulation.names(kind)
    places = {name: index for index, name in enumerate(names) if name}
    made, used = [], set()
    for index, name in enumerate(names):
        if name and (found := next((right for right in right_of(name) if right in places), None)):
            if places[found] not in used and index not in used:
                made.append((index, places[found]))
                used |= {index, places[found]}
    return made


def twins(simulation: Simulation) -> Twins:
    """The pairs of a model, found once."""
    if "twins" not in simulation.kept:
        simulation.kept["twins"] = Twins(simulation)
    found = simulation.kept["twins"]
    assert isinstance(found, Twins)
    return found
