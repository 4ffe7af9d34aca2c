"""What an actuator drives, or a sensor reads."""

from __future__ import annotations

from clinic.diagnosis.simulation import Simulation

OBJECTS = {  # mjtObj
    **{1: "body", 2: "body", 3: "joint", 5: "geom"},
    **{6: "site", 7: "camera", 18: "tendon", 19: "actuator"},
}


def attached(of: Simulation, kind: str, index: int) -> tuple[str, int] | None:
    """The joint of an actuator, or what a sensor reads, by kind and number; None for what has nothing of the like."""
    if kind == "actuator":
        joint = of.driven_joint(index)
        return None if joint is None else ("joint", joint)
    found = OBJECTS.get(int(of.model("sensor_objtype")[index]))
    return (found, int(of.model("sensor_objid")[index])) if found else None
