"""A spring hangs at its stop: what rests on it is too heavy for it.

A suspension works in the middle of its travel. With `stiffness` ten times too small, or a body ten times too heavy, the
slide comes down on its limit, and every bump goes through to the chassis.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="chassis" pos="0 0 0.3">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.03" mass="4"/>
          <body name="wheel" pos="0 0 -0.1">
            <joint name="spring" type="slide" axis="0 0 1" stiffness="500" damping="60" range="-0.03 0.03"/>
            <geom type="box" size="0.2 0.1 0.05" mass="0.5"/>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -         <joint name="spring" type="slide" axis="0 0 1" stiffness="500" damping="60" range="-0.03 0.03"/>
    +         <joint name="spring" type="slide" axis="0 0 1" stiffness="5000" damping="60" range="-0.03 0.03"/>

The number: two seconds after the model was let go, how far a slide that has a spring, and no actuator but motors, is
from where the spring is at rest, as a share of the way to its limit; above 0.75, and where it stands still. A stiffness
in N/mm is told where 1000 times as much lets it go 0.05 to 0.6 of the way. Or `springref` has the wrong sign, or is the
limit itself: the load moves the slide by 0.3 of half its range, and with the other sign, or with 0 where its range
leaves that out, by a third of that at most. A hinge that begins at its stop, such as a door's handle, is told alike
where the load takes it 1.4 times as far as its spring: its spring is to press it to that stop, and lets it hang.

When it is wrong: a button, a pedal or a landing gear that is meant to be pressed down.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.run import let_go
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "A spring that hangs at its stop"
FAMILIES = ("sags", "sinks", "stuck")
UNPLANTED = "healthy models have few slides with springs"

MOST, USUAL, LITTLE, STILL = 0.75, 0.3, 0.05, 0.05  # of the way to the limit; m/s
LEAVES, BACK = 0.3, 0.35  # of half of the range; of that, with the other sign
AT_STOP, FURTHER = 0.02, 1.4  # of the range; of the way to the spring's rest
GROUPS = 6  # of hinges with one rest, that are tried
ROUNDS = 4  # for the load on a spring at its stop shows only once the stop does not bear it


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The slides whose springs what rests on them presses to their limits, all together."""
    of = model.simulation
    if (turned := _other_sign(model)) is not None:
        yield turned
        return
    pressed = {joint: share for joint in _springs(of) if (share := _pressed(of, joint)) > MOST}
    if not pressed:
        return
    worst = max(pressed, key=lambda joint: pressed[joint])
    stiffness, percent, share = of.model("jnt_stiffness")[worst], 100 * pressed[worst], pressed[worst]
    probe = Probe("share of the way to its limit at which a spring rests", "", _most, tuple(pressed))
    value, edits = f"{stiffness:g}", tuple[Edit, ...]()
    in_mm = model.set("joint", tuple(pressed), "stiffness", f"{1000 * stiffness:g}")
    if LITTLE < model.measured(probe, in_mm) < 2 * USUAL:
        value, edits = f"{1000 * stiffness:g}", in_mm
    for _ in range(0 if edits else ROUNDS):
        value = rounded(float(value) * share / USUAL)
        edits = model.set("joint", tuple(pressed), "stiffness", value)
        share = model.measured(probe, edits)
        if share < 2 * USUAL:
            break
    yield Suspect(
        tuple(of.name("joint", joint) for joint in sorted(pressed, key=lambda joint: -pressed[joint])),
        "stiffness",
        f"{stiffness:g}",
        value,
        edits,
        probe,
        MOST,
        f"{of.name('joint', worst)} stands at {percent:.0f} % of the way from its spring's rest to its limit.",
        "near the middle of the travel",
    )


