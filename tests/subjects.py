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
