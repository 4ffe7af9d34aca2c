"""Law 5, signals: the words beside a number are those of the signal that it is taken from."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from clinic.proof.prose_laws import ELSEWHERE, prose_of
from clinic.proof.trials import checks_in
from clinic.record.case import Case
from clinic.record.problem import Problem, listed
from clinic.record.prose import FIELD
from clinic.record.signal import Signal

if TYPE_CHECKING:
    from clinic.proof.evidence import Evidence

SMALL = "the of a an in on at to and by from it is one that are as with for than through both all its"
SAME = 1e-3
POINTS = r"\}\} of$|^(?:At|Over|In|With)$"
SAID = (  # of a sweep's numbers: what stands before or after, and what it is said of
    (r"\bwrong (?:for|at)$", None, ("wrong",)),
    (POINTS, r"(?!at |off|or |of |from )[a-z]+s\b", ("points", "judged")),
    (r"\b(?:within|difference is|at most)$", None, ("worst",)),
)
CLEAR = 0.4  # by which all words of another's label have to fit better, where its first words do not
NAMED = {
    "max": "largest",
    "min": "smallest",
    "first": "first",
    "mean": "mean",
    "span": "range",
    "onset": "time of change",
}
TOLD = {
    "max": (
        r"\b(?:never|at most|highest|larg|great|longest|up to|grow|more than|exceed|"
        r"ris|above|arriv|fast|deep|peak|reach|as far|leaves|overshoot|jump|worst)"
    ),
    "min": r"\b(?:low|small|at least|below|least|fall|short|down to)",
    "first": r"\b(?:first|start|beg[iau]n|real time|before)",
    "mean": r"\b(?:mean|average)",
    "span": r"\b(?:by|range|sway|swing|mov|travel)",
    "onset": r"\b(?:after|beg[iau]n|until|since|onset)",
}
ALWAYS = ("first", "mean", "onset")  # numbers that words tell, whatever checks and other fields take
WHOLE = re.compile(r".+")
HEAD = re.compile(r"^(?:(?! of | from | along |, ).)+")  # *weight* of *weight of the cube*
OTHER = re.compile(r"\{\{ *(?:" + "|".join(ELSEWHERE) + r")\b.*?\}\}", re.DOTALL)
ENDING = re.compile(r"(?<=\w{3})(?:ing|ed|es|s|e)$")


def called(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, which signal. Its label, name and `said` have more words in common with those beside it than any other's.

    A word that several signals share counts by as much less. Where none has a word there, nothing is asked of grade B.
    """
    own = {name: words_of(name, signal) for name, signal in case.record.signals.items()}
    heads = {name: words_of(name, signal, HEAD) for name, signal in case.record.signals.items()}
    shared = Counter(word for words in own.values() for word in words)
    for where, text in prose_of(case):
        for paragraph in re.split(r"\n[ \t]*\n", text):
            for field in FIELD.finditer(paragraph):
                variant, _, rest = field[1].partition("|")[0].strip().partition(".")
                name = rest.partition(".")[0]
                if variant not in evidence.variants or name not in own:
                    continue
                near = words(beside(paragraph, field))
                whole, part = (
                    {each: sum(1 / shared[word] for word in known[each] & near) for each in known}
                    for known in (own, heads)
                )
                fits = {each: max(part[each], whole[each] - CLEAR) for each in own} | {name: whole[name]}
                best = max(fits, key=lambda each: fits[each])
                if fits[best] > fits[name] + 1e-9 or not (heads[name] & near or case.lacking):
                    told = f"beside words of {best}: {listed(sorted(own[best] & near))}" if fits[best] else "alone"
                    repair = f"correct the field, name it, or add the words that are beside it to `said` of {name}"
                    wanted = f"words of {name}: {listed(sorted(own[name]))}"
                    yield case.problem(where, f"{field[0]}, {told}", wanted, repair, quoted=field[0])


