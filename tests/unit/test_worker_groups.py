"""Tests of one group run on one worker: what is dear is made once, and devices that keep their own time have a core."""

from __future__ import annotations

import pytest


def test_workers_take_whole_groups_where_they_are_asked_to(request: pytest.FixtureRequest) -> None:
    if not request.config.getoption("loadgroup", default=False):
        pytest.skip("no workers that were asked to")
    path = request.node.nodeid.partition("::")[0]
    assert request.node.nodeid.endswith(f"@{path}"), "pytest and pytest-xdist do not fit: every test goes anywhere"