def _other_sign(model: ReaderModel) -> Suspect | None:
    """Springs with a rest of their own that the load moves far from the start, and with the other sign does not."""
    of = model.simulation
    alike: dict[tuple[int, float], list[int]] = {}
    for joint in (*_springs(of), *_levers(of)):
        alike.setdefault((of.joint_type(joint), of.model("qpos_spring")[of.place(joint)]), []).append(joint)
    for (kind, rest), joints in alike.items():
        probe = Probe("share of its travel by which a spring gives way to the load", "", _leaves, tuple(joints))
        within = all(low <= -rest <= high for low, high in (of.ranges[each] for each in joints))
        turned, unit = (-rest, model.angle_unit) if kind == HINGE else (-rest if within else 0.0, 1.0)
        value = f"{turned / unit:.4g}"
        edits = model.set("joint", joints, "springref", value) if rest else ()
        loose = model.set("joint", joints, "stiffness", "0")  # the load moves it, and not the spring
        if not edits or model.measured(probe, loose) <= LEAVES:
            continue
        if kind == HINGE and model.measured(probe) < FURTHER * max(_rests(of, each) for each in joints):
            continue
        if (before := model.measured(probe)) > LEAVES and model.measured(probe, edits) <= BACK * before:
            names = tuple(of.name("joint", joint) for joint in joints)
            now = f"{rest / unit:.4g}"
            says = f"{names[0]} has springref {now}, on the side to which the load pushes it."
            return Suspect(names, "springref", now, value, edits, probe, LEAVES, says, "next to nothing")
    return None


def _rests(of: Simulation, joint: int) -> float:
    """How far from the start a spring is at rest, over half of the range."""
    low, high = of.row("jnt_range", joint, 2)
    rest, begin = (of.model(field)[of.place(joint)] for field in ("qpos_spring", "qpos0"))
    return 2 * abs(rest - begin) / (high - low)


def _leaves(of: Simulation, *joints: int) -> float:
    """How far the slides come to rest from the start, over half of their range; 0 where one moves."""
    end, made = let_go(of).end, 0.0
    for joint in joints:
        low, high = of.row("jnt_range", joint, 2)
        if end is None or abs(end.qvel[of.dof(joint)]) > STILL:
            return 0.0
        made = max(made, 2 * abs(end.qpos[of.place(joint)] - of.model("qpos0")[of.place(joint)]) / (high - low))
    return made


def _springs(of: Simulation) -> list[int]:
    """The slides that have a spring and a range and no actuator that acts by itself."""
    slides = [joint for joint in of.ranges if of.joint_type(joint) == SLIDE]
    return [joint for joint in slides if of.model("jnt_stiffness")[joint] > 0 and not _held(of, joint)]


def _levers(of: Simulation) -> list[int]:
    """The hinges that begin at a stop, with a spring at rest within the range; none where they are many of a kind."""
    made = []
    for joint, (low, high) in of.ranges.items():
        if of.joint_type(joint) != HINGE or of.model("jnt_stiffness")[joint] <= 0 or _held(of, joint):
            continue
        rest, begin = (of.model(field)[of.place(joint)] for field in ("qpos_spring", "qpos0"))
        least = AT_STOP * (high - low)
        if min(begin - low, high - begin) < least < abs(rest - begin) and low < rest < high:
            made.append(joint)
    return made if len({of.model("qpos_spring")[of.place(joint)] for joint in made}) <= GROUPS else []


def _held(of: Simulation, joint: int) -> bool:
    """Whether an actuator acts on a joint when nobody commands it: all but a motor do, and it gives nothing."""
    of.begin()
    return any(any(of.bias(each)[:3]) or of.data("ctrl")[each] for each in of.drivers.get(joint, ()))


def _pressed(of: Simulation, joint: int) -> float:
    """The share of the way from the spring's rest to the limit; 0 where it moves, or rests outside or at that limit."""
    end, place = let_go(of).end, of.place(joint)
    low, high = of.row("jnt_range", joint, 2)
    rest = of.model("qpos_spring")[place]
    if end is None or not low <= rest <= high or abs(end.qvel[of.dof(joint)]) > STILL:
        return 0.0
    off = end.qpos[place] - rest
    way = high - rest if off > 0 else low - rest
    return off / way if way else 0.0


def _most(of: Simulation, *joints: int) -> float:
    return max(_pressed(of, joint) for joint in joints)
