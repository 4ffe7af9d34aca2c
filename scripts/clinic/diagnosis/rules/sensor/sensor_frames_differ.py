"""A place and a velocity of one thing are measured in two frames.

`ball_vel` is measured in the plate, and `ball_pos` lost its `refname`: it is measured in the world, so that the one is
not the rate of the other, and a controller that takes both steers by mixed numbers.

Bad:

    <mujoco>
      <worldbody>
        <body name="plate" pos="0 0 1">
          <joint axis="0 1 0"/>
          <geom type="box" size="0.2 0.2 0.01"/>
          <site name="middle"/>
        </body>
        <body name="ball" pos="0 0 1.05">
          <freejoint/>
          <geom size="0.02"/>
        </body>
      </worldbody>
      <sensor>
        <framepos name="ball_pos" objtype="body" objname="ball"/>
        <framelinvel name="ball_vel" objtype="body" objname="ball" reftype="site" refname="middle"/>
      </sensor>
    </mujoco>

Good:

    -     <framepos name="ball_pos" objtype="body" objname="ball"/>
    +     <framepos name="ball_pos" objtype="body" objname="ball" reftype="site" refname="middle"/>

The number: how many pairs of a `<framepos>` and a `<framelinvel>`, or a `<framequat>` and a `<frameangvel>`, of one
object are called alike but for the word of what they measure, and only one of them has a reference. Of 62 healthy
models with such sensors none has one.

When it is wrong: a place on the map, beside a velocity along the robot's own axes; or a reference that stands still and
is not turned.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A place and a velocity in two frames"
FAMILIES = ("wrong-numbers", "drifts")
LEVEL = "hint"
UNPLANTED = "few healthy models measure one frame in another"

RATES = {"framelinvel": "framepos", "frameangvel": "framequat"}
WHAT = re.compile(r"pos(?:ition)?|place|quat(?:ernion)?|ori(?:entation)?|rot(?:ation)?|(?:lin|ang)?vel(?:ocity)?|rate")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The sensor of each such pair that has no reference."""
    found = list(_pairs(model))
    for bare, other in found:
        name, reference = bare.get("name"), other.get("refname")
        edits = tuple(set_attribute(bare, each, other.get(each)) for each in ("reftype", "refname"))
        says = (
            f'"{other.get("name")}" of the same {bare.get("objtype")} is measured in "{reference}", this in the world.'
        )
        probe = counted("sensors of a place and of its rate in two frames", len(found))
        said = (f'sensor "{name}"',)
        yield Suspect(said, "refname", "left out", reference, edits, probe, 0, says, "one frame", level="hint", at=bare)


def _pairs(model: ReaderModel) -> Iterator[tuple[Element, Element]]:
    """The sensor without a reference and the one with it, of a place and of its rate that are called alike."""
    sensors = list(model.source.section("sensor")) if model.source else []
    for rate in sensors:
        of = [each for each in sensors if each.tag == RATES.get(rate.tag) and _read(each) == _read(rate)]
        alike = [each for each in of if _stem(each) == _stem(rate)]
        if len(alike) == 1 and bool(alike[0].get("refname")) != bool(rate.get("refname")):
            yield (rate, alike[0]) if alike[0].get("refname") else (alike[0], rate)


def _read(sensor: Element) -> tuple[str, str]:
    return sensor.get("objtype"), sensor.get("objname")


def _stem(sensor: Element) -> str:
    """A sensor's name without the words of what it measures; its own type where it has none."""
    words = re.findall(r"[a-z]+|\d+", sensor.get("name").lower())
    left = [word for word in words if not WHAT.fullmatch(word)]
    return " ".join(left) if len(left) < len(words) else sensor.tag
