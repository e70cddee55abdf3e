"""What every screen has in common: a hint for the action bar, one main action, and some others."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QEvent, Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from fruitgui.gui.step_words import way_words
from fruitgui.station.workflow import Step

MAIN_KEY = "Ctrl+Return"


class StepPage(QWidget):
    """One of the seven screens.

    A page makes its actions once and enables, disables or renames them as things change; the action bar follows. It
    is told when it comes into view and when it leaves, so that it draws and polls only while it is looked at.

    Attributes:
        hint_changed: another sentence is to be shown in the action bar.
        actions_changed: another set of actions is to be shown there.
        step_wanted: the operator goes on to another `Step`.
    """

    hint_changed = Signal(str)
    actions_changed = Signal()
    step_wanted = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "ground")
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self._hint = ""
        self._main: QAction | None = None
        self._others: tuple[QAction, ...] = ()
        self._ways: dict[Step, QAction] = {}

    @property
    def hint(self) -> str:
        """What to do next, or what is going on: one sentence."""
        return self._hint

    @property
    def main_action(self) -> QAction | None:
        """The one action that the operator most likely wants."""
        return self._main

    @property
    def other_actions(self) -> tuple[QAction, ...]:
        """Further actions of this screen, the most likely last (next to the main one)."""
        return self._others

    def say(self, hint: str) -> None:
        """Set the sentence of the action bar."""
        if hint != self._hint:
            self._hint = hint
            self.hint_changed.emit(hint)

    def offer(self, main: QAction | None, *others: QAction) -> None:
        """Set the actions. Their keys work while the page is in view; others that have the same keys do not."""
        if (main, others) != (self._main, self._others):
            for action in (*self._others, self._main):
                if action is not None:
                    self.removeAction(action)
            self._main, self._others = main, others
            for action in self._ways.values():
                action.setShortcut(MAIN_KEY if action is main else "")
            self.addActions([*others, *(() if main is None else (main,))])
            self.actions_changed.emit()

    def way_to(self, step: Step) -> QAction:
        """Return the action that leads to another step; as the main one it has the main one's key."""
        if step not in self._ways:
            way = self._ways[step] = QAction(self)
            way.setProperty("drawing", step.value)
            way.triggered.connect(partial(self.step_wanted.emit, step))
            self._name_ways()
        return self._ways[step]

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802 - Qt's name
        """Take over another language."""
        if event.type() == QEvent.Type.LanguageChange:
            self._name_ways()
        super().changeEvent(event)

    def _name_ways(self) -> None:
        for step, way in self._ways.items():
            text, tip = way_words(step)
            way.setText(text)
            way.setToolTip(tip)

    def complete(self) -> None:
        """Make what is not seen at first; overridden by pages that have such parts, and make them when asked, too."""

    def entered(self) -> None:
        """Come into view; overridden by pages that draw or poll."""

    def left(self) -> None:
        """Leave the view; overridden by pages that draw or poll."""
