"""The window while the line runs flat out, timed from inside."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

from PySide6.QtCore import QDeadlineTimer, QEventLoop
from PySide6.QtWidgets import QApplication

from fruitgui.gui.app import Application
from fruitgui.gui.benchmark.heartbeat import Blame, Heartbeat
from fruitgui.gui.benchmark.stage import start_flat_out
from fruitgui.gui.benchmark.watches import Memory, PictureCount
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.station.workflow import Step

WARM_FRUIT = 10
PATIENCE_MS = 120_000
ON_A_STEP_S = 3.0


class Run:
    """One window on one folder, from opening to closing; figures as lines."""

    def __init__(self, qt: QApplication, folder: Path) -> None:
        self._qt = qt
        self._folder = folder
        self._application = Application(qt, folder)
        self._session = self._application.session
        self._heart = Heartbeat(self._application)

    def figures(self, minutes: float, blame_ms: float | None) -> Iterator[str]:
        """Give one line for each figure."""
        blame = None if blame_ms is None else Blame(self._heart, blame_ms)
        self._application.start()
        self._heart.start()
        self._wait_until(lambda: self._session.connected.feed is not None and not self._session.tasks.running)
        yield f"while the sensors start: {self._heart.take().words()}"
        start_flat_out(self._session, self._folder)
        self._wait_until(lambda: self._session.running.tally.count_all >= WARM_FRUIT)
        yield f"while the line starts: {self._heart.take().words()}"
        if blame is not None:
            blame.start()
        yield from self._running(minutes)
        yield from self._walking()
        if blame is not None:
            yield blame.stop()
        yield self._closing()

    def _running(self, minutes: float) -> Iterator[str]:
        page = self._application.window.page(Step.LIVE)
        assert isinstance(page, LivePage)  # noqa: S101 - it is the live step's
        pictures, memory = PictureCount(page.body.pictures.pictures, page), Memory()
        running, began_s = self._session.running, time.monotonic()
        before = running.state
        until_s = began_s + 60.0 * minutes

        def over() -> bool:
            memory.look(running.tally.count_all)
            return time.monotonic() >= until_s

        self._wait_until(over, round(60_000 * minutes) + PATIENCE_MS)
        took_s, painted, after = time.monotonic() - began_s, pictures.take(), running.state
        yield f"live screen while the line runs flat out: {self._heart.take().words()}"
        if before is not None and after is not None:
            rates = ", ".join(f"{sensor} {count / took_s:.1f}/s" for sensor, count in sorted(painted.items()))
            yield f"pictures shown: {rates}; the line followed {(after.frames - before.frames) / took_s:.1f}/s of both"
            yield f"left out by the line: {sum(after.dropped.values())}; could not be used: {after.skipped}"
        yield f"memory: {memory.words()}"

    def _walking(self) -> Iterator[str]:
        """Look at every screen while the line goes on."""
        for step in (*Step, Step.LIVE):
            self._application.window.go_to(step)
            until_s = time.monotonic() + ON_A_STEP_S
            self._wait_until(lambda until_s=until_s: time.monotonic() >= until_s)  # type: ignore[misc]
            yield f"going to {step} while the line runs: {self._heart.take().words()}"

    def _closing(self) -> str:
        began_s = time.monotonic()
        self._application.window.close()
        closed_s = time.monotonic() - began_s
        self._heart.stop()
        return f"closing while the line runs: {closed_s:.1f} s"

    def _wait_until(self, ready: Callable[[], bool], most_ms: int = PATIENCE_MS) -> None:
        deadline = QDeadlineTimer(most_ms)
        while not ready():
            if deadline.hasExpired():
                raise TimeoutError("the window did not come to what was waited for")
            self._qt.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
