"""A sensor reads 0 for ever, for what it measures is not there.

`<tendonactuatorfrc>` of a tendon that no actuator pulls, `<gyro>` at a site of the world: each compiles, and reads 0
whatever happens. A mocap body, too, is put and has no velocity.

Bad:

    <mujoco>
      <worldbody>
        <site name="drum" pos="0 0 2"/>
        <body name="load" pos="0 0 1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.1" mass="5"/>
          <site name="eye" pos="0 0 0.1"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope" range="0 0.9" limited="true"><site site="drum"/><site site="eye"/></spatial>
      </tendon>
      <sensor>
        <tendonactuatorfrc name="tension" tendon="rope"/>
      </sensor>
    </mujoco>

Good:

    -     <tendonactuatorfrc name="tension" tendon="rope"/>
    +     <tendonlimitfrc name="tension" tendon="rope"/>

The number: how many sensors measure the force of actuators where there is none, the velocity of the world itself or
of a mocap body, or a magnetic field of 0. Of 385 healthy models none has one. A robot whose root is fixed for a test,
or until it is attached to something, is left alone.

When it is wrong: a list of sensors that is the same for every model.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import replace
from clinic.diagnosis.engine import TRN_IN_PARENT
from clinic.diagnosis.probes.attached import attached
from clinic.diagnosis.probes.tendons import pulled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Suspect, how_many

TITLE = "A sensor of what is not there"
FAMILIES = ("sensor-reads-zero", "wrong-numbers")
LEVEL = "hint"
UNPLANTED = "few healthy models have sensors of actuators' forces"

JOINT_FORCE, TENDON_FORCE, MAGNETOMETER = 16, 17, 6  # mjtSensor
VELOCITIES = (2, 3, 31, 32)  # velocimeter, gyro, framelinvel, frameangvel
BODIES = {"geom": "geom_bodyid", "site": "site_bodyid", "camera": "cam_bodyid"}


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor that must read 0."""
    of = model.simulation
    for sensor, why in _empty(of).items():
        element, name = model.element("sensor", sensor), of.name("sensor", sensor)
        tag, tendon = (element.tag, element.get("tendon")) if element is not None else ("", "")
        limited = tag == "tendonactuatorfrc" and of.model("tendon_limited")[int(of.model("sensor_objid")[sensor])]
        written = f'<tendonlimitfrc name="{element.get("name")}" tendon="{tendon}"/>' if element and limited else ""
        edits = (replace(element, written),) if element and written and element.get("name") else ()
        probe = how_many("sensors of what is not there", _empty)
        yield Suspect((name,), "", f"<{tag}>", "<tendonlimitfrc>" if edits else "", edits, probe, 0, why, at=element)


def _empty(of: Simulation) -> dict[int, str]:
    """Why a sensor must read 0, by sensor."""
    return {sensor: why for sensor in range(of.count("sensor")) if (why := _why(of, sensor))}


def _why(of: Simulation, sensor: int) -> str:
    """Why a sensor must read 0; empty where it need not."""
    kind, index = (int(of.model(f"sensor_{each}")[sensor]) for each in ("type", "objid"))
    found = attached(of, "sensor", sensor)
    if kind == MAGNETOMETER:
        return "" if any(of.model("opt.magnetic")) else "The magnetic field of the model is 0."
    if found is None:
        return ""
    name = of.name(*found)
    others = any(int(each) > TRN_IN_PARENT for each in of.model("actuator_trntype")) or any(of.model("body_gravcomp"))
    if (kind == TENDON_FORCE and index not in pulled(of).values()) or (
        kind == JOINT_FORCE and index not in of.drivers and not others
    ):
        return f"No actuator acts on {name}."
    return _still(of, *found) if kind in VELOCITIES and not of.model("sensor_reftype")[sensor] else ""


def _still(of: Simulation, kind: str, index: int) -> str:
    """Why a frame has no velocity; empty where it may have one."""
    body = index if kind == "body" else int(of.model(BODIES[kind])[index])
    if not body:
        return f"{of.name(kind, index)} is the world's."
    put = of.model("body_mocapid")[int(of.model("body_rootid")[body])] >= 0
    moved = any(of.model("body_dofnum")[each] for each in of.ancestors(body))
    return f"{of.name(kind, index)} is put by a mocap body, which has no velocity." if put and not moved else ""
