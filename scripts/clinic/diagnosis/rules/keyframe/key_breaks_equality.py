"""A keyframe does not keep what an equality holds together.

The start of the model keeps it, and a keyframe, which was set up by hand or saved from a run, does not: at its first
step the joints jump. The keyframe is wrong in a sign, or the equality: a lead in mm, or for a turn in place of a
radian; its two joints in each other's place; or the wrong joint.

Bad:

    <mujoco>
      <worldbody>
        <body name="nut" pos="0 0 1">
          <joint name="nut" axis="0 0 1" armature="0.02"/>
          <geom type="cylinder" size="0.03 0.02" mass="0.3"/>
        </body>
        <body name="quill" pos="0 0 1">
          <joint name="quill" type="slide" axis="0 0 1" range="-0.2 0.02"/>
          <geom type="cylinder" size="0.01 0.2" mass="0.5"/>
        </body>
      </worldbody>
      <equality>
        <joint joint1="quill" joint2="nut" polycoef="0 0.016 0 0 0"/>
      </equality>
      <keyframe>
        <key name="low" qpos="-31.4159 -0.08"/>
      </keyframe>
    </mujoco>

Good:

    -     <joint joint1="quill" joint2="nut" polycoef="0 0.016 0 0 0"/>
    +     <joint joint1="quill" joint2="nut" polycoef="0 0.00254648 0 0 0"/>

The number: how far a follower is from where its leader wants it at a keyframe, as a share of its range, or of its way
where that is more; 0.1 and more. Of a connection or a weld it is the gap, as a share of the model's extent; 0.02 and
more. The edit is the first of these that mends all keyframes: another leader, where the one that is written stands
still or several keyframes agree; the two joints exchanged; the signs of another coupling to the same leader, where the
follower's servo is told to be where the keyframe has it; the sign that a servo's control in the keyframe has; a factor
that is another by three times and more; and the follower put where it is led.

When it is wrong: a keyframe from which code switches the equality off.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import product

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.couplings import Coupling, couplings
from clinic.diagnosis.probes.equalities import CONNECT, WELD, by_mocap, gap, held, kind_of, sited
from clinic.diagnosis.probes.key import servos, start_at
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import ENDLESS, Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A keyframe that breaks an equality"
FAMILIES = ("jumps-at-start", "stuck", "explodes")
UNPLANTED = "few healthy models have a keyframe and a coupling"

COUPLING, GAP = 0.1, 0.02  # of the follower's range or way; of the model's extent
EXACT = 0.01  # of the follower's way
TIMES = 3.0  # as much another factor is one of another unit, and no sloppy pose
LEAST = 1e-3  # rad or m
Ways = tuple[float, float]  # of follower and leader


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each equality that keyframes break, with all of these."""
    of = model.simulation
    led = dict(couplings(of))
    for each, keys in broken(of).items():
        limit = COUPLING if each in led else GAP
        probe = Probe("worst keyframe off what an equality holds", "", _worst, (each,), dynamic=False)
        edits = mended(model, each) if each in led else ()
        names = [of.name("equality", each), *(of.name("key", key) for key in keys)]
        start_at(of, keys[0])
        if each in led:
            follower, leader = (of.name("joint", joint) for joint in held(of, each))
            own, wanted = _ways(of, keys[0], *held(of, each))
            says = f"{names[1]} puts {follower} {own:.4g} and {leader} {wanted:.4g} away from their start; "
            says += f"led it would be at {_led(led[each][2], wanted):.4g}."
            names += [follower, leader]
        else:
            parts = [of.name("site" if sited(of, each) else "body", it) for it in held(of, each)]
            says = f"At {names[1]} {parts[0]} and {parts[1]} are {1000 * (gap(of, each) or 0):.3g} mm apart."
            names += parts
        attribute, value = (edits[0].attribute, edits[0].value) if edits else ("qpos", "a pose that keeps it")
        if attribute == "qpos":
            names = [names[1], names[0], *names[2:]]
        element = model.element("key" if attribute == "qpos" else "equality", keys[0] if attribute == "qpos" else each)
        now = element.get(attribute) if element is not None else ""
        yield Suspect(tuple(names), attribute, now, value, edits, probe, limit, says, "0, as at the start", at=element)


