"""What is odd about the pairs of a model: the comparisons that stand out, and the edit that makes a pair alike."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from clinic.diagnosis.edit import Edit, remove_attribute, set_attribute
from clinic.diagnosis.probes.inertia import inertial, set_inertial
from clinic.diagnosis.probes.siblings import UNLIKE, Odd, odd_ones
from clinic.diagnosis.probes.siblings import unlike as alike
from clinic.diagnosis.probes.twins import Comparison, Twins, twins
from clinic.diagnosis.probes.vector import norm, sub, times, transpose, turned, written
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Level, Probe, Suspect

ODD_SHARE = 0.12  # of all comparisons: more of them, and the model is not meant to be its own mirror image
FEW = 0.2  # of the comparisons of one quantity
ENOUGH = 12  # comparisons that make a model one of pairs
COPIED = {  # attributes that are the same on both sides
    **{
        name: (name,)
        for name in ("stiffness", "damping", "armature", "frictionloss", "type", "gravcomp", "fovy", "gear")
    },
    **{name: (name,) for name in ("contype", "conaffinity", "condim", "friction", "size")},
    "gain": ("kp", "kv", "dampratio", "gainprm", "biasprm"),
    "bias": ("kp", "kv", "dampratio", "gainprm", "biasprm"),
}
FRAMES = {
    "body": "body_parentid",
    "geom": "geom_bodyid",
    "site": "site_bodyid",
    "camera": "cam_bodyid",
    "joint": "jnt_bodyid",
}
PLACES = {"body": "xpos", "geom": "geom_xpos", "site": "site_xpos", "camera": "cam_xpos", "joint": "xanchor"}


def odd(model: ReaderModel, kinds: Sequence[str], quantities: Sequence[str]) -> Iterator[tuple[list[Comparison], bool]]:
    """Comparisons of a model of pairs that stand out, those of equal pairs together; and whether they do so clearly."""
    found = twins(model.simulation)
    groups: dict[int, list[Comparison]] = {}
    for each in found.comparisons:
        groups.setdefault(found.group(each), []).append(each)
    trusted = [each for group, some in groups.items() if found.trusted(group, some) for each in some]
    if len(trusted) < ENOUGH or sum(each.odd for each in trusted) > max(2, ODD_SHARE * len(trusted)):
        return
    told: dict[tuple[object, ...], tuple[list[Comparison], bool]] = {}
    for kind in kinds:
        for quantity in quantities:
            same = [each for each in trusted if (each.kind, each.quantity) == (kind, quantity)]
            few = [each for each in same if each.odd and not (kind == "body" and _of_geoms(model, found, each))]
            agree = len(same) - len(few)
            close = sum(each.unlike <= each.limit / 5 for each in same)
            most = max(1, FEW * len(same), 2 if agree >= 3 else 0)
            if not few or len(few) > most or (agree < 2 and quantity not in ("joint", "target")) or close < 0.7 * agree:
                continue
            bodies = {found.bodies(each) for each in few}
            alone = len(trusted) >= 30 and not any(each.odd and found.bodies(each) not in bodies for each in trusted)
            enough = 6 if kind in ("geom", "site", "camera") and quantity in ("pos", "quat") else 3
            clear = (
                agree >= (2 if alone and len(few) == 1 and enough == 3 else enough)
                and len(few) <= 3
                and all(each.unlike > each.clear for each in few)
            )
            if clear or (kind in ("body", "joint", "actuator", "sensor") and len(few) <= 2):
                pairs = tuple((each.left, each.right) for each in few)
                before, was_clear = told.get((kind, *pairs), ([], False))
                told[kind, *pairs] = ([*before, *few], clear or was_clear)
    yield from told.values()


def siblings(model: ReaderModel, kind: str) -> Iterator[Suspect]:
    """One of three or more that are alike but for a number or a finger in their names, where its twin tells nothing."""
    of, pairs = model.simulation, twins(model.simulation).comparisons
    paired = {
        (each.quantity, side) for each in pairs if each.kind == kind and each.odd for side in (each.left, each.right)
    }
    found = [each for each in odd_ones(of, kind) if (each.attribute, each.index) not in paired]
    if len({each.index for each in found}) > 1:  # two that differ alike, left and right, are meant
        return
    for each in found:
        names = COPIED.get(each.attribute, (each.attribute,))
        edits = _copied(model, kind, each.index, each.siblings[0], names)
        if edits and not model.measured(alike(each), edits) <= UNLIKE:
            edits = ()
        others = ", ".join(of.name(kind, other) for other in each.siblings[:3])
        now = next((text for name in names if (text := model.value(kind, each.index, name))), "")
        says = f"{others} agree in their {each.attribute}, and it differs by {each.unlike:.3g} %."
        probe, value = alike(each), edits[0].value if edits else "that of its siblings"
        level: Level = "cause" if edits and len(each.siblings) >= 2 and not _none(of, each) else "hint"
        healthy = "siblings alike"
        elements = (of.name(kind, each.index),)
        yield Suspect(elements, each.attribute, now, value, edits, probe, UNLIKE, says, healthy, level=level)


def _none(of: Simulation, each: Odd) -> bool:
    """Whether the one or the others have none of it."""
    return each.unlike >= 99.9 and each.attribute in ("damping", "armature", "frictionloss", "stiffness")


def suspect(model: ReaderModel, found: Sequence[Comparison], clear: bool) -> Suspect:
    """The suspect that makes the pairs alike; a hint where it stands out little or no edit does it."""
    first, simulation = found[0], model.simulation
    alone = [each for each in found if each.quantity == first.quantity]
    sides = [_odd_side(model, each) for each in found]
    probe = Probe(
        f"{first.quantity} of {first.kind} and twin, unlike by",
        first.unit,
        _unlike,
        tuple((each.kind, each.quantity, each.left, each.right) for each in alone),
        dynamic=False,
    )
    limit = max(each.limit for each in alone)
    edits = _together(edit for each, side in zip(found, sides, strict=True) for edit in edits_of(model, each, side))
    if any(each.quantity == "axis sign" for each in found):  # the axis turned, a range that differs is mirrored too
        turned_axes = [(each, side) for each, side in zip(found, sides, strict=True) if each.quantity == "axis sign"]
        edits = _together(edit for each, side in turned_axes for edit in edits_of(model, each, side))
    if _absent(model, found):
        clear = False
    if edits and not model.measured(probe, edits) <= limit:
        edits = ()
    quantities = " and ".join(dict.fromkeys(each.quantity for each in found))
    names = tuple(simulation.name(first.kind, side) for side in sides)
    others = [
        simulation.name(first.kind, each.left + each.right - side) for each, side in zip(found, sides, strict=True)
    ]
    compared = twins(simulation).comparisons
    alike = sum((each.kind, each.quantity) == (first.kind, first.quantity) and not each.odd for each in compared)
    says = f"It differs from its twin, {others[0]}, in a model where {alike} other pairs agree in their {quantities}."
    return Suspect(
        tuple(dict.fromkeys(names)),
        first.quantity,
        _told(model, first, sides[0]),
        edits[0].value if edits else f"that of {others[0]}",
        edits,
        probe,
        limit,
        says,
        f"at most {limit:.3g} {first.unit}: of the models of 14 robots all but a few pairs agree to less",
        level="cause" if clear and edits else "hint",
    )


def _of_geoms(model: ReaderModel, found: Twins, each: Comparison) -> bool:
    """Whether a body's mass differs because its geoms do, which is told of them."""
    if each.quantity in ("pos", "gravcomp") or inertial(model, each.left) is not None:
        return False
    pair = found.bodies(each)
    return any(other.odd and other.kind == "geom" and found.bodies(other) == pair for other in found.comparisons)


