"""A keyframe has more numbers than the model has positions, speeds, controls or activations.

A free object in front of the robot takes the first seven places of `qpos`; a joint more or fewer changes them all.
A `qpos` that is too short is filled up in silence from the model's own start, `qpos0`; one that is too long is refused.

Bad:

    <mujoco>
      <worldbody>
        <body name="arm" pos="0 0 1">
          <joint name="elbow" axis="0 1 0" damping="1"/>
          <geom name="link" type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0.5 0 0"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0.5 0 0"/>
    +     <key name="home" qpos="0.5"/>

The number: MuJoCo's message has both counts. The numbers that are left over are cut; where they are
the seven of a free joint that no body has, the joint is put in.

When it is wrong: which numbers are superfluous only the author knows; look at what was removed from the model.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, insert, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.errors._message import mends, sentence
from clinic.diagnosis.source import Element, Source
from clinic.diagnosis.suspect import Suspect

TITLE = "A keyframe of the wrong size"
FAMILIES = ("will-not-compile",)

FREE, UNIT = 7, 0.02  # numbers of a free joint; how far from 1 the quaternion's length may be
MESSAGE = re.compile(r"key(?:frame)? '?([^':]*)'?: invalid (\w+) size, expected (?:length )?(\d+)")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All keys that have more numbers than fit, cut; where none has, those that have fewer, filled with zeros."""
    found = MESSAGE.match(sentence(model))
    if not found or model.source is None:
        return
    which, attribute, size = found.groups()
    keys = [key for key in model.source.section("keyframe") if len(key.get(attribute).split()) != int(size)]
    keys = [key for key in keys if attribute in key.attributes]
    keys = [key for key in keys if len(key.get(attribute).split()) > int(size)] or keys
    named = [key for key in keys if key.get("name") == which] or keys
    if not named:
        return
    if attribute == "qpos":
        yield from _free(model.source, named[0], int(size))
    edits: list[Edit] = []
    for key in keys:
        numbers = key.get(attribute).split()
        fitted = (numbers + ["0"] * int(size))[: int(size)]
        edits.append(set_attribute(key, attribute, " ".join(fitted)))
    count = len(named[0].get(attribute).split())
    says = f"Numbers in {attribute}: {size} in the model, {count} in the key: {sentence(model)}."
    edits.sort(key=lambda each: each.line != named[0].line)
    wanted = f"{size} number{'s' * (size != '1')}"
    yield mends(named[0], edits, says, attribute=attribute, now=f"{count} numbers", value=wanted)


def _free(source: Source, key: Element, size: int) -> Iterator[Suspect]:
    """The root's free joint, where a key begins with its seven numbers and no body has one."""
    numbers = key.get("qpos").split()
    bodies = [each for world in source.elements("worldbody") for each in world.children if each.tag == "body"]
    trees = [each for each in bodies if any(one.tag == "joint" for one in each.walk())]
    free = any(each.tag == "freejoint" or each.get("type") == "free" for body in bodies for each in body.walk())
    if len(numbers) - size != FREE or len(trees) != 1 or free or source.direct(trees[0], "joint"):
        return
    turn = [float(each) for each in numbers[3:FREE]]
    if abs(sum(each * each for each in turn) - 1) < UNIT:
        says = f"The key has {FREE} numbers more than the model, and begins with a place and a quaternion of length 1."
        edits = (insert(trees[0], "<freejoint/>"),)
        yield mends(trees[0], edits, says, attribute="freejoint", now="left out", value="<freejoint/>")
