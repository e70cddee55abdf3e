from __future__ import annotations

import mmap
import time
from collections import Counter
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from fruitgui.gui.benchmark import watches
from fruitgui.gui.benchmark.heartbeat import Blame, Heartbeat
from fruitgui.gui.benchmark.watches import Memory


def _block(for_s: float) -> None:
    until_s = time.perf_counter() + for_s
    while time.perf_counter() < until_s:
        pass


def test_what_holds_the_window_up_is_measured_and_found(qtbot: QtBot) -> None:
    heart = Heartbeat()
    blame = Blame(heart, 40.0)
    heart.start()
    blame.start()
    qtbot.waitUntil(lambda: len(heart.take().late_ms) > 0)
    _block(0.2)
    seen = Counter[str]()

    def beaten() -> bool:
        blocks = heart.take()
        seen["over"] += blocks.over
        seen["beats"] += len(blocks.late_ms)
        seen["longest_ms"] = max(seen["longest_ms"], round(blocks.longest_ms))
        return seen["beats"] > 0

    qtbot.waitUntil(beaten)
    heart.stop()
    assert seen["over"] >= 1
    assert seen["longest_ms"] >= 190
    assert "_block" in blame.stop()


def test_memory_that_grows_is_told_by_the_hour(monkeypatch: pytest.MonkeyPatch) -> None:
    at = iter(range(100))
    monkeypatch.setattr(watches.time, "monotonic", lambda: 2.0 * next(at))
    held = iter(range(100, 200))
    monkeypatch.setattr(watches, "resident_mb", lambda: float(next(held)))
    memory = Memory()
    for fruit in range(30):
        memory.look(fruit)
    words = memory.words()
    assert "110 MB, 129 MB" in words
    assert "19 fruit" in words
    assert "+1800 MB an hour" in words


def test_memory_that_was_hardly_looked_at_says_nothing() -> None:
    memory = Memory()
    memory.look(0)
    assert memory.words() == "looked at too few times"


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not say")
def test_the_process_holds_what_it_was_given() -> None:
    before_mb = watches.resident_mb()
    with mmap.mmap(-1, 50_000_000) as held:  # pages that nobody had before, not what was let go a moment ago
        held.write(b"x" * len(held))
        assert watches.resident_mb() - before_mb > 45.0