def _together(edits: Iterable[Edit]) -> tuple[Edit, ...]:
    """The edits without those of what another one writes anew."""
    made = {(each.file, each.start, each.action, each.attribute): each for each in edits}
    return tuple(made.values())


def _absent(model: ReaderModel, found: Sequence[Comparison]) -> bool:
    """Whether one side has none of it, as where a default was left in force: that may be meant."""
    fields = {"stiffness": "jnt_stiffness"} | {name: f"dof_{name}" for name in ("damping", "armature", "frictionloss")}
    field = fields.get(found[0].quantity)
    if field is None:
        return False
    of = model.simulation
    index = (lambda joint: joint) if field.startswith("jnt") else of.dof
    return any(of.model(field)[index(joint)] == 0 for each in found for joint in (each.left, each.right))


def _unlike(simulation: Simulation, *pairs: tuple[str, str, int, int]) -> float:
    found = twins(simulation).comparisons
    return max(
        (each.unlike for each in found if (each.kind, each.quantity, each.left, each.right) in pairs), default=0.0
    )


def _told(model: ReaderModel, each: Comparison, side: int) -> str:
    return next(
        (text for name in COPIED.get(each.quantity, (each.quantity,)) if (text := model.value(each.kind, side, name))),
        "",
    )


def _odd_side(model: ReaderModel, each: Comparison) -> int:
    """Which of a pair is the odd one: the one whose value fewer elements have; the left one when both have as many."""
    simulation = model.simulation

    def key(index: int) -> tuple[object, ...]:
        names = COPIED.get(each.quantity, (each.quantity,))
        texts = [model.value(each.kind, index, name) or "" for name in names]
        try:
            return tuple(sorted(round(abs(float(number)), 6) for text in texts for number in text.split()))
        except ValueError:
            return tuple(texts)

    if each.kind == "body" and inertial(model, each.left) is not None:
        far = [_centre_off(simulation, body) for body in (each.left, each.right)]
        return each.left if far[0] >= far[1] else each.right
    if each.kind in ("joint", "actuator"):
        for one in odd_ones(simulation, each.kind):
            if one.attribute == each.quantity and one.index in (each.left, each.right):
                return one.index
    if each.quantity == "ctrlrange":
        shares = [_in_reach(simulation, actuator) for actuator in (each.left, each.right)]
        if shares[0] != shares[1]:
            return each.left if shares[0] < shares[1] else each.right
    if each.quantity == "joint":
        joints = [simulation.driven_joint(actuator) for actuator in range(simulation.count("actuator"))]
        names = [
            simulation.engine.name("joint", joint) if (joint := joints[side]) is not None else ""
            for side in (each.left, each.right)
        ]
        own = [simulation.engine.name("actuator", side) for side in (each.left, each.right)]
        alike = [len(set(_pieces(a)) ^ set(_pieces(b))) for a, b in zip(names, own, strict=True)]
        return each.right if alike[1] > alike[0] else each.left
    counts = Counter(key(index) for index in range(simulation.count(each.kind)))
    return each.right if counts[key(each.right)] < counts[key(each.left)] else each.left


