"""Robustness: verdicts from other starts, over a longer run, at other timesteps."""

from __future__ import annotations

from clinic.engine.simulate import compile_model
from clinic.proof.robustness import STARTS, outcome, robustness
from helpers import tiny_case


def test_a_firm_case_keeps_every_verdict(tmp_path) -> None:
    made = robustness(tiny_case(tmp_path))

    assert {key: (robust.runs, robust.same) for key, robust in made.items()} == {
        "broken": (2 * STARTS, 2 * STARTS),
        "share-a-bit": (2 * STARTS, 2 * STARTS),
        "small-step": (STARTS, STARTS),
    }
    assert {key: robust.longer for key, robust in made.items()} == {
        "broken": None,
        "share-a-bit": True,
        "small-step": None,
    }
    assert made["broken"].shrunk == {"0.5": "broken", "0.05": "broken"}


def test_a_verdict_that_hangs_on_the_start_is_counted(tmp_path) -> None:
    case = tiny_case(tmp_path, ("between: [0.045, 0.051]", "take: first, equals: 0.06, within: 0.0002"))

    assert robustness(case)["share-a-bit"].same < 2 * STARTS


def test_the_timestep_is_put_back(tmp_path) -> None:
    case = tiny_case(tmp_path)
    model = compile_model(case.text)

    outcome(case.record, model, shrink=0.5)

    assert model.opt.timestep == 0.002
