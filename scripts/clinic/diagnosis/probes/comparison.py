"""How far each of a pair, left and right, is from being the other's mirror image."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial

from clinic.diagnosis.engine import BALL, FREE, HINGE, MESH, SLIDE
from clinic.diagnosis.probes.attached import attached
from clinic.diagnosis.probes.couplings import couplings
from clinic.diagnosis.probes.pairs import FITS, Pairs
from clinic.diagnosis.probes.vector import Vector, across, add, apart, diagonal, dot, norm, sub, times, turned

LITTLE = math.radians(3)


@dataclass(frozen=True)
class Comparison:
    """One quantity of a pair: how unlike it is, and the number above which it is."""

    kind: str
    left: int
    right: int
    quantity: str
    unlike: float
    limit: float
    unit: str = "%"

    @property
    def odd(self) -> bool:
        """Whether the two differ."""
        return self.unlike > self.limit

    @property
    def clear(self) -> float:
        """The number above which it cannot be a matter of taste."""
        return {
            "axis sign": math.inf,
            "mass": 40.0,
            "inertia": 60.0,
            "range": 12.0,
            "axis": 20.0,
            "ctrlrange": 12.0,
            "forcerange": 40.0,
            "pos": 3.2 * self.limit,
        }.get(self.quantity, 45.0 if self.unit == "%" and self.limit > 1 else 2 * self.limit)


class Comparisons(Pairs):
    """The pairs of a model, and what of them can be compared."""

    def interval_sign(self, each: Comparison) -> float:
        """Whether a range of the pair is the same on both sides (1) or mirrored (-1)."""
        if each.kind == "joint":
            return self.joint_sign(each.left, each.right)[0]
        joints = [self.of.driven_joint(actuator) or 0 for actuator in (each.left, each.right)]
        gears = [self.of.gear(actuator) for actuator in (each.left, each.right)]
        return self.joint_sign(joints[0], joints[1])[0] * math.copysign(1, gears[0] * gears[1])

    def compared(self) -> Iterator[Comparison]:
        """Every quantity of every pair that is compared."""
        for left, right in self.pairs["body"]:
            if left in self.images:
                yield from self._bodies(left, right)
        for left, right in self.pairs["joint"]:
            if self.of.body_of("joint", left) in self.images:
                yield from self._joints(left, right)
        kinds, bodies = self.of.model("geom_type"), self.of.model("geom_bodyid")
        named = self.of.names("geom")
        unordered = {bodies[a] for a, b in self.pairs["geom"] if kinds[a] != kinds[b] and not (named[a] and named[b])}
        for left, right in self.pairs["geom"]:
            if int(bodies[left]) in self.images and bodies[left] not in unordered:
                yield from self._geoms(left, right)
        for left, right in self.pairs["site"]:
            if (body := self.of.body_of("site", left)) in self.images:
                unlike = self._offset(body, "site_xpos", left, right, self.of.body_of("site", right))
                yield Comparison("site", left, right, "pos", unlike, FITS * self.size[body], "m")
        for left, right in self.pairs["camera"]:
            if (body := self.of.body_of("camera", left)) in self.images:
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
        kinds, size = of.model("geom_type"), norm(of.row("geom_size", geom, 3))
        same = [each for each in of.geoms_of(of.body_of("geom", geom)) if kinds[each] == kinds[geom]]
        return [each for each in same if apart(norm(of.row("geom_size", each, 3)), size) < 5]

    def _bodies(self, left: int, right: int) -> Iterator[Comparison]:
        of, pair = self.of, partial(Comparison, "body", left, right)
        image, size = self.images[left], self.size[left]
        slid = self._slid(left, right) or self._slid(of.parent(left), of.parent(right))
        yield pair("pos", 0.0 if slid else norm(self._shift(left, right)), FITS * size, "m")
        masses = of.model("body_mass")[left], of.model("body_mass")[right]
        yield pair("mass", apart(*masses), 10)
        if min(masses) > 1e-9:
            yield pair("center of mass", self._offset(left, "xipos", left, right, right), 2 * FITS * size, "m")
            tensors = [
                tuple(x / mass for x in self.tensor(body)) for body, mass in zip((left, right), masses, strict=True)
            ]
            difference = sub(turned(image.matrix, tensors[0]), tensors[1])
            yield pair("inertia", 100 * norm(difference) / max(norm(tensors[0]), norm(tensors[1])), 25)
        yield pair("gravcomp", apart(of.model("body_gravcomp")[left], of.model("body_gravcomp")[right]), 5)

    def _shift(self, left: int, right: int) -> Vector:
        """From the right body to the image of its twin, seen from the bodies that they hang on."""
        above, image = [self.of.parent(each) for each in (left, right)], self.images[left]
        if above[0] == above[1]:
            return sub(image.of(self.at("xpos", left)), self.at("xpos", right))
        here, there = (sub(self.at("xpos", b), self.at("xpos", p)) for b, p in zip((left, right), above, strict=True))
        return sub(times(image.matrix, here), there)

    def _slid(self, left: int, right: int) -> bool:
        """Whether a body's frame is elsewhere on its own hinge's line, and what hangs on it is back in its place."""
        if (left, right) not in self.pairs["body"] or left not in self.images:
            return False
        shift, near, joints = self._shift(left, right), FITS * self.size[left], self.of.joints_of(right)
        lines = [across(shift, self.at("xaxis", joint)) for joint in joints]
        held = [pair for pair in self.pairs["body"] if pair[0] in self.of.children.get(left, [])]
        back = [add(shift, self._shift(*pair)) for pair in held if pair[0] in self.images]
        return bool(joints and back) and all(norm(each) <= near for each in (*lines, *back))

    def tensor(self, body: int) -> Vector:
        """A body's inertia about its centre of mass in the world's axes, in kg m2."""
        return turned(self.at("ximat", body, 9), diagonal(self.of.row("body_inertia", body, 3)))

    def _joints(self, left: int, right: int) -> Iterator[Comparison]:
        of, pair = self.of, partial(Comparison, "joint", left, right)
        body = of.body_of("joint", left)
        if of.joint_type(left) != of.joint_type(right):
            yield pair("type", 100, 1)
            return
        if of.joint_type(left) == FREE:
            return
        springs = of.model("jnt_stiffness")
        yield pair("stiffness", apart(springs[left], springs[right]), 30)
        for quantity in ("damping", "armature", "frictionloss"):
            field = of.model(f"dof_{quantity}")
            yield pair(quantity, apart(field[of.dof(left)], field[of.dof(right)]), 30)
        other = of.body_of("joint", right)
        yield pair("pos", self._offset(body, "xanchor", left, right, other), FITS * self.size[body], "m")
        if of.joint_type(left) == BALL:
            return
        sign, angle = self.joint_sign(left, right)
        yield pair("axis", angle, 5, "degrees")
        if angle < 30:
            yield pair("limited", 100 * ((left in of.ranges) != (right in of.ranges)), 1)
            if left in of.ranges and right in of.ranges:
                ranges = of.ranges[left], of.ranges[right]
                little = of.joint_type(left) == HINGE and _apart(*ranges, sign) < LITTLE
                yield pair("range", 0.0 if little else _intervals(*ranges, sign), 10)
            if of.joint_type(left) == HINGE and springs[left] > 0 and springs[right] > 0:
                rests = [of.model("qpos_spring")[of.place(joint)] for joint in (left, right)]
                yield pair("springref", math.degrees(abs(sign * rests[0] - rests[1])), 5, "degrees")

    def _negated(self, left: int, right: int) -> bool:
        """Whether the range is negated with the axis, so that both turn the same way, and no other."""
        ranges = [self.of.row("jnt_range", joint, 2) for joint in (left, right)]
        sign, _ = self.joint_sign(left, right)
        unlike, otherwise = (_intervals(ranges[0], ranges[1], one) for one in (sign, -sign))
        return sign < 0 and unlike < 1 and otherwise > 10

    def _signs(self) -> Iterator[Comparison]:
        """Joint axes against the habit of the model: those along the normal of the mirror, and those across it."""
        kinds = (SLIDE, HINGE)
        for common in set(self.common.values()):
            normals: dict[bool, list[tuple[int, int, float]]] = {True: [], False: []}
            for left, right in self.pairs["joint"]:
                body = self.of.body_of("joint", left)
                if (
                    self.common.get(body) != common
                    or self.images[body].sign > 0
                    or self.of.joint_type(left) not in kinds
                ):
                    continue
                axis = self.at("xaxis", left)
                along = norm(add(times(self.images[body].matrix, axis), axis)) / 2  # 0 along the normal, 1 across it
                sign, angle = self.joint_sign(left, right)
                hinge = self.of.joint_type(left) == HINGE and not self._negated(left, right)
                if (along < 0.3 or along > 0.85) and angle < 30 and hinge:
                    normals[along < 0.3].append((left, right, sign))
            for found in normals.values():
                most = sum(sign for _, _, sign in found)
                for left, right, sign in found if abs(most) >= len(found) - 2 and len(found) >= 4 else ():
                    yield Comparison("joint", left, right, "axis sign", 100 * (sign * most < 0), 1)

    def _geoms(self, left: int, right: int) -> Iterator[Comparison]:
        of, pair = self.of, partial(Comparison, "geom", left, right)
        body, other = (of.body_of("geom", each) for each in (left, right))
        size = self.size[body]
        if not any(of.model(field)[each] for field in ("geom_contype", "geom_conaffinity") for each in (left, right)):
            return
        kinds = of.model("geom_type")[left], of.model("geom_type")[right]
        yield pair("type", 100 * (kinds[0] != kinds[1]), 1)
        for quantity in ("contype", "conaffinity", "condim"):
            field = of.model(f"geom_{quantity}")
            yield pair(quantity, 100 * (field[left] != field[right]), 1)
        frictions = [of.row("geom_friction", each, 3) for each in (left, right)]
        yield pair("friction", apart(frictions[0][0], frictions[1][0]), 5)
        for quantity, width in (("solref", 2), ("solimp", 5)):
            rows = (of.row(f"geom_{quantity}", each, width) for each in (left, right))
            yield pair(quantity, max(apart(abs(a), abs(b)) for a, b in zip(*rows, strict=True)), 30)
        if kinds[0] == kinds[1] != MESH:
            boxes = [of.row("geom_aabb", each, 6)[3:] for each in (left, right)]
            yield pair("size", max(apart(a, b) for a, b in zip(*map(sorted, boxes), strict=True)), 10)
            nearest = min(self._offset(body, "geom_xpos", left, each, other) for each in self._alike(right))
            yield pair("pos", nearest, FITS * size, "m")
            if nearest < self._offset(body, "geom_xpos", left, right, other) - FITS * size:
                return
            shapes = [turned(self.at("geom_xmat", each, 9), diagonal(tuple(x * x for x in box)))
                      for each, box in zip((left, right), boxes, strict=True)]  # fmt: skip
            turn = sub(turned(self.images[body].matrix, shapes[0]), shapes[1])
            yield pair("quat", 100 * norm(turn) / max(norm(shapes[0]), norm(shapes[1]), 1e-12), 20)

    def _cameras(self, body: int, left: int, right: int) -> Iterator[Comparison]:
        of, pair = self.of, partial(Comparison, "camera", left, right)
        other = of.body_of("camera", right)
        yield pair("pos", self._offset(body, "cam_xpos", left, right, other), FITS * self.size[body], "m")
        views = [tuple(self.at("cam_xmat", each, 9)[2::3]) for each in (left, right)]
        cosine = dot(times(self.images[body].matrix, views[0]), views[1])
        yield pair("direction", math.degrees(math.acos(max(-1.0, min(1.0, cosine)))), 5, "degrees")
        yield pair("fovy", apart(of.model("cam_fovy")[left], of.model("cam_fovy")[right]), 5)

    def _actuators(self, left: int, right: int) -> Iterator[Comparison]:
        of, pair = self.of, partial(Comparison, "actuator", left, right)
        joints = of.driven_joint(left), of.driven_joint(right)
        gears = of.row("actuator_gear", left, 6), of.row("actuator_gear", right, 6)
        yield pair("gear", apart(norm(gears[0]), norm(gears[1])), 30)
        if all(any(gear) for gear in gears):
            yield pair("gear sign", 100 * (dot(gears[0], gears[1]) < 0), 1)
        for quantity, row in (("gain", of.gain), ("bias", of.bias)):
            rows = row(left), row(right)
            yield pair(quantity, max(apart(abs(a), abs(b)) for a, b in zip(*rows, strict=True)), 30)
        if joints[0] is None or joints[1] is None:
            return
        paired = self.partner("joint", joints[0])
        if paired is not None or joints[0] == joints[1] or self.partner("joint", joints[1]) is not None:
            led = {frozenset((follower, leader)) for _, (follower, leader, _) in couplings(of)}
            either = frozenset((paired, joints[1])) in led  # of the two fingers of a gripper
            yield pair("joint", 100 * (paired != joints[1] and not either), 1)
        if paired != joints[1] or of.body_of("joint", joints[0]) not in self.images:
            return
        for quantity in ("ctrl", "force"):
            limited = [bool(of.model(f"actuator_{quantity}limited")[each]) for each in (left, right)]
            if all(limited):
                same = pair(f"{quantity}range", 0.0, 10)
                ranges = [of.row(f"actuator_{quantity}range", each, 2) for each in (left, right)]
                own = [of.ranges[joint] for joint in (joints[0], joints[1]) if joint in of.ranges]
                inherited = len(own) == 2 and all(_apart(*each, 1) < 1e-9 for each in zip(ranges, own, strict=True))
                unlike = _intervals(ranges[0], ranges[1], self.interval_sign(same))
                yield replace(same, unlike=0.0 if inherited else unlike)  # of the joints it is told

    def _sensors(self, left: int, right: int) -> Iterator[Comparison]:
        of, pair = self.of, partial(Comparison, "sensor", left, right)
        if of.model("sensor_objtype")[left] != of.model("sensor_objtype")[right]:
            return
        one, other = (attached(of, "sensor", each) for each in (left, right))
        partner = self.partner(*one) if one else None
        seen = [of.model("sensor_refid")[each] for each in (left, right)]  # as a contact sensor's other geom
        if one and other and (partner is not None or (one == other and seen[0] == seen[1])):
            yield pair("target", 100 * (partner != other[1]), 1)


def _intervals(left: Vector, right: Vector, sign: float) -> float:
    """How unlike a range is to its twin's image, in % of the wider."""
    return 100 * _apart(left, right, sign) / max(left[1] - left[0], right[1] - right[0], 1e-9)


def _apart(left: Vector, right: Vector, sign: float) -> float:
    """How far an end of a range is from that of its twin's image."""
    image = left if sign > 0 else (-left[1], -left[0])
    return max(abs(a - b) for a, b in zip(image, right, strict=True))
