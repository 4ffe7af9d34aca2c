"""How a finding's numbers are written: as a person would, with their units, in its sentences alone."""

from __future__ import annotations

from pathlib import Path

import pytest
from clinic.diagnosis.diagnose import examine
from clinic.diagnosis.finding import shown
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.rules import rules
from clinic.diagnosis.suspect import spoken


@pytest.mark.parametrize(
    ("said", "written"),
    [
        (f"{120:.2g} % of its range", "120 % of its range"),
        (f"{819_000:.3g} kg/m3", "819,000 kg/m3"),
        (f"{-2700:.2g} mm", "-2700 mm"),
        (f"{0.00002:g} m, {0.0000819:.3g} m.", "0.00002 m, 0.0000819 m."),
        (f"{1.5e12:.3g} and {3e-9:.3g} kg", "1.5 x 10^12 and 3 x 10^-9 kg"),
        ('solref="1e-05 1" of link_1e-05, 0x1e-05', 'solref="1e-05 1" of link_1e-05, 0x1e-05'),
    ],
)
def test_numbers_of_a_sentence_are_written_out(said: str, written: str) -> None:
    assert spoken(said) == written


def test_what_is_measured_is_written_out_and_has_its_unit() -> None:
    assert shown(819_000, "kg/m3") == "819,000 kg/m3"
    assert shown(1e-14, "m") == "0 m"
    assert shown(5000, "") == "5000"
    assert shown(float("inf"), "m") == "beyond all bounds"


def test_what_an_edit_writes_is_told_as_it_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    bad = rules()["no-armature"].example("Bad")
    (found, *_) = examine(NativeEngine(), {"model.xml": bad.replace('kp="200"', 'kp="2e+06"')}).causes
    assert found.rule == "no-armature"
    assert "kp 2,000,000 N m/rad on an inertia of 0.0000082 kg m2" in found.says
    assert found.value == found.edit[0].value
