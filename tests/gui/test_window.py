from __future__ import annotations

from collections.abc import Callable, Iterator
from threading import Event

import pytest
from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QToolButton, QToolTip
from pytestqt.qtbot import QtBot

from fruitgui.errors import InputError, WorldError
from fruitgui.gui.action_bar import ActionButton
from fruitgui.gui.health import warning_message
from fruitgui.gui.messages import Level, Message, Messages
from fruitgui.gui.session import Session
from fruitgui.gui.steps.calibrate.core_words import in_words
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.theme.tokens import TOUCH
from fruitgui.gui.told import Told
from fruitgui.gui.top_bar import Pill, TopBar
from fruitgui.gui.translate import Language
from fruitgui.gui.window import MainWindow
from fruitgui.progress import Cancelled, Progress
from fruitgui.station.live.state import LiveWarning
from fruitgui.station.workflow import Facts, State, Step, StepState, Why, step_states


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


def test_the_buttons_of_a_page_are_there_before_it_is_first_gone_to(
    qtbot: QtBot, session: Session, theme: Theme
) -> None:
    pages = {step: _Page() for step in Step}
    pages[Step.LOTS].offer(QAction("Export", pages[Step.LOTS]))
    window = MainWindow(theme, session.messages, session.tasks, pages)
    qtbot.addWidget(window)
    window.go_to(Step.CONNECT)
    window.show()
    window.page(Step.LOTS)
    (made,) = window.action_bar.findChildren(ActionButton)
    assert not made.isVisible()
    window.go_to(Step.LOTS)
    assert window.action_bar.findChildren(ActionButton) == [made]
    assert made.isVisible()


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
    silent = Told("Sensor kinect_2 is silent.", "Check its cable.")
    session.messages.say(Message(Level.WARN, lambda: silent, stays=True))
    session.messages.info(lambda: Told("Saved."))
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
    blind = Message(Level.BAD, lambda: Told("No sensor sees the left part.", "Fruit there are not counted."))
    messages.stand("blind", blind)
    assert (bar._text.text(), bar._detail.text()) == (blind.what, blind.remedy)
    messages.info(lambda: Told("Saved."))
    assert bar._text.text() == "Saved."
    bar._timer.timeout.emit()
    assert bar._text.text() == blind.what, "a passing word is over, what holds goes on"
    messages.stand("room", Message(Level.WARN, lambda: Told("The disk is nearly full.")))
    assert bar._text.text() == blind.what, "what matters most comes first"
    assert not bar._close.isVisible()
    messages.stand("blind", None)
    assert bar._text.text() == "The disk is nearly full."
    messages.stand("room", None)
    assert bar._text.text() == "Put fruit on the belt."


def _in_spanish(qapp: QApplication, shown: Callable[[], tuple[str, ...]]) -> tuple[str, ...]:
    """Return what is shown while the window speaks Spanish."""
    language = Language()
    language.put_on(qapp, "es")
    qapp.processEvents()
    try:
        return shown()
    finally:
        language.put_on(qapp, "en")
        qapp.processEvents()


def _no_room() -> Told:
    return Told(
        QCoreApplication.translate("Health", "Fruit cannot be kept on the disk now; they wait in memory."),
        QCoreApplication.translate(
            "Blind", "Sizes are less sure meanwhile. Check cable and power; it starts again by itself."
        ),
        QCoreApplication.translate("Classroom", "Undo"),
    )


def _say_good(messages: Messages) -> None:
    messages.good(lambda: Told(QCoreApplication.translate("BeltPage", "The belt is saved.")))


def _say_error(messages: Messages) -> None:
    messages.error(WorldError("disk_full", "The disk is full.", "Make room on it.", file="records.sqlite"))


def _say_warning(messages: Messages) -> None:
    messages.say(warning_message(LiveWarning("calibration_stale", "Sensor kinect_1 was moved.", ("kinect_1",))))


