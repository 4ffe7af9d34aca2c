"""All rules in turn, as far as the time goes."""

from __future__ import annotations

from itertools import count

import pytest
from clinic.diagnosis import diagnose
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules

WELL = "<mujoco><worldbody><geom name='ball' size='0.1'/></worldbody></mujoco>"
OTHERS = {name for name, rule in rules().items() if not rule.of_errors}


def test_rules_that_had_no_time_are_told_and_are_not_ruled_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(diagnose.time, "process_time", count().__next__)
    found = examine(NativeEngine(), {"model.xml": WELL}, limit=20)
    assert len(found.ruled_out) == 20
    assert {rules()[each].level for each in found.ruled_out} == {"cause"}
    assert {*found.untried} == OTHERS - {*found.ruled_out}
    assert list(found.untried) == found.data()["untried"] == sorted(found.untried)
    assert found.text().splitlines()[1].startswith(f"no time for {len(found.untried)} rules (")


def test_a_rule_that_had_time_from_one_start_and_not_from_the_other_is_not_ruled_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    text = WELL.replace("</mujoco>", "<keyframe><key time='1'/></keyframe></mujoco>")
    ticks = [*range(len(OTHERS) + 1), *range(1000, 1020), *[2000] * 2]  # all from the first start, then nineteen
    monkeypatch.setattr(diagnose.time, "process_time", lambda: ticks.pop(0))
    found = examine(NativeEngine(), {"model.xml": text}, limit=len(OTHERS))
    assert len(found.ruled_out) == 19
    assert {*found.untried} == OTHERS - {*found.ruled_out}


def test_where_no_rule_had_time_nothing_is_said_to_be_found_or_not() -> None:
    assert (
        examine(NativeEngine(), {"model.xml": WELL}, limit=-1).text().startswith(f"no time for {len(OTHERS)} rules (")
    )
