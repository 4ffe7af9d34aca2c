"""What a path and an edit tell by themselves: labels and titles in such words need nothing that shows them."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from xml.etree import ElementTree

from clinic.engine.variant import Variant, variants
from clinic.proof.prose.labels import NAMED, PRINTED, changed_names, related, words_in
from clinic.proof.prose.titles import ACTS, CODE_NAME, changed_attributes
from clinic.record.case import Case
from clinic.record.signal import PathSignal

FIELDS = (
    (r"\.xpos\[0\]", "x place along"),
    (r"\.xpos\[1\]", "y place along"),
    (r"\.x?i?pos\[2\]", "z height"),
    (r"^joint\(\w+\)\.qpos\[0\] rad", "angle"),
    (r"^joint\(\w+\)\.qvel\[0\] rad/s", "speed velocity"),
    (r"^joint\(\w+\)\.qacc\[0\] rad/s²", "angular acceleration"),
    (r"^joint\(\w+\)\.qvel\[2\] m/s", "upward upwards speed"),
    (r"^actuator\(\w+\)\.ctrl", "target control servo"),
    (r"^actuator\(\w+\)\.force\[0\] N m", "torque servo motor"),
    (r"^actuator\(\w+\)\.force\[0\] N$", "force"),
    (r"^actuator\(\w+\)\.length", "length servo"),
    (r"\.range\[0\]", "lower end limit range"),
    (r"\.range\[1\]", "upper end limit range"),
    (r"\.forcerange\[1\]", "upper end force range servo"),
    (r"\.gainprm\[0\]", "gain servo"),
    (r"\.gear\[0\]", "gear servo motor"),
    (r"\.solref\[0\]", "time constant"),
    (r"\.solimp\[1\]", "impedance"),
    (r"\.friction\[0\]", "friction"),
    (r"^contact\(.*\)\.dim", "dimensions"),
    (r"^contact\(.*\)\.count|^ncon", "number"),
    (r"^contact\(.*\)\.(?:friction|dim|count)|^ncon", "contact"),
    (r"^contact\(.*\)\.dist", "distance"),
    (r"^sensor\(", "reading sensor"),
    (r"^time\b", "data time"),
    (r"^warning\(", "warnings"),
)
"""Patterns of a path with its unit, and words that tell no more than they do; a field's own name does so too."""


def words(text: str) -> frozenset[str]:
    """The words of a text, as `words_in` gives them."""
    return frozenset(words_in(text))


SMALL = words("the a an of and at to by with in it times")
NUMBERS = words("half halve double twice two three four five ten twenty quarter")
VERBS = words("make take give raise divide choose use call step more shorter lighter integrate integrator cone ms")


def plain_label(case: Case, name: str) -> bool:
    """Whether a signal's label has no words but those of its path: of its field, and of the elements that it reads."""
    signal = case.record.signals[name]
    if not isinstance(signal, PathSignal):
        return False
    said = words(signal.label) - SMALL
    if shown := PRINTED.fullmatch(signal.path):
        return said <= words(shown[1])
    read = f"{signal.path} {signal.unit}"
    known = words(" ".join(told for pattern, told in FIELDS if re.search(pattern, read)))
    field = re.search(r"(\w+)(?:\[\d+\])*$", signal.path)
    own = words(field[1]) if field and signal.path.startswith("model.") else frozenset()
    named = [one.strip() for part in NAMED.findall(signal.path) for one in part.split(",")]
    return said <= known | own | _all(each for one in named for each in related(case.text, one))


def plain_title(case: Case, variant: Variant) -> bool:
    """Whether a remedy's title has no words but those that other laws hold against its edits.

    These are numbers, code that the edits write, elements that they change, and acts on an attribute that they change.
    """
    broken, title = variants(case)[0], CODE_NAME.sub("", variant.title)
    said = words(title) - SMALL - NUMBERS - VERBS
    attributes = changed_attributes(broken, variant)
    acted = {
        word
        for pattern, parts in ACTS
        if any(part in attribute for part in parts.split() for attribute in attributes)
        for word in said
        if re.match(pattern, word)
    }
    there = (
        _all(changed_names(broken.text, variant.text)) | _tags(broken.text, variant.text) if case.record.run else set()
    )
    return said <= acted | _all(attributes) | there


def printed_labels(code: str) -> Iterator[str]:
    """What a program in Python writes beside its numbers, each number as `{}`, flat; of two words and more.

    A line `name = value` is left out: a signal reads it by its name. So are docstrings, and texts of XML.
    """
    tree = ast.parse(code)
    inside = {id(part) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in ast.walk(node)}
    inside |= {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            parts = (part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
            text = "".join(map(str, parts))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in inside:
            text = node.value
        else:
            continue
        if len(re.findall(r"[A-Za-z_.]{2,}", text)) > 1 and not re.search(r"^[\w ,()-]+ = \{\}|=\"|<", text):
            yield " ".join(text.split())


def _tags(before: str, after: str) -> set[str]:
    """The tags of elements that differ, where none is new."""
    pair = [list(ElementTree.fromstring(text).iter()) for text in (before, after)]
    if len(pair[0]) != len(pair[1]):
        return set()
    return {one.tag for one, other in zip(*pair, strict=True) if one.attrib != other.attrib}


def _all(texts: Iterable[str]) -> set[str]:
    return {word for each in texts for word in words_in(each)}