@kept
def broken(of: Simulation) -> dict[int, list[int]]:
    """By equality that the model's own start keeps: the keyframes that do not."""
    made: dict[int, list[int]] = {}
    for each, active in enumerate(of.model("eq_active0") if of.count("key") else ()):
        limit = GAP if kind_of(of, each) in (CONNECT, WELD) else COUPLING
        if active and not by_mocap(of, each) and _off(of, each, -1) <= limit:
            keys = [key for key in range(of.count("key")) if _off(of, each, key) > limit]
            made |= {each: keys} if keys else {}
    return made


def elsewhere(model: ReaderModel, each: int) -> bool:
    """Whether keyframes say that a coupling is wrong, and how."""
    return each in broken(model.simulation) and any(edit.attribute != "qpos" for edit in mended(model, each))


def mended(model: ReaderModel, each: int) -> tuple[Edit, ...]:
    """The edits that let all keyframes keep a coupling, the likeliest first; none where there are none."""
    of = model.simulation
    keys, coupling = broken(of)[each], dict(couplings(of))[each]
    probe = Probe("worst keyframe off a coupling", "", _worst, (each,), dynamic=False)
    ways: Sequence[Callable[[], tuple[Edit, ...]]] = (
        lambda: _other_leader(model, each, coupling, keys),
        lambda: _exchanged(model, each, coupling, keys),
        lambda: _as_another(model, each, coupling, keys),
        lambda: _signs(model, coupling, keys),
        lambda: _other_factor(model, each, coupling, keys),
        lambda: _put(model, coupling[0], {key: _wanted(of, key, coupling) for key in keys}),
    )
    found = (edits for way in ways if (edits := way()) and model.measured(probe, edits) <= COUPLING)
    return next(found, ())


def _worst(of: Simulation, each: int) -> float:
    return max((_off(of, each, key) for key in range(of.count("key"))), default=0.0)


def _off(of: Simulation, each: int, key: int) -> float:
    """How far a keyframe, or the model's own start, is from what an equality holds."""
    if kind_of(of, each) in (CONNECT, WELD):
        start_at(of, key)
        return (gap(of, each) or 0.0) / of.extent
    if (coupling := dict(couplings(of)).get(each)) is None:
        return 0.0
    follower, leader, factors = coupling
    own, leading = _ways(of, key, follower, leader)
    led = _led(factors, leading)
    low, high = of.ranges.get(follower, (0.0, 0.0))
    return abs(own - led) / max(high - low, abs(own), abs(led)) if abs(own - led) > LEAST else 0.0


def _ways(of: Simulation, key: int, follower: int, leader: int) -> Ways:
    """How far two joints are from their start at a keyframe."""
    of.engine.reset(key)
    own, leading = (of.position(each) - of.model("qpos0")[of.place(each)] for each in (follower, leader))
    return own, leading


def _led(factors: Sequence[float], way: float) -> float:
    return sum(factor * way**power for power, factor in enumerate(factors))


def _wanted(of: Simulation, key: int, coupling: Coupling) -> float:
    """Where a follower is led at a keyframe."""
    follower, leader, factors = coupling
    return of.model("qpos0")[of.place(follower)] + _led(factors, _ways(of, key, follower, leader)[1])


def _keeps(of: Simulation, coupling: Coupling, keys: Sequence[int]) -> bool:
    """Whether keyframes keep a coupling nearly exactly, and one at least has its joints away from their start."""
    ways = [_ways(of, key, *coupling[:2]) for key in keys]
    exact = all(abs(own - _led(coupling[2], leading)) <= EXACT * abs(own) + LEAST * EXACT for own, leading in ways)
    return exact and any(own and leading for own, leading in ways)


def _other_leader(model: ReaderModel, each: int, coupling: Coupling, keys: Sequence[int]) -> tuple[Edit, ...]:
    of, (follower, leader, factors) = model.simulation, coupling
    if len(keys) < 2 and _ways(of, keys[0], follower, leader)[1]:
        return ()
    every = range(of.count("key"))
    led = {follower for _, (follower, _, _) in couplings(of)}
    free = [joint for joint in of.scalar_joints if joint not in led]
    found = [joint for joint in free if joint != leader and _keeps(of, (follower, joint, factors), every)]
    return model.set("equality", [each], "joint2", of.names("joint")[found[0]]) if len(found) == 1 else ()


