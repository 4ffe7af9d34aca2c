"""The control ranges of all servos are their joints' ranges, but for one.

Somebody mended the range of a joint and not that of its servo, or the other way round. The servo then stops short of
what the joint can reach, or presses it against its limit.

Bad:

    <mujoco>
      <default>
        <joint axis="0 0 1" damping="1" armature="0.1"/>
      </default>
      <worldbody>
        <body pos="0 0 1">
          <joint name="a" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
          <body pos="0.2 0 0">
            <joint name="b" range="-120 120"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
            <body pos="0.2 0 0">
              <joint name="c" range="-60 60"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
              <body pos="0.2 0 0">
                <joint name="d" range="-100 100"/>
                <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
      <actuator>
        <position joint="a" kp="20" kv="2" ctrlrange="-1.5708 1.5708"/>
        <position joint="b" kp="20" kv="2" ctrlrange="-2.0944 2.0944"/>
        <position joint="c" kp="20" kv="2" ctrlrange="-1.0472 0.7"/>
        <position joint="d" kp="20" kv="2" ctrlrange="-1.7453 1.7453"/>
      </actuator>
    </mujoco>

Good:

    -     <position joint="c" kp="20" kv="2" ctrlrange="-1.0472 0.7"/>
    +     <position joint="c" kp="20" kv="2" ctrlrange="-1.0472 1.0472"/>

The number: the share of the joint's range by which the two differ. Three servos at least, and two in three of all, have
both alike to 1 %; one or two differ by 3 to 90 %, each in its own way: what is written twice alike is meant. Where the
twin of the joint has the range of the targets, or its siblings have, it is the joint's range that is the odd one.

When it is wrong: a servo that is kept away from a limit on purpose. Only intent knows which of the two is right:
a hint.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.servo import Servo, greatest, servos
from clinic.diagnosis.probes.siblings import LIKE, odd_ones
from clinic.diagnosis.probes.twins import range_of_image, twins
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "One control range is not the joint's"
FAMILIES = ("stuck", "passes-limit")
LEVEL = "hint"

ALIKE, UNLIKE, FAR, FEW = 0.01, 0.03, 0.9, 2


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Servos whose control range is not their joint's, where those of most others are."""
    found = [(each, _apart(each)) for each in servos(model.simulation) if each.targets and each.range]
    alike = [each for each, unlike in found if unlike < ALIKE]
    odd = [each for each, unlike in found if UNLIKE < unlike < FAR]
    if len(alike) < max(3, 2 / 3 * len(found)) or len(odd) > FEW:
        return
    ends = [_ends(each) for each in odd]
    for each in odd if len(set(ends)) == len(ends) else ():
        assert each.targets is not None
        assert each.range is not None
        (low, high), (least, most) = each.targets, each.range
        says = (
            f"Targets from {low:.3g} to {high:.3g} {each.unit} for {model.simulation.name('joint', each.joint)}, whose "
            f"range is {least:.3g} to {most:.3g}; of {len(alike)} other servos the two are alike."
        )
        probe = Probe(
            "control range and joint range differ by", "of the range", _unlike, (each.actuator,), dynamic=False
        )
        names = model.simulation.name("actuator", each.actuator), model.simulation.name("joint", each.joint)
        told = "ctrlrange", f"{low:.4g} {high:.4g}", f"{least:.4g} {most:.4g}"
        if (like := ranged_like(model.simulation, each)) is not None:
            told = "range", told[2], told[1]
            names = names[::-1]
            says += f" {model.simulation.name('joint', like)} has the range of the targets."
        yield Suspect(names, *told, (), probe, UNLIKE, says, 'inheritrange="1"', level="hint")


def ranged_like(of: Simulation, servo: Servo) -> int | None:
    """The twin of a servo's joint, or a sibling where all others agree, that has the range of the targets.

    A twin that the joint mirrors has not: there the targets were copied from side to side.
    """
    odd = (each.siblings[0] for each in odd_ones(of, "joint", 2 * LIKE)
           if (each.attribute, each.index) == ("range", servo.joint))  # fmt: skip
    others = twins(of).partner("joint", servo.joint), next(odd, None)
    own = of.row("jnt_range", servo.joint, 2)
    ranges = {each: of.row("jnt_range", each, 2) for each in others if each is not None and servo.targets}
    same = (each for each, wide in ranges.items() if _same(wide, servo.targets or (0, 0)))
    return next((each for each in same if not _same((-ranges[each][1], -ranges[each][0]), (own[0], own[1]))), None)


def of_image(of: Simulation, servo: Servo) -> bool:
    """Whether the targets are the range that the joint would have as its twin's image, and has not."""
    wanted = range_of_image(of, servo.joint)
    return wanted is not None and servo.targets is not None and _same(wanted, servo.targets)


def _same(one: tuple[float, ...], other: tuple[float, float]) -> bool:
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) < ALIKE * max(other[1] - other[0], 1e-9)


def _ends(servo: Servo) -> tuple[tuple[float, ...], ...]:
    """Control range and range, the same for its mirror image."""
    return tuple(tuple(sorted(round(abs(end), 6) for end in pair or ())) for pair in (servo.ctrl, servo.range))


def _apart(servo: Servo) -> float:
    assert servo.targets is not None
    assert servo.range is not None
    pairs = zip(servo.targets, servo.range, strict=True)
    return max(abs(a - b) for a, b in pairs) / max(servo.range[1] - servo.range[0], 1e-9)


def _unlike(simulation: Simulation, actuator: int) -> float:
    return greatest(simulation, _apart, [actuator])
