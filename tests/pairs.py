"""Robots of which the limbs come in pairs, and what is found of them."""

from __future__ import annotations

from clinic.diagnosis.finding import Finding
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.probes.twins import twins
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.start import Start
from diagnosed import findings

PARTS = ("front", "middle", "rear")


def robot(change: dict[str, str] | None = None, **of_side: str) -> str:
    """Six legs in pairs; `change` replaces text of one body, by its name."""
    legs = ""
    for place, part in enumerate(PARTS):
        for side, y in (("left", 0.1), ("right", -0.1)):
            name = f"{side}_{part}"
            leg = (
                f'<body name="{name}" pos="{0.2 - 0.2 * place} {y} 0"><inertial pos="0 {y / 2} 0" mass="0.2" '
                f'diaginertia="1e-4 2e-4 3e-4"/><joint name="{name}" axis="1 0 0" damping="0.1" '
                f'range="{of_side.get(side, "-30 60")}"/><geom size="0.04" pos="0.0 {y / 2} 0"/></body>'
            )
            for found, other in (change or {}).items():
                who, _, text = found.partition(":")
                if who == name:
                    assert text in leg
                    leg = leg.replace(text, other)
            legs += leg
    return f'<mujoco><worldbody><body pos="0 0 1"><freejoint/><geom size="0.1"/>{legs}</body></worldbody></mujoco>'


def legs(calf: str = "0.02 0.02 0.06", mass: str = "0.2", knee: str = "0 0 -0.21") -> str:
    """A dog of four legs, of which one may have another calf."""
    made = ""
    for name, x, y in (("FL", 0.2, 0.1), ("FR", 0.2, -0.1), ("RL", -0.2, 0.1), ("RR", -0.2, -0.1)):
        own = (calf, mass, knee) if name == "RL" else ("0.02 0.02 0.06", "0.2", "0 0 -0.21")
        inertial = 'pos="0 0 -0.05" mass="{}" diaginertia="2e-4 2e-4 3e-5"'
        made += (
            f'<body name="{name}_thigh" pos="{x} {y} 0"><inertial {inertial.format(0.4)}/>'
            f'<joint name="{name}_hip" axis="0 1 0" range="-60 60"/><geom size="0.02" pos="0 0 -0.1"/>'
            f'<body name="{name}_calf" pos="{own[2]}"><inertial {inertial.format(own[1])}/>'
            f'<joint name="{name}_knee" axis="0 1 0" range="-90 0"/>'
            f'<geom type="box" size="{own[0]}" pos="0 0 -0.06"/></body></body>'
        )
    trunk = '<freejoint/><geom size="0.1" mass="5"/>'
    return f'<mujoco><worldbody><body pos="0 0 1">{trunk}{made}</body></worldbody></mujoco>'


def unlike(text: str) -> list[Finding]:
    """What the rules about twins find, as causes and as hints."""
    return [each for each in findings(text) if each.rule.startswith("twin-")]


def simulated(text: str) -> Simulation:
    return Simulation(NativeEngine().compile(text, {}), Start())


def odd(text: str, kind: str) -> list[str]:
    """The quantities in which a pair of a kind differs."""
    return [each.quantity for each in twins(simulated(text)).comparisons if each.odd and each.kind == kind]
