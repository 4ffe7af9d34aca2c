"""There is no light: the image is black, or dark and without shades.

MuJoCo has a headlight at the camera unless `<headlight active="0"/>` or zeros for its colours switch it off. Then a
`<light>` is needed.

Bad:

    <mujoco>
      <visual>
        <headlight active="0"/>
      </visual>
      <worldbody>
        <geom type="box" size="0.05 0.05 0.05"/>
      </worldbody>
    </mujoco>

Good:

        <worldbody>
    +     <light pos="0 0 2"/>

The number: how many lamps are off where none is on.

When it is wrong: code adds lights to the scene, or only depth is rendered.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Nothing is lit"
FAMILIES = ("camera",)
LEVEL = "cause"
UNPLANTED = "no harm is measured in images"

COLOURS = {"ambient": "0.1 0.1 0.1", "diffuse": "0.4 0.4 0.4", "specular": "0.5 0.5 0.5"}  # MuJoCo's defaults


def _dark(simulation: Simulation) -> float:
    shines = any(simulation.model("light_active"))
    active = simulation.model("vis.headlight.active")[0]
    colours = [each for name in ("ambient", "diffuse") for each in simulation.model(f"vis.headlight.{name}")]
    return 0.0 if shines or (active and any(colours)) else 1.0 + simulation.count("light")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The headlight, where no light is on."""
    if model.source is None:
        return
    lamps = [each for each in model.source.elements("headlight") if _off(each)]
    if not lamps or not _dark(model.simulation):
        return
    names = [name for name in ("active", *COLOURS) if name in lamps[-1].attributes]
    edits = tuple(remove_attribute(lamps[-1], name) for name in names)
    probe = Probe("lamps that are off, and none is on", "", _dark, dynamic=False)
    says = "The headlight is off, and no light is on."
    yield Suspect(("the headlight",), "active", "off", "on", edits, probe, 0.0, says)


def _off(lamp: Element) -> bool:
    dark = all(not any(map(float, lamp.get(name, COLOURS[name]).split())) for name in ("ambient", "diffuse"))
    return lamp.get("active", "1") in ("0", "false") or dark
