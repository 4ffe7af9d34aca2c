"""A robot that lives in a plane can move in it in two ways of three.

Two slides and a hinge let a walker or a swimmer move in a plane. Where one of them was left out, it cannot fall over,
or it slips along a rail that is nowhere.

Bad:

    <mujoco>
      <worldbody>
        <body name="torso" pos="0 0 1">
          <joint name="rootx" type="slide" axis="1 0 0"/>
          <joint name="rootz" type="slide" axis="0 0 1"/>
          <geom type="capsule" fromto="0 0 -0.2 0 0 0.2" size="0.05"/>
          <body name="left_leg" pos="0 0.06 -0.2">
            <joint name="left_hip" axis="0 1 0" range="-60 60"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/>
          </body>
          <body name="right_leg" pos="0 -0.06 -0.2">
            <joint name="right_hip" axis="0 1 0" range="-60 60"/>
            <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.04"/>
          </body>
        </body>
      </worldbody>
      <actuator>
        <motor joint="left_hip"/>
        <motor joint="right_hip"/>
      </actuator>
    </mujoco>

Good:

            <joint name="rootz" type="slide" axis="0 0 1"/>
    +       <joint name="rooty" axis="0 1 0"/>

The number: bodies on the world with two joints, a slide and another one across it, that nothing drives, limits or
springs, and which carry two hinges and more that are driven, all of them across the plane. Of 385 healthy models none
is so. What slides up and turns may be on a boom, as what has one leg and does not turn; both are left alone.

When it is wrong: a boom that holds the trunk of a biped upright.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from clinic.diagnosis.edit import insert
from clinic.diagnosis.engine import HINGE, SLIDE
from clinic.diagnosis.probes.vector import Vector, cross, dot, unit, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A planar root that lacks a joint"
FAMILIES = ("stuck", "wrong-numbers")
LEVEL = "hint"
UNPLANTED = "few healthy models live in a plane"

BOTH, DRIVEN, ALONG = 2, 2, 0.999  # joints; hinges; cosine of the angle between axes of one direction


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each root with two of the three joints."""
    of, probe = model.simulation, how_many("roots with two joints of three in their plane", _incomplete)
    for body, (kind, axis) in _incomplete(of).items():
        names = (of.name("body", body), *(of.name("joint", joint) for joint in of.joints_of(body)))
        element, value = model.element("body", body), f'<joint type="{kind}" axis="{written(axis)}"/>'
        edits = (insert(element, value),) if element and kind == "hinge" and not of.count("key") else ()
        says = f"Its hinges turn across one plane, in which it {'cannot turn' if kind == 'hinge' else 'has one slide'}."
        yield Suspect(names, "joint", "left out", value, edits, probe, 0, says, "two slides and a hinge")


def _incomplete(of: Simulation) -> dict[int, tuple[str, Vector]]:
    """By body, the type and the axis of the joint that it lacks."""
    made = {}
    for body in of.children.get(0, []):
        joints = of.joints_of(body)
        kinds = (
            sorted((of.joint_type(joint) for joint in joints), key=(SLIDE, HINGE).index) if _free(of, joints) else []
        )
        if kinds not in ([SLIDE, SLIDE], [SLIDE, HINGE]):
            continue
        slide, other = sorted(joints, key=lambda joint: of.joint_type(joint) != SLIDE)
        along, beside = (of.row("jnt_axis", joint, 3) for joint in (slide, other))
        of.begin()
        hinges = [joint for joint in of.drivers if of.joint_type(joint) == HINGE and body in _above(of, joint)]
        if abs(dot(along, beside)) > 1 - ALONG or len(hinges) < DRIVEN:
            continue
        normal = of.axis(other) if kinds[1] == HINGE else unit(cross(of.axis(slide), of.axis(other)))
        turns = [dot(of.axis(joint), normal) for joint in hinges]
        legs = {of.ancestors(of.body_of("joint", joint))[-3] for joint in hinges}  # of which each is on the root
        if min(map(abs, turns)) < ALONG or (kinds[1] == SLIDE and len(legs) == 1):
            continue
        missing = unit(cross(beside, along))
        missing = tuple(x * math.copysign(1, max(missing, key=abs)) for x in missing)
        if kinds[1] == SLIDE or abs(of.axis(slide)[2]) < 1 - ALONG:
            made[body] = "hinge" if kinds[1] == SLIDE else "slide", missing
    return made


def _free(of: Simulation, joints: list[int]) -> bool:
    """Whether they are two hinges and slides that nothing drives, limits or springs."""
    held = {joint for joint in joints if of.model("jnt_stiffness")[joint]} | set(of.ranges) | set(of.drivers)
    return len(joints) == BOTH and set(joints) <= {*of.scalar_joints} - held


def _above(of: Simulation, joint: int) -> list[int]:
    return of.ancestors(of.body_of("joint", joint))[1:]
