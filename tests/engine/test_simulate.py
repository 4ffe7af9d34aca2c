"""Runs, against motions with closed forms."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from clinic.engine.signals import parse_path
from clinic.engine.simulate import (
    MAX_STEPS,
    RunError,
    compile_model,
    data_at,
    initial_data,
    simulate,
    step_count,
)
from clinic.record.fields import RunSpec
from helpers import BALL, GRAVITY, PENDULUM

EXPLODING = """\
<mujoco>
  <option timestep="0.01"/>
  <worldbody>
    <body>
      <joint name="spring" type="slide" stiffness="300" springref="1"/>
      <geom size="0.1" mass="0.001"/>
    </body>
  </worldbody>
  <actuator>
    <motor name="motor" joint="spring"/>
  </actuator>
</mujoco>
"""
"""A stretched spring far beyond the integrator's limit of stability: it explodes, is reset, and explodes again."""


def spec(**fields: Any) -> RunSpec:
    return RunSpec.model_validate({"duration": 0.5, **fields}, strict=False)


def run(xml: str, run_spec: RunSpec, **paths: str) -> Any:
    return simulate(compile_model(xml), run_spec, {name: parse_path(path) for name, path in paths.items()})


def test_free_fall_is_sampled_after_every_step() -> None:
    made = run(BALL, spec(), height="body(ball).xpos[2]", fallen="qpos[2]")

    n = np.arange(1, 501)
    assert made.steps == 500
    assert made.traces["fallen"].time == pytest.approx(n * 0.001)
    # Semi-implicit Euler: after n steps the ball has fallen g h^2 (1 + 2 + ... + n).
    assert made.traces["fallen"].value == pytest.approx(1 - GRAVITY * 0.001**2 * n * (n + 1) / 2, abs=1e-12)
    # What is derived from the state, as mj_step leaves it, is that of the step's start.
    assert made.traces["height"].value[1:] == pytest.approx(made.traces["fallen"].value[:-1], abs=1e-12)


@pytest.mark.parametrize(
    ("fields", "position", "velocity"),
    [
        pytest.param({}, 0, 0, id="nothing-given"),
        pytest.param({"keyframe": "hanging"}, math.pi / 2, 0, id="keyframe"),
        pytest.param({"qpos": {"hinge": 0.3}}, 0.3, 0, id="position"),
        pytest.param({"qvel": {"hinge": -2}}, 0, -2, id="velocity"),
        pytest.param({"keyframe": "hanging", "qpos": {"hinge": 0.3}}, 0.3, 0, id="position-after-keyframe"),
    ],
)
def test_start(fields: dict[str, Any], position: float, velocity: float) -> None:
    data = initial_data(compile_model(PENDULUM), spec(**fields))
    assert (data.qpos[0], data.qvel[0]) == pytest.approx((position, velocity))


def test_nudge_acts_on_the_start() -> None:
    def nudge(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.qpos[2] += model.nq

    assert initial_data(compile_model(BALL), spec(), nudge).qpos[2] == 8


@pytest.mark.parametrize(
    ("control", "expected"),
    [
        pytest.param(0.5, [0.5, 0.5, 0.5, 0.5], id="constant"),
        pytest.param([(0.001, 1.0), (0.003, 3.0)], [1, 1, 2, 3], id="linear-between-constant-outside"),
        pytest.param([(0.002, 1.0)], [1, 1, 1, 1], id="one-point"),
    ],
)
def test_control_over_time(control: Any, expected: list[float]) -> None:
    made = run(PENDULUM, spec(duration=0.004, ctrl={"motor": control}), force="actuator(motor).force[0]")
    assert made.traces["force"].value == pytest.approx(expected)


def test_keyframe_brings_its_control() -> None:
    made = run(PENDULUM, spec(duration=0.001, keyframe="hanging"), force="actuator(motor).force[0]")
    assert made.traces["force"].value == pytest.approx([2])


@pytest.mark.parametrize(
    ("fields", "told"),
    [
        ({"keyframe": "hangin"}, "keyframe: the key hangin, which the model does not have; expected a key: hanging"),
        ({"qpos": {"hnge": 1}}, "qpos.hnge: the joint hnge, which the model does not have; expected a joint: hinge"),
        ({"ctrl": {"motr": 1}}, "ctrl.motr: the actuator motr, which the model does not have; expected an actuator"),
        ({"ctrl": {"motor": [(1, 0), (1, 2)]}}, "ctrl.motor: times [1.0, 1.0]; expected one or more times, each after"),
        ({"ctrl": {"motor": []}}, "ctrl.motor: times []; expected one or more times"),
        ({"duration": 1e-5}, f"duration: 1e-05 s at a timestep of 0.001 s; expected 1 to {MAX_STEPS} steps"),
    ],
)
def test_run_that_cannot_start(fields: dict[str, Any], told: str) -> None:
    with pytest.raises(RunError) as caught:
        run(PENDULUM, spec(**fields))
    assert str(caught.value).startswith(f"run.{told}")


def test_start_of_a_joint_with_many_numbers_is_refused() -> None:
    with pytest.raises(RunError, match="a joint with 6 numbers"):
        initial_data(compile_model(BALL), spec(qvel={"free": 1}))


@pytest.mark.parametrize(
    ("timestep", "duration", "steps"),
    [(0.002, 1.0, 500), (0.003, 1.0, 333), (0.0005, 0.3, 600), (0.1, 0.06, 1)],
)
def test_steps_are_duration_over_timestep_rounded(timestep: float, duration: float, steps: int) -> None:
    model = compile_model(BALL)
    model.opt.timestep = timestep
    assert step_count(model, spec(duration=duration)) == steps


def test_explosion_is_counted_although_the_reset_clears_it_and_ends_after_its_steps(
    capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    made = run(EXPLODING, spec(ctrl={"motor": [(0.0, 1e11), (0.01, 0.0)]}), time="time")

    assert made.steps == len(made.traces["time"].value) == 50
    assert np.sum(np.diff(made.traces["time"].value) < 0) > 1, "each reset turns time back"
    assert made.warnings == {"BADCTRL": 1, "BADQACC": 1}
    assert [message.split(" at ")[0].split()[-1] for message in made.messages] == ["CTRL", "QACC"]
    assert capfd.readouterr() == ("", "")
    assert not list(tmp_path.iterdir()), "MuJoCo's own log"


def test_quiet_run_has_no_warnings() -> None:
    made = run(BALL, spec())
    assert (made.warnings, made.messages, made.traces) == ({}, (), {})


def test_compile_error_is_said_by_mujoco() -> None:
    with pytest.raises(ValueError, match="unrecognized element"):
        compile_model("<mujoco><worldbdy/></mujoco>")


@pytest.mark.parametrize("time", [0.0, 0.1, 0.25])
def test_data_at_is_the_state_of_the_run_brought_up_to_date(time: float) -> None:
    data = data_at(compile_model(BALL), spec(), time)
    n = round(time / 0.001)
    height = 1 - GRAVITY * 0.001**2 * n * (n + 1) / 2
    assert data.time == pytest.approx(time)
    assert data.body("ball").xpos[2] == pytest.approx(height, abs=1e-12)


@pytest.mark.parametrize("timestep", [1e-9, 1e-320, 0.0, -1.0, math.nan])
def test_a_timestep_that_makes_no_run(timestep: float) -> None:
    model = compile_model(BALL)
    model.opt.timestep = timestep
    with pytest.raises(RunError, match=f"expected 1 to {MAX_STEPS} steps"):
        step_count(model, spec())