def _in_reach(simulation: Simulation, actuator: int) -> float:
    """The share of an actuator's control range that is in its joint's range."""
    joint = simulation.driven_joint(actuator)
    if joint is None or not simulation.model("jnt_limited")[joint]:
        return 1.0
    low, high = simulation.row("actuator_ctrlrange", actuator, 2)
    bottom, top = simulation.row("jnt_range", joint, 2)
    return max(0.0, min(high, top) - max(low, bottom)) / max(high - low, 1e-9)


def _pieces(name: str) -> list[str]:
    return name.lower().replace("-", "_").replace("/", "_").split("_")


def _centre_off(simulation: Simulation, body: int) -> float:
    """How far the centre of mass is from the middle of the body's geoms, in m."""
    places = [simulation.row("geom_pos", geom, 3) for geom in simulation.geoms_of(body)]
    if not places:
        return 0.0
    middle = tuple(sum(each) / len(places) for each in zip(*places, strict=True))
    off = sub(simulation.row("body_ipos", body, 3), middle)
    return norm(off)


def edits_of(model: ReaderModel, each: Comparison, side: int) -> tuple[Edit, ...]:
    """The edit of one side that makes it its twin's image; empty where none is known."""
    found = twins(model.simulation)
    twin = each.left + each.right - side
    if each.quantity in COPIED:
        return _copied(model, each.kind, side, twin, COPIED[each.quantity])
    if each.quantity in ("range", "ctrlrange", "forcerange", "limited"):
        return _range(model, found, each, side, twin)
    if each.quantity == "joint":
        return _other_joint(model, found, side, twin)
    if each.kind == "body" and each.quantity in ("mass", "center of mass", "inertia"):
        return _inertial(model, found, each, side, twin)
    if each.quantity == "pos":
        return _place(model, found, each, side, twin)
    if each.quantity == "axis":
        return _axis(model, found, each, side, twin)
    if each.quantity == "axis sign":
        return _turned_axis(model, side)
    return ()


