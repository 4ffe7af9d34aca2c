"""The playground's engine, run by Node, against the package: equal verdicts, and equal numbers from the same engine."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from clinic.engine.mjcf import SINCE, release_needed
from clinic.engine.node import executable as node
from clinic.engine.variant import apply_edits
from clinic.pages.playground import playground
from clinic.record.case import Case
from clinic.record.expression import evaluate, parse
from clinic.record.parts import Edit
from project import ROOT

pytestmark = pytest.mark.xdist_group("parity")
TOLERANCE = 1e-9

REPAIRS = yaml.safe_load((ROOT / "tests/proof/repairs.yaml").read_text(encoding="utf-8"))
PIXEL = 1 / 120  # of an image, which the browser measures with rays
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?")


@pytest.fixture(scope="module")
def files(cases: list[Case], tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("playgrounds")
    made = []
    for case in cases:
        record = json.loads(playground(case, cases))
        record["repairs"] = repairs(case)
        made.append(folder / f"{case.slug}.json")
        made[-1].write_text(json.dumps(record), encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def browser(root: Path, files: list[Path]) -> dict[str, Any]:
    return output(root, [node(), "tests/playground/parity.mjs", *map(str, files)])


@pytest.fixture(scope="module")
def twin(root: Path, files: list[Path]) -> dict[str, Any]:
    """What Python finds with the browser's version of the engine, which `make setup` installs beside."""
    beside = Path(sys.prefix, "parity")
    assert beside.is_dir(), "no engine of the browser's version beside this one: run `make setup`"
    path = os.pathsep.join([str(beside), str(root / "scripts")])
    return output(root, [sys.executable, "tests/playground/parity.py", str(root), *map(str, files)], PYTHONPATH=path)


