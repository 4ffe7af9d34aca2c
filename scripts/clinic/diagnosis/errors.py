"""A model that does not compile: what MuJoCo says against it is mended, one message after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from clinic.diagnosis.edit import apply
from clinic.diagnosis.engine import CompileError
from clinic.diagnosis.judge import Judged, suspects_of
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import Rule
from clinic.diagnosis.simulation import Start
from clinic.diagnosis.source import read_source
from clinic.diagnosis.suspect import Suspect

MOST = 12  # messages


def mended(
    model: ReaderModel, tried: Iterable[Rule], tell: Callable[[str], None]
) -> tuple[list[Judged], Mapping[str, str]]:
    """The faults in the order in which MuJoCo names them, and the texts as far as they could be mended."""
    rules, found = list(tried), list[Judged]()
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
        found.append(Judged(*best, "cause", 1.0, 0.0))
        texts = apply(model.texts, best[1].edits)
        model = ReaderModel(model.engine, texts, read_source(texts), Start())
    return found, model.texts


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
