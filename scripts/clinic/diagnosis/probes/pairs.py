"""Pairs of elements, left and right, and what makes one side the image of the other.

Pairs are found by name (`sides`), then by place in the tree.
Mirrored are they across the plane that fits most of what hangs on both sides, or turned by half a turn, or shifted,
whatever fits best.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

from clinic.diagnosis.engine import SLIDE
from clinic.diagnosis.probes.sides import by_name
from clinic.diagnosis.probes.vector import IDENTITY, Vector, add, dot, norm, sub, times, transpose, unit
from clinic.diagnosis.simulation import Simulation

KINDS = ("body", "joint", "geom", "site", "camera", "actuator", "sensor")
SYMMETRIC = 0.85  # of the points fit their image: the parts are meant to be mirrored
SAME, UNTURNED = 1e-3, 2.9  # m or quaternion's length that tells a copy; trace of a turn by 18 degrees
ASTRAY = 20.0  # times as far as half of the points: what is there does not tell how large a side is
FITS = 0.02  # of the size of what hangs on both sides: as far may a point be from its image


@dataclass(frozen=True)
class Image:
    """How one side becomes the other: `matrix * point + offset`; `sign` is -1 for a reflection."""

    matrix: Vector
    offset: Vector
    sign: int

    def of(self, point: Vector) -> Vector:
        """Where a point of one side is on the other."""
        return add(times(self.matrix, point), self.offset)


class Pairs:
    """The pairs of a model at its zero pose.

    Attributes:
        pairs: Left and right index, by kind.
        images: By the index of the left body, how the left side becomes the right.
        share: By the index of the left body, the share of its side's points that the image fits, as their bodies
            see them.
        size: By the index of the left body, the size in m of what hangs on its side.
        common: By the index of the left body, the body that both sides hang on.
    """

    def __init__(self, simulation: Simulation) -> None:
        self.of = simulation
        simulation.as_written()
        fields = ("xpos", "xmat", "xipos", "ximat", "xanchor", "xaxis", "geom_xpos", "geom_xmat", "site_xpos")
        self._data = {name: simulation.data(name) for name in (*fields, "cam_xpos", "cam_xmat")}
        self.pairs: dict[str, list[tuple[int, int]]] = {kind: by_name(simulation, kind) for kind in KINDS}
        self._by_place()
        self.images: dict[int, Image] = {}
        self.share: dict[int, float] = {}
        self.size: dict[int, float] = {}
        self.common: dict[int, int] = {}
        self._moved: set[int] = set()
        self._find_images()

    def at(self, field: str, index: int, width: int = 3) -> Vector:
        """A row of a field of mjData at the zero pose."""
        return tuple(self._data[field][width * index : width * (index + 1)])

    def displaced(self, left: int) -> bool:
        """Whether a pair is mirrored but for one coordinate of its place."""
        return left in self._moved

    def partner(self, kind: str, index: int) -> int | None:
        """The twin of an element; None for one without."""
        return next(
            (right if left == index else left for left, right in self.pairs.get(kind, ()) if index in (left, right)),
            None,
        )

    def image(self, left: int, side: int) -> Image:
        """The image that gives one side of the pair of a left body: itself, or its inverse for the left side."""
        image = self.images[left]
        if side != left:
            return image
        back = transpose(image.matrix)
        return Image(back, tuple(-x for x in times(back, image.offset)), image.sign)

    def joint_sign(self, left: int, right: int) -> tuple[float, float]:
        """Whether equal angles are mirror images (1) or opposite ones (-1), and the axes' angle in degrees."""
        body = self.of.body_of("joint", left)
        image = self.images[body]
        mirrored = times(image.matrix, self.at("xaxis", left))
        if self.of.joint_type(left) != SLIDE:
            mirrored = tuple(image.sign * x for x in mirrored)
        cosine = dot(mirrored, self.at("xaxis", right))
        return math.copysign(1, cosine), math.degrees(math.acos(min(1.0, abs(cosine))))

    @cached_property
    def crossed(self) -> set[int]:
        """The left bodies of pairs that tell no mirror image from a copy, and what hangs on them.

        Both hands have one finger on the same side, and the other where the mirror would have that one.
        """
        of, made, beside = self.of, set[int](), dict[tuple[int, int], list[tuple[int, int]]]()
        for left, right in self.pairs["body"]:
            hands = of.parent(left), of.parent(right)
            if hands[0] != hands[1]:
                beside.setdefault(hands, []).append((left, right))
        for fingers in beside.values():
            places = [[of.row("body_pos", each, 3) for each in pair] for pair in fingers]
            if len(fingers) == 2 and all(math.dist(*pair) < SAME for pair in places):
                one, other = places[0][0], places[1][0]
                across = [abs(a - b) > SAME for a, b in zip(one, other, strict=True)]
                if sum(across) == 1 and abs(dot(add(one, other), across)) < SAME:
                    made |= {each for left, _ in fingers for each in of.below(left)}
        return made

    def _telling(self, pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
        """The pairs that tell a mirror image from a copy; all where none does."""
        return [pair for pair in pairs if pair[0] not in self.crossed] or pairs

    def _by_place(self) -> None:
        of = self.of
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
            pair("body", of.children.get(left, []), of.children.get(right, []))
            pair("joint", of.joints_of(left), of.joints_of(right))
            pair("geom", of.geoms_of(left), of.geoms_of(right))
            done += 1

    def _find_images(self) -> None:
        groups: dict[int, list[tuple[int, int]]] = {}
        for left, right in self.pairs["body"]:
            above = set(self.of.ancestors(right))
            common = next(body for body in self.of.ancestors(left) if body in above)
            if common not in (left, right):
                groups.setdefault(common, []).append((left, right))
        for common, pairs in groups.items():
            points = self._points(pairs)
            here, there = points[0]
            every = (norm(sub(each, top)) for pair in points for each, top in zip(pair, (here, there), strict=True))
            ways = sorted([1e-4, *(way for way in every if way > 1e-4)])
            size = max(way for way in ways if way <= ASTRAY * ways[len(ways) // 2])
            telling = self._telling(pairs)
            image = self._copied(pairs) or self._best(common, pairs, self._points(telling), FITS * size)
            share = self._fit(telling, image, FITS * size)
            # one pair astray would else move the plane: it goes through the body that both sides hang on
            fixed = (self.at("xpos", common),) * 2 if image.sign < 0 else points[0]
            through = replace(image, offset=sub(fixed[1], times(image.matrix, fixed[0])))
            if (fits := self._fit(telling, through, FITS * size)) >= SYMMETRIC:
                image, share = through, fits
            if (mirror := self._displaced(common, pairs, FITS * size)) is not None:
                image, share = mirror, self._fit(pairs, mirror, FITS * size)
                self._moved |= {left for left, _ in pairs}
            for left, _ in pairs:
                self.images[left], self.share[left], self.size[left], self.common[left] = image, share, size, common
        self._through_origins()

    def _through_origins(self) -> None:
        """Moves the mirror of a group into that of another group, where it lies beside the body that it hangs on."""
        lefts = {common: left for left, common in self.common.items()}
        beside = {common: self._beside(common, self.images[left]) for common, left in lefts.items()}
        for common, left in lefts.items():
            image, near = self.images[left], FITS * self.size[left]
            for other, first in lefts.items():
                plane = self.images[first]
                if other == common or plane.sign > 0 or beside[other] > FITS * self.size[first]:
                    continue
                alike = image.sign < 0 and norm(sub(plane.matrix, image.matrix)) < 1e-3
                if alike and beside[common] > near >= self._beside(common, plane):
                    moved = Image(image.matrix, plane.offset, image.sign)
                    self.images |= {each: moved for each, body in self.common.items() if body == common}

    def _beside(self, common: int, image: Image) -> float:
        """How far a body is from its own image in m."""
        return norm(sub(image.of(self.at("xpos", common)), self.at("xpos", common)))

    def _fit(self, pairs: list[tuple[int, int]], image: Image, near: float) -> float:
        """The share of bodies, centres of mass and joints that are where the image has them, but for one that is odd.

        Each is seen from the body it hangs on, so that what hangs on the odd one is not odd, too.
        """
        made = []
        for left, right in pairs:
            above = self.of.parent(left), self.of.parent(right)
            whole = image.of(self.at("xpos", left)), self.at("xpos", right)
            seen = [sub(self.at("xpos", b), self.at("xpos", p)) for b, p in zip((left, right), above, strict=True)]
            made.append(whole if above[0] == above[1] else (times(image.matrix, seen[0]), seen[1]))
            inner = [sub(self.at("xipos", each), self.at("xpos", each)) for each in (left, right)]
            made.append((times(image.matrix, inner[0]), inner[1]))
        inside = {left for left, _ in pairs}
        for left, right in self.pairs["joint"]:
            bodies = [self.of.body_of("joint", each) for each in (left, right)]
            if bodies[0] in inside:
                anchors = zip((left, right), bodies, strict=True)
                inner = [sub(self.at("xanchor", joint), self.at("xpos", body)) for joint, body in anchors]
                made.append((times(image.matrix, inner[0]), inner[1]))
        return 1 - max(0, sum(norm(sub(a, b)) > near for a, b in made) - 1) / len(made)

    def _points(self, pairs: list[tuple[int, int]]) -> list[tuple[Vector, Vector]]:
        inside = {left for left, _ in pairs}
        made = [(self.at("xpos", left), self.at("xpos", right)) for left, right in pairs]
        made += [(self.at("xipos", left), self.at("xipos", right)) for left, right in pairs]
        for left, right in self.pairs["joint"]:
            if self.of.body_of("joint", left) in inside:
                made.append((self.at("xanchor", left), self.at("xanchor", right)))
        return made

    def _displaced(self, common: int, pairs: list[tuple[int, int]], near: float) -> Image | None:
        """The mirror through the body that both sides hang on, where all fits it but one coordinate of the first pair.

        A shift or an oblique mirror fits all, that pair as well, where what hangs on it is flat.
        """
        frame = self.at("xmat", common, 9)
        tops = [pair for pair in pairs if {self.of.parent(each) for each in pair} == {common}]
        if len(tops) != 1:
            return None
        left, right = (times(transpose(frame), sub(self.at("xpos", each), self.at("xpos", common))) for each in tops[0])
        same = [abs(a - b) <= near / 20 for a, b in zip(left, right, strict=True)]
        mirrored = [abs(a + b) <= near / 20 and abs(a) > near for a, b in zip(left, right, strict=True)]
        if sum(same) != 1 or sum(mirrored) != 1 or math.dist(left, right) < 3 * near:
            return None
        axis = tuple(frame[3 * row + mirrored.index(True)] for row in range(3))
        matrix = _reflection(axis)
        image = Image(matrix, sub(self.at("xpos", common), times(matrix, self.at("xpos", common))), -1)
        return image if self._fit(pairs, image, near) == 1 else None

    def _copied(self, pairs: list[tuple[int, int]]) -> Image | None:
        """The turn of one side into the other, where it is the same chain set up in another direction; else None."""
        of, lefts = self.of, {left for left, _ in pairs}
        inner = [(left, right) for left, right in pairs if self.of.parent(left) in lefts]
        tops = [pair for pair in pairs if pair not in inner]
        joints = [pair for pair in self.pairs["joint"] if of.body_of("joint", pair[0]) in lefts]
        fields = [("body_pos", 3, inner), ("body_quat", 4, inner), ("body_ipos", 3, pairs), ("jnt_axis", 3, joints)]
        apart = [norm(sub(*(of.row(name, each, n) for each in pair))) for name, n, some in fields for pair in some]
        if len(tops) != 1 or not inner or sum(each < SAME for each in apart) < SYMMETRIC * len(apart):
            return None
        here, there = (self.at("xmat", each, 9) for each in tops[0])
        matrix = times(there, transpose(here))
        if matrix[0] + matrix[4] + matrix[8] > UNTURNED:
            return None
        return Image(matrix, sub(self.at("xpos", tops[0][1]), times(matrix, self.at("xpos", tops[0][0]))), 1)

    def _best(
        self, common: int, pairs: list[tuple[int, int]], points: list[tuple[Vector, Vector]], near: float
    ) -> Image:
        frame = self.at("xmat", common, 9)
        axes = [tuple(frame[column + 3 * row] for row in range(3)) for column in range(3)]
        axes += [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
        axes += [unit(sub(self.at("xpos", left), self.at("xpos", right))) for left, right in pairs[:2]]
        tried = [(_reflection(axis), -1, axis) for axis in axes]
        tried += [*((_half_turn(axis), 1, axis) for axis in axes[:6]), (IDENTITY, 1, (0.0, 0.0, 0.0))]
        best, most = Image(IDENTITY, (0.0, 0.0, 0.0), 1), -1.0
        for matrix, sign, normal in tried:
            offsets = [sub(right, times(matrix, left)) for left, right in points]
            offset = tuple(sorted(each[axis] for each in offsets)[len(offsets) // 2] for axis in range(3))
            along = dot(offset, normal)  # a reflection shifts along its normal, a turn across its axis
            offset = tuple(along * x for x in normal) if sign < 0 else add(offset, normal, -along)
            fit = sum(norm(sub(each, offset)) <= near for each in offsets) / len(points)
            if fit > most + (0.15 if sign > 0 and best.sign < 0 else 1e-9):
                best, most = Image(matrix, offset, sign), fit
        return best


def _reflection(axis: Vector) -> Vector:
    return tuple((i == j) - 2 * axis[i] * axis[j] for i in range(3) for j in range(3))


def _half_turn(axis: Vector) -> Vector:
    return tuple(2 * axis[i] * axis[j] - (i == j) for i in range(3) for j in range(3))
