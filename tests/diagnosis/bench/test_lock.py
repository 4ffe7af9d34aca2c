"""The lock of the bench: the law that a cause is found in four of five plants, and that the lock is not stale."""

from __future__ import annotations

import pytest
from clinic.diagnosis.bench.faults import kinds
from clinic.diagnosis.bench.healthy import Healthy
from clinic.diagnosis.bench.lock import (
    Kept,
    KindKept,
    differing,
    kept,
    lock_text,
    read_lock,
    score,
    stale,
    unlawful,
    with_kinds,
)
from clinic.diagnosis.bench.table import Bench
from clinic.diagnosis.bench.trial import Plant, Told
from clinic.diagnosis.rules import rules


@pytest.fixture(scope="module")
def lock(root):
    return read_lock(root)


def test_a_rule_that_is_a_cause_finds_four_of_five_plants(lock):
    assert list(unlawful(lock)) == []


def test_the_lock_knows_all_rules_and_kinds(lock):
    assert list(stale(lock)) == []


def test_the_lock_is_written_as_it_stands(lock, root):
    assert (root / "bench.lock.json").read_text() == lock_text(lock)


def of(seen: str, held_out: str, rule: str = "condim-1", kind: str = "condim-1") -> Kept:
    return Kept(kinds={kind: KindKept(rule=rule, seen=seen, held_out=held_out)})


def said(lock: Kept, rule: str = "condim-1") -> str:
    return "\n".join(each for each in unlawful(lock) if each.startswith(f"{rule}: "))


def test_a_score_counts_the_plants_that_do_harm():
    found = score(of("cch-l", "cm.."), "condim-1")
    assert (found.plants, found.harmful, found.found, found.told) == (7, 6, 3, 2)
    assert (found.seen, found.held_out, found.share) == ((2, 4), (1, 2), 0.5)


@pytest.mark.parametrize(
    ("seen", "held_out", "why"),
    [
        ("cccc", "cccc", ""),
        ("cccm", "cccc", ""),
        ("cccm", "ccc", ""),
        ("ccch", "cclc", "finds 6 of 8 harmful faults"),
        ("c-", "--", "1 harmful faults are planted for it"),
        ("cccccccccccccccccccc", "cccmm", "finds 3 of 5 faults in held-out models, and 20 of 20"),
    ],
)
def test_the_law_of_a_cause(seen, held_out, why):
    told = said(of(seen, held_out))
    assert why in told
    assert bool(told) == bool(why)


def test_a_hint_may_miss_what_it_will():
    assert rules()["spring-far-off"].level == "hint"
    assert said(of("mmmm", "mmmm", "spring-far-off", "spring-pulls-away"), "spring-far-off") == ""


def test_a_rule_without_plants_says_why():
    without = {name for name in rules() if not any(kind.rules[0] == name for kind in kinds().values())}
    assert without == {name for name, rule in rules().items() if rule.unplanted}


def test_a_lock_that_lacks_a_kind_or_a_rule_is_stale():
    told = "\n".join(stale(of("c", "c", "another-rule")))
    assert "condim-1 measures condim-1, and bench.lock.json has another-rule" in told
    assert "the kind masks-of-a-body is in the code alone" in told
    assert "the rule weak-servo is in the code alone: `clinic bench-rules --write`" in told


def plant(number: int, level: str, kind: str = "condim-1", harm: str = "strays") -> Plant:
    findings = [{"rule": "condim-1", "level": level, "right": True}] if level else []
    return Plant(kind, "a/robot.xml", False, [], "condim", 1.0, harm, 0, Told(findings), number=number)


def test_what_was_measured_is_kept_in_the_order_of_the_plants():
    named = {"rule": "weak-servo", "level": "cause", "right": False}
    healthy = [(Healthy("a/robot.xml", "", 3), Told([named]))]
    made = kept(Bench(0, healthy, [plant(2, "hint"), plant(0, "cause")], [("condim-1", False, 1)], {}), 3)
    assert made.kinds["condim-1"].seen == "c.h"
    assert made.false == {"a/robot.xml": ["weak-servo"]}
    assert sum(made.healthy.values()) == 1


def test_some_kinds_measured_anew_leave_the_others():
    old = of("mm", "mm").model_copy(update={"seconds": {"condim-1": 2.0}, "false": {"a": ["b"]}})
    new = of("cc", "cc", "masks", "masks-of-a-body").model_copy(update={"seconds": {"condim-1": 1.0}})
    made = with_kinds(old, new)
    assert {name: row.seen for name, row in made.kinds.items()} == {"condim-1": "mm", "masks-of-a-body": "cc"}
    assert (made.seconds, made.false) == ({"condim-1": 2.0}, {"a": ["b"]})


def test_a_plant_that_comes_out_otherwise_is_told():
    lock = of("cm", "")
    assert list(differing(lock, Bench(0, [], [plant(0, "cause"), plant(1, "")], [], {}))) == []
    (told,) = differing(lock, Bench(0, [], [plant(1, "hint")], [], {}))
    assert "plant 1 of condim-1 in a/robot.xml: bench.lock.json has missed, it is hint" in told
    named = Told([{"rule": "weak-servo", "level": "cause", "right": False}])
    (told,) = differing(lock, Bench(0, [(Healthy("a/robot.xml", "", 3), named)], [], [], {}))
    assert "has [] as its causes, it is ['weak-servo']" in told
