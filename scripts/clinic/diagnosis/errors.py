"""A model that does not compile: what MuJoCo says against it is mended, one message after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from clinic.diagnosis.edit import Edit, apply
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.judge import Judged, suspects_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import Rule
from clinic.diagnosis.simulation import Start
from clinic.diagnosis.source import read_source
from clinic.diagnosis.suspect import Suspect

MOST = 12  # messages

Change = tuple[str, int, int, int]  # a file, where a change begins, and where it ended before and ends after it


def mended(
    model: ReaderModel, tried: Iterable[Rule], tell: Callable[[str], None]
) -> tuple[list[Judged], Mapping[str, str]]:
    """The faults in the order in which MuJoCo names them, and the texts as far as they could be mended."""
    rules, found, changes = list(tried), list[Judged](), list[Change]()
    for _ in range(MOST):
        if not model.error:
            break
        best: tuple[Rule, Suspect] | None = None
        for rule in rules:
            tell(rule.id)
            for suspect in suspects_of(model, rule, tell):
                if not suspect.edits:
                    found.append(Judged(rule, suspect, "hint", 1.0, None))
                elif not isinstance(made := model.with_edits(suspect.edits), CompileError):
                    best = (rule, suspect)
                    break
                elif best is None and _further(model.error, str(made), suspect):
                    best = (rule, suspect)
            if best and not isinstance(model.with_edits(best[1].edits), CompileError):
                break
        if best is None:
            break
        rule, suspect = best
        written = tuple(_as_written(each, changes) for each in suspect.edits)
        found.append(Judged(rule, replace(suspect, edits=written), "cause", 1.0, 0.0))
        texts = apply(model.texts, suspect.edits)
        changes += _changes(model.texts, suspect.edits)
        model = ReaderModel(model.engine, texts, read_source(texts), Start())
    return found, model.texts


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


def _as_written(each: Edit, changes: Sequence[Change]) -> Edit:
    """An edit of texts that were changed, at its place in the reader's own."""

    def back(place: int) -> int:
        for file, start, before, after in reversed(changes):
            if file == each.file and place >= after:
                place += before - after
            elif file == each.file and place > start:
                place = start
        return place

    return replace(each, start=back(each.start), head_end=back(each.head_end), end=back(each.end))


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
