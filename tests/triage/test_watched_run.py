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
    _, watch = examination(BALL).watched
    energies = np.array(watch.energies)
    assert np.ptp(energies.sum(axis=1)) < 0.002 * energies[:, 1].max()
    assert watch.supplied[-1] == 0
    assert watch.fastest[0] == pytest.approx(9.81)


def test_the_work_of_a_motor_is_the_energy_gained() -> None:
    _, watch = examination(PENDULUM, duration=0.2, ctrl={"motor": -1.0}).watched
    total = np.array(watch.energies).sum(axis=1)
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


def test_a_double_pendulum_on_its_head_is_chaotic_and_a_fall_is_not() -> None:
    xml = """<mujoco><worldbody><body euler="0 179 0"><joint axis="0 1 0"/><geom type="capsule" size=".02"
      fromto="0 0 0 0 0 -.1"/><body pos="0 0 -.1"><joint axis="0 1 0"/><geom type="capsule" size=".02"
      fromto="0 0 0 0 0 -.1"/></body></body></worldbody><option><flag contact="disable"/></option></mujoco>"""
    assert examination(xml, duration=8).chaos > 1e-3
    assert examination(BALL).chaos < 1e-6
