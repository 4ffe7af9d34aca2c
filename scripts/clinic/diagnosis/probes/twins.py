"""What of a pair, left and right, is unlike where it should be the other's mirror image."""

from __future__ import annotations

import math
from dataclasses import replace

from clinic.diagnosis.probes.comparison import Comparison, Comparisons
from clinic.diagnosis.probes.pairs import SYMMETRIC
from clinic.diagnosis.probes.same_part import copies, one_mesh
from clinic.diagnosis.simulation import Simulation, kept

EXACT, EXACT_MASS, PAIRS = 1.0, 4.0, 5  # %, %, and how many pairs there must be
PLACED = {"pos", "center of mass", "inertia", "axis", "axis sign", "range", "ctrlrange", "quat", "direction"}


class Twins(Comparisons):
    """The pairs of a model, and their quantities compared.

    Attributes:
        mirrored: The comparisons with mirror images.
        comparisons: The same without those that differ in what is one part used twice.
    """

    def __init__(self, simulation: Simulation) -> None:
        super().__init__(simulation)
        self.copies = copies(self)
        found = (each for each in self.compared() if math.isfinite(each.unlike) and not self._untold(each))
        self.mirrored = self._sharpened([*found])
        odd = {self.bodies(each)[0] for each in self.mirrored if each.odd and each.kind in ("body", "joint", "camera")}
        self.comparisons = [each for each in self.mirrored if not each.odd or not self._used_twice(each, odd)]

    def group(self, each: Comparison) -> int:
        """The body that both sides of a comparison hang on; -1 for actuators and sensors."""
        if each.kind in ("actuator", "sensor"):
            return -1
        return self.common[each.left if each.kind == "body" else self.of.body_of(each.kind, each.left)]

    def bodies(self, each: Comparison) -> tuple[int, int]:
        """The bodies that a comparison is of; those of the joints that actuators drive."""
        pair = (each.left, each.right)
        if each.kind == "actuator":
            left, right = (self.of.driven_joint(one) for one in pair)
            pair = (-1 if left is None else left, -1 if right is None else right)
        if each.kind in ("body", "sensor") or -1 in pair:
            return pair
        kind = "joint" if each.kind == "actuator" else each.kind
        return self.of.body_of(kind, pair[0]), self.of.body_of(kind, pair[1])

    def _used_twice(self, each: Comparison, odd: set[int]) -> bool:
        """Whether a pair is one part used twice, or of a chain that is a copy, as two odd bodies of it show."""
        top = self.copies.get(self.bodies(each)[0])
        part = each.quantity in ("center of mass", "inertia") and one_mesh(self.of, each.left, each.right)
        placed = (each.kind, each.quantity, each.left) == ("body", "pos", top)
        return part or (top is not None and not placed and sum(self.copies.get(body) == top for body in odd) > 1)

    def trusted(self, group: int, compared: list[Comparison]) -> bool:
        """Whether what hangs on a body on both sides is the other's image but for little."""
        fits = next((self.share[left] for left, body in self.common.items() if body == group), 1.0)
        return fits >= SYMMETRIC and sum(each.odd for each in compared) <= max(2, 0.2 * len(compared))

    def _untold(self, each: Comparison) -> bool:
        """Whether it is of where something is, and of fingers that the hands have on the same side."""
        body = self.bodies(each)[0]
        return each.quantity in PLACED and body in self.crossed and self.images[body].sign < 0

    @staticmethod
    def _sharpened(found: list[Comparison]) -> list[Comparison]:
        """Ranges and masses are held to more where all pairs of a model but few nearly have the same."""
        exact = {}
        for of, most, few in (
            (("joint", "range"), EXACT, 1),
            (("actuator", "ctrlrange"), EXACT, 1),
            (("body", "mass"), EXACT_MASS, 2),
        ):
            unlike = sorted(each.unlike for each in found if (each.kind, each.quantity) == of)
            if len(unlike) >= PAIRS + few - 1 and unlike[-1 - few] < EXACT / 2:
                exact[of] = most
        return [replace(each, limit=exact.get((each.kind, each.quantity), each.limit)) for each in found]


@kept
def twins(simulation: Simulation) -> Twins:
    """The pairs of a model."""
    return Twins(simulation)


def range_of_image(simulation: Simulation, joint: int) -> tuple[float, float] | None:
    """The range that a joint would have as the image of its twin; None where it has that, or no twin."""
    found = twins(simulation)
    for each in found.comparisons:
        if each.odd and (each.kind, each.quantity) == ("joint", "range") and joint in (each.left, each.right):
            low, high = simulation.row("jnt_range", each.left + each.right - joint, 2)
            return (low, high) if found.interval_sign(each) > 0 else (-high, -low)
    return None
