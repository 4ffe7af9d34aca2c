"""Models for triage, started and driven."""

from __future__ import annotations

import mujoco
from clinic.record.fields import RunSpec
from clinic.triage.recording import Subject


def subject(xml: str, **run: object) -> Subject:
    spec = mujoco.MjSpec.from_string(xml)
    given = {key.name: len(key.qpos) for key in spec.keys}
    return Subject(spec, spec.compile(), RunSpec.model_validate({"duration": 1.0, **run}), given=given)


HINGE = '<body name="arm"><joint name="elbow" {joint}/><geom name="arm" size=".1" pos=".3 0 0" mass="1" {geom}/></body>'
SERVO = '<actuator><position name="servo" joint="elbow" {servo}/></actuator>'


def arm(joint: str = "", geom: str = "", servo: str | None = None, more: str = "", before: str = "") -> str:
    actuator = "" if servo is None else SERVO.format(servo=servo)
    body = HINGE.format(joint=joint, geom=geom)
    return f"<mujoco>{before}<worldbody>{body}{more}</worldbody>{actuator}</mujoco>"


# two legs and an arm: most kinds of faults have a place in it
LEGS = """
<mujoco model="two legs">
  <compiler angle="radian"/>
  <option timestep="0.002"/>
  <asset><mesh name="rock" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
  <default><joint damping="0.5" armature="0.01"/></default>
  <worldbody>
    <camera name="front" pos="0 -3 1" xyaxes="1 0 0 0 0 1"/>
    <geom name="floor" type="plane" size="9 9 1"/>
    <body name="torso" pos="0 0 1">
      <freejoint name="root"/>
      <inertial pos="0 0 0" mass="5" diaginertia="0.05 0.04 0.03"/>
      <geom name="chest" type="box" size="0.2 0.15 0.1"/>
      <body name="left_leg" pos="0 0.1 -0.1">
        <joint name="left_hip" axis="0 1 0" range="-1 1.5"/>
        <geom name="left_shin" type="capsule" fromto="0 0 0 0 0 -0.5" size="0.04"/>
        <site name="left_sole" pos="0 0 -0.5" size="0.06"/>
      </body>
      <body name="right_leg" pos="0 -0.1 -0.1">
        <joint name="right_hip" axis="0 1 0" range="-1 1.5"/>
        <geom name="right_shin" type="capsule" fromto="0 0 0 0 0 -0.5" size="0.04"/>
        <site name="right_sole" pos="0 0 -0.5" size="0.06"/>
      </body>
    </body>
    <body name="arm" pos="1 0 1">
      <joint name="shoulder" axis="0 1 0" range="-1 1"/>
      <geom name="rod" type="capsule" fromto="0 0 0 0.4 0 0" size="0.03" mass="1"/>
      <body pos="0.4 0 0">
        <joint axis="0 1 0" range="-1 1"/>
        <geom name="tip" type="sphere" size="0.05" mass="0.2"/>
      </body>
    </body>
  </worldbody>
  <contact><exclude body1="left_leg" body2="right_leg"/></contact>
  <actuator>
    <motor name="left_drive" joint="left_hip" gear="20" ctrlrange="-1 1"/>
    <motor name="right_drive" joint="right_hip" gear="20" ctrlrange="-1 1"/>
    <motor name="lift" joint="shoulder" gear="10" ctrlrange="-1 1"/>
  </actuator>
  <sensor><touch name="left_touch" site="left_sole"/><touch name="right_touch" site="right_sole"/></sensor>
</mujoco>
"""
