"""The kinds of faults: each finds a place, changes the text, and is drawn anew from the same seed alike."""

from __future__ import annotations

from random import Random

import mujoco
import pytest
from clinic.diagnosis.bench.faults import DOES_NOT_COMPILE, Kind, kinds
from clinic.diagnosis.bench.faults.servo import with_servos
from clinic.diagnosis.bench.harm import HARMS
from clinic.diagnosis.edit import apply
from clinic.diagnosis.native import NativeEngine
from clinic.diagnosis.reader_model import ReaderModel
from clinic.diagnosis.source import Source
from clinic.diagnosis.start import Start
from subjects import LEGS

ELSEWHERE = {  # the model names no file, has no mesh, and one `<inertial>` and three servos
    "control-range-of-one",
    "file-missing",
    "inertial-forgotten",
    "mesh-in-millimetres",
}


def read(text: str) -> ReaderModel:
    texts = {"model.xml": text}
    made = ReaderModel(NativeEngine(), texts, Source(texts), Start())
    assert not made.error
    return made


@pytest.fixture(scope="module")
def healthy():
    return read(LEGS)


@pytest.fixture(scope="module")
def with_position_servos(healthy):
    return read(apply(healthy.texts, with_servos(healthy))["model.xml"])


@pytest.fixture(params=kinds().values(), ids=kinds())
def kind(request):
    return request.param


def planted(kind: Kind, model: ReaderModel, seed: str) -> str | None:
    fault = kind.plant(model, Random(seed))
    return apply(model.texts, fault.edits)["model.xml"] if fault else None


def test_a_kind_changes_the_text_as_it_says(kind, healthy, with_position_servos):
    model = with_position_servos if kind.servos else healthy
    made = [text for n in range(12) if (text := planted(kind, model, str(n)))]
    assert bool(made) == (kind.name not in ELSEWHERE)
    for text in made:
        assert text not in (healthy.texts["model.xml"], with_position_servos.texts["model.xml"])
    refused = sum(bool(ReaderModel(NativeEngine(), {"model.xml": text}, None, Start()).error) for text in made)
    assert refused >= 0.7 * len(made) if kind.harms == DOES_NOT_COMPILE else refused <= 0.3 * len(made)


def test_one_seed_gives_one_plant(kind, healthy):
    assert planted(kind, healthy, "7") == planted(kind, healthy, "7")


def test_the_truth_names_what_is_there(kind, healthy, with_position_servos):
    model = with_position_servos if kind.servos else healthy
    fault = next((made for n in range(12) if (made := kind.plant(model, Random(n)))), None)
    if fault is None:
        assert kind.name in ELSEWHERE
        return
    there = {
        model.simulation.name(of, i)
        for of in ("body", "joint", "geom", "site", "camera", "actuator", "sensor")
        for i in range(model.simulation.count(of))
    }
    fresh = {'geom "planted"', "the timestep", "the integrator"} | {
        f"geom {i} of {name}" for i in range(20) for name in there
    }
    assert set(fault.elements) <= there | fresh


def test_every_kind_says_what_its_harm_is_and_which_rule_it_measures(kind):
    assert kind.rules
    assert kind.text.endswith(".")
    assert kind.harms == DOES_NOT_COMPILE or set(kind.harms) <= set(HARMS)


def test_servos_take_the_place_of_motors(healthy, with_position_servos):
    made = mujoco.MjModel.from_xml_string(with_position_servos.texts["model.xml"])
    assert made.nu == 3
    assert (made.actuator_biasprm[:, 1] < 0).all()
    assert made.actuator_ctrlrange[2].tolist() == [-1, 1]
