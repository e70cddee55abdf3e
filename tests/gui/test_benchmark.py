from __future__ import annotations

import mmap
import os
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from fruitgui.errors import WorldError
from fruitgui.gui.benchmark import watches
from fruitgui.gui.benchmark.heartbeat import STEP_MS, Blame, Blocks, Heartbeat
from fruitgui.gui.benchmark.stage import stage_in
from fruitgui.gui.benchmark.watches import Memory


def test_the_line_is_set_up_in_another_process_which_says_what_it_cannot(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    with pytest.raises(WorldError) as raised, stage_in(tmp_path / "file"):
        pass
    assert type(raised.value.__cause__).__name__ == "_RemoteTraceback", "as another process raised it"


def _block(for_s: float) -> None:
    until_s = time.perf_counter() + for_s
    while time.perf_counter() < until_s:
        pass


def test_what_holds_the_window_up_is_measured_and_found(qtbot: QtBot) -> None:
    heart = Heartbeat()
    blame = Blame(heart, 40.0)
    heart.start()
    blame.start()
    qtbot.waitUntil(lambda: heart.take().beats > 0)
    _block(0.2)
    seen = Counter[str]()

    def beaten() -> bool:
        blocks = heart.take()
        seen["over"] += blocks.over
        seen["beats"] += blocks.beats
        seen["longest_ms"] = max(seen["longest_ms"], round(blocks.longest_ms))
        return seen["beats"] > 0

    qtbot.waitUntil(beaten)
    heart.stop()
    assert seen["over"] >= 1
    assert seen["longest_ms"] >= 190
    assert "_block" in blame.stop()


def test_what_the_window_worked_itself_is_told_apart_from_what_it_waited(qtbot: QtBot) -> None:
    heart = Heartbeat()
    heart.start()
    qtbot.waitUntil(lambda: heart.take().beats > 0)
    time.sleep(0.2)  # as another program that has the core
    slept: list[Blocks] = []

    def beaten() -> bool:
        slept.append(heart.take())
        return slept[-1].beats > 0

    qtbot.waitUntil(beaten)
    assert slept[-1].longest_ms >= 190.0
    assert slept[-1].most_work_ms < 100.0
    worked_s = time.thread_time()
    while time.thread_time() - worked_s < 0.1:
        pass
    qtbot.waitUntil(beaten)
    heart.stop()
    assert slept[-1].most_work_ms > 95.0


def _blocks(*beats: tuple[float, float]) -> Blocks:
    """Return beats, each (late, worked) milliseconds."""
    blocks = Blocks()
    for late_ms, work_ms in beats:
        blocks.add(late_ms, work_ms)
    return blocks


def test_beats_are_counted_and_not_kept() -> None:
    late_ms = np.random.default_rng(1).gamma(2.0, 2.0, 200_000) - 1.0
    blocks = _blocks(*((late, 0.0) for late in late_ms[:1000]))
    before = sys.getallocatedblocks()
    for late in late_ms[1000:]:
        blocks.add(late, 0.0)
    assert sys.getallocatedblocks() - before < 1000
    assert blocks.longest_ms == late_ms.max()
    for share in (0.5, 0.99, 0.999):
        assert blocks.quantile_ms(share) == pytest.approx(np.quantile(late_ms, share), abs=STEP_MS)
    assert Blocks().quantile_ms(0.99) == 0.0


def test_what_is_done_before_it_begins_anew_is_nobodys(qtbot: QtBot) -> None:
    heart = Heartbeat()
    heart.start()
    qtbot.waitUntil(lambda: heart.take().beats > 0)
    worked_s = time.thread_time()
    while time.thread_time() - worked_s < 0.1:
        pass
    heart.start()
    blocks = heart.take()
    while blocks.beats == 0:
        qtbot.wait(1)
        blocks = heart.take()
    heart.stop()
    assert blocks.most_work_ms < 95.0


def test_a_figure_says_what_was_asked_and_marks_what_is_not_so() -> None:
    late = _blocks((1.0, 1.0), (70.0, 12.0), (3.0, 3.0)).figure("live screen")
    good = _blocks((1.0, 1.0), (20.0, 12.0)).figure("live screen")
    assert late.met is False
    assert good.met is True
    line = late.line()
    for part in ("! longest block, live screen", "<= 50 ms", " 70 ms", "own work 12 ms", "over 50 ms: 1 of 3"):
        assert part in line
    assert good.line().startswith("  longest block")


def test_memory_that_grows_is_told_by_the_fruit(monkeypatch: pytest.MonkeyPatch) -> None:
    at = iter(range(100))
    monkeypatch.setattr(watches.time, "monotonic", lambda: 2.0 * next(at))
    held = {os.getpid(): iter(range(100, 200)), 7: iter([50] * 100), 8: iter(range(0, 200, 2))}
    monkeypatch.setattr(watches, "resident_mb", lambda pid: float(next(held[pid])))
    monkeypatch.setattr(watches, "beside_pids", lambda: [7, 8])
    memory = Memory()
    for fruit in range(0, 300, 10):
        memory.look(fruit)
    grown, beside, hours = memory.figures(fruit_per_hour=580.0)
    assert grown.measured == "+100.00 MB"
    assert grown.met is False
    assert "110 MB, 129 MB, most 129 MB after 0.6 minutes and 190 fruit" in grown.more
    assert (beside.measured, beside.met) == ("+200.00 MB", False)
    assert "70 MB, 108 MB, most 108 MB of 2 processes" in beside.more
    assert hours.measured == "0.50 hours"


def test_memory_that_was_hardly_looked_at_says_nothing() -> None:
    memory = Memory()
    memory.look(0)
    (figure,) = memory.figures(fruit_per_hour=1.0)
    assert figure.measured == "looked at too few times"
    assert figure.met is None


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not say")
def test_the_process_holds_what_it_was_given() -> None:
    before_mb = watches.resident_mb(os.getpid())
    with mmap.mmap(-1, 50_000_000) as held:  # pages that nobody had before, not what was let go a moment ago
        held.write(b"x" * len(held))
        assert watches.resident_mb(os.getpid()) - before_mb > 45.0


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the system does not say")
def test_processes_beside_are_found_with_those_that_they_started() -> None:
    program = "import subprocess, sys; one = subprocess.Popen([sys.executable, '-c', 'input()'])"
    program += "; print(one.pid, flush=True); one.wait()"
    with subprocess.Popen(
        [sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as first:
        assert first.stdout is not None
        second = int(first.stdout.readline())
        assert {first.pid, second} <= set(watches.beside_pids())
        assert watches.resident_mb(first.pid) > 1.0
        first.communicate("\n")
    assert first.pid not in watches.beside_pids()
    assert watches.resident_mb(first.pid) == 0.0
