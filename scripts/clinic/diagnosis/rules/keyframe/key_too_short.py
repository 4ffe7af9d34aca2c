"""A keyframe has fewer positions than the model.

On MuJoCo 4.0 a `qpos` that is too short is filled up from the model's start, without a word. A free body that stands
before the robot then takes the robot's first seven numbers, and the robot the rest.

Bad:

    <mujoco>
      <worldbody>
        <body name="box" pos="1 0 0.5">
          <freejoint/>
          <geom size="0.1"/>
        </body>
        <body name="link" pos="0 0 1">
          <joint axis="0 1 0" range="-90 90"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0.8"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0.8"/>
    +     <key name="home" qpos="1 0 0.5 1 0 0 0 0.8"/>

The number: how many numbers go to another joint than with the edit, which puts the places of free bodies that stand
first before the numbers that are written. A cause is told where the count of the missing is a multiple of seven, and
that of the written is not.

Where no free body stands first the numbers that are there belong to the joints they are meant for: a hint, for releases
of MuJoCo before 4 refuse the text.

When it is wrong: free bodies that come last and are meant to keep their places.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import FREE
from clinic.diagnosis.probes.key import astray
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "A keyframe is too short"
FAMILIES = ("jumps-at-start", "drifts")
LEVEL = "cause"
UNPLANTED = "no healthy model has a free body that stands before its robot"


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes with fewer positions than joints need, where a free body takes what is another's."""
    of = model.simulation
    start = list(of.model("qpos0"))
    for key in range(of.count("key")):
        element = model.element("key", key)
        values = [float(text) for text in element.get("qpos").split()] if element is not None else []
        missing = len(start) - len(values)
        free = 7 * len(of.free_bodies)
        first = bool(of.count("joint")) and of.joint_type(0) == FREE
        if element is None or not values or missing <= 0:
            continue
        if not first or missing > free:
            if len(values) in {int(place) for place in of.model("jnt_qposadr")}:
                yield _padded(model, key, element, values)
            continue
        qpos = [*start[:missing], *values]
        yield Suspect(
            (of.name("key", key),),
            "qpos",
            f"{len(values)} numbers",
            f"{len(start)} numbers",
            (set_attribute(element, "qpos", written(qpos)),),
            astray(key, tuple(qpos)),
            0.5,
            f"It has {len(values)} of {len(start)} numbers: {of.name('joint', 0)}, free, takes the first.",
            "as many numbers as nq",
            level="cause" if missing % 7 == 0 and len(values) % 7 else "hint",
        )


def _padded(model: ReaderModel, key: int, element: Element, values: list[float]) -> Suspect:
    """A keyframe whose missing numbers are those of the joints that come last."""
    of = model.simulation
    start = list(of.model("qpos0"))
    qpos = written([*values, *start[len(values) :]])
    says = (
        f"It has {len(values)} of {len(start)} numbers: MuJoCo 4 takes the rest from the model, older releases refuse."
    )
    probe = counted("numbers that a keyframe lacks", len(start) - len(values))
    edits = (set_attribute(element, "qpos", qpos),)
    told, having, wanted = (of.name("key", key),), f"{len(values)} numbers", f"{len(start)} numbers"
    healthy = "as many numbers as nq"
    return Suspect(told, "qpos", having, wanted, edits, probe, 0, says, healthy, level="hint")
