"""A sensor is of another kind than its name says.

A line of sensors is copied and one word is left: what is called a gyro is a `<velocimeter>`, and gives m/s where rad/s
are read. Both have three numbers, so that nothing complains.

Bad:

    <mujoco>
      <worldbody>
        <body name="robot" pos="0 0 0.1">
          <freejoint/>
          <geom type="box" size="0.1 0.1 0.05"/>
          <site name="imu"/>
        </body>
      </worldbody>
      <sensor>
        <accelerometer name="robot_accel" site="imu"/>
        <velocimeter name="robot_gyro" site="imu"/>
      </sensor>
    </mujoco>

Good:

    -     <velocimeter name="robot_gyro" site="imu"/>
    +     <gyro name="robot_gyro" site="imu"/>

The number: how many sensors of motion have a name that names one other kind of them, and not their own. An `upvector`
that points less than 30 degrees above the horizontal at the start, where another axis of its frame points up. And how
many sensors whose names differ by one word, `left_enc` and `right_enc`, which read what differs by the same word,
`left_wheel` and `right_wheel`, are of two kinds: of three and more the one that stands alone, of two both.

When it is wrong: a name that says what is made of the reading.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from clinic.diagnosis.edit import Edit, replace
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Element
from clinic.diagnosis.suspect import Probe, Suspect, counted

TITLE = "A sensor of another kind than its name says"
FAMILIES = ("wrong-numbers", "sensor-reads-zero")
UNPLANTED = "what a sensor is meant to read stands in its name alone"

SAID = {  # the words for what a sensor reads, and the kinds that read it; the first is what is meant
    r"gyro(?:scope)?|ang(?:ular)?_?vel(?:ocity)?": ("gyro", "frameangvel", "ballangvel", "subtreeangmom"),
    r"acc(?:el[a-z]*)?|lin(?:ear)?_?acc[a-z]*": ("accelerometer", "framelinacc"),
    r"velocimeter|lin(?:ear)?_?vel(?:ocity)?": ("velocimeter", "framelinvel", "subtreelinvel"),
    r"magnetometer": ("magnetometer",),
}
WORDS = {re.compile(rf"(?<![a-z])(?:{words})(?![a-z])", re.IGNORECASE): kinds for words, kinds in SAID.items()}
OWN = {"frame": "pos|quat|ori|rot|att|vel|acc|axis", "subtree": "com|vel|mom|subtree", "ball": "quat|vel|ball"}
SITED = ("gyro", "accelerometer", "velocimeter", "magnetometer")  # written alike
KINDS = {kind for kinds in SAID.values() for kind in kinds}
READ = ("joint", "tendon", "actuator", "site", "objname", "body")  # what a sensor reads, by attribute
UP, LYING = re.compile(r"(?<![a-z])up_?(?:vec(?:tor)?|axis)(?![a-z])", re.IGNORECASE), 0.5
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+")
AXES = ("framexaxis", "frameyaxis", "framezaxis")


def suspects(model: ReaderModel) -> Iterator[Suspect]:
    """Each sensor whose name says one kind, and that is another; those unlike what they are called like."""
    yield from _lying(model)
    yield from _unlike_sisters(model)
    sensors = model.source.section("sensor") if model.source else ()
    found = [(each, meant) for each in sensors if (meant := _meant(each))]
    for element, meant in found:
        edits = _of_kind(element, meant) if element.get("site") and meant in SITED else ()
        says = f"Its name speaks of a <{meant}>, and it is a <{element.tag}>."
        probe = counted("sensors of another kind than their name says", len(found))
        name = f'sensor "{element.get("name")}"'
        yield Suspect((name,), "", f"<{element.tag}>", f"<{meant}>", edits, probe, 0, says, at=element)


def _lying(model: ReaderModel) -> Iterator[Suspect]:
    """Each upward axis that lies at the start, beside one that points up."""
    of = model.simulation
    for sensor, name in enumerate(of.names("sensor")):
        element = model.element("sensor", sensor)
        if element is None or element.tag not in AXES or not UP.search(name) or element.get("refname"):
            continue
        of.begin()
        kind, index = element.get("objtype"), int(of.model("sensor_objid")[sensor])
        field = {"site": "site_xmat", "body": "xmat", "xbody": "xmat", "geom": "geom_xmat"}.get(kind, "")
        heights = of.data_row(field, index, 9)[6:] if field and kind != "body" else ()
        own = heights[AXES.index(element.tag)] if heights else 1.0
        if own > LYING or max(heights) < 1 - LYING / 5:
            continue
        meant = AXES[max(range(3), key=lambda axis: heights[axis])]
        edits = _of_kind(element, meant)
        says = f"At the start its axis is at {own:.2g} of upright, and that of a <{meant}> at {max(heights):.2g}."
        probe = counted("upward axes that lie at the start", 1)
        said = (of.name("sensor", sensor),)
        yield Suspect(said, "", f"<{element.tag}>", f"<{meant}>", edits, probe, 0, says, at=element)


def _unlike_sisters(model: ReaderModel) -> Iterator[Suspect]:
    """The sensors of another kind than those that are called alike and read what is called alike."""
    for some in _sisters(model):
        (usual, times), *_ = Counter(each.tag for each in some).most_common(1)
        odd = [each for each in some if each.tag != usual]
        alone = len(odd) == 1 and times > 1
        if not alone and len(some) > 2:
            continue
        told = odd if alone else some
        names = tuple(f'sensor "{each.get("name")}"' for each in told)
        now, value = f"<{told[0].tag}>", f"<{usual}>" if alone else ""
        other = next(each for each in some if each.tag != told[0].tag)
        says = f'It is a <{told[0].tag}>, and "{other.get("name")}", which reads what is called alike, a <{other.tag}>.'
        edits, probe = _of_kind(odd[0], usual) if alone else (), _apart(len(odd))
        yield Suspect(names, "", now, value, edits, probe, 0, says, at=told[0], level="hint")


def _apart(count: int) -> Probe:
    return counted("sensors of another kind than those that are called alike", count)


def _sisters(model: ReaderModel) -> Iterator[list[Element]]:
    """Sensors of two kinds and more whose names differ by a word, by which the names of what they read do too."""
    made: dict[tuple[str, ...], dict[str, Element]] = {}
    for each in model.source.section("sensor") if model.source else ():
        attribute = next((name for name in READ if each.get(name)), "")
        words, read = WORD.findall(each.get("name")), WORD.findall(each.get(attribute))
        for word in {*words} & {*read}:
            key = (each.get("objtype"), attribute, *("*" if some == word else some for some in (*words, "", *read)))
            made.setdefault(key, {})[word] = each
    seen = set[str]()
    for group in made.values():
        some = list(group.values())
        if len({each.tag for each in some}) > 1 and not seen & {each.get("name") for each in some}:
            seen |= {each.get("name") for each in some}
            yield some


def _of_kind(element: Element, kind: str) -> tuple[Edit, ...]:
    """The edit that makes a sensor one of another kind that is written alike."""
    attributes = "".join(f' {name}="{value}"' for name, value in element.attributes.items())
    return (replace(element, f"<{kind}{attributes}/>"),) if not set(attributes) & set("&<") else ()


def _meant(sensor: Element) -> str:
    """The kind that a sensor's name says, where it is of another; empty where it says none, or several."""
    name = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", sensor.get("name"))
    own = next((words for kind, words in OWN.items() if sensor.tag.startswith(kind)), "")
    if own and re.search(own, name, re.IGNORECASE):
        return ""
    said = [kinds for words, kinds in WORDS.items() if words.search(name)]
    return said[0][0] if len(said) == 1 and sensor.tag in KINDS and sensor.tag not in said[0] else ""
