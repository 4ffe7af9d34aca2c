"""Comments in a model that silence rules: `<!-- clinic: ignore[visual-mass] why -->`.

A comment silences its rules on the element that follows it, with all inside: before `<mujoco>` in the whole file,
before an `<include>` in the file that it names. A finding is silenced where that holds of everything that it would
edit, or of every element that it is about. A comment without a reason silences nothing, and is told, as is one that
has nothing to silence.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from clinic.diagnosis.edit import Edit
from clinic.diagnosis.finding import Finding, remark
from clinic.diagnosis.judge import Judged
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.rules import rules
from clinic.diagnosis.source import Comment, Element

ID = "ignore-comment"  # of the findings about the comments themselves
FORM = re.compile(r"\s*clinic\s*:\s*ignore\s*\[([^\]]*)\](.*)", re.S)
MARK = re.compile(r"\s*clinic\s*:")
DEEPEST = 20  # files that include each other


@dataclass(frozen=True)
class Ignore:
    """One rule that a comment silences, and why."""

    comment: Comment
    rule: str
    why: str


class Ignores:
    """The comments of a model, and which of them silenced something."""

    def __init__(self, model: ReaderModel) -> None:
        self.source = model.source
        self.kept: list[Ignore] = []
        self.wrong: list[tuple[Comment, str]] = []
        self.used: set[Ignore] = set()
        for comment in self.source.comments.values() if self.source else ():
            if MARK.match(comment.text):
                self._read(comment)

    def _read(self, comment: Comment) -> None:
        found = FORM.match(comment.text)
        inside, why = (found[1], " ".join(found[2].split())) if found else ("", "")
        names = re.findall(r"[^\s,]+", inside)
        if not names:
            self.wrong.append((comment, "It is not understood; expected `clinic: ignore[a-rule] why`"))
        elif not why:
            self.wrong.append((comment, f"It gives no reason, and silences nothing: write why behind `[{inside}]`"))
        elif comment.following is None:
            self.wrong.append((comment, "No element follows it, so that it silences nothing"))
        else:
            for name in names:
                if name not in rules():
                    self.wrong.append((comment, unknown(name).replace("no", "No", 1)))
                elif rules()[name].of_errors:
                    self.wrong.append(
                        (comment, f"The rule {name} is about models that do not compile, and is not silenced")
                    )
                else:
                    self.kept.append(Ignore(comment, name, why))

    def why(self, judged: Judged, model: ReaderModel) -> str:
        """Why a comment silences what was found in a model; empty where none does."""
        own = [each for each in self.kept if each.rule == judged.rule.id]
        if not own:
            return ""
        edits, named = judged.suspect.edits, filter(None, map(model.named, judged.suspect.elements))
        for places in (edits, list(named), [model.source.root] if model.source else []):
            holders = [next((each for each in own if self._holds(each, place)), None) for place in places]
            used = [each for each in holders if each]
            if used and len(used) == len(holders):
                self.used.update(used)
                return "; ".join(dict.fromkeys(each.why for each in used))
        return ""

    def _holds(self, ignore: Ignore, place: Edit | Element) -> bool:
        outer, file, at = ignore.comment.following, place.file, place.start
        for _ in range(DEEPEST):
            if outer and outer.file == file and outer.start <= at < outer.end:
                return True
            include = self.source.included.get(file) if self.source else None
            if include is None:
                return False
            file, at = include.file, include.start
        return False

    def findings(self, tried: Collection[str], found: Collection[str]) -> Iterator[Finding]:
        """What is wrong with the comments, given the rules that were tried and those that found something."""
        for comment, says in self.wrong:
            yield _told(comment, says)
        for each in self.kept:
            if each not in self.used and each.rule in tried:
                more = " that lies in what follows it alone" if each.rule in found else " here"
                yield _told(each.comment, f"The rule {each.rule} finds nothing{more}, so that it silences nothing")


def _told(comment: Comment, says: str) -> Finding:
    return remark(ID, "A comment that silences nothing", f"{says}.", comment.file, comment.line)


def unknown(rule: str) -> str:
    """That a rule is unknown, with the nearest that is known."""
    near = difflib.get_close_matches(rule, rules(), 1)
    return f"no rule is called {rule}" + (f"; {near[0]} is" if near else "; `clinic rules` lists them")
