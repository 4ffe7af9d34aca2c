"""An actuator pulls another tendon than its name says.

A line was copied from finger to finger, or from muscle to muscle, and one keeps the tendon of the one before. That
tendon is pulled twice, and its own hangs loose. Or a motor pulls one of two springs, an anti-roll bar, and the tendon
of its shaft does nothing.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="index" axis="0 1 0" range="0 90" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01"/>
        </body>
        <body pos="0 0.05 1">
          <joint name="ring" axis="0 1 0" range="0 90" damping="0.1"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01"/>
        </body>
      </worldbody>
      <tendon>
        <fixed name="index_pull">
          <joint joint="index" coef="1"/>
        </fixed>
        <fixed name="ring_pull">
          <joint joint="ring" coef="1"/>
        </fixed>
      </tendon>
      <actuator>
        <motor name="index_curl" tendon="index_pull" ctrlrange="0 1"/>
        <motor name="ring_curl" tendon="index_pull" ctrlrange="0 1"/>
      </actuator>
    </mujoco>

Good:

    -     <motor name="ring_curl" tendon="index_pull" ctrlrange="0 1"/>
    +     <motor name="ring_curl" tendon="ring_pull" ctrlrange="0 1"/>

The number: actuators on a tendon that another one pulls as well, where one tendon is pulled by none and has a word of
the actuator's name that its own has not, or is called like its own but for what sets the two actuators apart, or is the
twin on the other side of the tendon that the actuator's twin pulls. And the one actuator on a tendon with a stiffness,
beside others that have one and no actuator, where one fixed tendon alone has neither an actuator nor stiffness,
damping, limit or equality.

When it is wrong: two actuators on one tendon, beside a tendon that only limits.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from clinic.diagnosis.probes import equalities
from clinic.diagnosis.probes.copied import Line, misled
from clinic.diagnosis.probes.equalities import TIED
from clinic.diagnosis.probes.sides import sided
from clinic.diagnosis.probes.tendons import joints_of, pulled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "An actuator pulls another tendon than its name says"
FAMILIES = ("stuck", "drifts", "sags")
UNPLANTED = "few healthy models have actuators on tendons"

ACTS = ("stiffness", "damping", "frictionloss", "limited")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each actuator that leaves the tendon of its name alone."""
    of = model.simulation
    for actuator, (wrong, meant) in _misled(of).items():
        now, value = (of.names("tendon")[each] for each in (wrong, meant))
        edits = model.set("actuator", [actuator], "tendon", value)
        name = of.name("actuator", actuator)
        shared = "as another one does" if list(pulled(of).values()).count(wrong) > 1 else "a spring"
        says = f"{name} pulls {of.name('tendon', wrong)}, {shared}, and {of.name('tendon', meant)} is pulled by none."
        probe = how_many("actuators that pull another tendon than that of their name", _misled)
        yield Suspect((name,), "tendon", now, value, edits, probe, 0, says, "the tendon of its name")


def _misled(of: Simulation) -> dict[int, tuple[int, int]]:
    """By actuator: the tendon that it pulls, and the one that it is called like."""
    pulls = pulled(of)
    times, words = Counter(pulls.values()), [_words(name) for name in of.names("tendon")]
    idle = [tendon for tendon in range(of.count("tendon")) if tendon not in times]
    names, tendons = of.names("actuator"), of.names("tendon")
    lines = {each: Line(tendons[tendon], (names[each],)) for each, tendon in pulls.items()}
    copied = misled(lines, [tendons[each] for each in idle])
    made = {each: (pulls[each], tendons.index(name)) for each, name in copied.items()}
    for actuator, tendon in pulls.items():
        own = _words(names[actuator]) - words[tendon]
        meant = [each for each in idle if any(_called(word, own) for word in words[each])]
        if times[tendon] > 1 and len(meant) == 1:
            made[actuator] = (tendon, meant[0])
    return made | _unlike_its_twin(of, pulls) | _on_a_spring(of, pulls)


def _unlike_its_twin(of: Simulation, pulls: dict[int, int]) -> dict[int, tuple[int, int]]:
    """The actuators on a tendon that another pulls, where none pulls the twin of their own twin's tendon."""
    made, times = {}, Counter(pulls.values())
    actuators, tendons = sided(of, "actuator"), sided(of, "tendon")
    for actuator, tendon in pulls.items():
        _, twin = actuators.get(actuator, ("", -1))
        _, meant = tendons.get(pulls.get(twin, -1), ("", -1))
        if times[tendon] > 1 and meant >= 0 and meant not in times:
            made[actuator] = (tendon, meant)
    return made


def _on_a_spring(of: Simulation, pulls: dict[int, int]) -> dict[int, tuple[int, int]]:
    """The one actuator on a spring, beside springs that none pulls, where one fixed tendon alone does nothing."""
    tied = [each for each, kind in enumerate(of.model("eq_type")) if int(kind) == TIED]
    used = {*pulls.values(), *(tendon for each in tied for tendon in equalities.held(of, each))}
    fixed = [tendon for tendon in range(of.count("tendon")) if joints_of(of, tendon) and tendon not in used]
    idle = [tendon for tendon in fixed if not any(of.model(f"tendon_{field}")[tendon] for field in ACTS)]
    springs = [tendon for tendon, stiffness in enumerate(of.model("tendon_stiffness")) if stiffness > 0]
    on_spring = {actuator: tendon for actuator, tendon in pulls.items() if tendon in springs}
    if len(idle) != 1 or len(on_spring) != 1 or len(springs) < 2:
        return {}
    return {actuator: (tendon, idle[0]) for actuator, tendon in on_spring.items()}


def _called(word: str, own: set[str]) -> bool:
    """Whether a tendon's word is one of an actuator's, or begins with one: `ext` pulls `extensor`."""
    return word in own or any(len(each) > 2 and word.startswith(each) for each in own)


def _words(name: str) -> set[str]:
    return set(re.findall(r"[a-z]+\d*|\d+", re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()))