def _exchanged(model: ReaderModel, each: int, coupling: Coupling, keys: Sequence[int]) -> tuple[Edit, ...]:
    of, (follower, leader, factors) = model.simulation, coupling
    if not _keeps(of, (leader, follower, factors), keys):
        return ()
    one, other = (of.names("joint")[joint] for joint in (leader, follower))
    return (*model.set("equality", [each], "joint1", one), *model.set("equality", [each], "joint2", other))


def _as_another(model: ReaderModel, each: int, coupling: Coupling, keys: Sequence[int]) -> tuple[Edit, ...]:
    """The polynomial of a coupling of the same leader that differs in signs, where keyframes and servos agree on it."""
    of, every = model.simulation, range(model.simulation.count("key"))
    told = [
        pair for key in keys for actuator, pair in servos(of, key).items() if of.driven_joint(actuator) == coupling[0]
    ]
    if not any(at and abs(target - at) <= EXACT * abs(at) for target, at in told):
        return ()
    others = {other[2] for number, other in couplings(of) if other[1] == coupling[1] and number not in broken(of)}
    alike = [other for other in others if all(map(math.isclose, map(abs, other), map(abs, coupling[2])))]
    fits = [other for other in alike if _keeps(of, (*coupling[:2], other), every)]
    return model.set("equality", [each], "polycoef", written(fits[0])) if len(fits) == 1 else ()


def _signs(model: ReaderModel, coupling: Coupling, keys: Sequence[int]) -> tuple[Edit, ...]:
    """The keyframe's number of a joint whose servo is told the same with the other sign."""
    of = model.simulation
    made: dict[int, dict[int, float]] = {}
    for key, joint in product(keys, coupling[:2]):
        for actuator, (target, at) in servos(of, key).items():
            if of.driven_joint(actuator) == joint and at and abs(target + at) <= EXACT * abs(at):
                made.setdefault(joint, {})[key] = target
    return _put(model, *next(iter(made.items()))) if len(made) == 1 else ()


def _other_factor(model: ReaderModel, each: int, coupling: Coupling, keys: Sequence[int]) -> tuple[Edit, ...]:
    """The factor that the keyframes have, where it is another by far, or of the other sign in all of several."""
    of, (follower, leader, factors) = model.simulation, coupling
    ways = [_ways(of, key, follower, leader) for key in keys]
    away = all(_away(of, joint, way) for pair in ways for joint, way in zip((follower, leader), pair, strict=True))
    if factors[0] or any(factors[2:]) or not away:
        return ()
    shares = [own / leading for own, leading in ways]
    times = abs(shares[0] / factors[1]) if factors[1] else 0.0
    alike = all(abs(share - shares[0]) <= EXACT * abs(shares[0]) for share in shares)
    if not alike or (1 / TIMES < times < TIMES and not (len(keys) > 1 and shares[0] * factors[1] < 0)):
        return ()
    return model.set("equality", [each], "polycoef", written([0.0, shares[0], 0.0, 0.0, 0.0]))


def _away(of: Simulation, joint: int, way: float) -> bool:
    """Whether a joint is so far from its start that the keyframe means it: by a tenth of its range."""
    low, high = of.row("jnt_range", joint, 2)
    return abs(way) > (COUPLING * (high - low) if joint in of.ranges else LEAST)


def _put(model: ReaderModel, joint: int, places: dict[int, float]) -> tuple[Edit, ...]:
    """Edits that put a joint elsewhere in keyframes; none where its range leaves that out."""
    of, made = model.simulation, list[Edit]()
    low, high = of.ranges.get(joint, ENDLESS)
    for key, place in places.items():
        element = model.element("key", key)
        numbers = element.get("qpos").split() if element is not None else []
        inside = low - LEAST <= place <= high + LEAST
        if element is None or not inside or len(numbers) != len(of.model("qpos0")):
            return ()
        numbers[of.place(joint)] = written([place])
        made.append(set_attribute(element, "qpos", " ".join(numbers)))
    return tuple(made)
