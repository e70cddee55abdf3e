"""Settings of all tests."""

from __future__ import annotations

import multiprocessing
import threading
import time
from collections.abc import Iterator

import pytest
from hypothesis import settings

# The same examples at every run: a failure is then always about the change at hand.
settings.register_profile("repeatable", derandomize=True, deadline=None)
settings.load_profile("repeatable")


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
