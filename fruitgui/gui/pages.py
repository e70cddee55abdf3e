"""The seven screens: each made when it is first asked for, and all of them soon after the window was painted.

A screen's modules are loaded when it is made, so that the window need not wait for those that nobody looks at yet.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Iterator, Mapping
from functools import partial

from PySide6.QtCore import QEvent, QObject, QTimer, Signal
from PySide6.QtWidgets import QWidget

from fruitgui.gui.qt_classes import make_classes
from fruitgui.gui.session import Session
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.station.workflow import Step

PageMaker = Callable[[Session, Theme], StepPage]

BETWEEN_MS = 50
"""From one moment of making to the next: what a person does meanwhile comes first."""


def page_maker(step: Step) -> PageMaker:
    """Return what makes the screen of a step, with its modules loaded. Any thread may call."""
    match step:
        case Step.CONNECT:
            from fruitgui.gui.steps.connect.page import ConnectPage

            return ConnectPage
        case Step.CALIBRATE:
            from fruitgui.gui.steps.calibrate.page import CalibratePage

            return CalibratePage
        case Step.BELT:
            from fruitgui.gui.steps.belt.page import BeltPage

            return BeltPage
        case Step.TEACH:
            from fruitgui.gui.steps.teach.page import TeachPage

            return TeachPage
        case Step.TRAIN:
            from fruitgui.gui.steps.train.page import TrainPage

            return TrainPage
        case Step.LIVE:
            from fruitgui.gui.steps.live.page import LivePage

            return LivePage
        case Step.LOTS:
            from fruitgui.gui.steps.lots.page import LotsPage

            return LotsPage


class Pages(Mapping[Step, StepPage]):
    """A screen for every step, made when it is first asked for."""

    def __init__(self, session: Session, theme: Theme) -> None:
        self._session = session
        self._theme = theme
        self._made: dict[Step, StepPage] = {}

    def __getitem__(self, step: Step) -> StepPage:
        if step not in self._made:
            self._made[step] = page_maker(step)(self._session, self._theme)
        return self._made[step]

    def __iter__(self) -> Iterator[Step]:
        return iter(Step)

    def __len__(self) -> int:
        return len(Step)


class PageMaking(QObject):
    """Makes every screen once a window has been painted, so that none is waited for when it is first gone to.

    Modules are loaded beside the window; screens are made on its thread, one at a time, once that is done: meanwhile
    they would wait for Python's lock. Between making one, placing it, where it is dressed, and completing it with what
    is not seen at first, the window listens.

    Args:
        window: that is to be painted first.
        make: makes the screen of a step, if it is not there.
        place: puts it where it belongs.
        complete: makes the rest of it.

    Attributes:
        done: every screen is there.
    """

    done = Signal()

    def __init__(
        self,
        window: QWidget,
        make: Callable[[Step], object],
        place: Callable[[Step], object],
        complete: Callable[[Step], object],
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        make_classes()
        self._make, self._place, self._complete = make, place, complete
        self._begun: deque[Callable[[], object]] = deque()
        self._wanted = list(Step)
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._load, name="loading screens")
        self._between = QTimer(self, interval=BETWEEN_MS)
        self._between.timeout.connect(self._make_next)
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802 - Qt's name
        """Wait for the first painting."""
        if event.type() == QEvent.Type.Paint:
            watched.removeEventFilter(self)
            self._thread.start()
            self._between.start()
        return False

    @property
    def finished(self) -> bool:
        """Whether every screen is there."""
        return not self._wanted and not self._begun

    @property
    def running(self) -> bool:
        """Whether it loads or makes one more."""
        return self._between.isActive() or self._thread.is_alive()

    def stop(self) -> None:
        """Make no more."""
        self._stopped.set()
        self._between.stop()
        while self._begun:
            self._begun.popleft()()
        if self._thread.is_alive():
            self._thread.join()

    def _load(self) -> None:
        for step in Step:
            if not self._stopped.is_set():
                page_maker(step)

    def _make_next(self) -> None:
        if self._begun:
            self._begun.popleft()()
        elif not self._wanted:
            self._between.stop()
            self.done.emit()
        elif not self._thread.is_alive():
            step = self._wanted.pop(0)
            self._begun.extend((partial(self._place, step), partial(self._complete, step)))
            self._make(step)
