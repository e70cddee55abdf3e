"""Tests of one group run on one worker: what is dear is made once, and devices that keep their own time have a core."""

from __future__ import annotations

import os

import pytest

from tests.conftest import GIVES_WAY
from tests.emulated_usb.outside import alone


def test_workers_take_whole_groups_where_they_are_asked_to(request: pytest.FixtureRequest) -> None:
    if not request.config.getoption("loadgroup", default=False):
        pytest.skip("no workers that were asked to")
    path = request.node.nodeid.partition("::")[0]
    assert request.node.nodeid.endswith(f"@{path}"), "pytest and pytest-xdist do not fit: every test goes anywhere"


@alone
def test_devices_have_the_priority_of_the_whole_run(request: pytest.FixtureRequest) -> None:
    if not hasattr(request.config, "workerinput"):
        pytest.skip("no workers")
    assert os.getpriority(os.PRIO_PROCESS, 0) == os.getpriority(os.PRIO_PROCESS, os.getppid())


def test_all_others_give_way_to_devices(request: pytest.FixtureRequest) -> None:
    if not hasattr(request.config, "workerinput"):
        pytest.skip("no workers")
    assert os.getpriority(os.PRIO_PROCESS, 0) >= GIVES_WAY
