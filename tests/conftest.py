"""Settings of all tests."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

from tests.emulated_usb.outside import alone

# The same examples at every run: a failure is then always about the change at hand.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")

# A shell that starts the tests in the background lets them, and all that they start, be deaf to the keyboard's
# interrupt; the tests send it to programs that must hear it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


GIVES_WAY = 10
"""The priority of what keeps no device's time: a tenth of what devices have, where there is not enough for all."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Give each file to one worker, which makes its fixtures once; what has a group of its own is long and comes first.

    Devices that keep their own time come before all others, or their worker would have given way already.

    Run with `--dist loadgroup --no-loadscope-reorder`, or a file of one test that takes a minute is the last to begin.
    """
    if not hasattr(config, "workerinput"):
        return
    items.sort(key=lambda item: (not _keeps_time(item), item.get_closest_marker("xdist_group") is None))
    for item in items:
        if item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group(item.nodeid.partition("::")[0]))


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Let devices have a core before all that runs beside them, so that more workers than cores may fill their waits.

    A priority that was given up does not come back, but the devices' worker goes on to others only when they are done.
    """
    if not hasattr(item.config, "workerinput") or _keeps_time(item) or os.getpriority(os.PRIO_PROCESS, 0) >= GIVES_WAY:
        return
    for thread in Path("/proc/self/task").iterdir():
        with contextlib.suppress(ProcessLookupError):  # it ended meanwhile
            os.setpriority(os.PRIO_PROCESS, int(thread.name), GIVES_WAY)


def _keeps_time(item: pytest.Item) -> bool:
    return item.get_closest_marker("xdist_group") == alone.mark


@pytest.fixture
def no_leaked_threads() -> Iterator[None]:
    """Fail the test if a thread or a process that it started is still alive after it."""
    before = set(threading.enumerate())
    yield
    until_s = time.monotonic() + 5.0
    while (left := set(threading.enumerate()) - before) and time.monotonic() < until_s:
        next(iter(left)).join(0.1)
    assert not left, f"left running: {sorted(thread.name for thread in left)}"
    assert not multiprocessing.active_children()
