"""Signal paths, read from models whose numbers are known."""

from __future__ import annotations

import math

import mujoco
import pytest
from clinic.engine.signals import Path, SignalError, bind, element_names, parse_path
from helpers import BALL, GRAVITY, PENDULUM, RESTING, compiled

EXPLAINED = "see *Signal paths* in what `clinic reference` prints"


def read(xml: str, path: str) -> float:
    model, data = compiled(xml)
    return bind(parse_path(path), model, data)()


def refusal(xml: str, path: str) -> tuple[str, str, str]:
    with pytest.raises(SignalError) as caught:
        read(xml, path)
    return caught.value.found, caught.value.expected, caught.value.repair


@pytest.mark.parametrize(
    ("text", "path"),
    [
        pytest.param("ncon", Path(False, "", "", "ncon", ()), id="plain"),
        pytest.param(" energy[1] ", Path(False, "", "", "energy", (1,)), id="index-and-spaces"),
        pytest.param("xpos[1][2]", Path(False, "", "", "xpos", (1, 2)), id="two-indices"),
        pytest.param("body(box).xpos[2]", Path(False, "body", "box", "xpos", (2,)), id="element"),
        pytest.param("body(left hand-1).xpos", Path(False, "body", "left hand-1", "xpos", ()), id="any-name"),
        pytest.param("model.joint(elbow).range[1]", Path(True, "joint", "elbow", "range", (1,)), id="of-the-model"),
        pytest.param("model.opt.timestep", Path(True, "", "", "opt.timestep", ()), id="dotted"),
        pytest.param("model.qpos0[2]", Path(True, "", "", "qpos0", (2,)), id="field-with-a-digit"),
        pytest.param("sensor(force)[1]", Path(False, "sensor", "force", "data", (1,)), id="sensor"),
        pytest.param("contact(*).count", Path(False, "contact", "*", "count", ()), id="contacts"),
        pytest.param("warning(BADQACC)", Path(False, "warning", "BADQACC", "", ()), id="warning"),
        pytest.param("printed(tip error)", Path(False, "printed", "tip error", "", ()), id="printed"),
    ],
)
def test_parse(text: str, path: Path) -> None:
    assert parse_path(text) == path


@pytest.mark.parametrize(
    ("text", "repair"),
    [
        pytest.param("", EXPLAINED, id="empty"),
        pytest.param("body(box", EXPLAINED, id="unclosed"),
        pytest.param("body(box)xpos[2]", EXPLAINED, id="without-the-dot"),
        pytest.param(".ncon", EXPLAINED, id="dot-first"),
        pytest.param("xpos[a]", EXPLAINED, id="index-that-is-a-name"),
        pytest.param("xpos[1:2]", EXPLAINED, id="slice"),
        pytest.param("__import__('os').name", EXPLAINED, id="code"),
        pytest.param("body(box).xpos[2] + 1", EXPLAINED, id="arithmetic"),
        pytest.param("bdoy(box).xpos[2]", "write body(box)", id="unknown-kind"),
        pytest.param("quark(box).xpos[2]", "correct it", id="kind-like-none"),
        pytest.param("body( ).xpos", "name the element", id="no-name"),
        pytest.param("body(box)", "add the field after a dot", id="no-field"),
        pytest.param("warning(BADQACC).number", "remove what stands around it", id="field-of-a-warning"),
        pytest.param("printed(error)[1]", "remove what stands around it", id="index-of-a-printed-number"),
    ],
)
def test_no_path(text: str, repair: str) -> None:
    with pytest.raises(SignalError) as caught:
        parse_path(text)
    assert caught.value.repair == repair


@pytest.mark.parametrize(
    ("path", "value"),
    [
        pytest.param("joint(hinge).qfrc_bias", -2 * GRAVITY * 0.5, id="gravity-torque-of-a-horizontal-bob"),
        pytest.param("qfrc_bias[0]", -2 * GRAVITY * 0.5, id="the-same-as-a-plain-field"),
        pytest.param("site(tip).xpos[0]", 0.5, id="site"),
        pytest.param("sensor(where)[0]", 0.5, id="sensor"),
        pytest.param("xpos[1][2]", 0, id="two-indices"),
        pytest.param("time", 0, id="scalar"),
        pytest.param("model.joint(hinge).range[1]", math.pi / 4, id="compiled-range-in-radians"),
        pytest.param("model.actuator(motor).gear[0]", 3, id="gear"),
        pytest.param("model.geom(bob).friction[0]", 0.7, id="friction-of-a-geom"),
        pytest.param("model.body(rod).mass", 2, id="mass"),
        pytest.param("model.opt.timestep", 0.001, id="option"),
        pytest.param("model.opt.gravity[2]", -GRAVITY, id="gravity"),
        pytest.param("warning(BADQACC)", 0, id="warning"),
        pytest.param("contact(*).count", 0, id="no-contacts-counted"),
    ],
)
def test_value_of_the_pendulum(path: str, value: float) -> None:
    assert read(PENDULUM, path) == pytest.approx(value, abs=1e-12)


