from __future__ import annotations

from collections.abc import Iterator

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QPushButton
from pytestqt.qtbot import QtBot

from fruitgui.errors import WorldError
from fruitgui.gui.action_bar import ActionButton
from fruitgui.gui.health import warning_message
from fruitgui.gui.messages import Level, Message, error_message
from fruitgui.gui.session import Session
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import TOUCH
from fruitgui.gui.translate import Language
from fruitgui.gui.window import MainWindow
from fruitgui.station.live.state import LiveWarning
from fruitgui.station.workflow import Facts, Step, step_states


class _Page(StepPage):
    def __init__(self) -> None:
        super().__init__()
        self.seen: list[str] = []

    def entered(self) -> None:
        self.seen.append("entered")

    def left(self) -> None:
        self.seen.append("left")


@pytest.fixture
def window(qtbot: QtBot, session: Session, theme: Theme) -> Iterator[MainWindow]:
    made = MainWindow(theme, session.messages, session.tasks, {step: _Page() for step in Step})
    qtbot.addWidget(made)
    made.go_to(Step.CONNECT)
    made.show()
    made.activateWindow()
    qtbot.waitUntil(made.isActiveWindow)
    return made


def _buttons(window: MainWindow) -> list[ActionButton]:
    return [one for one in window.action_bar.findChildren(ActionButton) if one.isVisible()]


def test_a_page_is_told_when_it_comes_and_when_it_goes(qtbot: QtBot, window: MainWindow) -> None:
    first, second = window.page(Step.CONNECT), window.page(Step.LOTS)
    assert isinstance(first, _Page)
    assert isinstance(second, _Page)
    qtbot.mouseClick(window.rail.buttons[Step.LOTS], Qt.MouseButton.LeftButton)
    assert window.step is Step.LOTS
    assert (first.seen, second.seen) == (["entered", "left"], ["entered"])
    window.close()
    assert second.seen == ["entered", "left"]


def test_keys_walk_the_steps(qtbot: QtBot, window: MainWindow) -> None:
    qtbot.keyClick(window, Qt.Key.Key_3, Qt.KeyboardModifier.AltModifier)
    qtbot.waitUntil(lambda: window.step is Step.BELT)
    qtbot.keyClick(window, Qt.Key.Key_PageDown, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: window.step is Step.TEACH)


def test_the_action_bar_does_what_the_page_offers(qtbot: QtBot, window: MainWindow) -> None:
    page, done = window.page(Step.CONNECT), []
    main, other = QAction("Calibrate", page), QAction("Undo", page)
    main.triggered.connect(lambda: done.append("main"))
    page.offer(main, other)
    page.say("Put fruit on the belt.")
    assert [one.text() for one in _buttons(window)] == ["Undo", "Calibrate"]
    qtbot.mouseClick(_buttons(window)[-1], Qt.MouseButton.LeftButton)
    assert done == ["main"]
    main.setEnabled(False)
    assert not _buttons(window)[-1].isEnabled()


def test_the_keys_of_what_is_offered_work_and_of_what_was_offered_do_not(qtbot: QtBot, window: MainWindow) -> None:
    page, done = window.page(Step.CONNECT), []
    first, second = QAction("Calibrate", page), QAction("Keep", page)
    for action, name in ((first, "Calibrate"), (second, "Keep")):
        action.setShortcut("Ctrl+Return")
        action.triggered.connect(lambda _checked=False, name=name: done.append(name))
    for action in (first, second, first):
        page.offer(action)
        qtbot.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert done == ["Calibrate", "Keep", "Calibrate"]
    window.go_to(Step.LOTS)
    qtbot.keyClick(window, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert len(done) == 3, "the page is not in view"


def test_a_standing_error_is_not_pushed_away_by_a_lesser_word(
    qtbot: QtBot, session: Session, window: MainWindow
) -> None:
    session.messages.warn("Sensor kinect_2 is silent.", "Check its cable.", stays=True)
    session.messages.info("Saved.")
    shown = [one.text() for one in window.action_bar.findChildren(type(window.action_bar._text))]
    assert "Sensor kinect_2 is silent." in shown
    assert "Check its cable." in shown
    close = next(one for one in window.action_bar.findChildren(QPushButton) if one.text() == "Close")
    with qtbot.waitSignal(window.action_bar.closed_message):
        qtbot.mouseClick(close, Qt.MouseButton.LeftButton)
    assert not close.isVisible()


def test_what_holds_is_shown_for_as_long_as_it_holds(session: Session, window: MainWindow) -> None:
    bar, messages = window.action_bar, session.messages
    window.page(Step.CONNECT).say("Put fruit on the belt.")
    blind = Message(Level.BAD, "No sensor sees the left part.", "Fruit there are not counted.")
    messages.stand("blind", blind)
    assert (bar._text.text(), bar._detail.text()) == (blind.what, blind.remedy)
    messages.info("Saved.")
    assert bar._text.text() == "Saved."
    bar._timer.timeout.emit()
    assert bar._text.text() == blind.what, "a passing word is over, what holds goes on"
    messages.stand("room", Message(Level.WARN, "The disk is nearly full."))
    assert bar._text.text() == blind.what, "what matters most comes first"
    assert not bar._close.isVisible()
    messages.stand("blind", None)
    assert bar._text.text() == "The disk is nearly full."
    messages.stand("room", None)
    assert bar._text.text() == "Put fruit on the belt."


def test_what_is_said_of_an_error_takes_over_another_language(
    qapp: QApplication, session: Session, window: MainWindow
) -> None:
    error = WorldError("disk_full", "The disk is full.", "Make room on it.", file="records.sqlite")
    warning = LiveWarning("calibration_stale", "Sensor kinect_1 was moved.", ("kinect_1",))
    language, bar = Language(), window.action_bar
    for message in (error_message(error), warning_message(warning)):
        session.messages.say(message)
        english = bar._text.text(), bar._detail.text()
        language.put_on(qapp, "es")
        qapp.processEvents()
        try:
            spanish = bar._text.text(), bar._detail.text()
        finally:
            language.put_on(qapp, "en")
            qapp.processEvents()
        assert all(one != other for one, other in zip(english, spanish, strict=True))
        assert (bar._text.text(), bar._detail.text()) == english == (message.what, message.remedy)
        assert bar._close.isVisible()


def test_the_rail_says_how_far_each_step_is(window: MainWindow) -> None:
    window.show_states(step_states(Facts(sensors={"kinect_1": "A1"}, reference="kinect_1")))
    names = [button.accessibleName() for button in window.rail.buttons.values()]
    assert names[:3] == ["1. Connect: done", "2. Calibrate: ready", "3. Belt: to do"]
    assert "Calibrate" in window.rail.buttons[Step.BELT].toolTip()


def test_everything_that_is_pressed_is_large_enough_for_a_glove(window: MainWindow) -> None:
    page = window.page(Step.CONNECT)
    page.offer(QAction("Calibrate", page))
    for button in window.findChildren(QPushButton):
        if button.isVisible():
            assert min(button.height(), TOUCH) >= 40
