"""Code fences of hand-written pages that are run while the site is built, with their real output below them."""

from __future__ import annotations

import re
from collections.abc import Mapping

from clinic.engine.script import ScriptError, run_script
from clinic.record.case import Case
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, key_of

FENCE = re.compile(r"^```python run\n(?P<code>.*?)^```$", re.DOTALL | re.MULTILINE)
NAMED = re.compile(r"cases/([a-z0-9-]+)/")


def run_fences(file: str, text: str, cases: Mapping[str, Case], cache: Cache) -> str:
    """The page with every fence marked `python run` followed by what it printed.

    The code runs in a folder that holds the cases it names, as `cases/<slug>/<file>`.

    Raises:
        CaseError: With every fence that does not end well.
    """
    problems: list[Problem] = []

    def run(match: re.Match[str]) -> str:
        code = match["code"]
        files = _files(code, cases)
        try:
            output = cache.remember(key_of("fence", code, files, of="engine"), lambda: _run(code, files))
        except ScriptError as error:
            line = text.count("\n", 0, match.start()) + 1
            problems.append(Problem(file, line, "", error.found, "code that runs as it stands", error.repair))
            return match[0]
        return f"```python\n{code}```\n\nIt prints:\n\n```text\n{output['output'].decode().rstrip()}\n```"

    made = FENCE.sub(run, text)
    if problems:
        raise CaseError(problems)
    return made


def _run(code: str, files: dict[str, str]) -> dict[str, bytes]:
    return {"output": run_script(code, files, name="snippet.py").text.encode()}


def _files(code: str, cases: Mapping[str, Case]) -> dict[str, str]:
    return {
        f"cases/{slug}/{name}": text
        for slug in sorted(set(NAMED.findall(code)) & cases.keys())
        for name, text in cases[slug].texts.items()
    }
