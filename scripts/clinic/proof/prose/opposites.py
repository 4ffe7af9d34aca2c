"""Law 5, opposites: words that contradict an id, a path, an attribute's value or an index."""

from __future__ import annotations

import re
from collections.abc import Iterator

from clinic.engine.quotation import QUOTATION, QuotationError, quotation
from clinic.engine.signals import parse_path
from clinic.proof.evidence import Evidence
from clinic.proof.prose.signals import beside
from clinic.proof.prose.titles import VALUES
from clinic.proof.prose_laws import prose_of
from clinic.record.case import Case
from clinic.record.problem import Problem
from clinic.record.prose import FIELD, bare
from clinic.record.signal import PathSignal
from clinic.record.yaml_lines import Where

OPPOSITES = (
    ("before|first|earl(?:y|ier)", "after|last|late(?:r)?"),
    ("up|upwards?|rais\\w*|higher|lift\\w*", "down|downwards?|lower\\w*|sunk|drop\\w*"),
    ("upper", "lower"),
    ("left", "right"),
    ("large(?:r|st)?|greatest|max\\w*", "small(?:er|est)?|least|min\\w*"),
    ("long(?:er|est)?", "short(?:er|est)?"),
    ("fast(?:er|est)?|quick\\w*", "slow(?:er|est|ly)?"),
    ("heav(?:y|ier)", "light(?:er)?"),
    ("thick(?:er)?", "thin(?:ner)?"),
    ("stiff(?:er|en)?", "soft(?:er|en)?"),
    ("near(?:er)?|close(?:r)?", "far|further|farther"),
    ("more|increas\\w*|twice|double\\w*", "less|fewer|decreas\\w*|half|halve\\w*"),
    ("empty", "full"),
    ("single", "double"),
    ("on|enabled?", "off|disabled?"),
    ("weak(?:er)?", "strong(?:er)?"),
    ("rough(?:er)?", "smooth(?:er)?"),
    ("in|inside|into", "out|outside"),
    ("true", "false|reported"),
    ("sine", "cosine"),
    ("horizontal\\w*", "vertical\\w*"),
)
"""Words of which one denies the other."""
DEGREE = re.compile(r"\b(?:half|twice|times) as \w+")
ORDINALS = {"first": 0, "second": 1, "third": 2, "fourth": 3}
ORDINAL = re.compile(rf"\b({'|'.join(ORDINALS)}) (number|column|row|entry|component|one)\b", re.IGNORECASE)
AXIS = re.compile(
    r"\b([xyz])(?:'s)? (?:component|coordinate|part)\b|\b(?:along|of) (?:the world's )?([xyz])(?: axis)?\b"
    r"|\b(vertical)\b"
)
PRINTED = re.compile(r"printed\(")
ROWS = ("xmat", "frame", "mat")
VECTORS = ("xpos", "xipos", "pos", "ipos", "xanchor", "xaxis", "gravity")


def opposed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, opposites. A title does not say the opposite of its id, nor a label that of its name or path."""
    record = case.record
    told: list[tuple[Where, str, str]] = []
    for kind in ("fixes", "refuted", "trials"):
        told += [((kind, k, "title"), one.title, one.id) for k, one in enumerate(getattr(record, kind))]
    for name, signal in record.signals.items():
        source = signal.path if isinstance(signal, PathSignal) else ""
        told.append((("signals", name, "label"), signal.label, f"{name} {source}"))
    for name, sweep in record.sweep.items():
        told.append((("sweep", name, "prediction", "label"), sweep.prediction.label, sweep.prediction.expr))
    for where, text, known in told:
        for word, other in _contradictions(text, known):
            wanted = f"nothing that denies {other!r}, which its id, name or path says"
            yield case.problem(where, f"{word}: {text}", wanted, "correct one of them", text)


def valued(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, values. A sentence that quotes `angle="radian"` says radians, not degrees."""
    for where, text in prose_of(case):
        for sentence in re.split(r"(?<=[.?!;])\s|\n[ \t]*\n", text):
            for field in FIELD.finditer(sentence):
                match = QUOTATION.fullmatch(field[1].partition("|")[0])
                try:
                    shown = quotation(case, match) if match else ""
                except QuotationError:  # told where the prose is filled
                    continue
                words = bare(sentence)
                for group in VALUES:
                    own = [value for value in group if f'"{value}"' in shown]
                    said = [value for value in group if re.search(rf"\b{value}s?\b", words, re.IGNORECASE)]
                    if own and said and own[0] not in said:
                        yield case.problem(where, said[0], f"{own[0]}, which {shown} says", "correct it", said[0])


