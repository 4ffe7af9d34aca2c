"""The watched run: contacts, energies, work and overlaps."""

from __future__ import annotations

import numpy as np
import pytest
from clinic.triage.run import Budget
from clinic.triage.watch import Trial, unmatched
from helpers import BALL, MODEL, PENDULUM, RESTING
from subjects import subject


def test_contacts_are_seen_with_their_depth() -> None:
    _, watch = Trial(subject(RESTING), Budget()).base
    (pair, touch), *_ = watch.touched.items()
    assert pair == (0, 1)
    assert touch.since == 0
    assert 0 < touch.deepest < 1e-3


def test_a_fall_turns_potential_into_kinetic_energy() -> None:
    _, watch = Trial(subject(BALL), Budget()).base
    total = watch.energies.sum(axis=1)
    assert np.ptp(total) < 0.002 * watch.energies[:, 1].max()
    assert watch.supplied[-1] == 0
    assert watch.momenta[-1, 0, 2] == pytest.approx(-2 * 9.81 * 0.999)
    assert watch.fastest[0] == pytest.approx(9.81)


def test_the_work_of_a_motor_is_the_energy_gained() -> None:
    _, watch = Trial(subject(PENDULUM, duration=0.2, ctrl={"motor": -1.0}), Budget()).base
    total = watch.energies.sum(axis=1)
    assert watch.acted.all()
    assert total[-1] - total[0] == pytest.approx(watch.supplied[-1], rel=2e-2)


def test_geoms_whose_masks_do_not_match_are_seen_to_overlap() -> None:
    trial = Trial(subject(MODEL), Budget())
    assert list(unmatched(trial.subject.model)) == [(0, 1)]
    _, watch = trial.base
    assert not watch.touched
    assert 0 < watch.overlaps[(0, 1)] < 0.2


def test_parents_welded_and_excluded_pairs_are_no_unmatched_pairs() -> None:
    xml = """<mujoco><worldbody><body name="a"><joint/><geom size=".1" contype="2" conaffinity="2"/>
      <geom size=".1"/><body name="b"><joint/><geom size=".1"/><body name="c"><joint/>
      <geom size=".1" contype="4" conaffinity="4"/></body></body></body></worldbody>
      <contact><exclude body1="a" body2="c"/></contact></mujoco>"""
    assert list(unmatched(subject(xml).model)) == []


def test_a_double_pendulum_on_its_head_is_chaotic_and_a_fall_is_not() -> None:
    xml = """<mujoco><worldbody><body euler="0 179 0"><joint axis="0 1 0"/><geom type="capsule" size=".02"
      fromto="0 0 0 0 0 -.1"/><body pos="0 0 -.1"><joint axis="0 1 0"/><geom type="capsule" size=".02"
      fromto="0 0 0 0 0 -.1"/></body></body></worldbody><option><flag contact="disable"/></option></mujoco>"""
    assert Trial(subject(xml, duration=8), Budget()).chaos > 1e-3
    assert Trial(subject(BALL), Budget()).chaos < 1e-6
