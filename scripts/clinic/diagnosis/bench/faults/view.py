"""Sensors and cameras."""

from __future__ import annotations

from random import Random

from clinic.diagnosis.bench.faults import Fault, between, kind, numbers, pick, text_of, written
from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import ORIENTATIONS, Element


@kind("touch-site-too-small", harms=("reads",))
def touch_site_small(model: ReaderModel, random: Random) -> Fault | None:
    """The site of a touch sensor 0.01 to 0.5 of its size."""
    kinds, of = model.simulation.model("sensor_type"), model.simulation.model("sensor_objid")
    touched = {int(of[i]) for i, each in enumerate(kinds) if each == 0}
    sites = sorted(touched.intersection(written(model, "site", "size")))
    site, factor = pick(random, sites), between(random, 0.01, 0.5)
    element = model.element("site", site)
    assert element is not None
    size = text_of(*(factor * each for each in numbers(model.value("site", site, "size"))))
    sensors = [i for i, each in enumerate(of) if kinds[i] == 0 and int(each) == site]
    names = (model.simulation.name("site", site), *(model.simulation.name("sensor", i) for i in sensors))
    return Fault((set_attribute(element, "size", size),), names, "size", factor)


STEEP = 0.9  # of the view along the vertical: then an image has no upper side


def _camera(model: ReaderModel, random: Random, *, level: bool = False) -> tuple[int, Element] | None:
    modes = model.simulation.model("cam_mode")
    found = [(i, model.element("camera", i)) for i in written(model, "camera") if modes[i] < 3]
    if level:
        model.simulation.begin()
        views = model.simulation.data("cam_xmat")[8::9]
        found = [(i, element) for i, element in found if abs(views[i]) < STEEP]
    placed = [(i, element) for i, element in found if element is not None]
    return random.choice(placed) if placed else None


def _turned(model: ReaderModel, random: Random, axis: int) -> Fault | None:
    """A camera turned by 180 degrees about an axis of its image."""
    if (chosen := _camera(model, random, level=axis == 2)) is None:
        return None
    i, element = chosen
    w, x, y, z = model.simulation.row("cam_quat", i, 4)
    quat = ((-x, w, z, -y), (-y, -z, w, x), (-z, y, -x, w))[axis]
    gone: list[Edit] = [remove_attribute(element, name) for name in ORIENTATIONS if name in element.attributes]
    edits = (*gone, set_attribute(element, "quat", text_of(*quat)))
    return Fault(edits, (model.simulation.name("camera", i),), "quat")


@kind("camera-upside-down", harms=("looks",))
def camera_upside_down(model: ReaderModel, random: Random) -> Fault | None:
    """A camera that does not look straight up or down, with its image upside down."""
    return _turned(model, random, 2)


@kind("camera-sees-nothing", harms=("looks",))
def camera_looks_away(model: ReaderModel, random: Random) -> Fault | None:
    """A camera that looks the other way."""
    return _turned(model, random, random.choice((0, 1)))


@kind("field-of-view", harms=("looks",))
def camera_field_of_view(model: ReaderModel, random: Random) -> Fault | None:
    """A camera with a field of view of 0.2 to 5, or 150 to 179 degrees."""
    if (chosen := _camera(model, random)) is None:
        return None
    i, element = chosen
    value = random.choice((between(random, 0.2, 5), random.uniform(150, 179)))
    return Fault(
        (set_attribute(element, "fovy", text_of(value)),), (model.simulation.name("camera", i),), "fovy", value
    )