def indexed(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, components. *Third number*, *z component*, *vertical*: the signal's path has that index."""
    for name, signal in case.record.signals.items():
        if isinstance(signal, PathSignal):
            for word in _misplaced(signal, signal.label):
                wanted, repair = f"the component that {signal.path} is", "correct the label or the path"
                yield case.problem(("signals", name, "label"), f"{word}: {signal.label}", wanted, repair)
    yield from _columns(case)
    for where, text in prose_of(case):
        for paragraph in re.split(r"\n[ \t]*\n", text):
            for field in FIELD.finditer(paragraph):
                parts = field[1].partition("|")[0].strip().split(".")
                read = case.record.signals.get(parts[1]) if len(parts) == 3 else None
                if isinstance(read, PathSignal) and parts[0] in evidence.variants:
                    for word in _misplaced(read, beside(paragraph, field)):
                        wanted, repair = f"the component that {read.path} is", "correct the words or the field"
                        yield case.problem(where, f"{word}, before {field[0]}", wanted, repair, field[0])


def _columns(case: Case) -> Iterator[Problem]:
    """Labels that call different columns of one matrix alike: *y component of the image's up*, *z component of ...*."""
    known: dict[tuple[str, str], int] = {}
    for name, signal in case.record.signals.items():
        told = re.search(r"(?:component|part) of (.*?)(?: along .*)?$", signal.label)
        path = parse_path(signal.path) if isinstance(signal, PathSignal) and not PRINTED.match(signal.path) else None
        if told is None or path is None or path.field.rpartition(".")[2] not in ROWS or not path.index:
            continue
        column = path.index[-1] // 3 if path.field == "frame" else path.index[-1] % 3
        key = (f"{path.kind} {path.name} {path.field}", told[1])
        if known.setdefault(key, column) != column:
            wanted, repair = f"another column than column {known[key]} is called", "correct the label or the path"
            yield case.problem(("signals", name, "label"), signal.label, wanted, repair)


def _contradictions(text: str, known: str) -> Iterator[tuple[str, str]]:
    """Words of a text with the words of another that they deny, where it has not the same word itself."""
    sides = [DEGREE.sub("", " ".join(re.findall(r"[a-z]+", each.lower()))) for each in (text, known)]
    for pair in OPPOSITES:
        for here, there in (pair, pair[::-1]):
            said, other = re.search(rf"\b(?:{here})\b", sides[0]), re.search(rf"\b(?:{there})\b", sides[1])
            both = re.search(rf"\b(?:{here})\b", sides[1]) or re.search(rf"\b(?:{there})\b", sides[0])
            if said and other and not both:
                yield said[0], other[0]


def _misplaced(signal: PathSignal, words: str) -> Iterator[str]:
    """Ordinals and axes of which the signal's path has another."""
    path = None if PRINTED.match(signal.path) else parse_path(signal.path)
    words = " ".join(words.split())
    if path is None or not path.index:
        return
    field, index = path.field.rpartition(".")[2], path.index[-1]
    row, column = (index // 3, index % 3) if field in ROWS and field != "frame" else (index % 3, index // 3)
    for found in list(ORDINAL.finditer(words))[-1:]:
        place = {"column": column, "row": row}.get(found[2].lower(), index)
        if found[2].lower() != "one" and ORDINALS[found[1].lower()] != place:
            yield found[0]
    if field in ROWS or field in VECTORS:
        for found in list(AXIS.finditer(words))[-1:]:
            letter = "z" if found[3] else found[1] or found[2]
            if "xyz".index(letter) != row:
                yield found[0]
