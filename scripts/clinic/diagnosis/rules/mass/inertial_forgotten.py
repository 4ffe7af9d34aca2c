"""One body of many has no `<inertial>`, so that its geoms make its mass.

Where a body has no `<inertial>`, MuJoCo makes its mass of its geoms, at 1,000 kg/m3 or the density of their default
class. In a robot whose other bodies all have theirs, it is usually the line that was lost, and the mass is that of the
collision shapes.

Bad:

    <mujoco>
      <worldbody>
        <body name="hip" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
          <body name="thigh" pos="0.2 0 0">
            <joint axis="0 1 0"/>
            <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
            <body name="shin" pos="0.2 0 0">
              <joint axis="0 1 0"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
              <body name="foot" pos="0.2 0 0">
                <joint axis="0 1 0"/>
                <inertial pos="0.05 0 0" mass="0.5" diaginertia="0.0005 0.001 0.001"/>
                <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="hip" pos="0 0 1">
          <joint axis="0 1 0"/>
          <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>
          <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
          <body name="thigh" pos="0.2 0 0">
            <joint axis="0 1 0"/>
            <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>
            <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
            <body name="shin" pos="0.2 0 0">
              <joint axis="0 1 0"/>
              <inertial pos="0.1 0 0" mass="1" diaginertia="0.001 0.004 0.004"/>
              <geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.02"/>
              <body name="foot" pos="0.2 0 0">
                <joint axis="0 1 0"/>
                <inertial pos="0.05 0 0" mass="0.5" diaginertia="0.0005 0.001 0.001"/>
                <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.02"/>
              </body>
            </body>
          </body>
        </body>
      </worldbody>
    </mujoco>

The number: told are at most two bodies, where three and more in four of their mechanism have an `<inertial>`, and no
geom of theirs has a mass or a density written on itself.

When it is wrong: a body that was added by hand and is as heavy as its geoms.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.inertia import inertial
from clinic.diagnosis.probes.matter import mass_of
from clinic.diagnosis.probes.shape import root_of, roots
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Suspect

TITLE = "A body without its inertial"
FAMILIES = ("wrong-mass", "sags", "drifts")
SINCE = "0.2"
LEVEL = "hint"

SHARE, FEW = 0.75, 2


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Jointed bodies of their geoms' mass among bodies that have an `<inertial>`."""
    of, owner = model.simulation, root_of(model.simulation)
    for root in roots(of):
        jointed = [body for body, top in enumerate(owner) if top == root and of.joints_of(body)]
        bare = [body for body in jointed if model.element("body", body) and inertial(model, body) is None]
        if not bare or len(bare) > FEW or len(jointed) - len(bare) < max(3, SHARE * len(jointed)):
            continue
        for body in bare:
            placed = [each for geom in of.geoms_of(body) if (each := model.element("geom", geom)) is not None]
            if not placed or any((each.get(name) or "0") != "0" for each in placed for name in ("mass", "density")):
                continue
            mass = of.model("body_mass")[body]
            others = len(jointed) - len(bare)
            says = f"{others} others have an <inertial>; its {mass:.3g} kg are those of its geoms."
            yield Suspect(
                (of.name("body", body),), "inertial", "left out", "", (), mass_of((body,)), 0.0, says,
                "its own <inertial>", level="hint",
            )  # fmt: skip
