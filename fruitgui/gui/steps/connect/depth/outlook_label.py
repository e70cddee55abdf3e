"""Says what is known of a sensor before it is raised, and what that adds: nobody climbs a ladder for nothing."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QLabel, QWidget

from fruitgui.calibration.depth.measured import DepthRefusal
from fruitgui.calibration.depth.sureness import Outlook, outlook
from fruitgui.gui.numbers import number_text
from fruitgui.gui.queries import Queries
from fruitgui.gui.steps.connect.depth.course import Course, Stage
from fruitgui.gui.steps.connect.depth.reason_words import reason_words
from fruitgui.gui.widgets.cards import set_health

translate = QCoreApplication.translate


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


def outlook_text(known: Outlook | DepthRefusal, raised_m: float) -> str:
    """Return what is known before the sensor is raised, and what raising it by so much adds."""
    if isinstance(known, DepthRefusal):
        return " ".join(reason_words(known.reasons[0]))
    now, then = known.now, known.raised(raised_m)
    text = translate(
        "Depth",
        "Known so far: scale ±{scale} %, offset ±{offset} mm. With this raise: about ±{scale2} %, ±{offset2} mm.",
    )
    scale, scale2 = (number_text(196.0 * one.scale_std, 1) for one in (now, then))
    offset, offset2 = (number_text(1960.0 * one.offset_std_m, 0) for one in (now, then))
    return text.format(scale=scale, offset=offset, scale2=scale2, offset2=offset2)
