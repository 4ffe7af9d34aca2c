"""What a site is, apart from what makes it, which is slow to import."""

from __future__ import annotations

from dataclasses import dataclass

from clinic.record.problem import Problem
from clinic.work.cache import Files

Navigation = list[dict[str, object]]
SECTION = 50  # cases; more than these are shown in sections


@dataclass(frozen=True)
class Site:
    """What there is to publish; a case in error has a page that says so.

    Attributes:
        files: Every generated file, by its path below the documentation folder.
        navigation: As MkDocs takes it.
        problems: All problems of all cases, and every claim that the runs do not bear out.
    """

    files: Files
    navigation: Navigation
    problems: tuple[Problem, ...] = ()
