"""An actuator takes seconds to let a control through: by its filter, or by its own damping.

`dyntype="filter"` and `filterexact` smooth the control with the time constant `dynprm`, which is 1 s where nobody wrote
it; `timeconst` of `<position>` and `<velocity>` is the same, and that of `<cylinder>` is 1 s, too. The robot follows
what it was told a second ago. A muscle has two of them, `0.01 0.04`; written in milliseconds they are 10 s and 40 s. A
servo with as much `kv` as `kp` lags by a second as well: their quotient is a time constant.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="0.5" armature="0.01"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="0.3"/>
        </body>
      </worldbody>
      <actuator>
        <general joint="elbow" gainprm="20" biastype="affine" biasprm="0 -20 -1" dyntype="filter"/>
      </actuator>
    </mujoco>

Good:

    -     <general joint="elbow" gainprm="20" biastype="affine" biasprm="0 -20 -1" dyntype="filter"/>
    +     <general joint="elbow" gainprm="20" biastype="affine" biasprm="0 -20 -1" dyntype="filter" dynprm="0.02"/>

The number: the greatest time constant of the actuators with a filter, and of muscles; 0.5 s and more is told. Of servos
kv over kp, from 0.6 s on, unless the weight moves one of them by a tenth of its way: then kp is too small.

When it is wrong: a heater, a pump, or another actuator that is as slow as that.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.engine import DYN_FILTER, DYN_FILTEREXACT, DYN_MUSCLE
from clinic.diagnosis.probes.load import sags, travel
from clinic.diagnosis.probes.servo import affine, servos
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect, rounded

TITLE = "An actuator that lags by a second"
FAMILIES = ("slow", "oscillates")
UNPLANTED = "few healthy models have actuators with a filter"

FILTERS, SLOW = (DYN_FILTER, DYN_FILTEREXACT), 0.5  # s
LATE, PROMPT = 0.6, 0.2  # s: the quotient that is told, and that an edit leaves
SAGS = 0.1  # of a joint's way
USUAL = {True: "0.01 0.04", False: "0.02"}  # of a muscle, of others


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The actuators with a slow filter, all together."""
    of = model.simulation
    yield from _damped(model)
    slow = {each: time for each, time in _times(of).items() if time >= SLOW}
    if not slow:
        return
    worst = max(slow, key=lambda each: slow[each])
    where = {each: _attribute(model, each) for each in slow}
    attribute, edits = where[worst], tuple[Edit, ...]()
    for name, muscle in sorted({(where[each], _muscle(of, each)) for each in slow}):
        some = [each for each in slow if (where[each], _muscle(of, each)) == (name, muscle)]
        edits += model.set("actuator", some, name, USUAL[muscle])
    now, value = model.value("actuator", worst, attribute) or "left out", USUAL[_muscle(of, worst)]
    says = f"{slow[worst]:.3g} s after its control changes, {of.name('actuator', worst)} gives 63 % of the change."
    if _muscle(of, worst):
        says = f"The longer time constant of {of.name('actuator', worst)} is {slow[worst]:.3g} s."
    probe = Probe("greatest time constant of an actuator's filter", "s", _slowest, dynamic=False)
    names = tuple(of.name("actuator", each) for each in slow)
    yield Suspect(names, attribute, now, value, edits, probe, SLOW - 1e-6, says, "0.01 to 0.1 s", level="hint")


def _damped(model: ReaderModel) -> Iterator[Suspect]:
    """Servos that are slow by their own damping, all together."""
    of = model.simulation
    times = {each: time for each in range(of.count("actuator")) if (time := _lag(of, each)) >= LATE}
    if not times or _weak(of, times):
        return
    worst = max(times, key=lambda each: times[each])
    kv = -of.bias(worst)[2]
    says = (
        f"Its kv over its kp is {times[worst]:.2g} s: in that time {of.name('actuator', worst)} goes 63 % of the way."
    )
    names = tuple(of.name("actuator", each) for each in times)
    probe = Probe("kv over kp", "s", _lag, (worst,), dynamic=False)
    value = rounded(kv * PROMPT / times[worst])
    healthy = "0.5 s is the most of 55 healthy models with servos"
    yield Suspect(names, "kv", f"{kv:.3g}", value, (), probe, LATE - 1e-6, says, healthy)


def _weak(of: Simulation, actuators: Collection[int]) -> bool:
    """Whether the weight moves the joint of one of some servos far off: then kp is too small, and not kv too large."""
    far = {each.actuator: SAGS * travel(each) for each in servos(of)}
    return any(sags(of).get(each, 0.0) > far.get(each, math.inf) for each in actuators)


def _lag(of: Simulation, actuator: int) -> float:
    """kv over kp of a position servo in s; 0 of another actuator."""
    bias, plain = of.bias(actuator), affine(of, actuator) and not of.model("actuator_dyntype")[actuator]
    return bias[2] / bias[1] if plain and bias[1] < 0 and of.gain(actuator)[0] else 0.0


def _attribute(model: ReaderModel, actuator: int) -> str:
    """Where the time constant of an actuator is written; only `<general>` has `dynprm`."""
    element = model.element("actuator", actuator)
    return "dynprm" if element is None or element.tag == "general" else "timeconst"


def _muscle(of: Simulation, actuator: int) -> bool:
    return int(of.model("actuator_dyntype")[actuator]) == DYN_MUSCLE


def _times(of: Simulation) -> dict[int, float]:
    """The time constants of the actuators with a filter in s; of a muscle the longer of its two."""
    count = of.count("actuator")
    width = len(of.model("actuator_dynprm")) // max(1, count)
    kinds = [int(kind) for kind in of.model("actuator_dyntype")]
    rows = {i: of.row("actuator_dynprm", i, width) for i in range(count) if kinds[i] in (*FILTERS, DYN_MUSCLE)}
    return {i: max(row[: 2 if kinds[i] == DYN_MUSCLE else 1]) for i, row in rows.items()}


def _slowest(of: Simulation) -> float:
    return max(_times(of).values(), default=0.0)
