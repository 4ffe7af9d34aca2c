"""An actuator drives another joint than the one that it is named after.

A name that was copied and not changed: the joint that was meant is never driven, and the other gets two commands. Or
two that were swapped: each moves what the other should.

Bad:

    <mujoco>
      <worldbody>
        <body pos="0 0 1">
          <joint name="left_hip" axis="0 1 0" damping="0.5"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02" mass="1"/>
        </body>
        <body pos="0 0.3 1">
          <joint name="right_hip" axis="0 1 0" damping="0.5"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.02" mass="1"/>
        </body>
      </worldbody>
      <actuator>
        <position name="left_hip" joint="left_hip" kp="50"/>
        <position name="right_hip" joint="left_hip" kp="50"/>
      </actuator>
    </mujoco>

Good:

    -     <position name="right_hip" joint="left_hip" kp="50"/>
    +     <position name="right_hip" joint="right_hip" kp="50"/>

The number: how many actuators drive another joint than the one that they are named after, where no actuator drives that
one, or only one that is named after the other. Of `v1` to `v3`, which are called alike and drive `q1` to `q3`, two
whose numbers are each other's.

When it is wrong: an actuator that drives another joint than the one of its name on purpose.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from clinic.diagnosis.probes.shape import root_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "An actuator drives another joint than its name says"
FAMILIES = ("stuck", "drifts", "sags")

LONG = 4  # letters
NUMBERED = re.compile(r"(\D*)(\d+)(\D*)")
LEAST = 3  # of one name and a number
WORDS = ("actuator", "act", "motor", "servo", "joint", "ctrl", "pos", "position", "torque", "a", "m", "j", "t")


def _key(name: str) -> tuple[str, ...]:
    """The words of a name without those that only say what it is."""
    words = name.lower().replace("-", "_").replace("/", "_").replace(".", "_").replace(":", "_").split("_")
    return tuple(each for each in words if each and each not in WORDS)


def _meant(simulation: Simulation) -> dict[int, tuple[int, int]]:
    """For an actuator: the joint that it drives, and that of its name, where these differ.

    The joint of its name is undriven, or driven by one that has the name of this one's joint.
    """
    joints: dict[tuple[str, ...], list[int]] = {}
    for joint, name in enumerate(simulation.names("joint")):
        if name and joint in simulation.scalar_joints:
            joints.setdefault(_key(name), []).append(joint)
    drives = {each: simulation.driven_joint(each) for each in range(simulation.count("actuator"))}
    owner, bodies = root_of(simulation), simulation.model("jnt_bodyid")
    made, undriven = {}, set(range(simulation.count("joint"))) - set(drives.values())
    for actuator, name in enumerate(simulation.names("actuator")):
        key, driven = _key(name), drives[actuator]
        found = joints.get(key) or _within(joints, key, undriven)
        if not found and driven is not None:
            found = [each for each in _longer(joints, key) if owner[int(bodies[each])] == owner[int(bodies[driven])]]
        if key and len(found) == 1 and driven not in (None, found[0]):
            made[actuator] = (driven, found[0])
    made |= _by_number(simulation, drives)
    wrong = {meant: driven for driven, meant in made.values()}
    return {
        each: (driven, meant)
        for each, (driven, meant) in made.items()
        if wrong.get(driven) == meant or (meant in undriven and not _named_too(simulation, each, driven))
    }


def _by_number(of: Simulation, drives: Mapping[int, int | None]) -> dict[int, tuple[int, int]]:
    """Two of several numbered actuators that drive the joint of each other's number, as `_meant` has them."""
    rows: dict[tuple[str, ...], dict[str, tuple[int, str, int]]] = {}
    for actuator, joint in drives.items():
        if joint is None:
            continue
        own = NUMBERED.fullmatch(of.names("actuator")[actuator])
        other = NUMBERED.fullmatch(of.names("joint")[joint])
        if own and other:
            rows.setdefault((own[1], own[3], other[1], other[3]), {})[own[2]] = (actuator, other[2], joint)
    made = dict[int, tuple[int, int]]()
    for row in rows.values():
        odd = [number for number, (_, driven, _) in row.items() if number != driven]
        if len(row) >= LEAST and len(odd) == 2 and {row[each][1] for each in odd} == {*odd}:
            one, two = (row[each] for each in odd)
            made |= {one[0]: (one[2], two[2]), two[0]: (two[2], one[2])}
    return made


def _named_too(simulation: Simulation, actuator: int, joint: int) -> bool:
    """Whether a joint bears the name of an actuator and more: `boom_cylinder` of `boom`, which moves hinge `boom`."""
    name, own = _key(simulation.names("actuator")[actuator]), _key(simulation.names("joint")[joint])
    return len(own) > len(name) == sum(each in own for each in name) and not own[-1].isdigit()


def _within(joints: Mapping[tuple[str, ...], list[int]], key: tuple[str, ...], undriven: set[int]) -> list[int]:
    """The driven joints that have all words of an actuator's name, and more."""
    words = set(key)
    within = [each for others, some in joints.items() if words.issubset(others) for each in some]
    return [each for each in within if each not in undriven]


def _longer(joints: Mapping[tuple[str, ...], list[int]], key: tuple[str, ...]) -> list[int]:
    """The joints whose one word begins with that of an actuator: `slide` drives `slider`."""
    return [each for words, some in joints.items() if len(words) == len(key) == 1 and len(key[0]) >= LONG
            and words[0].startswith(key[0]) for each in some]  # fmt: skip


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Actuators that leave the joint of their name alone, each by itself; two that are swapped together."""
    simulation = model.simulation
    found = _meant(simulation)
    for actuator, (driven, meant) in found.items():
        name = simulation.names("joint")[meant]
        other = next((each for each, pair in found.items() if pair == (meant, driven)), None)
        edits = model.set("actuator", [actuator], "joint", name)
        if other is not None:
            edits += model.set("actuator", [other], "joint", simulation.names("joint")[driven])
            if other < actuator:
                continue
        yield Suspect(
            (simulation.name("actuator", actuator),),
            "joint",
            simulation.names("joint")[driven],
            name,
            edits,
            how_many("actuators that drive another joint than that of their name", _meant),
            0.5,
            f"{simulation.name('actuator', actuator)} drives {simulation.name('joint', driven)}, and "
            f"{simulation.name('joint', meant)} is driven by "
            + ("none." if other is None else f"{simulation.name('actuator', other)}."),
            "an actuator drives the joint of its name",
            share=0.99,
        )
