"""What is set of the belt beside its region: how it moves, and how tall fruit are."""

from __future__ import annotations

import math
from dataclasses import replace

from PySide6.QtCore import QSize, Signal
from PySide6.QtWidgets import (
    QButtonGroup,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.session import Session
from fruitgui.gui.steps.belt.draft import Draft
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.gui.widgets.show_switch import ShowSwitch
from fruitgui.gui.widgets.stepper import Stepper
from fruitgui.gui.widgets.tick_box import TickBox
from fruitgui.gui.widgets.worded import Worded


class SidePanel(Worded, QWidget):
    """Two cards: motion, and fruit.

    Attributes:
        changed: a `Draft` with what was set.
        measure: asked for.
    """

    changed = Signal(object)
    measure = Signal()

    def __init__(self, session: Session, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme = theme
        self._draft: Draft | None = None
        self._spread_m_s: float | None = None
        self.motion, self.fruit = Card(), Card()
        self._problem = label("", "small")
        self.measure_button = QPushButton()
        self.fixed = TickBox()
        self.speed, self.turn = Stepper(theme, 3, "m/s"), Stepper(theme, 1, "°")
        self.forwards, self.backwards = QPushButton(), QPushButton()
        self._ways = QButtonGroup(self)
        self.measured = label("", "small")
        self.shortest, self.tallest = Stepper(theme, 0, "mm"), Stepper(theme, 0, "mm")
        self._labels = {name: QLabel() for name in ("speed", "turn", "shortest", "tallest")}
        self.switch = ShowSwitch(session.source)
        self._lay_out()
        self._connect()
        self._say_words()
        self._draw_icons()

    def show_draft(self, draft: Draft, spread_m_s: float | None) -> None:
        """Show a draft; `spread_m_s` is the standard deviation of a speed that was measured."""
        self._draft, self._spread_m_s = None, spread_m_s  # what follows is shown, not set
        self.fixed.setChecked(draft.fixed)
        self.speed.show_value(draft.speed_m_s)
        self.turn.show_value(math.degrees(draft.turned_rad))
        (self.backwards if draft.backwards else self.forwards).setChecked(True)
        self.shortest.show_value(draft.shortest_m * 1e3)
        self.tallest.show_value(draft.tallest_m * 1e3)
        for one in (self.speed, self.turn, self.forwards, self.backwards):
            one.setEnabled(draft.fixed)
        self._draft = draft
        self._say_figures()

    def busy(self, busy: bool, *, ready: bool) -> None:
        """Let nothing be measured while it is, nor where no sensor runs."""
        self.measure_button.setEnabled(ready and not busy)

    def _lay_out(self) -> None:
        for one in (self._problem, self.measured):
            one.setWordWrap(True)
        set_health(self._problem, "bad")
        ways = QHBoxLayout()
        ways.setSpacing(GRID // 2)
        for button in (self.forwards, self.backwards):
            button.setCheckable(True)
            self._ways.addButton(button)
            ways.addWidget(button, 1)
        self.motion.body.addWidget(self.measure_button)
        self.motion.body.addWidget(self.measured)
        self.motion.body.addWidget(self.fixed)
        self.motion.body.addLayout(self._grid(("speed", self.speed), ("turn", self.turn)))
        self.motion.body.addLayout(ways)
        self.fruit.body.addLayout(self._grid(("shortest", self.shortest), ("tallest", self.tallest)))
        self.fruit.body.addWidget(self._problem)
        self.speed.set_range(0.001, 3.0, 0.005)
        self.turn.set_range(-60.0, 60.0, 0.5)
        self.shortest.set_range(3.0, 300.0, 1.0)
        self.tallest.set_range(10.0, 400.0, 5.0)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(1 * GRID)
        for card in (self.motion, self.fruit):
            card.body.setSpacing(GRID // 2)
            card.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
            column.addWidget(card)
        column.addWidget(self.switch)
        column.addStretch()

    def _grid(self, *rows: tuple[str, Stepper]) -> QGridLayout:
        grid = QGridLayout()
        grid.setSpacing(GRID // 2)
        grid.setColumnStretch(1, 1)
        for row, (name, stepper) in enumerate(rows):
            self._labels[name].setBuddy(stepper.box)
            grid.addWidget(self._labels[name], row, 0)
            grid.addWidget(stepper, row, 1)
        return grid

    def _connect(self) -> None:
        self.measure_button.clicked.connect(self.measure)
        self.fixed.toggled.connect(self._set)
        self._ways.buttonClicked.connect(self._set)
        for stepper in (self.speed, self.turn, self.shortest, self.tallest):
            stepper.changed.connect(self._set)
        self._theme.changed.connect(self._draw_icons)

    def _set(self) -> None:
        draft = self._draft
        if draft is None:
            return
        self.changed.emit(
            replace(
                draft,
                fixed=self.fixed.isChecked(),
                speed_m_s=self.speed.value,
                turned_rad=math.radians(self.turn.value),
                backwards=self.backwards.isChecked(),
                shortest_m=self.shortest.value / 1e3,
                tallest_m=self.tallest.value / 1e3,
            )
        )

    def _say_words(self) -> None:
        self.motion.set_title(self.tr("How the belt moves"))
        self.fruit.set_title(self.tr("How tall fruit are"))
        self.measure_button.setText(self.tr("Measure from passing fruit"))
        self.measure_button.setShortcut("Ctrl+M")
        self.measure_button.setToolTip(self.tr("Let the belt run with fruit on it, and measure (Ctrl+M)"))
        self.fixed.setText(self.tr("The speed is always the same"))
        self.fixed.setToolTip(self.tr("Otherwise every run measures it anew from its first fruit"))
        self.forwards.setText(self.tr("To the right"))
        self.backwards.setText(self.tr("To the left"))
        for button in (self.forwards, self.backwards):
            button.setToolTip(self.tr("Where the belt moves to, as seen from above"))
            button.setAccessibleName(button.text())
        names = {
            "speed": self.tr("&Speed"),
            "turn": self.tr("Tu&rned"),
            "shortest": self.tr("Sh&ortest"),
            "tallest": self.tr("&Tallest"),
        }
        for name, text in names.items():
            self._labels[name].setText(text)
        less, more = self.tr("Less"), self.tr("More")
        tips = {
            "speed": self.tr("Speed of the belt"),
            "turn": self.tr("Angle between the belt's motion and the longer side of the region"),
            "shortest": self.tr("Height above the belt of the lowest fruit that comes"),
            "tallest": self.tr("Height above the belt of the highest fruit that comes"),
        }
        steppers = {"speed": self.speed, "turn": self.turn, "shortest": self.shortest, "tallest": self.tallest}
        for name, stepper in steppers.items():
            stepper.name(names[name].replace("&", ""), tips[name], less, more)
        self._say_figures()

    def _say_figures(self) -> None:
        draft = self._draft
        if draft is None:
            return
        self.measured.setText(self._motion_text(draft))
        wrong = draft.problem == "heights"
        self._problem.setText(self.tr("The tallest fruit must be taller than the shortest.") if wrong else "")
        self._problem.setVisible(wrong)

    def _motion_text(self, draft: Draft) -> str:
        if self._spread_m_s is not None:
            speed = f"{number_text(draft.speed_m_s, 3)} ± {number_text(1.96 * self._spread_m_s, 3)}{THIN}m/s"
            return self.tr("Measured: {speed}").format(speed=speed)
        if draft.fixed:
            return self.tr("As it is typed here.")
        return self.tr("Every run measures it anew from its first fruit.")

    def _draw_icons(self) -> None:
        text, dim = self._theme.colour("text"), self._theme.colour("text_dim")
        self.measure_button.setIcon(icons.icon("belt", text, dim))
        self.measure_button.setIconSize(QSize(20, 20))
        for button, icon in ((self.forwards, "right"), (self.backwards, "left")):
            button.setIcon(icons.icon(icon, text, dim))
