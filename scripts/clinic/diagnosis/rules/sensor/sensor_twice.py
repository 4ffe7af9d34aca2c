"""Two sensors read the same thing.

A line is copied, its name is changed and what it reads is not, or its kind: the observation has one joint twice, and
another not at all.

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
        <jointpos name="shoulder_angle" joint="shoulder"/>
        <jointpos name="elbow_angle" joint="shoulder"/>
      </sensor>
    </mujoco>

Good:

    -     <jointpos name="elbow_angle" joint="shoulder"/>
    +     <jointpos name="elbow_angle" joint="elbow"/>

The number: how many sensors read what another one reads: written alike but for `name` and `user`. Where the name of one
has the name of something that no sensor of its kind reads, that is what is meant; else what is called like that which
both read, but for what sets their names apart: `toe_R` beside `toe_L`, which reads `L_toe`.

When it is wrong: one reading under two names, for two readers.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.copied import Line, misled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Two sensors that read the same"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
UNPLANTED = "one reading under two names may be meant"

KINDS = {"joint": "joint", "site": "site", "actuator": "actuator", "tendon": "tendon"}
FREE_OF_OBJECTS = ("user", "plugin", "clock", "e_potential", "e_kinetic")
ROW = ("type", "objtype", "objid", "reftype", "refid")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor that is written as one before it, with another name."""
    of, seen = model.simulation, dict[tuple[object, ...], int]()
    for sensor in range(of.count("sensor")):
        element = model.element("sensor", sensor)
        if element is None or element.tag in FREE_OF_OBJECTS:
            continue
        first = seen.setdefault(_written(element), sensor)
        if first == sensor:
            continue
        wrong, attribute, meant = _meant(model, (first, sensor))
        names = (of.name("sensor", wrong), of.name("sensor", first if wrong == sensor else sensor))
        kind, read = (attribute or "object"), element.get(attribute) or element.get("objname") or ""
        yield Suspect(
            names,
            attribute or "objname",
            read,
            meant or f"another {kind}, or another sensor than <{element.tag}>",
            model.set("sensor", [wrong], attribute, meant) if meant else (),
            Probe("whether two sensors read the same", "", _alike, (first, sensor), dynamic=False),
            0.5,
            f"{names[0]} and {names[1]} are both <{element.tag}>" + (f' of {kind} "{read}".' if read else "."),
            "each sensor reads something of its own",
        )


def _written(element: Element) -> tuple[object, ...]:
    """What an element says of what it reads."""
    return element.tag, *sorted(pair for pair in element.attributes.items() if pair[0] not in ("name", "user"))


def _alike(of: Simulation, one: int, other: int) -> float:
    rows = [tuple(of.model(f"sensor_{field}")[sensor] for field in ROW) for sensor in (one, other)]
    return float(rows[0] == rows[1])


def _meant(model: ReaderModel, sensors: tuple[int, int]) -> tuple[int, str, str]:
    """Which of two sensors is meant for something that none of its kind reads, by its name: it, by what, and that."""
    of, element = model.simulation, model.element("sensor", sensors[1])
    assert element is not None
    attribute = next((each for each in KINDS if element.get(each)), "")
    if not attribute:
        return sensors[1], "", ""
    same = [model.element("sensor", each) for each in range(of.count("sensor"))]
    read = {each.get(attribute) for each in same if each is not None and each.tag == element.tag}
    free = [each for each in of.names(KINDS[attribute]) if each and each not in read]
    for sensor in sensors[::-1]:
        name = of.names("sensor")[sensor].lower()
        found = [each for each in free if each.lower() in name]
        if len(found) == 1:
            return sensor, attribute, found[0]
    lines = {each: Line(element.get(attribute), (of.names("sensor")[each],)) for each in sensors}
    return next(((each, attribute, name) for each, name in misled(lines, free).items()), (sensors[1], attribute, ""))
