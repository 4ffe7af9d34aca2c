"""What prose quotes: an attribute of a named element in a variant's text, and MuJoCo's own default of one."""

from __future__ import annotations

import re
from collections.abc import Iterator
from xml.etree import ElementTree

import mujoco
import numpy as np

from clinic.engine.variant import variants
from clinic.record.case import Case
from clinic.record.problem import listed

UNNAMED = ("option", "compiler", "flag", "statistic", "map")
QUOTATION = re.compile(
    rf"\s*(?P<variant>[a-z][a-z0-9-]*)\.(?:(?P<tag>[a-z]+)\((?P<name>[^)]*)\)|(?P<alone>{'|'.join(UNNAMED)}))"
    r"\.(?P<attributes>[a-z0-9_]+(?: [a-z0-9_]+)*)\s*"
)
SERVO = (
    '<mujoco><worldbody><body><joint name="a"/><geom size="1"/></body></worldbody>'
    '<actuator><position joint="a"/></actuator></mujoco>'
)
Element = ElementTree.Element


class QuotationError(ValueError):
    """A quotation of what is not there: what was found, expected, and the repair."""

    def __init__(self, found: str, expected: str) -> None:
        self.found, self.expected, self.repair = found, expected, "correct the field"
        super().__init__(found, expected)


def quotation(case: Case, match: re.Match[str]) -> str:
    """The attributes that a field such as `broken.geom(cube).priority` names, as they are written: `priority="2"`.

    Raises:
        QuotationError: If the variant, the element or an attribute does not exist.
    """
    texts = {variant.id: variant.text for variant in variants(case)}
    if match["variant"] not in texts or case.record.run is None:
        raise QuotationError(f"{match['variant']} is no variant that has elements", listed(texts, 20))
    tag, name = match["tag"] or match["alone"], match["name"]
    written = attributes(texts[match["variant"]], tag, name)
    for wanted in match["attributes"].split():
        if wanted not in written:
            element = tag if name is None else f"{tag}({name})"
            raise QuotationError(f"{wanted}, which {element} of {match['variant']} does not have", listed(written, 30))
    return " ".join(f'{wanted}="{written[wanted]}"' for wanted in match["attributes"].split())


def attributes(xml: str, tag: str, name: str | None) -> dict[str, str]:
    """What is written of an element: its own attributes, and those of its default classes; empty if there is none."""
    root = ElementTree.fromstring(xml)
    parents = {child: parent for parent in root.iter() for child in parent}
    for element in root.iter(tag):
        above = list(_above(element, parents))
        if element.get("name") == name and not any(parent.tag == "default" for parent in above):
            given = (parent.get("childclass") for parent in above)
            chosen = element.get("class") or next(filter(None, given), None)
            return {**_defaults(root, parents, chosen, tag), **element.attrib}
    return {}


def engine_default(path: str) -> str:
    """MuJoCo's default, as `geom.solref` or `visual.map.zfar`, from an empty model: `0.02 1`.

    Raises:
        QuotationError: If there is none.
    """
    if path == "position.kp":  # no field of the specification: the gain of an actuator that is given none
        return f"{mujoco.MjModel.from_xml_string(SERVO).actuator_gainprm[0, 0]:g}"
    spec = mujoco.MjSpec()
    first, *rest = path.split(".")
    value: object = getattr(spec.default, first, None) or getattr(spec, first, None)
    for part in rest:
        value = getattr(value, part, None)
    try:
        numbers = np.atleast_1d(np.asarray(value, float))
    except (TypeError, ValueError):
        raise QuotationError(f"default.{path}", "a number of an empty model: default.geom.contype") from None
    if not rest or np.isnan(numbers).any():
        raise QuotationError(f"default.{path}", "a number of an empty model: default.geom.contype")
    return " ".join(f"{number:g}" for number in numbers)


def _defaults(root: Element, parents: dict[Element, Element], chosen: str | None, tag: str) -> dict[str, str]:
    """What the default classes say of such elements, an inner class over the one around it."""
    classes = list(root.iter("default"))
    node = next((one for one in classes if chosen and one.get("class") == chosen), None) or next(iter(classes), None)
    chain = [] if node is None else [node, *(one for one in _above(node, parents) if one.tag == "default")]
    made: dict[str, str] = {}
    for one in reversed(chain):
        made |= {key: value for child in one.findall(tag) for key, value in child.attrib.items()}
    return made


def _above(element: Element, parents: dict[Element, Element]) -> Iterator[Element]:
    while element in parents:
        element = parents[element]
        yield element
