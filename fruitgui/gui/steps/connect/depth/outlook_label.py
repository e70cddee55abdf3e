"""Says what is known of a sensor before it is raised, and what that adds: nobody climbs a ladder for nothing."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QLabel, QWidget

from fruitgui.calibration.depth.measured import DepthRefusal
from fruitgui.calibration.depth.sureness import Outlook, outlook
from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.connect.depth.course import Course, Stage
from fruitgui.gui.steps.connect.depth.words import outlook_text
from fruitgui.gui.widgets.cards import set_health


class OutlookLabel(QLabel):
    """One sentence, worked out beside the window; empty and hidden at every stage but that of raising."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._queries = Queries(self)
        self._course: Course | None = None
        self._known: Outlook | DepthRefusal | None = None
        self._raised_mm = 0.0
        self.setProperty("role", "small")
        self.setWordWrap(True)
        self._say()

    def show_course(self, course: Course) -> None:
        """Show what is known by the measurements of a course."""
        if course is self._course:
            self._say()
            return
        self._course, self._known = course, None
        measured = course.measurements()
        if course.stage is Stage.RAISED and measured is not None:
            self._queries.ask("outlook", partial(outlook, measured), partial(self._take, course))
        self._say()

    def show_raise(self, raised_mm: float) -> None:
        """Show what raising by so much adds."""
        self._raised_mm = raised_mm
        self._say()

    def _take(self, course: Course, known: Outlook | DepthRefusal) -> None:
        if course is self._course:
            self._known = known
            self._say()

    def _say(self) -> None:
        known = self._known
        self.setText("" if known is None else outlook_text(known, self._raised_mm * 1e-3))
        set_health(self, "warn" if isinstance(known, DepthRefusal) else "")
        self.setVisible(known is not None)
