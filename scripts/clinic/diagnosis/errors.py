"""A model that does not compile: what MuJoCo says against it is mended, one message after the other."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from clinic.diagnosis.edit import Edit, apply, edit
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.judge import Judged, suspects_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import Rule
from clinic.diagnosis.source import Element, read_source
from clinic.diagnosis.stand_ins import StandIns
from clinic.diagnosis.start import Start
from clinic.diagnosis.suspect import Suspect

MOST, LIMIT = 60, 15.0  # messages, s
OF_FILES = {"missing-file", "unusable-file"}
LAST = "refused-element"  # what only takes an element out is tried where no other rule knows better

Change = tuple[str, int, int, int]  # a file, where a change begins, and where it ended before and ends after it


def mended(
    model: ReaderModel, tried: Iterable[Rule], tell: Callable[[str], None]
) -> tuple[list[Judged], ReaderModel, Callable[[Suspect], Suspect]]:
    """The faults in the order in which MuJoCo names them, and the model as far as it could be mended.

    The third gives what is suspected in that model its place in the reader's own text.

    Where files cannot be read, boxes stand in for them in all that follows (`stand_ins`).
    """
    rules, found, changes = sorted(tried, key=lambda rule: rule.id == LAST), list[Judged](), list[Change]()
    written = dict(model.texts)
    until = time.monotonic() + LIMIT
    for _ in range(MOST):
        if not model.error or time.monotonic() > until:
            break
        best, hints = _best(model, rules, tell)
        if best is None:
            stand_ins = StandIns(model.engine)
            filled = ReaderModel(stand_ins, model.texts, model.source, Start(), model.symptom)
            goes_on = bool(stand_ins.absent) and {rule.id for rule, _ in hints} <= OF_FILES and bool(hints)
            if goes_on and len(stand_ins.absent) > 1:
                more = f" So it is with {len(stand_ins.absent) - 1} more."
                hints = [(rule, replace(each, says=each.says + more)) for rule, each in hints[:1]]
            found += [Judged(rule, _placed(each, changes, written), "hint", 1.0, None) for rule, each in hints]
            if not goes_on:
                break
            model = filled
            continue
        rule, suspect = best
        found.append(Judged(rule, _placed(suspect, changes, written), "cause", 1.0, 0.0))
        texts = apply(model.texts, suspect.edits)
        changes += _changes(model.texts, suspect.edits)
        model = ReaderModel(model.engine, texts, read_source(texts), Start(), model.symptom)
    return found, model, lambda suspect: _placed(suspect, changes, written)


def _best(
    model: ReaderModel, rules: Iterable[Rule], tell: Callable[[str], None]
) -> tuple[tuple[Rule, Suspect] | None, list[tuple[Rule, Suspect]]]:
    """The suspect whose edits make the model compile, or else the first with which MuJoCo comes further; the hints."""
    best, hints = None, list[tuple[Rule, Suspect]]()
    for rule in rules:
        if rule.id == LAST and (best or hints):
            break
        tell(rule.id)
        for suspect in suspects_of(model, rule, tell):
            if not suspect.edits:
                hints.append((rule, suspect))
            elif not isinstance(made := model.with_edits(suspect.edits), CompileError):
                return (rule, suspect), hints
            elif best is None and _further(model.error, str(made), suspect):
                best = (rule, suspect)
    return best, hints


def _placed(suspect: Suspect, changes: Sequence[Change], texts: Mapping[str, str]) -> Suspect:
    """A suspect in texts that were changed, at its place in the reader's own."""
    edits = tuple(_as_written(each, changes, texts) for each in suspect.edits)
    if suspect.at is None:
        return replace(suspect, edits=edits)
    at = _as_written(edit(suspect.at, "delete"), changes, texts)
    return replace(suspect, edits=edits, at=Element(at.element, at.file, at.line, {}, start=at.start))


def _changes(texts: Mapping[str, str], edits: Sequence[Edit]) -> list[Change]:
    """Where edits change bytes of the texts, one after the other from the end."""
    made = list[Change]()
    for each in sorted(dict.fromkeys(edits), key=lambda each: each.start, reverse=True):
        after = apply(texts, [each])
        one, other = texts[each.file].encode(), after[each.file].encode()
        same = _alike(one, other)
        end = _alike(one[same:][::-1], other[same:][::-1])
        made.append((each.file, same, len(one) - end, len(other) - end))
        texts = after
    return made


def _alike(one: bytes, other: bytes) -> int:
    """How many bytes at the beginning are the same."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((place for place, (a, b) in pairs if a != b), min(len(one), len(other)))


def _as_written(each: Edit, changes: Sequence[Change], texts: Mapping[str, str]) -> Edit:
    """An edit of texts that were changed, at its place in the reader's own."""

    def back(place: int) -> int:
        for file, start, before, after in reversed(changes):
            if file == each.file and place >= after:
                place += before - after
            elif file == each.file and place > start:
                place = start
        return place

    start = back(each.start)
    line = texts[each.file].encode()[:start].count(b"\n") + 1 if changes else each.line
    return replace(each, line=line, start=start, head_end=back(each.head_end), end=back(each.end))


def _further(before: str, after: str, suspect: Suspect) -> bool:
    """Whether MuJoCo now says something else, and not against the edit."""
    if before == after:
        return False
    phases = [_phase(each) for each in (before, after)]
    values = [each.value for each in suspect.edits if each.value]
    return phases[1] > phases[0] or (phases[1] == phases[0] and not any(f"'{value}'" in after for value in values))


def _phase(message: str) -> int:
    """Reading the XML comes before its schema, and that before the model."""
    return 0 if message.startswith("XML parse") else 1 if message.startswith("XML") else 2
