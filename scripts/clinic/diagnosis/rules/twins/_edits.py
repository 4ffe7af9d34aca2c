"""The edit of one of a pair that makes it its twin's image."""

from __future__ import annotations

import math
from collections.abc import Sequence

from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.probes.attached import attached
from clinic.diagnosis.probes.comparison import Comparison
from clinic.diagnosis.probes.inertia import inertial, set_inertial
from clinic.diagnosis.probes.twins import Twins, twins
from clinic.diagnosis.probes.vector import dot, sub, times, transpose, turned, written
from clinic.diagnosis.reader_model import ReaderModel

COPIED = {  # attributes that are the same on both sides
    **{
        name: (name,)
        for name in ("stiffness", "damping", "armature", "frictionloss", "type", "gravcomp", "fovy", "gear")
    },
    **{name: (name,) for name in ("contype", "conaffinity", "condim", "friction", "size")},
    "gear sign": ("gear",),
    "gain": ("kp", "kv", "dampratio", "gainprm", "biasprm"),
    "bias": ("kp", "kv", "dampratio", "gainprm", "biasprm"),
}
PLACES = {"body": "xpos", "geom": "geom_xpos", "site": "site_xpos", "camera": "cam_xpos", "joint": "xanchor"}


def edits_of(model: ReaderModel, each: Comparison, side: int) -> tuple[Edit, ...]:
    """The edit of one side that makes it its twin's image; empty where none is known."""
    found = twins(model.simulation)
    twin = each.left + each.right - side
    if each.quantity in COPIED:
        return copied(model, each.kind, side, twin, COPIED[each.quantity])
    if each.quantity in ("range", "ctrlrange", "forcerange", "limited"):
        return _range(model, found, each, side, twin)
    if each.quantity in ("joint", "target"):
        return _attached(model, found, each.kind, side, twin)
    if each.kind == "body" and each.quantity in ("mass", "center of mass", "inertia"):
        return _inertial(model, found, each, side, twin)
    if each.quantity == "pos":
        return _place(model, found, each, side, twin)
    if each.quantity == "axis":
        return _axis(model, found, each, side, twin)
    if each.quantity == "axis sign":
        return model.turned_axis(side)
    if each.quantity == "springref":
        rest = float(model.value("joint", twin, "springref") or 0) * found.interval_sign(each)
        return model.set("joint", [side], "springref", f"{rest + 0.0:g}")
    return ()


def copied(model: ReaderModel, kind: str, side: int, twin: int, names: Sequence[str]) -> tuple[Edit, ...]:
    made: list[Edit] = []
    element = model.element(kind, side)
    for name in names:
        own, other = model.value(kind, side, name), model.value(kind, twin, name)
        if element is None or own == other:
            continue
        if name == "pos" and own and other:
            pairs = zip(own.split(), other.split(), strict=True)
            other = written([math.copysign(float(there), float(here)) for here, there in pairs])
        if other is not None:
            made.append(set_attribute(element, name, other))
        elif name in element.attributes:
            made.append(remove_attribute(element, name))
    return tuple(made)


def _range(model: ReaderModel, found: Twins, each: Comparison, side: int, twin: int) -> tuple[Edit, ...]:
    name = "range" if each.quantity == "limited" else each.quantity
    text, element = model.value(each.kind, twin, name), model.element(each.kind, side)
    if element is None:
        return ()
    if model.urdf:
        low, high = model.simulation.row("jnt_range", twin, 2)
        if found.interval_sign(each) < 0:
            low, high = -high, -low
        limit = element.first("limit")
        return tuple(
            set_attribute(limit, name, f"{value:.6g}") for name, value in (("lower", low), ("upper", high)) if limit
        )
    if text is None:
        return ()
    low, high = (float(number) for number in text.split())
    if found.interval_sign(each) < 0:
        low, high = -high, -low
    made = [set_attribute(element, name, written((low, high)))]
    if each.quantity == "limited" and (limited := model.value(each.kind, twin, "limited")):
        made.append(set_attribute(element, "limited", limited))
    return tuple(made)


def _attached(model: ReaderModel, found: Twins, kind: str, side: int, twin: int) -> tuple[Edit, ...]:
    """What the twin drives or reads, of this side."""
    of, element, other = model.simulation, model.element(kind, side), attached(model.simulation, kind, twin)
    partner = found.partner(*other) if other else None
    if other is None or partner is None or element is None:
        return ()
    attribute = "objname" if element.get("objname") else other[0]
    return (set_attribute(element, attribute, of.names(other[0])[partner]),)


def _inertial(model: ReaderModel, found: Twins, each: Comparison, side: int, twin: int) -> tuple[Edit, ...]:
    if inertial(model, side) is None:
        geoms = [(found.partner("geom", geom), geom) for geom in model.simulation.geoms_of(side)]
        pairs = [(partner, geom) for partner, geom in geoms if partner is not None]
        return tuple(
            made for partner, geom in pairs for made in copied(model, "geom", geom, partner, ("mass", "density"))
        )
    simulation, image = model.simulation, found.image(each.left, side)
    frame = transpose(found.at("xmat", side, 9))
    centre = times(frame, times(image.matrix, sub(found.at("xipos", twin), found.at("xpos", twin))))
    about = turned(frame, turned(image.matrix, found.tensor(twin)))
    return set_inertial(model, side, simulation.model("body_mass")[twin], centre, about)


def _place(model: ReaderModel, found: Twins, each: Comparison, side: int, twin: int) -> tuple[Edit, ...]:
    element, simulation = model.element(each.kind, side), model.simulation
    if element is None or "fromto" in element.attributes:
        return ()
    here, there = simulation.body_of(each.kind, side), simulation.body_of(each.kind, twin)
    left_body = each.left if each.kind == "body" else simulation.body_of(each.kind, each.left)
    image = found.image(left_body, here if each.kind != "body" else side)
    seen = times(image.matrix, sub(found.at(PLACES[each.kind], twin), found.at("xpos", there)))
    if here == there:
        seen = sub(image.of(found.at(PLACES[each.kind], twin)), found.at("xpos", here))
    return (set_attribute(element, "pos", written(times(transpose(found.at("xmat", here, 9)), seen))),)


def _axis(model: ReaderModel, found: Twins, each: Comparison, side: int, twin: int) -> tuple[Edit, ...]:
    element, body = model.element("joint", side), model.simulation.body_of("joint", side)
    if element is None:
        return ()
    image = found.image(model.simulation.body_of("joint", each.left), body)
    axis = times(transpose(found.at("xmat", body, 9)), times(image.matrix, found.at("xaxis", twin)))
    own = model.simulation.row("jnt_axis", side, 3)
    sign = 1.0 if dot(axis, own) >= 0 else -1.0
    return (set_attribute(element, "axis", written(tuple(sign * x for x in axis))),)
