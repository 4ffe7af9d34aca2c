"""The servos of a keyframe are told to go elsewhere than where it puts the joints.

A `<key>` with `qpos` and no `ctrl`, or with a `ctrl` in another order: at the first step the robot leaves the pose.

Bad:

    <mujoco>
      <worldbody>
        <body name="upper" pos="0 0 1">
          <joint name="shoulder" axis="0 1 0" range="-90 90" damping="1" armature="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          <body name="lower" pos="0.3 0 0">
            <joint name="elbow" axis="0 1 0" range="0 120" damping="1" armature="0.1"/>
            <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <position name="shoulder" joint="shoulder" kp="50" kv="5"/>
        <position name="elbow" joint="elbow" kp="50" kv="5"/>
      </actuator>
      <keyframe>
        <key name="home" qpos="0.8 1.2"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0.8 1.2"/>
    +     <key name="home" qpos="0.8 1.2" ctrl="0.8 1.2"/>

The number: how far three quarters of the position servos are at most from their joints, in rad or m; above 0.1 it is a
cause, for keyframes in which at least two servos and half of them are off by that. Where there is no `ctrl`, two
servos that go 0.5 away are told in a hint. Two that are each told the other's place are told as such. Joints outside of
their ranges do not count: their places are wrong, which another rule tells. Winches that hold what moves freely count
as servos of joints; another servo on a tendon, a gripper's, is told where it goes more than half of the tendon's way.
Where the `ctrl` is that of another keyframe, which fits its own pose, and not zero, two servos that go elsewhere are
told in a hint. Of five actuators with a state and more the one whose `act` is not its `ctrl`, as it is of all others,
is told in a hint.

When it is wrong: a keyframe that is meant to start a motion.
Whether `ctrl` is left out on purpose, only its author knows: all zero and no `ctrl` is a hint.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.probes import tendons
from clinic.diagnosis.probes.key import beyond, farthest_target, off_target, reordered, servos, start_at
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect, how_many, rounded

TITLE = "A keyframe's targets are not its pose"
FAMILIES = ("drifts", "jumps-at-start", "sags", "stuck")
LEVEL = "cause"
UNPLANTED = "no healthy model has a keyframe with controls"

LIMIT, FAR = 0.1, 0.5  # rad or m
WAY = 0.5  # of a tendon's
STATES, SAME = 5, 1e-6


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes whose `ctrl` holds another pose than their `qpos`."""
    of = model.simulation
    for key in range(of.count("key")):
        yield from _tendons(model, key)
        yield from _states(model, key)
        if reordered(model, key):
            continue
        outside = beyond(of, key)
        found = {each: at for each, at in servos(of, key).items() if of.driven_joint(each) not in outside}
        off = [actuator for actuator, (target, at) in found.items() if abs(target - at) > LIMIT]
        element = model.element("key", key)
        left_out = element is not None and "ctrl" not in element.attributes
        if element is not None and len(off) == 2 and _exchanged(found, *off):
            yield _swap(model, key, element, found, off)
            continue
        if element is not None and len(off) > 1 and (other := _fitting(of, key)) is not None:
            yield _borrowed(model, key, element, found, off, other)
            continue
        far = [actuator for actuator in off if abs(found[actuator][0] - found[actuator][1]) > FAR]
        if (
            not (len(off) >= max(2, 0.5 * len(found)) or (left_out and len(far) > 1))
            or element is None
            or len(element.get("qpos").split()) != len(of.model("qpos0"))
        ):
            continue
        most = len(off) >= max(2, 0.5 * len(found))
        ctrl = list(of.data("ctrl"))
        for actuator, (_, at) in found.items():
            ctrl[actuator] = _holding(of, actuator, at)
        worst = max(off, key=lambda actuator: abs(found[actuator][0] - found[actuator][1]))
        target, at = found[worst]
        yield Suspect(
            (of.name("key", key),),
            "ctrl",
            element.get("ctrl") or "left out",
            written(ctrl),
            (set_attribute(element, "ctrl", written(ctrl)),),
            off_target(key) if most else farthest_target(key),
            LIMIT if most else FAR,
            f"{len(off)} of {len(found)} servos go away: {of.name('actuator', worst)} from {at:.3g} to {target:.3g}.",
            "the targets of a pose are its joints' positions",
            level="hint" if left_out else "cause",
        )


def _exchanged(found: Mapping[int, tuple[float, float]], one: int, other: int) -> bool:
    """Whether each of two servos is told to go where the other one's joint is."""
    return all(abs(found[a][0] - found[b][1]) < LIMIT / 2 for a, b in ((one, other), (other, one)))


def _holding(of: Simulation, actuator: int, at: float) -> float:
    """The control with which a servo stays where its joint is."""
    offset, slope = of.bias(actuator)[:2]
    return (at * of.gear(actuator) * -slope - offset) / of.gain(actuator)[0]