def counted(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, which sample. Another number than a run's last is told by words.

    Of grade B it is enough that a check or another field takes it.
    """
    record = case.record
    everywhere = [checks_in(record, trial) for trial in (None, *record.trials)]
    known = {(check.signal, check.take) for checks in everywhere for check in (*checks.broken, *checks.fixed)}
    known |= {(sweep.outcome.signal, sweep.outcome.take) for sweep in record.sweep.values()}
    fields = [
        (where, text, field, field[1].partition("|")[0].strip())
        for where, text in prose_of(case)
        for field in FIELD.finditer(text)
    ]
    taken = Counter(tuple(name.split(".")[1:]) for *_, name in fields if name.count(".") == 2)
    for where, text, field, name in fields:
        variant, _, rest = name.partition(".")
        signal, _, take = rest.partition(".")
        values = evidence.variants[variant].values.get(signal, {}) if variant in evidence.variants else {}
        one, last = values.get(take), values.get("final")
        if take not in TOLD or one is None or (last is None and take not in ALWAYS):
            continue
        if last is not None and abs(one - last) <= SAME * max(abs(one), abs(last)):
            continue
        begun = max((m.end() for m in re.finditer(r"[.?!]\s|\n[ \t]*\n", text[: field.start()])), default=0)
        ended = re.search(r"[.?!](?:\s|$)", text[field.end() :])
        sentence = text[begun : field.end() + ended.start() if ended else None]
        told = re.search(TOLD[take], FIELD.sub("", sentence), re.IGNORECASE)
        excused = case.lacking and take not in ALWAYS and ((signal, take) in known or taken[signal, take] > 1)
        if not (told or excused):
            wanted = f"its `final`, or words for its {NAMED[take]}"
            yield case.problem(where, field[0], wanted, "correct the field or the words", quoted=field[0])


def within_its_sweep(case: Case, evidence: Evidence) -> Iterator[Problem]:
    """Law 5, which sweep. A sweep's text has its own numbers, and a rival's number stands beside the rival's words."""
    for where, text in prose_of(case):
        for field in FIELD.finditer(text):
            first, *rest = field[1].partition("|")[0].strip().split(".")
            if first != "sweep" or rest[0] not in case.record.sweep:
                continue
            if where[0] == "sweep" and where[1] != rest[0]:
                yield case.problem(where, field[0], f"a number of {where[1]}", "correct the field", quoted=field[0])
            before, after = " ".join(text[: field.start()].split()), text[field.end() :].lstrip()
            for ahead, behind, takes in SAID:
                told = re.search(ahead, before) or (behind and re.match(behind, after))
                if told and rest[-1] in {"wrong", "points", "judged", "worst"} - {*takes}:
                    wanted, repair = f"its `{takes[0]}`: so the words say", "correct the field or the words"
                    yield case.problem(where, field[0], wanted, repair, quoted=field[0])
            near = words(beside(text, field, ()))
            for rival in case.record.sweep[rest[0]].rivals:
                named = words(f"{rival.label} {rival.id}")
                if rest[1] in ("wrong", "judged", "worst", "good_from") and len(named & near) >= min(2, len(named)):
                    repair = "correct the field or the words"
                    yield case.problem(where, field[0], f"a number of {rival.id}", repair, quoted=field[0])


def words_of(name: str, signal: Signal, part: re.Pattern[str] = WHOLE) -> set[str]:
    """The words by which prose knows a signal: `part` of its label, its name and `said`."""
    return words(" ".join([name.replace("_", " "), *part.findall(signal.label)[:1], *signal.said]))


def words(text: str) -> set[str]:
    """The words of a text in small letters and without their endings."""
    found = re.findall(r"[^\W\d_]+", text.lower().replace("'s", ""))
    return {ENDING.sub("", word) for word in found if word not in SMALL.split()}


def beside(paragraph: str, field: re.Match[str], without: Sequence[str] = ELSEWHERE) -> str:
    """The words that a field belongs to: before it from the field or the stop before, after it to the next comma."""
    before, after = (
        OTHER.sub("", part) if without else part for part in (paragraph[: field.start()], paragraph[field.end() :])
    )
    after = re.split(r"[,.?!:;](?:\s|$)|\{\{", after)[0]
    before = re.sub(r"\|[^,|.?!:;]*,", "|", FIELD.sub("|", before))
    *earlier, last = re.split(r"[.?!:;]\s|\|", before)
    told = [last] if words(last + after) else [clause for clause in earlier if words(clause)][-1:]
    return " ".join([*told, after])
