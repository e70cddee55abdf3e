"""The window while the line runs flat out, timed from inside."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path

from PySide6.QtCore import QDeadlineTimer, QEventLoop
from PySide6.QtWidgets import QApplication

from fruitgui.gui.app import Application
from fruitgui.gui.benchmark.figure import Figure
from fruitgui.gui.benchmark.heartbeat import Blame, Heartbeat
from fruitgui.gui.benchmark.stage import FRUIT_PER_HOUR, start_flat_out
from fruitgui.gui.benchmark.watches import Memory, PictureCount
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.station.workflow import Step

WARM_FRUIT = 10
PATIENCE_MS = 120_000
ON_A_STEP_S = 3.0
PICTURES_HZ = 15.0
CLOSED_S = 10.0


class Run:
    """One window on one folder, from opening to closing."""

    def __init__(self, qt: QApplication, folder: Path) -> None:
        self._qt = qt
        self._folder = folder
        self._application = Application(qt, folder)
        self._session = self._application.session
        self._heart = Heartbeat(self._application)

    def figures(self, minutes: float, blame_ms: float | None) -> Iterator[Figure]:
        """Give one figure after the other; where the window was late is told as the last of them."""
        blame = None if blame_ms is None else Blame(self._heart, blame_ms)
        self._application.start()
        self._heart.start()
        self._wait_until(lambda: self._session.connected.feed is not None and not self._session.tasks.running)
        self._wait_until(lambda: self._application.page_making.finished)
        yield self._heart.take().figure("sensors start and screens are made")
        start_flat_out(self._session, self._folder)
        self._wait_until(lambda: self._session.running.tally.count_all >= WARM_FRUIT)
        yield self._heart.take().figure("line starts")
        if blame is not None:
            blame.start()
        yield from self._running(minutes)
        yield from self._walking()
        if blame is not None:
            yield Figure("where it was late", "", more=blame.stop())
        yield self._closing()

    def _running(self, minutes: float) -> Iterator[Figure]:
        page = self._application.window.page(Step.LIVE)
        assert isinstance(page, LivePage)  # noqa: S101 - it is the live step's
        pictures, memory = PictureCount(page.body.pictures.pictures, page), Memory()
        running, began_s = self._session.running, time.monotonic()
        before = running.state
        self._heart.start()
        until_s = began_s + 60.0 * minutes

        def over() -> bool:
            memory.look(running.tally.count_all)
            return time.monotonic() >= until_s

        self._wait_until(over, round(60_000 * minutes) + PATIENCE_MS)
        took_s, painted, after = time.monotonic() - began_s, pictures.take(), running.state
        yield self._heart.take().figure("live screen")
        followed = 0 if before is None or after is None else after.frames - before.frames
        for sensor, count in sorted(painted.items()):
            more = f"the line followed {followed / took_s:.1f}/s of all sensors"
            met = count / took_s >= PICTURES_HZ
            yield Figure(f"pictures shown of {sensor}", f"{count / took_s:.1f}/s", f">= {PICTURES_HZ:.0f}/s", met, more)
        if after is not None:
            lost = sum(after.dropped.values()) + after.skipped
            yield Figure("frames that were not followed", f"{lost}", "0", lost == 0)
        yield from memory.figures(FRUIT_PER_HOUR)

    def _walking(self) -> Iterator[Figure]:
        """Look at every screen while the line goes on."""
        for step in (*Step, Step.LIVE):
            self._heart.start()  # what the benchmark itself did since the last beat is not the window's
            self._application.window.go_to(step)
            until_s = time.monotonic() + ON_A_STEP_S
            self._wait_until(lambda until_s=until_s: time.monotonic() >= until_s)  # type: ignore[misc]
            yield self._heart.take().figure(f"going to {step}")

    def _closing(self) -> Figure:
        began_s = time.monotonic()
        self._application.window.close()
        closed_s = time.monotonic() - began_s
        self._heart.stop()
        met = closed_s <= CLOSED_S
        return Figure("closing while the line runs", f"{closed_s:.1f} s", f"<= {CLOSED_S:.0f} s", met)

    def _wait_until(self, ready: Callable[[], bool], most_ms: int = PATIENCE_MS) -> None:
        deadline = QDeadlineTimer(most_ms)
        while not ready():
            if deadline.hasExpired():
                raise TimeoutError("the window did not come to what was waited for")
            self._qt.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
