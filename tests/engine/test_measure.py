"""Signals of every kind, and numbers of models with known answers."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from clinic.engine.measure import MODEL_NUMBERS, measure_model, measure_output, omega_max, omega_one_link
from clinic.engine.simulate import compile_model
from clinic.record import closed_forms
from clinic.record.fields import Record
from helpers import MODEL, script_case, tiny_case

FIXED = MODEL.replace(' contype="2" conaffinity="2"', "")


def with_signals(root: Path, signals: str) -> Record:
    """The tiny record with more signals, one a line."""
    more = "".join(f"\n  {line.strip()}" for line in signals.strip().splitlines())
    return tiny_case(root, ("contacts: {path: ncon}", "contacts: {path: ncon}" + more)).record


def measured(record: Record, xml: str = MODEL) -> dict[str, np.ndarray]:
    assert record.run is not None
    _, traces = measure_model(record, compile_model(xml), record.run)
    return {name: trace.value for name, trace in traces.items()}


def test_every_signal_is_measured_in_the_records_order(tmp_path: Path) -> None:
    record = with_signals(tmp_path, "twice: {expr: 2 * height}\nspeed: {path: 'qvel[2]'}")
    assert list(measured(record)) == ["height", "contacts", "twice", "speed"]


def test_only_wanted_signals_are_given(tmp_path: Path) -> None:
    record = with_signals(tmp_path, "twice: {expr: 2 * height}")
    assert record.run is not None
    _, traces = measure_model(record, compile_model(MODEL), record.run, ["twice"])
    assert list(traces) == ["twice"]


def test_expression_is_computed_sample_by_sample(tmp_path: Path) -> None:
    found = measured(with_signals(tmp_path, "sum: {expr: 2 * height + contacts}"), FIXED)
    assert found["sum"] == pytest.approx(2 * found["height"] + found["contacts"])
    assert found["contacts"].max() == 4


def test_expression_without_names_is_a_constant_trace(tmp_path: Path) -> None:
    found = measured(with_signals(tmp_path, "weight: {expr: 1 * 9.81}"))
    assert found["weight"] == pytest.approx(np.full(len(found["height"]), 9.81))


def test_expressions_leave_the_traces_they_read_as_they_are(tmp_path: Path) -> None:
    plain = measured(tiny_case(tmp_path / "plain").record)
    found = measured(with_signals(tmp_path / "more", "root: {expr: sqrt(abs(height))}\nfloored: {expr: floor(height)}"))
    assert found["height"].tobytes() == plain["height"].tobytes()


def test_division_by_zero_is_no_error(tmp_path: Path) -> None:
    found = measured(with_signals(tmp_path, "odd: {expr: contacts / contacts}"))
    assert np.isnan(found["odd"]).all()


@pytest.mark.parametrize(
    ("holds", "fraction"),
    [
        # Shifted by 0, 1, 2, 3 and 4 m from 0.06 m, the box has fallen 0.787 m after 0.4 s.
        pytest.param("{signal: height, above: 0}", 4 / 5, id="all-but-the-lowest"),
        pytest.param("{signal: height, above: 1.5}", 2 / 5, id="the-two-highest"),
        pytest.param("{signal: height, take: first, between: [1, 3]}", 2 / 5, id="by-the-start"),
        pytest.param("{signal: contacts, take: max, above: 0}", 0, id="none"),
    ],
)
def test_fraction_of_starts(tmp_path: Path, holds: str, fraction: float) -> None:
    signal = f"share: {{measure: fraction_of_starts, joint: free, index: 2, offset: [0, 4], count: 5, holds: {holds}}}"
    assert measured(with_signals(tmp_path, signal))["share"].tolist() == pytest.approx([fraction])


def test_image_row_of_a_box_below_the_cameras_axis(tmp_path: Path) -> None:
    (row,) = measured(with_signals(tmp_path, "row: {measure: image_row, camera: side, geom: box}"))["row"]
    assert 0.5 < row < 1


def test_printed_signals_are_read_from_the_output(tmp_path: Path) -> None:
    two = ("{path: printed(error), unit: m}", "{path: printed(error)}\n  twice: {expr: 2 * error}")
    record = script_case(tmp_path, two).record
    traces = measure_output(record, "error = 1\nother = 9\nerror = 3\n")
    assert {name: trace.value.tolist() for name, trace in traces.items()} == {"error": [1, 3], "twice": [2, 6]}


def test_what_was_not_printed_is_an_empty_trace_and_so_is_what_is_computed_from_it(tmp_path: Path) -> None:
    more = "{path: printed(error)}\n  other: {path: printed(other)}\n  sum: {expr: error + other}"
    traces = measure_output(
        script_case(tmp_path, ("{path: printed(error), unit: m}", more)).record, "error = 1\nerror = 2\n"
    )
    assert {name: len(trace.value) for name, trace in traces.items()} == {"error": 2, "other": 0, "sum": 0}


PENDULA = """
<mujoco>
  <worldbody>
    <body>
      <joint axis="0 1 0" stiffness="8"/>
      <inertial pos="0 0 0" mass="1" diaginertia="2 2 2"/>
    </body>
    <body>
      <joint axis="0 1 0" stiffness="18"/>
      <inertial pos="0 0 0" mass="1" diaginertia="2 2 2"/>
    </body>
  </worldbody>
</mujoco>
"""


def test_uncoupled_springs_have_the_frequencies_of_each() -> None:
    model = mujoco.MjModel.from_xml_string(PENDULA)

    assert omega_max(model) == pytest.approx(3.0)
    assert omega_one_link(model) == pytest.approx(3.0)


def test_the_fast_joint_decides_wherever_it_stands() -> None:
    model = mujoco.MjModel.from_xml_string(PENDULA.replace('"8"', '"32"'))

    assert omega_max(model) == pytest.approx(4.0)
    assert omega_one_link(model) == pytest.approx(3.0)


def test_a_record_may_name_each_of_them() -> None:
    assert tuple(MODEL_NUMBERS) == closed_forms.MODEL_NUMBERS
