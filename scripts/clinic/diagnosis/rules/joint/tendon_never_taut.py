"""A rope whose limit is longer than it ever gets.

A spatial tendon without a spring, an actuator or damping holds by its `range` alone. Where that allows more than the
length at which something else stops the load, such as the floor, the rope does nothing.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <site name="hook" pos="0 0 2"/>
        <body name="load" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1" mass="1"/>
          <site name="eye" pos="0 0 0.1"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope" limited="true" range="0 5">
          <site site="hook"/>
          <site site="eye"/>
        </spatial>
      </tendon>
    </mujoco>

Good:

    -     <spatial name="rope" limited="true" range="0 5">
    +     <spatial name="rope" limited="true" range="0 0.95">

The number: the greatest length in 2 s after letting go, as a share of the upper limit: below 0.95 it never holds. Told
where a rope grows by more than 10 % in that time, and all of the model's ropes hang slack. So is a
rope with a `range` whose two ends are equal, which is none, and no other force.

When it is wrong: a leash that is to hold later, and hangs slack until then.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.tendons import joints_of, pulled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation, kept
from clinic.diagnosis.suspect import Probe, Suspect, counted

TITLE = "A rope that never gets taut"
FAMILIES = ("falls-through", "drifts", "sensor-reads-zero", "stuck")
UNPLANTED = "no healthy model hangs anything on a rope"

SLACK, GROWN = 1 / 0.95, 1.1
SAMPLES = 50


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The ropes of a model, where none of them holds what falls, and those that are no limit at all."""
    of = model.simulation
    yield from _without_limit(model)
    ropes = [tendon for tendon in range(of.count("tendon")) if _rope(of, tendon)]
    if not ropes or any(_slack(of, tendon) <= SLACK for tendon in ropes):
        return
    grown = [tendon for tendon in ropes if _longest(of)[tendon] > GROWN * of.model("tendon_length0")[tendon]]
    if not grown:
        return
    worst = grown[0]
    limit, length, most = of.row("tendon_range", worst, 2)[1], of.model("tendon_length0")[worst], _longest(of)[worst]
    says = f"It is {length:.3g} m long at the start and {most:.3g} m at most, and holds from {limit:g} m on."
    edits = model.set_each("tendon", "range", {each: _shortened(of, each) for each in grown})
    value = _shortened(of, worst)
    probe = Probe("upper limit over the greatest length", "", _slack, (worst,))
    names = tuple(of.name("tendon", tendon) for tendon in grown)
    now = f"{of.row('tendon_range', worst, 2)[0]:g} {limit:g}"
    yield Suspect(names, "range", now, value, edits, probe, SLACK, says, "no longer than the rope", level="hint")


def _shortened(of: Simulation, tendon: int) -> str:
    return f"{of.row('tendon_range', tendon, 2)[0]:g} {0.99 * of.model('tendon_length0')[tendon]:.3g}"


def _without_limit(model: ReaderModel) -> Iterator[Suspect]:
    """Ropes whose range has two equal ends, which MuJoCo takes for none."""
    of = model.simulation
    for tendon in range(of.count("tendon")):
        low, high = of.row("tendon_range", tendon, 2)
        if (
            low < high
            or of.model("tendon_limited")[tendon]
            or model.value("tendon", tendon, "range") is None
            or _acts(of, tendon)
        ):
            continue
        length = of.model("tendon_length0")[tendon]
        value = f"0 {length:.3g}"
        edits = model.set("tendon", [tendon], "range", value)
        says = f"A range from {low:g} to {high:g} is none, and nothing else acts on it: it holds nothing."
        probe = counted("ropes that hold nothing", 1)
        name, now = of.name("tendon", tendon), f"{low:g} {high:g}"
        yield Suspect((name,), "range", now, value, edits, probe, 0, says, "up to its length", level="hint")


def _acts(of: Simulation, tendon: int) -> bool:
    """Whether a spring, a damper, friction or an actuator acts on a tendon, or it is one of joints."""
    fixed = bool(joints_of(of, tendon))
    passive = any(of.model(f"tendon_{what}")[tendon] for what in ("stiffness", "damping", "frictionloss"))
    return fixed or passive or tendon in pulled(of).values()


def _rope(of: Simulation, tendon: int) -> bool:
    """Whether a tendon runs through space, and nothing acts on it but its limit."""
    limited = bool(of.model("tendon_limited")[tendon]) and of.row("tendon_range", tendon, 2)[1] > 0
    return limited and not _acts(of, tendon)


@kept
def _longest(of: Simulation) -> tuple[float, ...]:
    """The greatest length of each tendon in m after letting go."""
    of.begin()
    found = list(of.data("ten_length"))
    for _ in of.run(of.begin_with.duration, SAMPLES):
        found = [max(pair) for pair in zip(found, of.data("ten_length"), strict=True)]
    return tuple(found)


def _slack(of: Simulation, tendon: int) -> float:
    return of.row("tendon_range", tendon, 2)[1] / max(_longest(of)[tendon], 1e-9)
