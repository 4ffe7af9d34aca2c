"""Tests that share what is dear to set up run in one worker."""

from __future__ import annotations

import pytest


@pytest.mark.xdist_group("together")
def test_groups_reach_the_scheduler(request: pytest.FixtureRequest, worker_id: str) -> None:
    if worker_id == "master":
        pytest.skip("one process runs every test")
    assert request.node.nodeid.endswith("@together"), (
        "no groups: run with `--dist loadgroup`; if that was so, this pytest-xdist ignores them: see pyproject.toml"
    )
