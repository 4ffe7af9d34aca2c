"""Two links of a mechanism run into each other within the range of the joint between them.

MuJoCo lets a body pass through its parent, but not through its grandparent. A link that hits it at some angle of its
range stops there, and its servo presses on.

Bad:

    <mujoco>
      <worldbody>
        <body name="trunk" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1"/>
          <body name="hip" pos="0 0.15 0">
            <joint axis="0 1 0" range="-20 20"/>
            <geom size="0.03"/>
            <body name="thigh">
              <joint name="swing" axis="1 0 0" range="-120 60"/>
              <geom type="capsule" fromto="0 0 -0.06 0 0 -0.3" size="0.03"/>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    -           <joint name="swing" axis="1 0 0" range="-120 60"/>
    +           <joint name="swing" axis="1 0 0" range="0 60"/>

The number: the share of 21 poses over the range, the other joints at their start, in which a body overlaps its
grandparent by more than a tenth of the thinner one, or a parent that is fixed to the world by 0.1 mm; told from half
on: arms of humanoids may reach their own trunk in 40 %. It must be so too with the other joints anywhere in their
ranges: the last link of an arm may lie in its forearm at 0 of the wrist, and nowhere else.

Where the same range about the opposite axis is free, the axis has the wrong sign, and is told in its place.

When it is wrong: links that may well touch. Only intent knows whether range, geom or a missing `<exclude>` is at fault:
a hint.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from clinic.diagnosis.probes.load import poses
from clinic.diagnosis.probes.shape import thickness
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Links that jam within the range"
FAMILIES = ("stuck",)
UNPLANTED = "a wider range is harm by itself, whether links jam in it or not"

POSES, LINKS, DEEP, JAMMED, FREE = 21, 2, 0.1, 0.5, 0.06
TOUCHES = 1e-4  # m
MOST = 60  # joints


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The pair of links that jams most, and the joint that brings them together."""
    of = model.simulation
    if not of.ranges or len(of.ranges) > MOST:
        return
    shares = {joint: found for joint in of.ranges if (found := _jams(of, joint))}
    jammed: list[tuple[float, int, int, int]] = []
    for joint, pairs in shares.items():
        (one, other), share = max(pairs.items(), key=lambda each: each[1])
        if JAMMED < share < 1 and _jams(of, joint, poses(of)).get((one, other), 0.0) > JAMMED:
            names, says = _told(of, share, joint, one, other)
            probe = Probe("share of the range in which two links jam", "", _share, (joint,), dynamic=False)
            axis = of.row("jnt_axis", joint, 3)
            turned = model.set("joint", [joint], "axis", written(tuple(-x for x in axis)))
            if turned and model.measured(probe, turned) < FREE:
                says += " About the opposite axis it is free."
                now, value = written(axis), written(tuple(-x for x in axis))
                yield Suspect(names, "axis", now, value, turned, probe, FREE, says, "the axis reversed", level="hint")
                continue
            jammed.append((share, joint, one, other))
    if jammed:
        worst, *others = sorted(jammed, reverse=True)
        names, says = _told(of, *worst)
        names += tuple(of.name("joint", joint) for _, joint, _, _ in others)
        says += f" So it is with {len(others)} more joint{'s' * (len(others) > 1)}." if others else ""
        joints = tuple(joint for _, joint, _, _ in jammed)
        probe = Probe("share of the range in which two links jam", "", _share, joints, dynamic=False)
        yield Suspect(names, "range", "", "", (), probe, JAMMED, says, "an <exclude>, or a smaller range")


def _told(of: Simulation, share: float, joint: int, one: int, other: int) -> tuple[tuple[str, ...], str]:
    """The joint and the two bodies that jam, and a sentence of it."""
    names = of.name("joint", joint), of.name("body", one), of.name("body", other)
    return names, f"In {100 * share:.0f} % of its range {names[1]} is inside of {names[2]}, which stops it."


def _share(simulation: Simulation, *joints: int) -> float:
    return max((share for joint in joints for share in _jams(simulation, joint).values()), default=0.0)


def _jams(simulation: Simulation, joint: int, others: Sequence[list[float]] = ()) -> dict[tuple[int, int], float]:
    """The share of a joint's range in which two near relatives jam, for each pair that it moves against each other.

    The other joints are at their start, or as in one of `others` after the other.
    """
    place, body = simulation.place(joint), simulation.body_of("joint", joint)
    low, high = simulation.row("jnt_range", joint, 2)
    bodies = simulation.model("geom_bodyid")
    made: dict[tuple[int, int], float] = {}
    simulation.begin(forward=False)
    for pose in range(POSES):
        if others:
            simulation.engine.write("qpos", others[pose % len(others)])
        simulation.engine.write("qpos", [low + (high - low) * pose / (POSES - 1)], place)
        simulation.engine.forward()
        deep = set()
        for contact in simulation.engine.contacts():
            if min(contact.geoms) < 0:
                continue
            one, other = sorted((int(bodies[geom]) for geom in contact.geoms), reverse=True)
            base = other == simulation.parent(one)  # a contact of these two: the parent stands still
            thin = min(thickness(simulation, geom) for geom in contact.geoms)
            if -contact.distance > (TOUCHES if base else DEEP * thin) and _between(simulation, body, one, other):
                deep.add((one, other))
        for pair in deep:
            made[pair] = made.get(pair, 0.0) + 1 / POSES
    return made


def _between(simulation: Simulation, body: int, one: int, other: int) -> bool:
    """Whether a joint's body carries one of two bodies that are at most LINKS apart in one line, and not the other."""
    line = [one]
    while line[-1] and line[-1] != other:
        line.append(simulation.parent(line[-1]))
    return line[-1] == other != 0 and len(line) <= LINKS + 1 and body in line[:-1]
