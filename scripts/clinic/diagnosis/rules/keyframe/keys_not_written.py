"""Room is kept for keyframes that nobody wrote.

`<size nkey="5">` asks for five keyframes. Those that no `<key>` writes are the model's own start, at time 0 and at
rest. A viewer offers them, and code that resets to one gets a start that may lie outside of ranges.

Bad:

    <mujoco>
      <size nkey="3"/>
      <worldbody>
        <body pos="0 0 1">
          <joint name="knee" axis="0 1 0" range="-160 -2"/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03"/>
        </body>
      </worldbody>
      <keyframe>
        <key name="bent" qpos="-1"/>
      </keyframe>
    </mujoco>

Good:

    -   <size nkey="3"/>

The number: how many keyframes there are beyond those that are written.

When it is wrong: keyframes that code fills in. A model that writes none at all is not told: many old ones keep room for
five and use none.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import remove_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "Keyframes that nobody wrote"
FAMILIES = ("jumps-at-start", "passes-limit")
UNPLANTED = "keyframes that nobody asks for harm nobody"
MINOR = True


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The `<size>` that asks for more keyframes than there are `<key>`."""
    if model.source is None:
        return
    written = sum(each.tag == "key" for each in model.source.section("keyframe"))
    sizes = [each for each in model.source.elements("size") if "nkey" in each.attributes]
    if not written or not sizes or any(True for _ in model.source.elements("attach", "model")):
        return
    size = sizes[-1]
    probe = Probe("keyframes that are not written", "", _unwritten, (written,), dynamic=False)
    says = f"nkey {size.get('nkey')} makes {size.get('nkey')} keyframes, and the model writes {written} of them."
    edits = (remove_attribute(size, "nkey"),)
    yield Suspect(("<size>",), "nkey", size.get("nkey"), "left out", edits, probe, 0, says, "as many as are written")


def _unwritten(of: Simulation, written: int) -> float:
    return float(of.count("key") - written)
