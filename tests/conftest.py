"""Settings of all tests."""

from __future__ import annotations

import multiprocessing
import signal
import threading
import time
from collections.abc import Iterator

import pytest
from hypothesis import settings

# The same examples at every run: a failure is then always about the change at hand.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")

# A shell that starts the tests in the background lets them, and all that they start, be deaf to the keyboard's
# interrupt; the tests send it to programs that must hear it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Give each file to one worker, which makes its fixtures once; what has a group of its own is long and comes first.

    Run with `--dist loadgroup --no-loadscope-reorder`, or a file of one test that takes a minute is the last to begin.
    """
    if not hasattr(config, "workerinput"):
        return
    items.sort(key=lambda item: item.get_closest_marker("xdist_group") is None)
    for item in items:
        if item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group(item.nodeid.partition("::")[0]))


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
