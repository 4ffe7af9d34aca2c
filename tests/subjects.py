"""Models for triage, started and driven, and a clock that needs no time."""

from __future__ import annotations

import mujoco
from clinic.record.fields import RunSpec
from clinic.triage.run import Budget, Subject
from clinic.triage.watched_run import Examination


def subject(xml: str, **run: object) -> Subject:
    spec = mujoco.MjSpec.from_string(xml)
    given = {key.name: len(key.qpos) for key in spec.keys}
    return Subject(spec, spec.compile(), RunSpec.model_validate({"duration": 1.0, **run}), given=given)


def examination(xml: str, **run: object) -> Examination:
    return Examination(subject(xml, **run), Budget())


class Ticks:
    """A clock that moves on by one second whenever it is read."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        self.now += 1.0
        return self.now


HINGE = '<body name="arm"><joint name="elbow" {joint}/><geom name="arm" size=".1" pos=".3 0 0" mass="1" {geom}/></body>'
SERVO = '<actuator><position name="servo" joint="elbow" {servo}/></actuator>'


def arm(joint: str = "", geom: str = "", servo: str | None = None, more: str = "", before: str = "") -> str:
    actuator = "" if servo is None else SERVO.format(servo=servo)
    body = HINGE.format(joint=joint, geom=geom)
    return f"<mujoco>{before}<worldbody>{body}{more}</worldbody>{actuator}</mujoco>"
