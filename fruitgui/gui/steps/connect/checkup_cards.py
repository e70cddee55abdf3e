"""What a checkup found, drawn: the computer's problems, a card for each sensor, the USB controllers."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QVBoxLayout, QWidget

from fruitgui.gui.numbers import THIN, number_text
from fruitgui.gui.steps.connect.checkup_words import measured_text, place_text, said, state_words
from fruitgui.gui.steps.connect.driver_words import limit_words
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.sensors.usb.problems import Problem
from fruitgui.station.checkup.records import CheckedController, CheckedSensor

ICON_PX = 20
_COLOURS = {"good": "good", "warn": "warn", "bad": "bad"}


class Mark(QLabel):
    """The icon of a health, in its colour."""

    def __init__(self, theme: Theme, health: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._theme, self._health = theme, health
        self.setFixedSize(ICON_PX, ICON_PX)
        theme.changed.connect(self._draw)
        self._draw()

    def _draw(self) -> None:
        colour = self._theme.colour(_COLOURS[self._health])
        self.setPixmap(icons.pixmap(self._health, colour, ICON_PX, self.devicePixelRatioF()))


class ProblemCard(Card):
    """What is wrong with the computer itself."""

    def __init__(self, theme: Theme, problems: Sequence[Problem], parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self.set_title(self.tr("This computer"))
        for problem in problems:
            self.body.addLayout(_problem_row(theme, problem))


class CheckedSensorCard(Card):
    """One sensor: who and where it is, how it is, and what is wrong with it."""

    def __init__(self, theme: Theme, sensor: CheckedSensor, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        condition = state_words(sensor)
        head = QHBoxLayout()
        head.setSpacing(GRID)
        firmware = self.tr("firmware {version}").format(version=sensor.firmware) if sensor.firmware else ""
        who = " · ".join(part for part in (sensor.model, sensor.serial, firmware) if part)
        word = label(condition.word, "strong")
        set_health(word, condition.health)
        head.addWidget(Mark(theme, condition.health))
        head.addWidget(label(sensor.name, "strong"))
        head.addWidget(label(who, "dim"))
        head.addStretch()
        head.addWidget(word)
        self.setAccessibleName(f"{sensor.name}: {condition.word}")
        self.body.setSpacing(GRID // 2)
        self.body.addLayout(head)
        facts = " · ".join(part for part in (measured_text(sensor), place_text(sensor)) if part)
        if facts:
            self.body.addWidget(_wrapped(facts, "small"))
        for problem in sensor.problems:
            self.body.addLayout(_problem_row(theme, problem))
        for limit in sensor.limits:
            self.body.addWidget(_wrapped(limit_words(limit), "small"))


class ControllerCard(Card):
    """Which USB controller carries which sensors, and whether its Kinects fit."""

    def __init__(self, controllers: Sequence[CheckedController], parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self.set_title(self.tr("USB controllers"))
        table = QGridLayout()
        table.setHorizontalSpacing(3 * GRID)
        table.setVerticalSpacing(GRID // 2)
        table.setColumnStretch(3, 1)
        heads = (self.tr("Controller"), self.tr("Sensors"), self.tr("Room for Kinects taken"))
        for column, head in enumerate(heads):
            table.addWidget(label(head, "small"), 0, column)
        for row, one in enumerate(controllers, start=1):
            load = label("–" if one.load is None else f"{number_text(100 * one.load, 0)}{THIN}%")
            if one.load is not None:
                set_health(load, "good" if one.load <= 1.0 else "bad")
            table.addWidget(label(one.address), row, 0)
            table.addWidget(label(", ".join(one.sensors) or "–"), row, 1)
            table.addWidget(load, row, 2)
        self.body.addLayout(table)


def _problem_row(theme: Theme, problem: Problem) -> QHBoxLayout:
    what, remedy = said(problem)
    words = QVBoxLayout()
    words.setSpacing(2)
    words.addWidget(_wrapped(what, ""))
    words.addWidget(_wrapped(remedy, "dim"))
    row = QHBoxLayout()
    row.setContentsMargins(0, GRID // 2, 0, GRID // 2)
    row.setSpacing(GRID)
    row.addWidget(Mark(theme, "warn"), 0, Qt.AlignmentFlag.AlignTop)
    row.addLayout(words, 1)
    return row


def _wrapped(text: str, role: str) -> QLabel:
    made = label(text, role)
    made.setWordWrap(True)
    made.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return made
