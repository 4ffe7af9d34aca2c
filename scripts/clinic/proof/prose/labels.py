"""Law 5, names: a label names the elements that its signal reads, a title those that its edits change."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from xml.etree import ElementTree

from clinic.engine.quotation import attributes
from clinic.engine.variant import variants
from clinic.proof.evidence import Evidence
from clinic.record.case import Case
from clinic.record.expression import names, parse
from clinic.record.problem import Problem, listed
from clinic.record.signal import ExpressionSignal, PathSignal

NAMED = re.compile(r"\(([^)]*)\)")
ARITHMETIC = {"minus": ast.Sub, "plus": ast.Add, "ratio": ast.Div, "divided by": ast.Div, "share": ast.Div}
TINY = 1e-12
SIZED = re.compile(r"\.size\b")
HALF = re.compile(r"\b(?:half|radius|size)\b")
PRINTED = re.compile(r"printed\((.*)\)")


def labelled(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, labels. A label names no element that its signal does not read; sizes are halves, units those printed."""
    output = evidence.variants["broken"].output or ""
    known = {word for name in elements(case.text) for word in words_in(name)} if case.record.run else set()
    for name, signal in case.record.signals.items():
        read = _read(case, name)
        told = [word for word in words_in(signal.label) if word in known]
        if read and set(told) - read:
            expected = f"an element that it reads: {listed(sorted(read))}"
            yield case.problem(("signals", name, "label"), signal.label, expected, "correct the label or the path")
        if isinstance(signal, PathSignal) and SIZED.search(signal.path) and not HALF.search(signal.label):
            expected, repair = "a half, or a radius, as sizes in MJCF are", "correct the label"
            yield case.problem(("signals", name, "label"), signal.label, expected, repair)
        shown = PRINTED.fullmatch(signal.path) if isinstance(signal, PathSignal) else None
        lines = re.findall(rf"^{re.escape(shown[1])} = \S+ ?(.*)$", output, re.MULTILINE) if shown else []
        if lines and lines[0] and _plain(lines[0]) != _plain(signal.unit):
            expected = f"the unit that is printed: {lines[0]}"
            yield case.problem(("signals", name, "unit"), signal.unit or "no unit", expected, "correct one of them")


def computed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, arithmetic. A label that says *mean of*, *minus*, *ratio*, ... is of an expression that computes it."""
    for name, signal in case.record.signals.items():
        if not isinstance(signal, ExpressionSignal):
            continue
        tree = parse(signal.expr)
        used = {type(node.op) for node in ast.walk(tree) if isinstance(node, ast.BinOp)}
        said = [word for word in ARITHMETIC if re.search(rf"\b{word}\b", signal.label)]
        lacking = [word for word in said if ARITHMETIC[word] not in used]
        if signal.label.startswith("mean of") and not all(
            _between(tree, name, each.values) for each in evidence.variants.values()
        ):
            lacking.append("mean of")
        if lacking:
            wanted = f"arithmetic of which {lacking[0]!r} can be said"
            repair = "correct the label or the expression"
            yield case.problem(("signals", name, "expr"), f"{signal.label}: {signal.expr}", wanted, repair)


def _between(tree: ast.expr, name: str, values: Mapping[str, Mapping[str, float | None]]) -> bool:
    """Whether an expression's last value lies between those of the signals that it reads."""
    parts, own = [values[part].get("final") for part in names(tree)], values[name].get("final")
    known = [part for part in parts if part is not None]
    return own is None or not known or min(known) - TINY <= own <= max(known) + TINY


def entitled(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, titles. Where the title of a remedy names elements, its edits change one of them or what is in it."""
    if case.record.run is None:
        return
    broken, *others = variants(case)
    known = {word for name in elements(broken.text) for word in words_in(name)}
    for variant in others:
        told = {word for word in words_in(variant.title) if word in known}
        changed = {word for name in changed_names(broken.text, variant.text) for word in words_in(name)}
        if told and changed and not told & changed:
            expected = f"an element that it changes: {listed(sorted(changed))}"
            yield case.problem((*variant.where, "title"), variant.title, expected, "correct the title or the edits")


def _read(case: Case, name: str) -> set[str]:
    """The words for what a signal reads: of the elements in its paths, those around and in them, and of the signals."""
    signal = case.record.signals.get(name)
    if isinstance(signal, ExpressionSignal):
        parts = [_read(case, each) for each in names(parse(signal.expr)) if each in case.record.signals]
        return {word for part in parts for word in part}.union(words_in(name)) if any(parts) else set()
    found = NAMED.findall(signal.path) if isinstance(signal, PathSignal) and case.record.run else []
    named = {one.strip() for part in found for one in part.split(",")}
    around = {word for each in named for word in related(case.text, each)}
    return {word for each in around for word in words_in(each)}.union(words_in(name)) if named else set()


def related(xml: str, name: str) -> set[str]:
    """The name of an element, of what is around and in its body, and of what it refers to."""
    root, made = ElementTree.fromstring(xml), {name}
    for body in root.iter("body"):
        if name in {one.get("name") for one in body.iter()}:
            own = {body.get("name", "")} | {one.get("name", "") for one in body if one.tag != "body"}
            made |= own if name in own else {body.get("name", "")}
    for part in ("actuator", "sensor"):
        made |= {
            value for one in root.iterfind(part + "/*") if one.get("name") == name for value in one.attrib.values()
        }
    return made


def elements(xml: str) -> dict[str, list[str]]:
    """Every named element's tag and the names of the bodies around it."""
    made: dict[str, list[str]] = {}

    def visit(element: ElementTree.Element, above: list[str]) -> None:
        own = element.get("name")
        if own is not None and element.tag not in ("texture", "material", "light"):
            made.setdefault(own, []).extend([element.tag, *above])
        for child in element:
            visit(child, [*above, own] if own is not None else above)

    visit(ElementTree.fromstring(xml), [])
    return made


def changed_names(before: str, after: str) -> set[str]:
    """The names of the elements of which an attribute differs, and those of the bodies that they are in."""
    made = set()
    for name, (tag, *around) in {**elements(before), **elements(after)}.items():
        tags = {tag, *around} & {"body", "geom", "joint", "freejoint", "camera", "site", "position", "motor", "general"}
        if any(attributes(before, each, name) != attributes(after, each, name) for each in tags):
            made |= {name, *(each for each in around if each not in tags)}
    return made


def words_in(text: str) -> list[str]:
    """The words of a text in small letters, without the *s* of the plural."""
    return [word.removesuffix("s") for word in re.findall(r"[a-z]+", text.lower().replace("'s", ""))]


def _plain(unit: str) -> str:
    return unit.strip().replace("²", "2").replace("^", "").replace("°", "deg")
