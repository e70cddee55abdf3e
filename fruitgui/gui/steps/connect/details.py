"""The chosen sensor: who it is, how it is, and what can be changed about it."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QSizePolicy,
    QToolButton,
    QWidget,
)

from fruitgui.gui.steps.connect.presenter import SensorView
from fruitgui.gui.steps.connect.words import Condition, name_problem
from fruitgui.gui.theme import icons
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import GRID
from fruitgui.gui.widgets.cards import Card, label, set_health
from fruitgui.gui.widgets.worded import Worded

_KEYS = {
    "identify": "Ctrl+I", "reference": "Ctrl+R", "left": "Ctrl+Left", "right": "Ctrl+Right", "leave": "Ctrl+Del",
    "depth": "Ctrl+D",
}  # fmt: skip
_ICONS = {
    "identify": "flash", "reference": "link", "left": "left", "right": "right", "leave": "delete", "depth": "layers",
}  # fmt: skip

_FACTS = ("device", "serial", "firmware", "rate", "lost", "colour", "warmth", "correction")


class SensorDetails(Worded, Card):
    """Shows one sensor and tells what a person wants done with it.

    Attributes:
        renamed: the new name. moved: by how many places. identify, reference, leave, correct_depth: asked for.
    """

    renamed = Signal(str)
    moved = Signal(int)
    identify = Signal()
    reference = Signal()
    leave = Signal()
    correct_depth = Signal()

    def __init__(self, theme: Theme, parent: QWidget | None = None) -> None:
        super().__init__("", parent)
        self._theme = theme
        self._view: SensorView | None = None
        self._others: tuple[str, ...] = ()
        self.name = QLineEdit()
        self.name.setMaxLength(64)
        self._problem = label("", "small")
        self._condition, self._remedy = label("", "strong"), label("", "small")
        self._heads = {part: label("", "dim") for part in _FACTS}
        self._facts = {part: label("") for part in self._heads}
        self._lock_remedy = label("", "small")
        self.buttons: dict[str, QPushButton | QToolButton] = {
            "identify": QPushButton(),
            "reference": QPushButton(),
            "left": QToolButton(),
            "right": QToolButton(),
            "leave": QToolButton(),
            "depth": QPushButton(),
        }
        self._lay_out()
        self._connect()
        self._say_words()
        self._draw_icons()

    def show_view(self, view: SensorView | None, others: tuple[str, ...], *, fixed: bool = False) -> None:
        """Show a sensor; `others` are the other sensors' names. Nothing can be changed while it is `fixed`."""
        changed = view is None or self._view is None or view.name != self._view.name
        self._view, self._others = view, others
        self.setEnabled(view is not None)
        if view is None:
            return
        if changed and (not self.name.hasFocus() or self.name.text() in others):
            self.name.setText(view.name)
            self._check()
        self._show_condition(view.condition)
        texts = {
            "device": view.device, "serial": view.serial, "rate": view.rate, "lost": view.lost,
            "correction": view.correction, "firmware": view.firmware,
        }  # fmt: skip
        for part, text in texts.items():
            self._facts[part].setText(text)
        for label_of in (self._heads, self._facts):
            label_of["firmware"].setVisible(bool(view.firmware))
        colour = view.light if view.light.health == "warn" else view.colour
        for part, one in (("colour", colour), ("warmth", view.warmth)):
            self._facts[part].setText(one.word)
            set_health(self._facts[part], one.health)
        remedies = dict.fromkeys(one.remedy for one in (view.colour, view.light, view.warmth) if one.remedy)
        self._lock_remedy.setText("\n".join(remedies))
        self._lock_remedy.setVisible(bool(remedies))
        self.name.setEnabled(not fixed)
        self.buttons["reference"].setEnabled(not view.reference and not fixed)
        self.buttons["left"].setEnabled(view.place > 1 and not fixed)
        self.buttons["right"].setEnabled(view.place <= len(others) and not fixed)
        self.buttons["leave"].setEnabled(bool(others) and not fixed)
        self.buttons["depth"].setEnabled(view.condition.health in ("good", "warn") and not fixed)

    def _show_condition(self, condition: Condition) -> None:
        self._condition.setText(condition.word[:1].upper() + condition.word[1:])
        set_health(self._condition, condition.health)
        self._condition.setVisible(condition.health != "good")
        self._remedy.setText(condition.remedy)
        self._remedy.setVisible(bool(condition.remedy))

    def _lay_out(self) -> None:
        for one in (self._problem, self._remedy, self._lock_remedy, *self._facts.values()):
            one.setWordWrap(True)
        self._problem.hide()
        set_health(self._problem, "bad")
        facts = QGridLayout()
        facts.setHorizontalSpacing(2 * GRID)
        facts.setVerticalSpacing(2)
        facts.setColumnStretch(1, 1)
        for row, part in enumerate(self._heads):
            facts.addWidget(self._heads[part], row, 0, Qt.AlignmentFlag.AlignTop)
            facts.addWidget(self._facts[part], row, 1)
        facts.addWidget(self._lock_remedy, len(self._heads), 0, 1, 2)
        top, wide = QHBoxLayout(), QHBoxLayout()
        for line in (top, wide):
            line.setSpacing(GRID)
        top.addWidget(self.name, 1)
        for part in ("left", "right", "leave"):
            top.addWidget(self.buttons[part])
        for part in ("identify", "reference"):
            self.buttons[part].setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
            wide.addWidget(self.buttons[part], 1)
        self.body.setSpacing(GRID // 2)
        self.body.addLayout(top)
        for text in (self._problem, self._condition, self._remedy):
            self.body.addWidget(text)
        self.body.addSpacing(GRID // 2)
        self.body.addLayout(facts)
        self.body.addSpacing(GRID // 2)
        self.body.addLayout(wide)
        self.body.addSpacing(GRID // 2)
        self.body.addWidget(self.buttons["depth"])
        self.body.addStretch()

    def _connect(self) -> None:
        self.name.textEdited.connect(self._check)
        self.name.editingFinished.connect(self._rename)
        self.buttons["identify"].clicked.connect(self.identify)
        self.buttons["reference"].clicked.connect(self.reference)
        self.buttons["leave"].clicked.connect(self.leave)
        self.buttons["depth"].clicked.connect(self.correct_depth)
        self.buttons["left"].clicked.connect(self._move_left)
        self.buttons["right"].clicked.connect(self._move_right)
        self._theme.changed.connect(self._draw_icons)

    def _say_words(self) -> None:
        texts = {
            "identify": (self.tr("Identify"), self.tr("Flash the picture of this sensor")),
            "reference": (self.tr("Reference"), self.tr("Place all other sensors in the frame of this one")),
            "left": ("", self.tr("Move to the left")),
            "right": ("", self.tr("Move to the right")),
            "leave": ("", self.tr("Leave this sensor out; connect the source again to have it back")),
            "depth": (
                self.tr("Correct its depth…"),
                self.tr("Measure with a box, a tape and a ball how far this sensor's depth is off"),
            ),
        }
        for part, (text, tip) in texts.items():
            button = self.buttons[part]
            button.setText(text)
            button.setShortcut(_KEYS[part])  # setting a text forgets the shortcut
            button.setToolTip(f"{tip} ({_KEYS[part]})")
            button.setAccessibleName(text or tip)
        heads = {
            "device": self.tr("Device"),
            "serial": self.tr("Serial"),
            "firmware": self.tr("Firmware"),
            "rate": self.tr("Pictures"),
            "lost": self.tr("Lost"),
            "colour": self.tr("Exposure"),
            "warmth": self.tr("Drift"),
            "correction": self.tr("Depth"),
        }
        for part, text in heads.items():
            self._heads[part].setText(text)
        self._facts["colour"].setToolTip(
            self.tr("Whether exposure and white balance, and the light on the belt, stay as they are")
        )
        self._facts["warmth"].setToolTip(self.tr("Whether its depth still drifts, seen on the bare belt"))
        self.name.setAccessibleName(self.tr("Name of the sensor"))
        self.name.setToolTip(self.tr("Name of the sensor: letters, digits and _, beginning with a letter"))

    def _draw_icons(self) -> None:
        for part, button in self.buttons.items():
            button.setIcon(icons.icon(_ICONS[part], self._theme.colour("text"), self._theme.colour("line")))
            button.setIconSize(QSize(20, 20))

    def _check(self) -> None:
        problem = name_problem(self.name.text(), self._others)
        self._problem.setText(problem)
        self._problem.setVisible(bool(problem))

    def _rename(self) -> None:
        if self._view is None or self.name.text() == self._view.name:
            return
        if name_problem(self.name.text(), self._others):
            self.name.setText(self._view.name)
            self._check()
            return
        self.renamed.emit(self.name.text())

    def _move_left(self) -> None:
        self.moved.emit(-1)

    def _move_right(self) -> None:
        self.moved.emit(1)
