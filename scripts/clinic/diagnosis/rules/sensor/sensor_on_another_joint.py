"""A sensor reads another joint, site or body than its name says.

A block of sensors was copied, and one has the new name and the old joint: `elbow_pos` reads the shoulder.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="shoulder" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
          <body pos="0.3 0 0">
            <joint name="elbow" axis="0 1 0"/>
            <geom type="capsule" fromto="0.05 0 0 0.3 0 0" size="0.03"/>
          </body>
        </body>
      </worldbody>
      <sensor>
        <jointpos name="elbow_pos" joint="shoulder"/>
      </sensor>
    </mujoco>

Good:

    -     <jointpos name="elbow_pos" joint="shoulder"/>
    +     <jointpos name="elbow_pos" joint="elbow"/>

The number: how many sensors of a joint, site or body bear the name of another one, and not of their own; of a body, the
name of a site that it has; of a reference, beside a word of what is measured in it. And those of three and more called
alike, `boom_stroke` and `stick_stroke`, that read what all others do not, `boom_barrel` beside `stick_rod`, where
`boom_rod` is there. A sensor `boom_stroke` of a joint `boom_cylinder` is left alone, though a hinge is called `boom`.
Of 568 healthy models none has one of a joint.

When it is wrong: a sensor that is called after a place, where a joint has the same name.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from clinic.diagnosis.probes.attached import OBJECTS
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A sensor reads another part than its name says"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
UNPLANTED = "only a name says what a sensor is for"

KINDS = ("body", "joint", "site")
SISTERS = 3


class Meant(NamedTuple):
    """What a sensor reads as its `objname` or `refname`, and the name, maybe of another kind, that it bears."""

    end: str
    kind: str
    read: str
    meant: str
    other_kind: str = ""


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor that has the name of something else than what it reads, or in which it reads."""
    of = model.simulation
    for sensor, found in _misnamed(of).items():
        probe = Probe("whether a sensor reads another part than its name says", "", _wrong, (sensor,), dynamic=False)
        name, element, kind = of.name("sensor", sensor), model.element("sensor", sensor), found.other_kind or found.kind
        attribute = found.end if element is not None and element.get(found.end) else found.kind
        edits = model.set("sensor", [sensor], attribute, found.meant)
        if found.other_kind:
            edits += model.set("sensor", [sensor], "objtype", kind)
        does = "reads" if found.end == "objname" else "measures in"
        says = f'{name} {does} {found.kind} "{found.read}", and bears the name of {kind} "{found.meant}".'
        if not _within(found.meant, of.names("sensor")[sensor]):
            says = f'{name} reads {found.kind} "{found.read}"; its sisters read what is called like "{found.meant}".'
        healthy = f"the {kind} of its name"
        yield Suspect((name,), attribute, found.read, found.meant, edits, probe, 0.5, says, healthy, level="hint")


def _wrong(of: Simulation, sensor: int) -> float:
    return float(sensor in _misnamed(of))


def _misnamed(of: Simulation) -> dict[int, Meant]:
    """By sensor: what it bears the name of, where that is not what it reads; or what its sisters say that it reads."""
    made = _unlike_sisters(of)
    for sensor, name in enumerate(of.names("sensor")):
        kind, index = _end(of, sensor, "obj")
        reference, at = _end(of, sensor, "ref")
        other = of.names(reference)[at] if reference else ""
        own = of.names(kind)[index] if kind else ""
        if (meant := _named(of, name, kind, index)) and meant != other:
            made[sensor] = Meant("objname", kind, own, meant)
        elif kind == "body" and (meant := _site_of(of, name, index)):
            made[sensor] = Meant("objname", kind, own, meant, other_kind="site")
        elif (meant := _named(of, name, reference, at)) and _beside(of, name, meant, kind, index):
            made[sensor] = Meant("refname", reference, other, meant)
    return made


def _end(of: Simulation, sensor: int, end: str) -> tuple[str, int]:
    """The kind and number of what a sensor reads, or reads in; an empty kind for none, and for others than these."""
    kind = OBJECTS.get(int(of.model(f"sensor_{end}type")[sensor]), "")
    return kind if kind in KINDS else "", int(of.model(f"sensor_{end}id")[sensor])


def _named(of: Simulation, sensor: str, kind: str, index: int) -> str:
    """The one name of a kind that a sensor's has in it, where it has not that of its own as well; else empty.

    A joint whose name has it, as `boom_cylinder` has `boom`, may be meant.
    """
    names = of.names(kind) if kind and sensor else []
    own = names[index] if names else ""
    if not own or _within(own, sensor) or (kind == "site" and _within(_holder(of, index), sensor)):
        return ""
    meant = _longest(sensor, names)
    return "" if kind == "joint" and _within(meant, own) else meant


def _longest(sensor: str, names: list[str]) -> str:
    """The longest of the names that a sensor's has in it; empty for none, or two."""
    found = [name for name in names if name and _within(name, sensor)]
    found = [name for name in found if len(name) == max(map(len, found))]
    return found[0] if len(found) == 1 else ""


def _site_of(of: Simulation, sensor: str, body: int) -> str:
    """The site of a body that a sensor of the body is called after, and not after the body; else empty."""
    sites = [name for site, name in enumerate(of.names("site")) if of.body_of("site", site) == body]
    own = of.names("body")[body]
    return "" if not own or set(_words(own)) & set(_words(sensor)) else _longest(sensor, sites)


def _beside(of: Simulation, sensor: str, meant: str, kind: str, index: int) -> bool:
    """Whether a sensor's name has a word of what it reads beside another name, as `cube_in_palm` has."""
    if not kind:
        return False
    own = {*_words(of.names(kind)[index]), *(_words(_holder(of, index)) if kind == "site" else ())}
    return bool(own & set(_words(sensor)) - set(_words(meant))) and not own & set(_words(meant))


def _unlike_sisters(of: Simulation) -> dict[int, Meant]:
    """The one of three sensors and more called alike that reads another thing than all others do, by its name."""
    alike: dict[tuple[float, str, str], list[tuple[int, str, str]]] = {}
    for sensor, name in enumerate(of.names("sensor")):
        kind, index = _end(of, sensor, "obj")
        word, _, rest = name.partition("_")
        read = of.names(kind)[index] if kind else ""
        if rest and read.startswith(f"{word}_"):
            key = (of.model("sensor_type")[sensor], kind, rest)
            alike.setdefault(key, []).append((sensor, word, read.removeprefix(word)))
    made = {}
    for (_, kind, _), some in alike.items():
        usual, times = Counter(tail for *_, tail in some).most_common(1)[0]
        odd = [each for each in some if each[2] != usual]
        if len(some) >= SISTERS and times == len(some) - 1 and odd[0][1] + usual in of.names(kind):
            sensor, word, tail = odd[0]
            made[sensor] = Meant("objname", kind, word + tail, word + usual)
    return made


def _holder(of: Simulation, site: int) -> str:
    """The name of the body of a site."""
    return of.names("body")[of.body_of("site", site)]


def _words(name: str) -> list[str]:
    return re.findall(r"[a-z0-9]+", name.lower())


def _within(part: str, sensor: str) -> bool:
    """Whether a sensor's name has that of a part in it, as whole words."""
    return part.lower() in sensor.lower() and bool(
        re.search(rf"(?<![a-z0-9]){re.escape(part.lower())}(?![a-z0-9])", sensor.lower())
    )