@pytest.mark.parametrize(
    "say",
    [
        lambda messages: messages.info(_no_room, lambda: None),
        lambda messages: messages.say(Message(Level.WARN, _no_room, stays=True)),
        lambda messages: messages.stand("room", Message(Level.WARN, _no_room)),
        _say_good,
        _say_error,
        _say_warning,
    ],
)
def test_whatever_is_said_takes_over_another_language(
    qapp: QApplication, session: Session, window: MainWindow, say: Callable[[Messages], None]
) -> None:
    bar = window.action_bar

    def shown() -> tuple[str, ...]:
        return tuple(text for text in (bar._text.text(), bar._detail.text(), bar._do.text()) if text)

    nothing = shown()
    say(session.messages)
    english = shown()
    assert english != nothing
    spanish = _in_spanish(qapp, shown)
    assert all(one != other for one, other in zip(english, spanish, strict=True))
    assert shown() == english


def test_a_jobs_name_takes_over_another_language_in_the_bar_and_in_its_error(
    qtbot: QtBot, qapp: QApplication, session: Session, window: MainWindow
) -> None:
    bar, go = window.action_bar, Event()
    session.messages.said.disconnect(bar.say)

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001
        go.wait()
        raise ZeroDivisionError

    task = session.tasks.run(lambda: QCoreApplication.translate("Trainer", "Training"), job)
    task.failed.connect(session.messages.error)
    assert bar._text.text() == "Training"
    assert _in_spanish(qapp, lambda: (bar._text.text(),)) == ("Entrenando",)
    assert bar._text.text() == "Training"
    go.set()
    qtbot.waitUntil(lambda: bool(session.messages.history))
    error = session.messages.history[-1]
    assert "“Training”" in error.what
    assert "Entrenando" in _in_spanish(qapp, lambda: (error.what,))[0]


def test_an_error_leads_to_the_step_that_mends_it(
    qtbot: QtBot, qapp: QApplication, session: Session, window: MainWindow
) -> None:
    session.messages.error(WorldError("disk_full", "The disk is full.", "Make room on it.", file="records.sqlite"))
    assert not window.action_bar._do.isVisible(), "no screen mends it"
    window.action_bar._close.click()
    session.messages.error(InputError("bad_model", "model.zip is not a model.", "Train again."))
    do = window.action_bar._do
    assert do.text() == "Train"
    assert _in_spanish(qapp, lambda: (do.text(),)) == ("Entrenar",)
    qtbot.mouseClick(do, Qt.MouseButton.LeftButton)
    assert window.step is Step.TRAIN


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


def _labels(window: MainWindow) -> list[str]:
    return [one.text() for one in window.action_bar.findChildren(QLabel) if one.isVisible() and one.text()]


def test_what_a_job_is_at_follows_the_language_at_once(
    qtbot: QtBot, window: MainWindow, session: Session, qapp: QApplication
) -> None:
    go = Event()

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001 - it waits to be let go
        progress(0.5, "Placing the sensors")
        go.wait(60)

    task = session.tasks.run(lambda: QCoreApplication.translate("CalibratePage", "Calibrating"), job, in_words)
    qtbot.waitUntil(lambda: "Placing the sensors" in _labels(window))
    language = Language()
    language.put_on(qapp, "es")
    try:
        qtbot.waitUntil(lambda: "Ubicando los sensores" in _labels(window))
    finally:
        language.put_on(qapp, "en")
        with qtbot.waitSignal(task.ended):
            go.set()


