"""Quaternions are written x y z w, and MuJoCo reads w x y z.

ROS and SciPy put the real part last, MuJoCo puts it first. `quat="0 0 0 1"`, no turn for them, is half a turn about z
here.

Bad:

    <mujoco>
      <worldbody>
        <body name="shelf" pos="1 0 0.5" quat="0 0 0 1">
          <geom type="box" size="0.2 0.4 0.02"/>
        </body>
        <body name="bin" pos="0 1 0.2" quat="0 0.13 0 0.991">
          <geom type="box" size="0.1 0.1 0.2"/>
          <geom name="lip" type="box" size="0.1 0.01 0.05" pos="0.1 0 0.2" quat="0 0 0.131 0.991"/>
        </body>
      </worldbody>
    </mujoco>

Good:

    <mujoco>
      <worldbody>
        <body name="shelf" pos="1 0 0.5" quat="1 0 0 0">
          <geom type="box" size="0.2 0.4 0.02"/>
        </body>
        <body name="bin" pos="0 1 0.2" quat="0.991 0 0.13 0">
          <geom type="box" size="0.1 0.1 0.2"/>
          <geom name="lip" type="box" size="0.1 0.01 0.05" pos="0.1 0 0.2" quat="0.991 0 0 0.131"/>
        </body>
      </worldbody>
    </mujoco>

The number: how many `quat` of bodies, geoms, sites, cameras and frames turn by more than a right angle as they stand,
where none turns by less, and all turn by less than 120 degrees, and by less than now, in the other order. Two and more
are told.

When it is wrong: parts that are all turned by more than a right angle about their own z.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Suspect, counted

TITLE = "Quaternions in the other order"
FAMILIES = ("wrong-numbers", "drifts", "jumps-at-start", "camera")
UNPLANTED = "healthy models of the bench have too few quaternions"

LEAST, HALF = 2, 0.5  # quaternions; of the length


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """All quaternions of the text, where each has its real part last."""
    if model.source is None or model.urdf:
        return
    found: list[tuple[Element, tuple[str, ...]]] = []
    for element in model.source.elements("body", "geom", "site", "camera", "frame"):
        words = tuple(element.get("quat").split())
        first, *rest = (float(word) for word in words) if len(words) == 4 else (1.0,)
        if any(rest):
            length = sum(x * x for x in (first, *rest)) ** 0.5
            if abs(rest[2]) <= max(abs(first), HALF * length):
                return
            found.append((element, words))
    if len(found) < LEAST or not any(words[:3] != ("0", "0", "0") for _, words in found[1:] or found):
        return
    edits = tuple(set_attribute(element, "quat", " ".join((words[3], *words[:3]))) for element, words in found)
    element, words = found[0]
    probe = counted("quaternions that turn by more than a right angle", len(found))
    says = (
        f"All {len(found)} quaternions turn by more than a right angle, and by less as x y z w: MuJoCo reads w x y z."
    )
    names = tuple(f'{each.tag} "{each.get("name")}"' if each.get("name") else f"<{each.tag}>" for each, _ in found)
    yield Suspect(
        tuple(dict.fromkeys(names)), "quat", " ".join(words), edits[0].value, edits, probe, 0, says,
        "the real part first", level="hint",
    )  # fmt: skip
