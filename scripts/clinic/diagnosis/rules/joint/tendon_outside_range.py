"""A tendon starts outside of its range.

The limit of a tendon is a constraint: where it is longer than it may be at the start, the first step pulls its ends
together, or throws them apart, as hard as a stiff spring. `range="0 0.0001"` is taken for a rigid rod, and is one of
0.1 mm.

Bad:

    <mujoco>
      <worldbody>
        <site name="hook" pos="0 0 1.2"/>
        <body name="weight" pos="0 0 1">
          <freejoint/>
          <geom type="sphere" size="0.05"/>
          <site name="eye" pos="0 0 0.05"/>
        </body>
      </worldbody>
      <tendon>
        <spatial name="rope" limited="true" range="0 0.0001">
          <site site="hook"/>
          <site site="eye"/>
        </spatial>
      </tendon>
    </mujoco>

Good:

    -     <spatial name="rope" limited="true" range="0 0.0001">
    +     <spatial name="rope" limited="true" range="0 0.16">

The number: how far its length at the start lies outside of the range, as a share of the largest of that length, the
width of the range and, where it is too short, the lower end of the range; more than 80 %. Where the range begins at ten
times the length and more, its width does not count. In a model with keyframes it is so in the first of them as well. Of
a tendon that an actuator pulls 20 % are enough: of 260 healthy models none has one that is outside by 3 %. From 20 %
on, a tendon through sites is told where one thing in the text, and nothing else, brings it into its range: another
site, through which no tendon goes, or another sign of a number in the `pos` or `euler` of what it is fixed to.

When it is wrong: a rope that is to be pulled tight at the start.
"""

from __future__ import annotations

from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, set_attribute
from clinic.diagnosis.probes.key import start_at
from clinic.diagnosis.probes.tendons import path, pulled
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.simulation import Simulation
from clinic.diagnosis.suspect import Probe, Suspect

TITLE = "A tendon starts outside of its range"
FAMILIES = ("jumps-at-start", "explodes")
UNPLANTED = "the limited tendons of the healthy models are those of two hands"

OUTSIDE, SOME = 0.8, 0.2
MANY = 40  # edits that are tried


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each tendon whose start its limit does not allow."""
    of = model.simulation
    keys = range(min(1, of.count("key"))) if of.begin_with.key < 0 else ()  # a model that has keyframes begins with one
    for tendon in range(of.count("tendon")):
        outside = min([_outside(of, tendon), *(_outside_at(of, tendon, key) for key in keys)])
        if outside > SOME and (mended := _mended(model, tendon)) is not None:
            yield mended
            continue
        if outside <= (SOME if tendon in pulled(of).values() else OUTSIDE):
            continue
        of.begin()
        (low, high), length = of.row("tendon_range", tendon, 2), of.data("ten_length")[tendon]
        least, most = min(low, 0.98 * length), max(high, 1.02 * length)
        value = f"{least:.3g} {1.01 * most:.3g}"
        if low / 1000 <= length <= high / 1000:
            value = f"{low / 1000:g} {high / 1000:g}"  # in m
        says, limit = f"It is {length:.3g} long at the start, and its range is {low:g} to {high:g}.", OUTSIDE
        if outside <= OUTSIDE:
            says, limit = f"{says} An actuator pulls it, and its limit does so from the start.", SOME
        edits = model.set("tendon", [tendon], "range", value)
        names, now = (of.name("tendon", tendon),), f"{low:g} {high:g}"
        yield Suspect(names, "range", now, value, edits, _begins(tendon), limit, says, "inside of the range")


def _mended(model: ReaderModel, tendon: int) -> Suspect | None:
    """The one edit of a site or a sign that brings a tendon into its range; None where there is none, or several."""
    of = model.simulation
    tried = [*_other_sites(model, tendon), *_other_signs(model, tendon)]
    found = [each for each in tried if model.measured(_begins(tendon), [each[-1]]) <= 0] if len(tried) <= MANY else []
    found = [each for each in found if model.measured(_lowest(), [each[-1]]) <= model.measured(_lowest())]
    if len(found) != 1:
        return None
    (element, now, edit), (low, high) = found[0], of.row("tendon_range", tendon, 2)
    of.begin()
    says = (
        f"It is {of.data('ten_length')[tendon]:.3g} long at the start, and its range is {low:g} to {high:g}. "
        f'With {edit.attribute}="{edit.value}" it is inside.'
    )
    names, healthy = (of.name("tendon", tendon), element), "inside of the range"
    return Suspect(names, edit.attribute, now, edit.value, (edit,), _begins(tendon), SOME, says, healthy)


def _other_sites(model: ReaderModel, tendon: int) -> Iterator[tuple[str, str, Edit]]:
    """Edits that let a tendon go through a site that none goes through, in the place of one of its own."""
    of, names, element = model.simulation, model.simulation.names("site"), model.element("tendon", tendon)
    used = {site for each in range(of.count("tendon")) for kind, site in path(of, each) if kind == "site"}
    for part in element.children if element is not None else ():
        now = part.get("site")
        for other in set(names) - {names[site] for site in used} - {""} if now and part.tag == "site" else ():
            yield f'site "{now}"', now, set_attribute(part, "site", other)


def _other_signs(model: ReaderModel, tendon: int) -> Iterator[tuple[str, str, Edit]]:
    """Edits of the sign of one number in the places and the angles of a tendon's sites and of their bodies."""
    of, sites = model.simulation, [site for kind, site in path(model.simulation, tendon) if kind == "site"]
    bodies = {each for site in sites for each in of.ancestors(of.body_of("site", site)) if each}
    for kind, index in [*(("site", site) for site in sites), *(("body", body) for body in sorted(bodies))]:
        element = model.element(kind, index)
        for attribute in ("pos", "euler") if element is not None else ():
            numbers = element.get(attribute).split() if element is not None else []
            for place, number in enumerate(numbers):
                if element is not None and float(number):
                    turned = number[1:] if number.startswith("-") else f"-{number.removeprefix('+')}"
                    value = " ".join([*numbers[:place], turned, *numbers[place + 1 :]])
                    yield of.name(kind, index), " ".join(numbers), set_attribute(element, attribute, value)


def _depth(simulation: Simulation) -> float:
    """How deep the lowest of what moves lies below the world's origin, in m."""
    simulation.begin()
    return -min((simulation.data_row("xipos", body, 3)[2] for body in simulation.moving_bodies), default=0.0)


def _lowest() -> Probe:
    return Probe("how deep the lowest body is", "m", _depth, dynamic=False)


def _begins(tendon: int) -> Probe:
    title = "how far a tendon starts outside of its range"
    return Probe(title, "of its length or range", _outside, (tendon,), dynamic=False)


def _outside(simulation: Simulation, tendon: int) -> float:
    simulation.begin()
    return _beyond(simulation, tendon)


def _outside_at(simulation: Simulation, tendon: int, key: int) -> float:
    start_at(simulation, key)
    return _beyond(simulation, tendon)


def _beyond(simulation: Simulation, tendon: int) -> float:
    """How far a tendon is outside of its range now."""
    if not simulation.model("tendon_limited")[tendon]:
        return 0.0
    (low, high), length = simulation.row("tendon_range", tendon, 2), simulation.data("ten_length")[tendon]
    wide = 0.0 if 0 < 10 * length < low else high - low
    return max(low - length, length - high) / max(abs(length), abs(low) if low > length else 0.0, wide, 1e-9)


def far_outside(simulation: Simulation) -> bool:
    """Whether some tendon begins where its limit does not allow."""
    return any(_outside(simulation, tendon) > OUTSIDE for tendon in range(simulation.count("tendon")))
