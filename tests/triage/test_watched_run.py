"""The watched run: contacts, energies, work and overlaps."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import BALL, MODEL, PENDULUM, RESTING
from subjects import examination


def test_contacts_are_seen() -> None:
    _, watch = examination(RESTING).watched
    assert (0, 1) in watch.touching


def test_a_fall_turns_potential_into_kinetic_energy() -> None:
    run, watch = examination(BALL).watched
    assert np.ptp(run.energies.sum(axis=1)) < 0.002 * run.energies[:, 1].max()
    assert watch.supplied[-1] == 0
    assert watch.fastest[0] == pytest.approx(9.81)


def test_the_work_of_a_motor_is_the_energy_gained() -> None:
    run, watch = examination(PENDULUM, duration=0.2, ctrl={"motor": -1.0}).watched
    total = run.energies.sum(axis=1)
    assert total[-1] - total[0] == pytest.approx(watch.supplied[-2], rel=2e-2)


def test_geoms_whose_masks_do_not_match_are_seen_to_overlap() -> None:
    examined = examination(MODEL)
    _, watch = examined.watched
    assert not watch.touching
    assert 0 < watch.overlaps[(0, 1)] < 0.2


def test_parents_welded_and_excluded_pairs_do_not_overlap() -> None:
    xml = """<mujoco><worldbody><body name="a"><joint/><geom size=".1" contype="2" conaffinity="2"/>
      <geom size=".1"/><body name="b"><joint/><geom size=".1"/><body name="c"><joint/>
      <geom size=".1" contype="4" conaffinity="4"/></body></body></body></worldbody>
      <contact><exclude body1="a" body2="c"/></contact></mujoco>"""
    assert examination(xml).watched[1].overlaps == {}
