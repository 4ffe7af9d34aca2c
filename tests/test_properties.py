"""Whatever an author writes, the answer is a case or a list of problems.

HYPOTHESIS_EXAMPLES raises the number of examples a test.
"""

from __future__ import annotations

import json
import os
import random
import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from clinic.engine.simulate import compile_model
from clinic.pages.text.markup import line
from clinic.pages.text.prose import ProseError, markdown
from clinic.proof.model_problems import check_against_model
from clinic.record.case import load_case
from clinic.record.fields import Record
from clinic.record.problem import CaseError, Problem
from helpers import MODEL, evidence_of_variants, write_folder
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from markup import acting, rendered

ROOT = Path(__file__).parent.parent
RECORDS = sorted((ROOT / "cases").glob("*/case.yaml"))
MODELS = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "cases").glob("*/*.xml"))]
EXAMPLES = int(os.environ.get("HYPOTHESIS_EXAMPLES", "0"))
NUMBERS = re.findall(r"\S+", "nan inf -inf 1e308 1e400 1e-320 -1 0 2147483648 99999999999 0x10 true 1e10 2 -0.5 1e-9")


def examples(usual: int) -> settings:
    """Settings under which a test is the same every time; a slow machine changes nothing."""
    return settings(
        max_examples=EXAMPLES or usual,
        derandomize=True,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )


words = st.sampled_from([*Record.model_fields, "find", "replace", "path", "measure", "expr", "id", "edits"])
scalars = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20) | words
values = st.recursive(
    scalars, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(words | st.text(max_size=8), inner, max_size=4)
)


def outcome(folder: Path) -> tuple[Problem, ...]:
    """The problems of the case in a folder; none when it is read, compiled and bound."""
    try:
        check_against_model(load_case(folder))
    except CaseError as error:
        return error.problems
    return ()


def complete(problems: tuple[Problem, ...], text: str) -> None:
    """Every problem says where it is, what was found and expected, and the repair; none is a bare list of nothing."""
    for problem in problems:
        assert problem.file.startswith("cases/")
        assert 1 <= problem.line <= text.count("\n") + 2
        assert problem.found.strip()
        assert problem.expected.strip()
        assert problem.repair.strip()
    assert len(set(problems)) == len(problems)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A case's folder, to be written over and over."""
    return write_folder(tmp_path_factory.mktemp("root"), "a-case", {"model.xml": MODEL})


@examples(80)
@given(record=st.dictionaries(words | st.text(max_size=8), values, max_size=8))
def test_any_mapping_is_refused_with_problems(folder: Path, record: dict[str, Any]) -> None:
    text = json.dumps(record)
    (folder / "case.yaml").write_text(text, encoding="utf-8")
    problems = outcome(folder)
    assert problems
    complete(problems, text)


@examples(150)
@given(text=st.text(st.sampled_from("ab1:-?[]{}#&*!|>'\"%@` \n\t\\<~=,.\x00"), max_size=60))
def test_any_text_is_refused_with_problems(folder: Path, text: str) -> None:
    (folder / "case.yaml").write_bytes(text.encode("utf-8", "surrogatepass"))
    problems = outcome(folder)
    assert problems
    complete(problems, text)


def mutated(value: Any, chance: random.Random, new: Any) -> Any:
    """The record with one place of it dropped, given twice, given another's value, or given `new`."""
    places: list[tuple[Any, Any]] = []
    stack = [value]
    while stack:
        part = stack.pop()
        for key, inner in list(part.items() if isinstance(part, dict) else enumerate(part)):
            places.append((part, key))
            stack += [inner] if isinstance(inner, dict | list) else []
    part, key = chance.choice(places)
    other, at = chance.choice(places)
    match chance.randrange(6):
        case 0:
            del part[key]
        case 1:
            part[key] = json.loads(json.dumps(other[at], default=str))
        case 2 if isinstance(part, dict):
            part[f"{key}x"] = part.pop(key)
        case 3:
            part[key] = [part[key]]
        case 4:
            part[key] = str(part[key])
        case _:
            part[key] = new
    return value


@examples(50)
@given(which=st.sampled_from(RECORDS), seed=st.integers(0, 2**32), new=scalars, count=st.integers(1, 4))
def test_a_changed_record_is_a_case_or_problems(
    tmp_path_factory: Any, which: Path, seed: int, new: Any, count: int
) -> None:
    record = yaml.safe_load(which.read_text(encoding="utf-8"))
    chance = random.Random(seed)
    for _ in range(count):
        record = mutated(record, chance, new) if record else record
    files = {p.name: p.read_text(encoding="utf-8") for p in which.parent.iterdir() if p != which}
    text = json.dumps(record, default=str)
    folder = write_folder(tmp_path_factory.mktemp("root"), which.parent.name, {**files, "case.yaml": text})
    complete(outcome(folder), text + max(files.values(), key=len))


def changed(xml: str, chance: random.Random) -> str:
    """The text with a tag, an attribute, a number or a character removed, doubled, moved or replaced."""
    tags = [m.span() for m in re.finditer(r"<[^>]*>", xml)] or [(0, 0)]
    attributes = [m.span() for m in re.finditer(r'[\w]+="[^"]*"', xml)] or [(0, 0)]
    numbers = [m.span() for m in re.finditer(r"-?\d+\.?\d*", xml)] or [(0, 0)]
    (a, b), (c, _), (d, e), (f, g) = map(chance.choice, (tags, tags, attributes, numbers))
    at = chance.randrange(len(xml) + 1)
    h, i = chance.choice(attributes)
    return [
        xml[:a] + xml[b:],
        xml[:c] + xml[a:b] + xml[c:],
        xml[:d] + xml[e:],
        xml[:d] + xml[h:i] + xml[e:],
        xml[:f] + chance.choice(NUMBERS) + xml[g:],
        xml[:f] + chance.choice(NUMBERS) + xml[g:],
        xml[:at] + chance.choice("<>/\"=&;\0é 'a0") + xml[at + chance.randrange(2) :],
    ][chance.randrange(7)]


@examples(250)
@given(xml=st.sampled_from(MODELS), seed=st.integers(0, 2**32), count=st.integers(1, 3))
def test_a_changed_model_compiles_or_says_why(xml: str, seed: int, count: int) -> None:
    chance = random.Random(seed)
    for _ in range(count):
        xml = changed(xml, chance)
    message = "compiled"
    try:
        compile_model(xml)
    except ValueError as error:
        message = str(error)
    assert message


MARKS = r"` `` ``` ~~~ > - 1. # !!! ??? [a] [a][a] <javascript:x> &lt;script> \ * _ $x$ $ <!-- --> <?php </div>"
PIECES = [
    "<script>alert(1)</script>",
    "<img src=x onerror=alert(1)>",
    "[x](javascript:alert(1))",
    "![x](//h/x)",
    "{ onclick=alert(1) }",
    "{: onload=x }",
    "[a]: javascript:x",
    "<![CDATA[",
    "<details markdown>",
    *MARKS.split(),
    "\n",
    "\n\n",
    "\t",
    "    ",
    "{{ engine }}",
    "{% x %}",
]


@examples(200)
@given(pieces=st.lists(st.sampled_from(PIECES) | st.text(max_size=5), min_size=1, max_size=12))
def test_prose_of_any_kind_makes_no_element_that_acts(pieces: list[str]) -> None:
    text = "".join(pieces)
    try:
        shown = markdown(text, evidence_of_variants())
    except ProseError:
        return
    assert acting(rendered(f"# {line(text)}\n\n{shown}\n\n??? x\n\n    {line(text)}\n\n{shown}\n")) == []
