"""Someone who works with the window: the real program in this process, its keys and buttons pressed."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from PySide6.QtCore import QCoreApplication, QDeadlineTimer, QEvent, QEventLoop, Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QAbstractButton, QApplication, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.cli import main
from fruitgui.gui.action_bar import ActionButton
from fruitgui.gui.messages import Level
from fruitgui.gui.session import Session
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.window import MainWindow
from fruitgui.station.workflow import Step

T = TypeVar("T")
P = TypeVar("P", bound=StepPage)
W = TypeVar("W", bound=QWidget)

LONG_MS = 240_000
"""A lesson of some twenty fruit takes ten seconds; on a machine that does much else, minutes."""


class Operator:
    """Presses what a person would press. Made for the time that one window is open."""

    def __init__(self, qtbot: QtBot, window: MainWindow) -> None:
        self._qtbot = qtbot
        self.window = window

    @property
    def session(self) -> Session:
        """What the window works on: looked at, never changed."""
        session: Session = self.window.page(Step.CONNECT)._session  # type: ignore[attr-defined]
        return session

    def go(self, step: Step, of: type[P]) -> P:
        """Go to a step by its key; return its screen."""
        self.window.activateWindow()  # as the desktop does when a dialog is closed; here there is none
        self.wait(self.window.isActiveWindow)
        key = Qt.Key(ord(str(list(Step).index(step) + 1)))
        self._qtbot.keyClick(self.window, key, Qt.KeyboardModifier.AltModifier)
        self.wait(lambda: self.window.step is step)
        page = self.window.page(step)
        assert isinstance(page, of)
        return page

    def press(self, action: QAction) -> None:
        """Press the button of an action at the bottom, once it can be pressed."""

        def button() -> ActionButton | None:
            shown = self.window.action_bar.findChildren(ActionButton)
            return next((one for one in shown if one._action is action and one.isVisible() and one.isEnabled()), None)

        self.wait(lambda: button() is not None)
        found = button()
        assert found is not None
        self.click(found)

    def click(self, widget: QWidget) -> None:
        """Click in the middle of something."""
        assert widget.isVisible(), f"{widget.accessibleName()} cannot be seen"
        assert not isinstance(widget, QAbstractButton) or widget.isEnabled(), f"{widget.accessibleName()} is off"
        self._qtbot.mouseClick(widget, Qt.MouseButton.LeftButton)

    def key(self, widget: QWidget, key: Qt.Key, modifier: Qt.KeyboardModifier = Qt.KeyboardModifier.NoModifier) -> None:
        """Press a key."""
        self._qtbot.keyClick(widget, key, modifier)

    def type(self, field: QWidget, text: str) -> None:
        """Type into a field what shall stand in it."""
        field.setFocus()
        self._qtbot.keyClick(field, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
        self._qtbot.keyClicks(field, text)

    def dialog(self, of: type[W]) -> W:
        """Return the dialog that is open, once it is."""

        def shown() -> W | None:
            return next((one for one in self.window.findChildren(of) if one.isVisible()), None)

        self.wait(lambda: shown() is not None)
        found = shown()
        assert found is not None
        return found

    def wait(self, until: Callable[[], object], most_ms: int = LONG_MS) -> None:
        """Wait until something can be seen; an error that is said meanwhile is not what was waited for."""

        def seen() -> bool:
            said = [one for one in self.session.messages.history if one.level is Level.BAD]
            assert not said, f"{said[0].what} {said[0].remedy}"
            return bool(until())

        deadline = QDeadlineTimer(most_ms)
        while not seen():
            assert not deadline.hasExpired(), "what was waited for did not come"
            QCoreApplication.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
            # The script runs within an event of the program, where Qt deletes nothing by itself.
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)

    def ask(self, question: Callable[[], T]) -> T:
        """Look something up beside the window, as another program would."""
        answers: list[T] = []
        thread = threading.Thread(target=lambda: answers.append(question()))
        thread.start()
        self.wait(lambda: not thread.is_alive())
        return answers[0]


def operate(qtbot: QtBot, folder: Path, script: Callable[[Operator], None]) -> int:
    """Open the window by the command line, let someone work with it, and close it; return the exit code.

    What goes wrong in the script is raised here, once the window is closed.
    """
    wrong: list[BaseException] = []

    def work() -> None:
        windows = [one for one in QApplication.topLevelWidgets() if isinstance(one, MainWindow) and one.isVisible()]
        try:
            (window,) = windows
            script(Operator(qtbot, window))
        except BaseException as error:  # noqa: BLE001 - Qt would swallow it
            wrong.append(error)
        finally:
            for one in windows:
                one.close()

    QTimer.singleShot(0, work)
    code = main(["--folder", str(folder)])
    if wrong:
        raise wrong[0]
    return code