def _copied(model: ReaderModel, kind: str, side: int, twin: int, names: Sequence[str]) -> tuple[Edit, ...]:
    made: list[Edit] = []
    element = model.element(kind, side)
    for name in names:
        own, other = model.value(kind, side, name), model.value(kind, twin, name)
        if element is None or own == other:
            continue
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
    if model.source is not None and model.source.urdf:
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


def _other_joint(model: ReaderModel, found: Twins, side: int, twin: int) -> tuple[Edit, ...]:
    driven, element = model.simulation.driven_joint(twin), model.element("actuator", side)
    partner = found.partner("joint", driven) if driven is not None else None
    if partner is None or element is None:
        return ()
    return (set_attribute(element, "joint", model.simulation.engine.name("joint", partner)),)


def _inertial(model: ReaderModel, found: Twins, each: Comparison, side: int, twin: int) -> tuple[Edit, ...]:
    if inertial(model, side) is None:
        geoms = [(found.partner("geom", geom), geom) for geom in model.simulation.geoms_of(side)]
        pairs = [(partner, geom) for partner, geom in geoms if partner is not None]
        return tuple(
            made for partner, geom in pairs for made in _copied(model, "geom", geom, partner, ("mass", "density"))
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
    owners = simulation.model(FRAMES[each.kind])
    here, there = int(owners[side]), int(owners[twin])
    left_body = each.left if each.kind == "body" else int(owners[each.left])
    image = found.image(left_body, here if each.kind != "body" else side)
    seen = times(image.matrix, sub(found.at(PLACES[each.kind], twin), found.at("xpos", there)))
    if here == there:
        seen = sub(image.of(found.at(PLACES[each.kind], twin)), found.at("xpos", here))
    return (set_attribute(element, "pos", written(times(transpose(found.at("xmat", here, 9)), seen))),)


def _turned_axis(model: ReaderModel, side: int) -> tuple[Edit, ...]:
    element = model.element("joint", side)
    if element is None:
        return ()
    if model.source is not None and model.source.urdf:
        axis = element.first("axis")
        turned_axis = written(tuple(-float(x) for x in axis.get("xyz").split())) if axis is not None else ""
        return (set_attribute(axis, "xyz", turned_axis),) if axis is not None else ()
    text = model.value("joint", side, "axis") or "0 0 1"
    return (set_attribute(element, "axis", written(tuple(-float(x) for x in text.split()))),)


def _axis(model: ReaderModel, found: Twins, each: Comparison, side: int, twin: int) -> tuple[Edit, ...]:
    element, body = model.element("joint", side), int(model.simulation.model("jnt_bodyid")[side])
    if element is None:
        return ()
    image = found.image(int(model.simulation.model("jnt_bodyid")[each.left]), body)
    axis = times(transpose(found.at("xmat", body, 9)), times(image.matrix, found.at("xaxis", twin)))
    own = model.simulation.row("jnt_axis", side, 3)
    sign = 1.0 if sum(a * b for a, b in zip(axis, own, strict=True)) >= 0 else -1.0
    return (set_attribute(element, "axis", written(tuple(sign * x for x in axis))),)