def _swap(
    model: ReaderModel, key: int, element: Element, found: Mapping[int, tuple[float, float]], off: Sequence[int]
) -> Suspect:
    """The two targets that stand in each other's place."""
    of = model.simulation
    start_at(of, key)
    ctrl = list(of.data("ctrl"))
    for actuator in off:
        ctrl[actuator] = _holding(of, actuator, found[actuator][1])
    edits, names = (set_attribute(element, "ctrl", written(ctrl)),), tuple(of.name("actuator", each) for each in off)
    says = f"{names[0]} and {names[1]} are told to go where the other one's joint is."
    healthy = "the targets of a pose are its joints' positions"
    now, value = element.get("ctrl"), written(ctrl)
    return Suspect((of.name("key", key), *names), "ctrl", now, value, edits, farthest_target(key), LIMIT, says, healthy)


def _fitting(of: Simulation, key: int) -> int | None:
    """Another keyframe that has the same `ctrl`, not all zero, and whose pose this fits in all servos."""
    width, own = of.count("actuator"), of.row("key_ctrl", key, of.count("actuator"))
    for other in range(of.count("key")) if any(own) else ():
        fits = other != key and of.row("key_ctrl", other, width) == own
        if fits and all(abs(target - at) < LIMIT for target, at in servos(of, other).values()):
            return other
    return None


def _borrowed(
    model: ReaderModel,
    key: int,
    element: Element,
    found: Mapping[int, tuple[float, float]],
    off: Sequence[int],
    other: int,
) -> Suspect:
    """The targets that were taken over from another keyframe."""
    of = model.simulation
    start_at(of, key)
    ctrl = list(of.data("ctrl"))
    for actuator in off:
        ctrl[actuator] = _holding(of, actuator, found[actuator][1])
    edits, value = (set_attribute(element, "ctrl", written(ctrl)),), written(ctrl)
    says = f"Its controls are those of {of.name('key', other)}, which fit the pose of that; of its own "
    says += f"{len(off)} of {len(found)} servos go away."
    now, healthy = element.get("ctrl"), "the targets of a pose are its joints' positions"
    probe = farthest_target(key)
    return Suspect(
        (of.name("key", key),), "ctrl", now, value, edits, probe, LIMIT, says, healthy, share=0.99, level="hint"
    )


def _states(model: ReaderModel, key: int) -> Iterator[Suspect]:
    """The one actuator whose state in a keyframe is not its control, where it is of all others."""
    of, element = model.simulation, model.element("key", key)
    if element is None or not element.get("act") or not element.get("ctrl") or len(off := _unlike(of, key)) != 1:
        return
    start_at(of, key)
    (actuator,), acts = off, list(of.data("act"))
    place, ctrl = int(of.model("actuator_actadr")[actuator]), of.data("ctrl")[actuator]
    now, acts[place] = acts[place], ctrl
    says = f"{of.name('actuator', actuator)} begins at {now:g} and is told {ctrl:g}; of all others the two are equal."
    probe = how_many("actuators whose state is not their control", _unlike, key)
    names, edits = (of.name("key", key), of.name("actuator", actuator)), (set_attribute(element, "act", written(acts)),)
    yield Suspect(names, "act", f"{now:g}", f"{ctrl:g}", edits, probe, 0, says, "its control", level="hint")


def _unlike(of: Simulation, key: int) -> list[int]:
    """The actuators whose state is not their control, of five and more that have one."""
    start_at(of, key)
    places, acts, ctrl = of.model("actuator_actadr"), of.data("act"), of.data("ctrl")
    having = [actuator for actuator, place in enumerate(places) if place >= 0]
    off = [each for each in having if abs(acts[int(places[each])] - ctrl[each]) > SAME]
    return off if len(having) >= STATES else []


def _tendons(model: ReaderModel, key: int) -> Iterator[Suspect]:
    """Servos on tendons, such as a gripper's, that a keyframe with `ctrl` tells to go most of their way."""
    of, element = model.simulation, model.element("key", key)
    if element is None or not element.get("ctrl"):
        return
    for actuator in range(of.count("actuator")):
        if _away(of, key, actuator) <= WAY:
            continue
        offset, scale = tendons.servo(of, actuator) or (0.0, 1.0)
        tendon = int(of.model("actuator_trnid")[2 * actuator])
        start_at(of, key)
        ctrl, length = list(of.data("ctrl")), of.data("ten_length")[tendon]
        now, held = f"{ctrl[actuator]:g}", rounded((length - offset) / scale)
        ctrl[actuator] = float(held)
        says = f"{of.name('actuator', actuator)} pulls {of.name('tendon', tendon)} from {length:.3g} to "
        says += f"{offset + scale * float(now):.3g}; a control of {held} would hold it."
        probe = Probe("way that a servo goes from the keyframe", "of the tendon's way", _away, (key, actuator), False)
        edits, names = (
            (set_attribute(element, "ctrl", written(ctrl)),),
            (of.name("key", key), of.name("actuator", actuator)),
        )
        yield Suspect(names, "ctrl", now, held, edits, probe, WAY, says, "the tendon's length", level="hint")


def _away(of: Simulation, key: int, actuator: int) -> float:
    """How far a servo's tendon is from its target in a keyframe, as a share of the way that it has."""
    line = tendons.servo(of, actuator)
    tendon = int(of.model("actuator_trnid")[2 * actuator])
    way = tendons.reach(of, tendon) if line else None
    if line is None or way is None or way[1] <= way[0]:
        return 0.0
    start_at(of, key)
    return abs(line[0] + line[1] * of.data("ctrl")[actuator] - of.data("ten_length")[tendon]) / (way[1] - way[0])
