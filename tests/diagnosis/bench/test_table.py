"""The measurement: a seeded sample of it, and that what is found is judged rightly."""

from __future__ import annotations

import json
from random import Random

import pytest
from clinic.diagnosis.bench import table, trial
from clinic.diagnosis.bench.faults import Fault, kinds
from clinic.diagnosis.bench.healthy import KNOWN, Healthy
from clinic.diagnosis.bench.lock import differing, read_lock
from clinic.diagnosis.bench.table import Bench, Task, data, measure, tasks
from clinic.diagnosis.bench.trial import Told, plant_one
from clinic.record.checkout import cache_folder
from clinic.work.cache import Cache
from subjects import LEGS

SMALL = 16  # degrees of freedom


def sample(models: list[Healthy]) -> list[Task]:
    """Eight small healthy models, and sixteen plants, of the models that rules are made with."""
    drawn, random = tasks(models, 0, 1, held_out=False), Random(19)
    healthy = random.sample([task for task in drawn if not task.kind and task.models[0].dofs <= SMALL], 8)
    return healthy + random.sample([task for task in drawn if task.kind], 16)


@pytest.fixture(scope="module")
def bench(root):
    return measure(root, Cache(cache_folder(root)), sample, tell=lambda done, of: None)


@pytest.fixture(scope="module")
def sampled(bench):
    return data(bench)


@pytest.fixture
def legs(tmp_path):
    (tmp_path / "legs.xml").write_text(LEGS)
    return Healthy("legs.xml", str(tmp_path / "legs.xml"), 10)


def test_healthy_models_of_the_sample_get_no_cause(sampled):
    assert sampled["healthy"]["seen"]["models"] == 8
    assert [(name, found["causes"]) for name, found in sampled["models"].items() if found["causes"]] == []


def test_the_sample_comes_out_as_the_lock_has_it(bench, root):
    assert list(differing(read_lock(root), bench)) == []


def test_plants_of_the_sample_do_harm_and_no_rule_stumbles(sampled):
    assert sampled["planted"]["seen"]["harmful"] >= 8
    assert sampled["stumbled"] == []


def test_a_cause_on_a_healthy_model_is_false_unless_the_fault_is_known():
    def told(*rules: str) -> Told:
        return Told(findings=[{"rule": rule, "level": "cause", "right": False} for rule in rules])

    healthy = [(Healthy(name, "", 3), told("weak-servo", *faults)) for name, faults in KNOWN.items()]
    made = data(Bench(0, [*healthy, (Healthy("a/robot.xml", "", 3), told("lighter-than-air"))], [], [], {}))
    assert [made["models"][name]["causes"] for name in KNOWN] == [["weak-servo"]] * len(KNOWN)
    assert made["models"]["a/robot.xml"]["causes"] == ["lighter-than-air"]
    assert made["healthy"]["seen"]["with_a_cause"] == len(healthy) + 1


def test_the_table_is_plain_data(sampled):
    assert json.loads(json.dumps(sampled)) == sampled
    assert {row["kind"] for row in sampled["kinds"]} == set(kinds())
    for row in (*sampled["rules"], *sampled["kinds"]):
        counts = row["seen"]
        assert counts["harmful"] == sum(counts[name] for name in table.OUTCOMES)


def test_a_text_fault_is_found_where_it_was_planted(legs):
    made = plant_one([legs], "number-malformed", 3, 0)
    assert made["harm"] == "does not compile"
    first = made["told"]["findings"][0]
    assert (first["rule"], first["right"]) == ("malformed-number", True)


def test_a_plant_that_does_no_harm_is_not_diagnosed(legs, monkeypatch):
    monkeypatch.setattr(trial, "HARMS", dict.fromkeys(trial.HARMS, lambda was, now: 0.5))
    made = plant_one([legs], "mass-too-large", 3, 0)
    assert (made["harm"], made["harmless"], made["told"]["findings"]) == ("", 0, [])


def test_the_same_seed_plants_the_same(legs, monkeypatch):
    monkeypatch.setattr(trial, "_diagnosed", lambda texts: Told())
    assert plant_one([legs], "twin-range", 5, 2) == plant_one([legs], "twin-range", 5, 2)
    strengths = {plant_one([legs], "mass-too-large", 5, number)["strength"] for number in range(5)}
    assert len(strengths) > 1


def finding(**changes: object) -> dict[str, object]:
    given = {
        "rule": "no-armature",
        "level": "cause",
        "attribute": "armature",
        "elements": ['joint "wrist"'],
        "lines": [],
    }
    return {**given, **changes}


@pytest.mark.parametrize(
    ("changes", "right"),
    [
        ({}, True),
        ({"elements": ['joint "elbow"']}, False),
        ({"elements": ['joint "elbow"'], "lines": [["m.xml", 7]]}, True),
        ({"elements": [], "lines": [["m.xml", 8]]}, False),
        ({"rule": "weak-servo"}, False),
        ({"rule": "weak-servo", "attribute": "kp"}, True),
        ({"rule": "twin-joint-differs"}, True),
        ({"rule": "twin-joint-differs", "elements": ['joint "elbow"']}, False),
    ],
)
def test_a_finding_is_right_about_what_was_planted_where_it_was(changes, right):
    fault = Fault((), ('joint "wrist"', 'actuator "drive"'), "kp")
    assert trial._right(finding(**changes), kinds()["servo-stiff"], fault, {("m.xml", 7)}) == right


def test_changed_lines_are_those_of_the_planted_text():
    before = "a\nb\nc\nd\n"
    assert trial._changed_lines({"m": before}, {"m": "a\nX\nc\nd\n"}) == {("m", 2)}
    assert trial._changed_lines({"m": before}, {"m": "a\nb\nX\nY\nc\nd\n"}) == {("m", 3), ("m", 4)}
    assert trial._changed_lines({"m": before}, {"m": "a\nc\nd\n"}) & {("m", 1), ("m", 2)}


@pytest.mark.parametrize(("rule", "right"), [("gravity", True), ("twin-joint-differs", False)])
def test_a_twin_is_no_answer_to_a_fault_of_the_whole_model(rule, right):
    fault = Fault((), (), "gravity")
    told = finding(rule=rule, attribute="gravity" if rule == "gravity" else "")
    assert trial._right(told, kinds()["gravity-wrong"], fault, set()) == right
