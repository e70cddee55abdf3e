"""The strip of steps at the left: where the operator is, and how far each step is."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QFont, QFontMetricsF, QPainter, QPaintEvent
from PySide6.QtWidgets import QAbstractButton, QButtonGroup, QSizePolicy, QVBoxLayout, QWidget

from fruitgui.gui.step_words import reason_text, state_name, step_name
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID, RAIL
from fruitgui.gui.widgets.focus import paint_focus
from fruitgui.station.workflow import State, Step, StepState

HEIGHT = 68
ICON_PX = 26
MARK_PX = 20

MOST_ROWS = 4
"""Of a reason: so that all seven steps are in view in the least window though four of them are to be done again."""

MARKS = {State.TO_DO: "ring", State.READY: "ready", State.DONE: "done", State.REDO: "redo_step"}
COLOURS = {State.TO_DO: "edge", State.READY: "accent", State.DONE: "good", State.REDO: "warn"}


class StepButton(QAbstractButton):
    """One step: its icon, its name, what state it is in, and the mark of that state."""

    def __init__(self, step: Step, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.step = step
        self._theme = theme
        self._state = StepState(State.TO_DO)
        self.setCheckable(True)
        self.setProperty("role", "step")
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setCursor(Qt.CursorShape.PointingHandCursor)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAttribute(Qt.WidgetAttribute.WA_Hover)
        theme.changed.connect(self.update)
        self._name()

    def show_state(self, state: StepState) -> None:
        """Show how far the step is."""
        if state != self._state:
            self._state = state
            self._name()
            self.updateGeometry()
            self.update()

    def sizeHint(self) -> QSize:  # noqa: N802 - Qt's name
        """Return the size that it wants."""
        return QSize(RAIL, HEIGHT + round(self._reason_height()))

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._name()
            self.updateGeometry()
        super().changeEvent(event)

    def paintEvent(self, _event: QPaintEvent) -> None:  # noqa: N802 - Qt's name
        """Draw it."""
        with QPainter(self) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self._paint_ground(painter)
            theme, here = self._theme, self.isChecked()
            text = theme.colour("text" if here or self._state.state is not State.TO_DO else "text_dim")
            middle = HEIGHT / 2
            place = QRectF(2.5 * GRID, middle - ICON_PX / 2, ICON_PX, ICON_PX)
            icons.paint(painter, place, self.step.value, theme.colour("accent") if here else text)
            left = place.right() + 1.5 * GRID
            width = self.width() - left - MARK_PX - 2.5 * GRID
            painter.setPen(text)
            painter.setFont(theme.font("body", QFont.Weight.DemiBold if here else QFont.Weight.Medium))
            bottom_left = Qt.AlignmentFlag.AlignBottom | Qt.AlignmentFlag.AlignLeft
            painter.drawText(QRectF(left, 0, width, middle), bottom_left, self.text())
            painter.setPen(theme.colour("warn" if self._state.state is State.REDO else "text_dim"))
            painter.setFont(theme.font("small"))
            painter.drawText(
                QRectF(left, middle + 2, width, middle), Qt.AlignmentFlag.AlignLeft, state_name(self._state)
            )
            mark = QRectF(self.width() - MARK_PX - 1.5 * GRID, middle - MARK_PX / 2, MARK_PX, MARK_PX)
            icons.paint(painter, mark, MARKS[self._state.state], theme.colour(COLOURS[self._state.state]),
                        theme.colour("surface"))  # fmt: skip
            self._paint_reason(painter)

    def _reason(self) -> str:
        """Return why it is to be done again; the others' reasons can wait until one goes there."""
        return reason_text(self._state) if self._state.state is State.REDO else ""

    def _reason_height(self) -> float:
        if not self._reason():
            return 0.0
        metrics = QFontMetricsF(self._theme.font("small"))
        room = QRectF(0, 0, RAIL - 2.5 * GRID - 2 * GRID, 1e4)
        high = metrics.boundingRect(room, int(Qt.TextFlag.TextWordWrap), self._reason()).height()
        return min(high, MOST_ROWS * metrics.lineSpacing()) + GRID / 2

    def _paint_reason(self, painter: QPainter) -> None:
        """Write the reason below, as much of it as goes into a few rows; the tooltip has all of it."""
        if not self._reason():
            return
        room = QRectF(2.5 * GRID, HEIGHT - 1.5 * GRID, self.width() - 4.5 * GRID, self._reason_height())
        painter.setPen(self._theme.colour("text"))
        painter.setFont(self._theme.font("small"))
        painter.setClipRect(room)
        painter.drawText(room, int(Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap), self._reason())

    def _paint_ground(self, painter: QPainter) -> None:
        theme = self._theme
        card = QRectF(self.rect()).adjusted(GRID, GRID / 2, -GRID / 2, -GRID / 2)
        if self.isChecked() or self.underMouse():
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(theme.colour("raised"))
            painter.drawRoundedRect(card, GRID, GRID)
        if self.isChecked():
            painter.setBrush(theme.colour("accent"))
            painter.drawRoundedRect(QRectF(0, card.top() + GRID, 4, card.height() - 2 * GRID), 2, 2)
        if self.hasFocus():
            paint_focus(painter, card, GRID, theme)

    def _name(self) -> None:
        number = list(Step).index(self.step) + 1
        name = step_name(self.step)
        self.setText(name)
        self.setShortcut(f"Alt+{number}")  # setting a text forgets the shortcut
        why = reason_text(self._state)
        self.setToolTip(f"{name} (Alt+{number})" + (f"\n{why}" if why else ""))
        self.setAccessibleName(f"{number}. {name}: {state_name(self._state)}")


class Rail(QWidget):
    """The seven steps; one is chosen.

    Attributes:
        chosen: the operator chose a `Step`.
    """

    chosen = Signal(object)

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "bar")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setFixedWidth(RAIL)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, GRID, 0, GRID)
        column.setSpacing(0)
        self._group = QButtonGroup(self)
        self.buttons = {step: StepButton(step, theme, self) for step in Step}
        for step, button in self.buttons.items():
            self._group.addButton(button)
            button.clicked.connect(lambda _checked=False, step=step: self.chosen.emit(step))
            column.addWidget(button)
        column.addStretch()

    def show_step(self, step: Step) -> None:
        """Mark a step as the one on the screen."""
        self.buttons[step].setChecked(True)

    def show_states(self, states: Mapping[Step, StepState]) -> None:
        """Show how far each step is."""
        for step, state in states.items():
            self.buttons[step].show_state(state)
