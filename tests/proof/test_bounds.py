"""What a check, a trial and a sweep can tell."""

from __future__ import annotations

import pytest
from clinic.proof.bounds import bounded, differing, parting, varied, windowed
from clinic.proof.evidence import collect
from clinic.proof.sweep import measure_sweep
from helpers import SWEEP, tiny_case

CHECK = "{signal: height, between: [0.045, 0.051]}"


@pytest.mark.parametrize(
    ("bound", "far"),
    [
        ("between: [0.04, 0.06]", False),
        ("above: 0.01", False),
        ("above: 0.001", False),  # where the broken box is not
        ("between: [0, 100]", False),
        ("between: [-100, 100]", True),
        ("above: -100", True),
        ("equals: 0.05, within: 0.01", False),
        ("equals: 0.055, within: 0.01", True),  # 0.05 is measured
        ("equals: 0.05, within: 1", True),
        ("equals: 0.05, within: 0.03", True),  # it tells the broken box, but is no equality
    ],
)
def test_a_bound_is_near_what_it_admits(tmp_path, bound: str, far: bool) -> None:
    case = tiny_case(tmp_path, (CHECK, f"{{signal: height, {bound}}}"))
    assert [problem.where for problem in bounded(case, collect(case))] == ["checks.fixed[0]"] * far


@pytest.mark.parametrize(
    ("situation", "same"),
    [
        ("start: {'joint(free).qpos[2]': 0.5}", False),
        ("set: {'model.opt.gravity[2]': -9.9}", True),
        ("duration: 0.9", False),
        ("duration: 0.41", True),
    ],
)
def test_a_trial_differs_from_the_run(tmp_path, situation: str, same: bool) -> None:
    heavy = "trials:\n  - {id: heavy, title: Heavy, set: {'model.body(box).mass': 3}}\n"
    trials = f"{heavy}  - {{id: other, title: Otherwise, {situation}}}\nfilm:"
    checks = ", checks: {fixed: [{signal: height, above: 0.04}], broken: [{signal: contacts, take: max, equals: 0}]}}"
    case = tiny_case(tmp_path, ("film:", trials.replace("}\nfilm", f"{checks}\nfilm")))
    assert [problem.where for problem in differing(case, collect(case))] == ["trials[1]"] * same


@pytest.mark.parametrize(
    ("kind", "check", "near"),
    [
        ("fixed", "{signal: height, above: 0.02}", False),
        ("fixed", "{signal: height, above: -0.6}", True),
        ("fixed", "{signal: height, above: -50}", True),
        ("fixed", "{signal: height, between: [0.02, 0.06]}", False),
        ("fixed", "{signal: height, between: [-0.6, 0.06]}", True),
        ("broken", "{signal: height, below: -0.3}", False),
        ("broken", "{signal: height, below: 0.045}", True),
        ("broken", "{signal: height, below: 1}", True),
    ],
)
def test_an_end_of_a_bound_keeps_off_the_other_kind(tmp_path, kind: str, check: str, near: bool) -> None:
    case = tiny_case(tmp_path, (f"  {kind}:\n", f"  {kind}:\n    - {check}\n"))
    assert [problem.where for problem in parting(case, collect(case))] == [f"checks.{kind}[0]"] * near


@pytest.mark.parametrize(("window", "spares"), [("[0, 0.002]", True), ("[0, 0.4]", False), (None, False)])
def test_no_window_spares_the_broken_variant_a_check(tmp_path, window: str | None, spares: bool) -> None:
    check = f"{{signal: height, take: min, above: 0.04{f', window: {window}' if window else ''}}}"
    case = tiny_case(tmp_path, ("  fixed:\n", f"  fixed:\n    - {check}\n"))
    assert [problem.where for problem in windowed(case, collect(case))] == ["checks.fixed[0]"] * spares


@pytest.mark.parametrize(("values", "same"), [("[1, 2, 4, 8]", False), ("[1, 1.001]", True)])
def test_the_outcome_of_a_sweep_changes(tmp_path, values: str, same: bool) -> None:
    sweep = SWEEP.replace("[1, 2, 4, 8]", values)
    case = tiny_case(tmp_path, ("no_sweep: The masks are not a number.\n", sweep))
    evidence = collect(case).model_copy(update={"sweep": {"fall": measure_sweep(case, "fall")}})
    assert [problem.where for problem in varied(case, evidence)] == ["sweep.fall.vary[0]"] * same
