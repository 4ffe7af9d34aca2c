"""The playground's engine, run by Node, against the package: equal verdicts, and equal numbers from the same engine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from clinic.engine.node import executable as node
from clinic.pages.playground import playground
from clinic.record.case import Case, read_cases
from clinic.record.expression import evaluate, parse
from packaging.specifiers import SpecifierSet
from packaging.version import Version

pytestmark = pytest.mark.xdist_group("parity")
TOLERANCE = 1e-9

# Repairs and attempts that no record holds: the case, the edits, and whether they repair it.
UNWRITTEN: list[tuple[str, dict[str, str], bool]] = [
    ("box-falls-through-floor", {'mass="0.1"': 'mass="0.1" conaffinity="3"'}, True),
    ("box-falls-through-floor", {'mass="0.1"': 'mass="0.1" contype="3"'}, True),
    ("box-falls-through-floor", {'mass="0.1"': 'mass="0.1" conaffinity="5"'}, False),
    ("box-falls-through-floor", {'mass="0.1"': 'mass="1"'}, False),
    ("arm-explodes", {'timestep="0.01"': 'timestep="0.0007"'}, True),
    ("arm-explodes", {'timestep="0.01"': 'timestep="0.01" integrator="RK4"'}, False),
    (
        "ball-passes-through-shelf",
        {
            'timestep="0.002"': 'timestep="0.001"',
            'size="0.08 0.05 0.003"': 'size="0.08 0.05 0.003" solref="0.0025 1" priority="2"',
        },
        True,
    ),
    ("grasp-slips", {'friction="0.15" priority="2"': 'friction="0.15" priority="0"'}, True),
    ("arm-explodes", {'stiffness="2000"': 'stiffness="2000" armature="0.3"'}, True),
    ("arm-explodes", {'stiffness="2000"': 'stiffness="10"'}, False),
    ("box-on-its-side", {'quat="0 0 0.7071068 0.7071068"': 'axisangle="0 0 1 1.5707963"'}, True),
    ("box-on-its-side", {' quat="0 0 0.7071068 0.7071068"': ""}, False),
    ("camera-upside-down", {'xyaxes="0 -1 0 0 0 -1"': 'quat="0.5 0.5 0.5 0.5"'}, True),
    ("elbow-will-not-bend", {'range="0 2.5"': 'limited="false"'}, False),
    ("gravity-ignores-forearm", {'pos="0 0 -0.3"': 'pos="0 0 -0.3" euler="90 0 0"'}, True),
    ("grasp-slips", {'mass="0.4"': 'mass="0.8"'}, False),
    ("grasp-slips", {'friction="0.15"': 'friction="1.5"'}, True),
    ("servo-oscillates", {'axis="0 0 1"': 'axis="0 0 1" damping="11.5"'}, True),
    ("servo-oscillates", {'axis="0 0 1"': 'axis="0 0 1" armature="1"'}, False),
    ("servo-sags", {'damping="1"': 'damping="30"', 'joint="shoulder"/>': 'joint="shoulder" kp="600"/>'}, True),
]


@pytest.fixture(scope="module")
def cases(root: Path) -> list[Case]:
    return [case for case in read_cases(root / "cases")[0] if case.record.model is not None]


@pytest.fixture(scope="module")
def files(cases: list[Case], tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("playgrounds")
    made = []
    for case in cases:
        record = json.loads(playground(case, cases))
        record["refuted"] += unwritten(case.slug)
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


def unwritten(slug: str) -> list[dict[str, Any]]:
    return [
        {"id": f"unwritten-{k}", "title": "", "edits": [{"find": f, "replace": r} for f, r in edits.items()]}
        for k, (case, edits, _) in enumerate(UNWRITTEN)
        if case == slug
    ]


def test_browser_and_twin_are_of_one_version(root: Path, browser: dict[str, Any], twin: dict[str, Any]) -> None:
    locked = json.loads((root / "package.json").read_text(encoding="utf-8"))["dependencies"]["@mujoco/mujoco"]
    assert browser["engine"] == twin["engine"] == locked


def test_every_variant_gets_the_verdicts_of_the_evidence(cases: list[Case], browser: dict[str, Any], proven) -> None:
    wrong = []
    for case in cases:
        _, evidence = proven(case.slug)
        for name, variant in evidence.variants.items():
            if name not in browser["cases"][case.slug]:  # an edit that this engine does not know yet
                known = [Version(browser["engine"]) in SpecifierSet(releases) for releases in case.record.older]
                assert any(known), f"{case.slug} {name} does not compile, and `older` does not say so"
                continue
            found = browser["cases"][case.slug][name]
            for kind, results in variant.checks.items():
                for result, there in zip(results, found[kind], strict=True):
                    if result.holds != there["holds"]:
                        wrong.append(f"{case.slug} {name}: {result.signal} {result.measured}, in the browser {there}")
            if set(variant.warnings) != set(found["warnings"]):
                wrong.append(f"{case.slug} {name}: warns {variant.warnings}, in the browser {found['warnings']}")
            if found["well"] != (variant.kind == "fix"):
                wrong.append(f"{case.slug} {name}: a {variant.kind}, yet well is {found['well']}")
    assert not wrong, "\n".join(wrong)


def test_every_number_is_that_of_the_same_engine_in_python(browser: dict[str, Any], twin: dict[str, Any]) -> None:
    wrong, compared = [], 0
    for slug, variants in twin["cases"].items():
        assert variants.keys() == browser["cases"][slug].keys()
        for name, here in variants.items():
            there = browser["cases"][slug][name]
            checks = [
                pair for kind in ("broken", "fixed") for pair in zip(here[kind], there[kind], strict=True) if pair[0]
            ]
            numbers = [(a["measured"], b["measured"]) for a, b in checks]
            assert here["values"].keys() == there["values"].keys(), f"{slug} {name}"
            for signal, values in here["values"].items():
                numbers += zip(values, there["values"][signal], strict=True)
            equal = here["warnings"] or all(a == near(b) for a, b in numbers)  # an exploding run magnifies rounding
            if not equal or any(a["holds"] != b["holds"] for a, b in checks):
                wrong.append(f"{slug} {name}: {here} in Python, {there} in the browser")
            compared += len(checks)
    assert not wrong, "\n".join(wrong)
    assert compared > len(twin["cases"])


@pytest.mark.parametrize("k", range(len(UNWRITTEN)), ids=lambda k: f"{UNWRITTEN[k][0]}-{k}")
def test_repairs_that_no_record_holds_are_judged(browser: dict[str, Any], k: int) -> None:
    slug, edits, repairs = UNWRITTEN[k]
    assert browser["cases"][slug][f"unwritten-{k}"]["well"] is repairs, edits


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