def test_a_job_stays_in_view_when_one_that_began_later_has_ended(
    qtbot: QtBot, window: MainWindow, session: Session
) -> None:
    first, second = Event(), Event()

    def job(until: Event, doing: str) -> Callable[[Progress, Cancelled], None]:
        def run(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001 - it waits to be let go
            progress(0.25, doing)
            until.wait(60)

        return run

    slow = session.tasks.run(lambda: "Slow", job(first, "slow_1"))
    qtbot.waitUntil(lambda: "slow_1" in _labels(window))
    quick = session.tasks.run(lambda: "Quick", job(second, "quick_1"))
    qtbot.waitUntil(lambda: "quick_1" in _labels(window))
    with qtbot.waitSignal(quick.ended):
        second.set()
    qtbot.waitUntil(lambda: {"Slow", "slow_1"} <= set(_labels(window)))
    with qtbot.waitSignal(slow.ended):
        first.set()
    qtbot.waitUntil(lambda: "Slow" not in _labels(window))


def test_the_progress_of_a_job_does_not_take_the_place_of_what_an_error_says_to_do(
    qtbot: QtBot, window: MainWindow, session: Session
) -> None:
    told, end = Event(), Event()

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001 - it waits to be let go
        progress(0.25, "one_1")
        told.wait(60)
        progress(0.5, "two_2")
        end.wait(60)

    task = session.tasks.run(lambda: "Slow", job)
    qtbot.waitUntil(lambda: "one_1" in _labels(window))
    session.messages.error(InputError("what_is_wrong", "The file is damaged.", "Choose another."))
    shares: list[float] = []
    task.progressed.connect(lambda share, _: shares.append(share))
    told.set()
    qtbot.waitUntil(lambda: shares == [0.5])
    assert {"The file is damaged.", "Choose another."} <= set(_labels(window))
    assert "two_2" not in _labels(window)
    with qtbot.waitSignal(task.ended):
        end.set()


def test_a_job_that_begins_takes_the_place_of_what_an_earlier_one_did_but_not_of_a_way_to_undo_it(
    qtbot: QtBot, session: Session, window: MainWindow
) -> None:
    ends = Event()

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001 - it waits to be let go
        ends.wait(60)

    session.messages.good(lambda: Told("The new model is in use."))
    task = session.tasks.run(lambda: "Training", job)
    assert "Training" in _labels(window)
    session.messages.info(lambda: Told("Named: Lemon.", action="Undo"), lambda: None)
    with qtbot.waitSignal(task.ended):
        ends.set()
    ends.clear()
    second = session.tasks.run(lambda: "Looking for mistakes", job)
    assert "Named: Lemon." in _labels(window)
    with qtbot.waitSignal(second.ended):
        ends.set()


def test_why_a_step_is_to_be_done_again_stands_below_it_and_all_seven_stay_in_view(
    qapp: QApplication, window: MainWindow
) -> None:
    window.resize(1280, 720)
    low = window.rail.buttons[Step.BELT].height()
    why = Why("sensors_changed", {"added": ["kinect_3"], "removed": ["kinect_2"], "exchanged": ["left_1", "right_1"]})
    again = (Step.CALIBRATE, Step.BELT, Step.TEACH, Step.TRAIN)
    window.show_states({step: StepState(State.REDO if step in again else State.DONE, why) for step in Step})
    qapp.processEvents()
    assert window.rail.buttons[Step.CALIBRATE].height() > low + 30
    assert window.rail.buttons[Step.LIVE].height() == low, "what is done needs no reason"
    last = window.rail.buttons[Step.LOTS]
    assert last.geometry().bottom() <= window.rail.height()


@pytest.mark.qt_log_ignore("does not support raise", extend=True)
def test_a_press_on_a_pill_says_what_a_resting_pointer_would(qtbot: QtBot, window: MainWindow) -> None:
    window.top_bar.show_pills((Pill("disk", "disk", "3 GB", "warn", "Free on the disk: 3 GB."),))
    (button,) = (one for one in window.top_bar.findChildren(QToolButton) if one.text() == "3 GB")
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    assert QToolTip.text() == "Free on the disk: 3 GB."
    QToolTip.hideText()
    qtbot.waitUntil(lambda: not QToolTip.isVisible())


def test_what_is_not_well_has_a_sign_and_not_a_colour_alone(qtbot: QtBot, theme: Theme) -> None:
    bar = TopBar(theme)
    qtbot.addWidget(bar)
    widths = []
    for health in ("good", "warn", "bad"):
        bar.show_pills((Pill("line", "clock", "140 ms", health),))
        (button,) = (one for one in bar.findChildren(QToolButton) if one.text() == "140 ms")
        widths.append(button.iconSize().width())
    assert widths[0] < widths[1] == widths[2]