def settled() -> tuple[mujoco.MjModel, mujoco.MjData]:
    model, data = compiled(RESTING)
    for _ in range(2000):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.parametrize(
    ("path", "value"),
    [
        pytest.param("contact(*).count", 4, id="four-corners"),
        pytest.param("contact(floor, box).count", 4, id="between-two-geoms"),
        pytest.param("contact(box,floor).count", 4, id="in-either-order"),
        pytest.param("contact(box, other).count", 0, id="geoms-that-do-not-touch"),
        pytest.param("contact(*).friction[0]", 0.9, id="friction-is-the-larger-one"),
        pytest.param("contact(*).friction[2]", 0.02, id="element-by-element"),
        pytest.param("contact(*).dim", 3, id="dimension"),
        pytest.param("contact(*).force[0]", 3 * GRAVITY / 4, id="each-corner-carries-a-quarter-of-the-weight"),
        pytest.param("contact(*).frame[2]", 1, id="normal-points-up"),
        pytest.param("contact(*).pos[0]", 0.05, id="largest-over-the-contacts"),
    ],
)
def test_contacts_of_a_resting_box(path: str, value: float) -> None:
    model, data = settled()
    assert bind(parse_path(path), model, data)() == pytest.approx(value, rel=1e-6, abs=1e-9)


def test_the_constraint_forces_of_a_resting_box_carry_its_weight() -> None:
    model, data = settled()
    forces = [bind(parse_path(f"efc_force[{i}]"), model, data)() for i in range(data.nefc)]
    assert sum(forces) == pytest.approx(3 * GRAVITY, rel=1e-6)


@pytest.mark.parametrize(
    "path", ["contact(*).friction[0]", "contact(*).force[0]", "contact(floor, other).dist", "efc_force[99]"]
)
def test_what_is_not_there_is_not_a_number(path: str) -> None:
    model, data = compiled(RESTING.replace("0.0499", "0.5"))
    assert math.isnan(bind(parse_path(path), model, data)())


def test_reader_follows_the_data() -> None:
    model, data = compiled(BALL)
    height, time = (bind(parse_path(path), model, data) for path in ("body(ball).xpos[2]", "time"))
    mujoco.mj_step(model, data)
    mujoco.mj_step(model, data)
    assert height() == pytest.approx(1 - GRAVITY * 0.001**2)
    assert time() == pytest.approx(0.002)


def test_warning_counts() -> None:
    model, data = compiled(BALL)
    count = bind(parse_path("warning(BADCTRL)"), model, data)
    data.warning[mujoco.mjtWarning.mjWARN_BADCTRL].number = 3
    assert count() == 3


@pytest.mark.parametrize(
    ("path", "found", "expected", "repair"),
    [
        ("body(rood).xpos[0]", "the body rood, which the model does not have", "a body: world, rod", "write rod"),
        (
            "tendon(string).length",
            "the tendon string, which the model does not have",
            "a tendon: none",
            "correct the name, or name the tendon in the model",
        ),
        ("body(rod).xpos[3]", "body(rod).xpos[3]", "1 index(es) from 0 into 3 numbers", "correct the index"),
        ("body(rod).xpos[-1]", "body(rod).xpos[-1]", "1 index(es) from 0 into 3 numbers", "correct the index"),
        ("xpos[1]", "data.xpos[1]", "2 index(es) from 0 into 2 x 3 numbers", "correct the index"),
        ("ncon[0]", "data.ncon[0]", "no index: it is one number", "correct the index"),
        ("body(rod).name", "body(rod).name", "a field that holds numbers", "name a numeric field"),
        ("contact", "data.contact", "a field that holds numbers", "name a numeric field"),
        (
            "warning(BADLUCK)",
            "warning(BADLUCK)",
            "one of INERTIA, CONTACTFULL, CNSTRFULL, BADQPOS, BADQVEL, BADQACC, BADCTRL",
            "correct the name",
        ),
        ("contact(bob).dist", "contact(bob)", "`*`, or two geoms: bob", "name the two geoms of the contact"),
        (
            "contact(*).colour",
            "contact(...).colour",
            "one of friction, dist, pos, frame, includemargin, dim, force, count",
            "correct the field",
        ),
        ("contact(*).pos[3]", "contact(...).pos[3]", "an index below 3", "correct it"),
        ("printed(error)", "printed(error)", "a path into MuJoCo: this case is a model", "read the model"),
    ],
)
def test_refused_by_the_pendulum(path: str, found: str, expected: str, repair: str) -> None:
    assert refusal(PENDULUM, path) == (found, expected, repair)


@pytest.mark.parametrize(
    ("path", "repair"),
    [
        pytest.param("body(rod).xpso[0]", "write xpos", id="misspelt"),
        pytest.param("body(rod).__class__", "correct the field", id="private"),
        pytest.param("model.opt.timstep", "write timestep", id="nested"),
        pytest.param("model.body(rod).xpos[0]", "write pos", id="field-of-the-data-asked-of-the-model"),
    ],
)
def test_missing_field(path: str, repair: str) -> None:
    found, _, said = refusal(PENDULUM, path)
    assert found.endswith(", which does not exist")
    assert said == repair


def test_names_leave_out_the_unnamed() -> None:
    model, _ = compiled(RESTING)
    assert element_names(model, "joint") == []
    assert element_names(model, "geom") == ["floor", "box", "other"]
