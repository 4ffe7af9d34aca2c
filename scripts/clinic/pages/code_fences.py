"""Code fences of hand-written pages that are run while the site is built, with their real output below them."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from contextlib import redirect_stdout

from clinic.engine.script import BY_HAND, ScriptError, run_script
from clinic.record.case import Case
from clinic.record.problem import CaseError, Problem
from clinic.work.cache import Cache, key_of

FENCE = re.compile(r"^```python (?P<how>run|shared)\n(?P<code>.*?)^```$", re.DOTALL | re.MULTILINE)
NAMED = re.compile(r"cases/([a-z0-9-]+)/")


def run_fences(file: str, text: str, cases: Mapping[str, Case], cache: Cache) -> str:
    """The page with every fence marked `python run` or `python shared` followed by what it printed.

    The code of the first kind runs in a process and a folder of its own, which holds the cases it names, as
    `cases/<slug>/<file>`. That of the second runs here, and a page's fences of this kind share their names.

    Raises:
        CaseError: With every fence that does not end well.
    """
    problems: list[Problem] = []
    shared: dict[str, object] = {}

    def run(match: re.Match[str]) -> str:
        code = match["code"]
        try:
            output = _run_here(code, shared) if match["how"] == "shared" else _run(code, _files(code, cases), cache)
        except ScriptError as error:
            line = text.count("\n", 0, match.start()) + 1
            problems.append(Problem(file, line, "", error.found, "code that runs as it stands", error.repair))
            return match[0]
        return f"```python\n{code}```\n\nIt prints:\n\n```text\n{output.rstrip()}\n```"

    made = FENCE.sub(run, text)
    if problems:
        raise CaseError(problems)
    return made


def _run(code: str, files: dict[str, str], cache: Cache) -> str:
    key = key_of("fence", code, files, of="engine")
    made = cache.remember(key, lambda: {"output": run_script(code, files, name="snippet.py").encode()})
    return made["output"].decode()


def _run_here(code: str, names: dict[str, object]) -> str:
    output = io.StringIO()
    try:
        with redirect_stdout(output):
            exec(code, names)
    except Exception as error:
        raise ScriptError(f"{type(error).__name__}: {error}", BY_HAND) from error
    return output.getvalue()


def _files(code: str, cases: Mapping[str, Case]) -> dict[str, str]:
    return {
        f"cases/{slug}/{name}": text
        for slug in sorted(set(NAMED.findall(code)) & cases.keys())
        for name, text in cases[slug].texts.items()
    }
