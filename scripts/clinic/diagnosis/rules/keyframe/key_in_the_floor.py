"""A keyframe puts the robot into the floor.

The height of a free joint that belongs to another pose, or to another frame: the contacts throw the robot up at the
first step.

Bad:

    <mujoco>
      <worldbody>
        <geom type="plane" size="2 2 0.1"/>
        <body name="robot" pos="0 0 0.2">
          <freejoint/>
          <geom type="box" size="0.2 0.1 0.1" mass="4"/>
        </body>
      </worldbody>
      <keyframe>
        <key name="home" qpos="0 0 0.02 1 0 0 0"/>
      </keyframe>
    </mujoco>

Good:

    -     <key name="home" qpos="0 0 0.02 1 0 0 0"/>
    +     <key name="home" qpos="0 0 0.1 1 0 0 0"/>

The number: how deep the deepest contact with a plane is at the keyframe, over the size of the model: 6 % and more.
Where the first key stands well, a later one is a hint: it may be there for its joints alone.
Where all that is in the plane are boxes on edge, whose middle is as high as another of their half sizes, these are told
in its place: they would lie on it with two sizes exchanged.

When it is wrong: something that is meant to be planted.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from clinic.diagnosis.edit import set_attribute
from clinic.diagnosis.engine import BOX, PLANE
from clinic.diagnosis.probes.key import reordered, start_at, sunk
from clinic.diagnosis.probes.vector import written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.suspect import Level, Suspect

TITLE = "A keyframe is in the floor"
FAMILIES = ("jumps-at-start", "explodes")

SHARE = 0.06  # of the size of what is free
UPRIGHT, SAME = 0.999, 0.05  # cosine of the angle to the vertical; of the height


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Keyframes of one free robot that begin inside of a plane."""
    of = model.simulation
    if len(of.free_bodies) != 1:
        return
    joint = of.joints_of(of.free_bodies[0])[0]
    height = of.place(joint) + 2
    for key in range(of.count("key")):
        if reordered(model, key):
            continue
        deep, element = model.measured(sunk(key)), model.element("key", key)
        start_at(of, key)
        places = of.data("xpos")[3:]
        size = max(max(places[i::3]) - min(places[i::3]) for i in range(3)) + max(of.model("geom_rbound"), default=0.0)
        if element is None or deep <= SHARE * size:
            continue
        if on_edge := _on_edge(model, key):
            yield from _turned_over(model, key, on_edge, SHARE * size)
            return
        level: Level = "hint" if key and model.measured(sunk(0)) <= SHARE * size else "cause"
        qpos = list(of.data("qpos"))
        qpos[height] += deep
        yield Suspect(
            (of.name("key", key),),
            "qpos",
            f"height {qpos[height] - deep:.4g}",
            f"height {qpos[height]:.4g}",
            (set_attribute(element, "qpos", written(qpos)),),
            sunk(key),
            SHARE * size,
            f"At the keyframe {of.name('body', of.free_bodies[0])} begins {1000 * deep:.3g} mm deep in a plane.",
            "at most 6 % of the robot's size",
            excess=deep / (SHARE * size),
            level=level,
        )


def _turned_over(model: ReaderModel, key: int, sizes: Mapping[int, str], limit: float) -> Iterator[Suspect]:
    """The boxes on edge, with their sizes in the order in which they lie on the plane."""
    of, first = model.simulation, next(iter(sizes))
    names = (*(of.name("geom", geom) for geom in sizes), of.name("key", key))
    now, edits = written(of.row("geom_size", first, 3)), model.set("geom", [*sizes], "size", sizes[first])
    says = (
        f"It stands {1000 * model.measured(sunk(key)):.3g} mm deep in a plane, and in another order of its sizes on it."
    )
    yield Suspect(names, "size", now, sizes[first], edits, sunk(key), limit, says, "half lengths along x, y and z")


def _on_edge(model: ReaderModel, key: int) -> dict[int, str]:
    """The boxes in a plane that would lie on it with two of their sizes exchanged; empty unless all in it are alike."""
    of, made = model.simulation, dict[int, str]()
    start_at(of, key)
    kinds = of.model("geom_type")
    for contact in of.engine.contacts():
        plane, geom = sorted(contact.geoms, key=lambda each: int(kinds[each]) != PLANE)
        if int(kinds[plane]) != PLANE or of.data_row("geom_xmat", plane, 9)[8] < UPRIGHT:
            continue
        size, ups = list(of.row("geom_size", geom, 3)), of.data_row("geom_xmat", geom, 9)[6:]
        height = of.data_row("geom_xpos", geom, 3)[2] - of.data_row("geom_xpos", plane, 3)[2]
        up = max(range(3), key=lambda axis: abs(ups[axis]))
        flat = [axis for axis in range(3) if abs(size[axis] - height) < SAME * height and size[axis] < size[up] / 2]
        if int(kinds[geom]) != BOX or abs(ups[up]) < UPRIGHT or not flat:
            return {}
        size[up], size[flat[0]] = size[flat[0]], size[up]
        made[geom] = written(size)
    return made if len(set(made.values())) == 1 else {}