def output(root: Path, command: list[str], **environment: str) -> dict[str, Any]:
    env = {**os.environ, **environment}
    done = subprocess.run(command, cwd=root, env=env, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def near(value: float | None) -> Any:
    return value if value is None else pytest.approx(value, rel=TOLERANCE, abs=TOLERANCE)


def repairs(case: Case) -> dict[str, str]:
    """The texts of all repairs that are known for a case, `right: ...` and `wrong: ...`."""
    made = {}
    for kind, listed in REPAIRS[case.slug].items():
        for name, texts in listed.items():
            pairs = zip(texts[::2], texts[1::2], strict=True)
            made[f"{kind}: {name}"] = apply_edits(
                case.text, [Edit(find=find, replace=replace) for find, replace in pairs]
            )
    return made


CHAOTIC = ("hand-shakes-at-once",)  # what shakes with the timestep magnifies rounding; its verdicts are compared


def test_browser_and_twin_are_of_one_version(root: Path, browser: dict[str, Any], twin: dict[str, Any]) -> None:
    locked = json.loads((root / "package.json").read_text(encoding="utf-8"))["dependencies"]["@mujoco/mujoco"]
    assert browser["engine"] == twin["engine"] == locked


def test_every_variant_gets_the_verdicts_of_the_evidence(cases: list[Case], browser: dict[str, Any], proven) -> None:
    wrong = []
    for case in cases:
        _, evidence = proven(case.slug)
        for name, variant in evidence.variants.items():
            found = browser["cases"][case.slug][name]
            if found.get("newer"):
                continue
            for kind, results in variant.checks.items():
                for result, there in zip(results, found[kind], strict=True):
                    if result.holds != there["holds"]:
                        wrong.append(f"{case.slug} {name}: {result.signal} {result.measured}, in the browser {there}")
            if set(variant.warnings) != set(found["warnings"]):
                wrong.append(f"{case.slug} {name}: warns {variant.warnings}, in the browser {found['warnings']}")
            if found["repaired"] != (variant.kind == "fix"):
                wrong.append(f"{case.slug} {name}: a {variant.kind}, yet repaired is {found['repaired']}")
    assert not wrong, "\n".join(wrong)


def test_every_number_is_that_of_the_same_engine_in_python(browser: dict[str, Any], twin: dict[str, Any]) -> None:
    wrong, compared = [], 0
    for slug, variants in twin["cases"].items():
        for name, here in variants.items():
            there = browser["cases"][slug][name]
            if "values" not in here:
                continue
            checks = [
                pair for kind in ("broken", "fixed") for pair in zip(here[kind], there[kind], strict=True) if pair[0]
            ]
            numbers = [(a["measured"], b["measured"]) for a, b in checks]
            assert here["values"].keys() == there["values"].keys(), f"{slug} {name}"
            for signal, values in here["values"].items():
                numbers += zip(values, there["values"][signal], strict=True)
            equal = (
                here["warnings"] or slug in CHAOTIC or all(a == near(b) for a, b in numbers)
            )  # an exploding run magnifies rounding
            if not equal or any(a["holds"] != b["holds"] for a, b in checks):
                wrong.append(f"{slug} {name}: {here} in Python, {there} in the browser")
            compared += len(checks)
    assert not wrong, "\n".join(wrong)
    assert compared > len(twin["cases"])


def test_every_repair_is_judged_rightly_in_the_browser(cases: list[Case], browser: dict[str, Any]) -> None:
    wrong, judged = [], 0
    for case in cases:
        for name, text in repairs(case).items():
            found = browser["cases"][case.slug][name]
            if found["repaired"] != (name.startswith("right") and not newer(release_needed(text), browser["engine"])):
                wrong.append(f"{case.slug} {name}: {found}")
            judged += 1
    assert not wrong, "\n".join(wrong)
    assert judged > 200


def test_the_browser_says_of_a_repair_what_python_says(browser: dict[str, Any], twin: dict[str, Any]) -> None:
    wrong, compared = [], 0
    for slug, variants in twin["cases"].items():
        for name, here in variants.items():
            there = browser["cases"][slug][name]
            if "changes" in here:
                lists = [(here["changes"], there.get("changes", []))]
                if slug not in CHAOTIC:
                    lists.append((here["failed"], there.get("failed", [])))
                same = all(len(a) == len(b) and all(map(alike, a, b)) for a, b in lists)
                if not same or bool(here["error"]) != ("error" in there):
                    wrong.append(f"{slug} {name}: {here} in Python, {there} in the browser")
                compared += sum(len(a) for a, _ in lists)
    assert not wrong, "\n".join(wrong)
    assert compared > 200


def alike(here: str, there: str) -> bool:
    """Whether two sentences differ in rounding alone, or in why a trial cannot be run."""
    a, b = (told.partition(" cannot be run: ")[0] for told in (here, there))
    numbers = [[float(number) for number in NUMBER.findall(told)] for told in (a, b)]
    tolerance = PIXEL if "row" in a else TOLERANCE
    return NUMBER.sub("#", a) == NUMBER.sub("#", b) and numbers[0] == pytest.approx(numbers[1], rel=1e-3, abs=tolerance)


def newer(release: str, version: str) -> bool:
    here, there = (tuple(map(int, each.split("."))) for each in (version, release or "0.0"))
    return there > here[:2]


def test_what_the_page_s_engine_lacks_is_known_and_told(
    root: Path, browser: dict[str, Any], twin: dict[str, Any]
) -> None:
    """The list of what came with which release is kept by hand: a new engine adds to it what this test finds."""
    here = set(output(root, [sys.executable, "tests/playground/parity.py", str(root)])["schema"])
    lacked = here - set(twin["schema"])
    lacked -= {name for name in lacked if "." in name and name.split(".")[0] in lacked}
    assert lacked == {name for release, names in SINCE.items() if newer(release, twin["engine"]) for name in names}

    speculative = browser["cases"]["ball-passes-through-shelf"]["right: speculative contacts"]
    version = twin["engine"]
    assert "unrecognized attribute: 'speculative'" in speculative["error"]
    assert speculative["newer"] == (
        f"This page runs MuJoCo {version}, which does not know `speculative`; `clinic judge` with MuJoCo 4.0 does."
    )
    assert twin["cases"]["ball-passes-through-shelf"]["right: speculative contacts"]["error"].startswith(
        f"This is MuJoCo {version}, which does not know `speculative`; MuJoCo 4.0 does. XML Error: "
    )


EXPRESSIONS = [
    "a ** 2 ** b",
    "-a ** 2",
    "2 ** -b",
    "a - b - 1",
    "a / b / 2",
    "-(a + b) * -2",
    "sqrt(abs(-a)) + minimum(a, b) - maximum(1, b)",
    "1.5e-3 * a + .5 * pi",
    "exp(log(a)) + sin(a) * cos(b) - tan(1) + arccos(0.5) + floor(a * b)",
]


REFUSED = ["", "a +", "(a", "a b", "alert(1)", "a.b", "a[0]", "constructor(1)", "'x'"]
CODE = """
  const { parse, evaluate, ExpressionError } = await import("./docs/playground/record/expression.js");
  const [texts, values] = JSON.parse(process.argv[1]);
  console.log(JSON.stringify(texts.map((text) => {
    try { return evaluate(parse(text), (name) => values[name]); }
    catch (error) { return error instanceof ExpressionError ? "refused" : String(error); }
  })));
"""


def test_expressions_have_the_same_values_and_what_is_none_is_refused(root: Path) -> None:
    values = {"a": 3.25, "b": 0.75}
    texts = json.dumps([EXPRESSIONS + REFUSED, values])

    found = output(root, [node(), "--input-type=module", "-e", CODE, texts])

    expected = [float(np.asarray(evaluate(parse(text), values))) for text in EXPRESSIONS]
    assert found[: len(EXPRESSIONS)] == pytest.approx(expected, rel=1e-14)
    assert found[len(EXPRESSIONS) :] == ["refused"] * len(REFUSED)


def test_memory_is_steady_over_edits_and_runs(root: Path, files: list[Path]) -> None:
    heaps = output(root, [node(), "tests/playground/memory.mjs", str(files[-1])])

    assert len(heaps) == 300
    assert heaps[-1] == heaps[100]
