"""Jaws press too weakly on what they are to lift.

A grasp holds while friction times the normal forces is more than the weight, and every start and turn of the arm asks
for more. How hard a position servo presses is its `kp` times how far its target lies inside of the thing, up to its
`forcerange`.

Bad:

    <mujoco>
      <option cone="elliptic" impratio="20"/>
      <worldbody>
        <geom type="plane" size="1 1 0.1"/>
        <body name="left" pos="-0.04 0 0.06">
          <joint name="left" type="slide" axis="1 0 0"/>
          <geom type="box" size="0.005 0.015 0.04" mass="0.1"/>
        </body>
        <body name="right" pos="0.04 0 0.06">
          <joint name="right" type="slide" axis="-1 0 0"/>
          <geom type="box" size="0.005 0.015 0.04" mass="0.1"/>
        </body>
        <body name="cube" pos="0.3 0 0.025">
          <freejoint/>
          <geom type="box" size="0.025 0.025 0.025" mass="0.4"/>
        </body>
      </worldbody>
      <actuator>
        <position name="left" joint="left" kp="200" kv="10" ctrlrange="0 0.03"/>
        <position name="right" joint="right" kp="200" kv="10" ctrlrange="0 0.03"/>
      </actuator>
    </mujoco>

Good:

    -     <position name="left" joint="left" kp="200" kv="10" ctrlrange="0 0.03"/>
    -     <position name="right" joint="right" kp="200" kv="10" ctrlrange="0 0.03"/>
    +     <position name="left" joint="left" kp="1000" kv="10" ctrlrange="0 0.03"/>
    +     <position name="right" joint="right" kp="1000" kv="10" ctrlrange="0 0.03"/>

The number: the weight of a free thing that was put between the jaws over what friction carries, once they went to an
end of their controls for 1 s; told from a third on. The grippers of three healthy models carry 12 to 74 times the
weight.

When it is wrong: a thing that is not to be lifted, or jaws whose force code sets.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.probes.grasp import grasps, needed
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules.contact.grasp_slips import would_hold
from clinic.diagnosis.suspect import Suspect

TITLE = "Jaws that press too weakly"
FAMILIES = ("slips",)
UNPLANTED = "most healthy models have nothing to grasp"

FEW, TIMES, HELPS = 3.0, 5.0, 0.6  # times the weight; times the gain; of what is needed


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """The actuators of jaws whose friction would do if they pressed harder."""
    of = model.simulation
    for found in grasps(of):
        if found.carries > FEW * found.weight or would_hold(model, found):
            continue
        gains = {each: TIMES * of.gain(each)[0] for each in found.jaws.actuators}
        written = all(model.value("actuator", each, "kp") is not None for each in gains)
        edits = model.set_each("actuator", "kp", {each: f"{gain:g}" for each, gain in gains.items()}) if written else ()
        names = tuple(of.name("actuator", each) for each in gains)
        says = (
            f"The jaws press with {found.force:.3g} N in all, of which friction carries {found.carries:.3g} N; "
            f"{of.name('body', found.body)} weighs {found.weight:.3g} N."
        )
        first, probe = found.jaws.actuators[0], needed(found)
        told = "kp", f"{of.gain(first)[0]:g}", f"{gains[first]:g}"
        if edits and model.measured(probe, edits) > HELPS * model.measured(probe):  # at the end of its force already
            told, edits = ("forcerange", model.value("actuator", first, "forcerange") or "", "a wider one"), ()
        yield Suspect(names, *told, edits, probe, 1 / FEW, says, "a third of what is carried", level="hint")
        return
