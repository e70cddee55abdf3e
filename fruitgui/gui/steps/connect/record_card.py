"""A recording while it is being made: how long, how much, how much room is left, and a button that ends it."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QSize, Signal
from PySide6.QtWidgets import QProgressBar, QPushButton, QWidget

from fruitgui.gui.recorder_words import clock_time, lost_text, progress_text, room_text
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label
from fruitgui.station.record_state import RecordPlan, RecordState


class RecordCard(Card):
    """Shows a recording.

    Attributes:
        stop_wanted: the person wants it to end.
    """

    stop_wanted = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._theme = theme
        self._time, self._much, self._room = label("", "page"), label("", "dim"), label("", "dim")
        self._trouble = label("", "strong")
        self._bar, self.stop = QProgressBar(), QPushButton()
        self._bar.setTextVisible(False)
        self._bar.setRange(0, 1000)
        for one in (self._much, self._room, self._trouble):
            one.setWordWrap(True)
        self._shown: tuple[RecordPlan, RecordState | None, bool] | None = None
        self.body.setSpacing(GRID // 2)
        for part in (self._time, self._bar, self._much, self._room, self._trouble):
            self.body.addWidget(part)
        self.body.addSpacing(GRID // 2)
        self.body.addWidget(self.stop)
        self.stop.clicked.connect(self.stop_wanted)
        theme.changed.connect(self._draw_icon)
        self._say_words()
        self._draw_icon()

    def show_recording(self, plan: RecordPlan, state: RecordState | None, *, stopping: bool) -> None:
        """Show how far it is."""
        self._shown = plan, state, stopping
        self.set_title(self.tr("Recording {name}").format(name=plan.out.stem))
        seconds = 0.0 if state is None else state.seconds
        lasted = clock_time(seconds)
        if plan.seconds is not None:
            lasted = self.tr("{time} of {length}").format(time=lasted, length=clock_time(plan.seconds))
        self._time.setText(lasted)
        self._bar.setVisible(plan.seconds is not None)
        self._bar.setValue(0 if state is None else round(1000 * state.share))
        self._much.setText(self.tr("Waiting for the first picture") if state is None else progress_text(state))
        self._room.setText("" if state is None else room_text(state))
        self._room.setVisible(state is not None)
        trouble = "" if state is None else self._trouble_of(state)
        self._trouble.setText(trouble)
        self._trouble.setVisible(bool(trouble))
        self.stop.setEnabled(not stopping)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._say_words()
            if self._shown is not None:
                plan, state, stopping = self._shown
                self.show_recording(plan, state, stopping=stopping)
        super().changeEvent(event)

    def _trouble_of(self, state: RecordState) -> str:
        parts = []
        if state.silent:
            silent = ", ".join(state.silent)
            parts.append(self.tr("No pictures from {sensors}; the others go on.").format(sensors=silent))
        lost = sum(state.lost.values())
        if lost:
            parts.append(lost_text(lost))
        return " ".join(parts)

    def _say_words(self) -> None:
        self.stop.setText(self.tr("Stop and keep"))
        self.stop.setToolTip(self.tr("End the recording; what was recorded is kept"))

    def _draw_icon(self) -> None:
        self.stop.setIcon(icons.icon("stop", self._theme.colour("text")))
        self.stop.setIconSize(QSize(20, 20))
