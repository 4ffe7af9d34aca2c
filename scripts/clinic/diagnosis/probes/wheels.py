"""What is called a wheel, and what a caster."""

from __future__ import annotations

import re

CASTER = re.compile(r"caster|castor|ball_?wheel|roller", re.IGNORECASE)
WHEEL = re.compile(r"wheel|tyre|tire(?![a-z])", re.IGNORECASE)
OTHER = re.compile(
    r"steer|caster|castor|susp|fork|hub|spare|swivel|mount|knuckle|motor|axle|arm|leg|guard|cover|fender|well|yaw|camber"
    r"|pivot|hand|prism|valve|stator|flywheel|reaction|wheel_?(base|chair)",
    re.IGNORECASE,
)


def is_wheel(*names: str) -> bool:
    """Whether one of the names of a body and its hinge is a wheel's, and none that of what carries or covers one."""
    return any(WHEEL.search(name) for name in names) and not any(OTHER.search(name) for name in names)
