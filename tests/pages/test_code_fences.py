"""Fences of hand-written pages that are run."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest
from clinic.pages.code_fences import run_fences
from clinic.record.problem import CaseError
from clinic.work.cache import Cache
from helpers import SLUG, tiny_case


def test_a_run_fence_is_followed_by_its_output(cache: Cache) -> None:
    text = "# Page\n\n```python run\nprint(1 + 1)\nprint('two')\n```\n\nEnd.\n"
    assert run_fences("docs/x.md", text, {}, cache) == (
        "# Page\n\n```python\nprint(1 + 1)\nprint('two')\n```\n\nIt prints:\n\n```text\n2\ntwo\n```\n\nEnd.\n"
    )


def test_shared_fences_of_a_page_share_their_names(cache: Cache) -> None:
    text = "```python shared\nfound = 6\n```\n\n```python shared\nprint(found * 7)\n```\n"
    assert run_fences("docs/x.md", text, {}, cache).endswith("```text\n42\n```\n")
    with pytest.raises(CaseError, match="NameError: name 'found' is not defined"):
        run_fences("docs/x.md", "```python shared\nprint(found)\n```\n", {}, cache)


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("```python\nboom\n```\n", id="python-not-to-run"),
        pytest.param("```xml\n<geom/>\n```\n", id="another-language"),
        pytest.param("Write `python run` here.\n", id="words"),
    ],
)
def test_other_text_is_left(cache: Cache, text: str) -> None:
    assert run_fences("docs/x.md", text, {}, cache) == text


def test_output_is_taken_literally(cache: Cache) -> None:
    made = run_fences("docs/x.md", "```python run\nprint(r'\\1 \\g<0>')\n```\n", {}, cache)
    assert "```text\n\\1 \\g<0>\n```" in made


def test_the_cases_it_names_lie_beside_it(tmp_path: Path, cache: Cache) -> None:
    code = f"print(open('cases/{SLUG}/model.xml').read().splitlines()[0])"
    case = tiny_case(tmp_path)
    made = run_fences("docs/x.md", f"```python run\n{code}\n```\n", {SLUG: case, "other": case}, cache)
    assert made.endswith("```text\n<mujoco>\n```\n")


def test_all_fences_that_fail_are_reported_with_their_lines(cache: Cache) -> None:
    text = dedent("""\
        # Page

        ```python run
        print(undefined)
        ```

        ```python run
        print('fine')
        ```

        ```python run
        open('model.xml')
        ```
        """)
    with pytest.raises(CaseError) as caught:
        run_fences("docs/x.md", text, {}, cache)
    assert str(caught.value) == dedent("""\
        docs/x.md:3:
          found:    NameError: name 'undefined' is not defined (line 1 of snippet.py)
          expected: code that runs as it stands
          repair:   run it by hand and mend it
        docs/x.md:11:
          found:    FileNotFoundError: [Errno 2] No such file or directory: 'model.xml' (line 1 of snippet.py)
          expected: code that runs as it stands
          repair:   run it by hand and mend it""")


def test_a_fence_is_run_once_for_the_same_code_and_files(tmp_path: Path, cache: Cache) -> None:
    text = "```python run\nimport time\nprint(time.perf_counter_ns())\n```\n"
    first = run_fences("docs/x.md", text, {}, cache)
    assert run_fences("docs/y.md", text, {}, cache) == first
    assert run_fences("docs/x.md", text, {}, Cache(tmp_path / "another")) != first
