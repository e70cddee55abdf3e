"""The checkup in the window: checks beside it, shows each sensor with its remedies, and installs rules after a yes."""

from __future__ import annotations

import json
import string
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QAbstractButton, QApplication, QLabel
from pytestqt.qtbot import QtBot

from fruitgui.errors import CancelledByUserError, WorldError
from fruitgui.gui.session import Session
from fruitgui.gui.shots import checkups
from fruitgui.gui.shots.frozen import FrozenSource, frozen_source, frozen_sources
from fruitgui.gui.steps.connect.checkup_cards import CheckedSensorCard
from fruitgui.gui.steps.connect.checkup_dialog import CheckupDialog
from fruitgui.gui.steps.connect.checkup_words import problem_words, said
from fruitgui.gui.steps.connect.driver_words import _limits, fault_words, limit_words
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.tasks import Job, TaskRunner
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.translate import Language
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.kinect import faults
from fruitgui.sensors.kinect.models import KINECT_1414, KINECT_1473, KINECT_FOR_WINDOWS
from fruitgui.sensors.usb.machine import Machine
from fruitgui.sensors.usb.problems import WORDS, problem, problem_of
from fruitgui.sensors.usb.udev import rules_are_installed
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.checkup.measuring import MeasuringBeside, Outcome
from fruitgui.station.checkup.records import Checkup, SensorState
from fruitgui.station.workspace import open_workspace
from tests.unit.sensors.made_system import MadeSystem
from tests.unit.station.made_drivers import RunningSensor

LONG_MS = 20_000


@pytest.fixture
def tasks(qtbot: QtBot) -> Iterator[TaskRunner]:
    made = TaskRunner()
    yield made
    qtbot.waitUntil(lambda: not made.running, timeout=LONG_MS)
    assert made.close()


Opening = Callable[[Job[Checkup]], CheckupDialog]


@pytest.fixture
def opened(qtbot: QtBot, theme: Theme, tasks: TaskRunner, tmp_path: Path) -> Opening:
    def open_(check: Job[Checkup]) -> CheckupDialog:
        dialog = CheckupDialog(check, MadeSystem(tmp_path).machine, tasks, theme)
        qtbot.addWidget(dialog)
        dialog.show()
        return dialog

    return open_


def finding(found: Checkup) -> Job[Checkup]:
    def check(progress: Progress, cancelled: Cancelled) -> Checkup:
        progress(0.5, "Asking the drivers")
        stop_if(cancelled)
        return found

    return check


def done(qtbot: QtBot, dialog: CheckupDialog) -> None:
    qtbot.waitUntil(lambda: not dialog.busy, timeout=LONG_MS)


def texts(dialog: CheckupDialog) -> list[str]:
    return [one.text() for one in dialog.findChildren(QLabel) if one.isVisible()]


def test_every_sensor_has_a_card_with_what_is_wrong_and_what_to_do(qtbot: QtBot, opened: Opening) -> None:
    dialog = opened(finding(checkups.much_wrong()))
    done(qtbot, dialog)
    cards = dialog.findChildren(CheckedSensorCard)
    assert [card.accessibleName() for card in cards] == [
        "kinect_1: runs", "kinect_2: runs", "kinect_3: no access", "realsense_1: in use"
    ]  # fmt: skip
    shown = texts(dialog)
    assert "4 sensors; 7 things are wrong." in shown
    assert "Kinect 1414 · A00363A01205 · firmware 1.14" in shown
    assert "Kinect 1473 · A00364A22105" in shown, "of this one it is not known"
    assert "It lost 34 of 120 pictures, though this computer had time to take them." in shown
    assert "Close that program, then check again." in shown
    assert "21.4 pictures a second, 34 of 120 lost · Port 1-2.3 of USB controller 0000:00:14.0" in shown
    assert "146\u2009%" in shown


@pytest.mark.parametrize(
    ("found", "summary"),
    [(checkups.all_well, "2 sensors; nothing is wrong."), (checkups.nothing, "No sensor was found.")],
)
def test_all_of_it_is_said_in_one_sentence(
    qtbot: QtBot, opened: Opening, found: Callable[[], Checkup], summary: str
) -> None:
    dialog = opened(finding(found()))
    done(qtbot, dialog)
    assert summary in texts(dialog)
    assert not dialog.let_me.isVisible()


def test_where_nothing_is_connected_it_says_what_to_check(qtbot: QtBot, opened: Opening) -> None:
    dialog = opened(finding(checkups.nothing()))
    done(qtbot, dialog)
    assert any("power supply" in text for text in texts(dialog))


def test_it_shows_how_far_it_is_and_can_be_stopped_and_begun_again(qtbot: QtBot, opened: Opening) -> None:
    asked = 0

    def check(progress: Progress, cancelled: Cancelled) -> Checkup:
        nonlocal asked
        asked += 1
        progress(0.4, "Watching the sensors run")
        while asked == 1:
            stop_if(cancelled)
            threading.Event().wait(0.01)
        return checkups.all_well()

    dialog = opened(check)
    qtbot.waitUntil(lambda: "Watching the sensors run" in texts(dialog), timeout=LONG_MS)
    assert dialog._working.share == 0.4
    assert not dialog.again.isEnabled()
    qtbot.mouseClick(dialog.stop, Qt.MouseButton.LeftButton)
    done(qtbot, dialog)
    assert dialog.checkup is None
    assert "The check was stopped." in texts(dialog)
    dialog.activateWindow()
    qtbot.waitUntil(dialog.isActiveWindow, timeout=LONG_MS)
    qtbot.keyClick(dialog, Qt.Key.Key_F5)
    qtbot.waitUntil(lambda: asked == 2, timeout=LONG_MS)
    done(qtbot, dialog)
    assert dialog.checkup == checkups.all_well()
    assert "The check was stopped." not in texts(dialog)


def test_closing_it_stops_the_check(qtbot: QtBot, opened: Opening, tasks: TaskRunner) -> None:
    began, stopped = threading.Event(), threading.Event()

    def check(progress: Progress, cancelled: Cancelled) -> Checkup:  # noqa: ARG001
        began.set()
        while not cancelled():
            threading.Event().wait(0.01)
        stopped.set()
        return checkups.nothing()

    dialog = opened(check)
    qtbot.waitUntil(began.is_set, timeout=LONG_MS)
    qtbot.keyClick(dialog, Qt.Key.Key_Escape)
    assert not dialog.isVisible()
    qtbot.waitUntil(stopped.is_set, timeout=LONG_MS)
    qtbot.waitUntil(lambda: not tasks.running, timeout=LONG_MS)


def test_a_check_that_fails_is_said(qtbot: QtBot, opened: Opening) -> None:
    def check(progress: Progress, cancelled: Cancelled) -> Checkup:  # noqa: ARG001
        raise WorldError("broken", "It broke.", "Mend it.")

    dialog = opened(check)
    done(qtbot, dialog)
    assert "It broke. Mend it." in texts(dialog)
    assert dialog.again.isEnabled()
    assert not dialog.copy.isEnabled()


def test_all_of_it_is_copied_for_whoever_helps(qtbot: QtBot, opened: Opening) -> None:
    dialog = opened(finding(checkups.much_wrong()))
    done(qtbot, dialog)
    qtbot.mouseClick(dialog.copy, Qt.MouseButton.LeftButton)
    assert json.loads(QGuiApplication.clipboard().text()) == checkups.much_wrong().value()


def test_another_language_is_taken_over(qtbot: QtBot, opened: Opening, qapp: QApplication) -> None:
    dialog = opened(finding(checkups.much_wrong()))
    done(qtbot, dialog)
    language = Language()
    try:
        language.put_on(qapp, "es")
        qtbot.waitUntil(lambda: "4 sensores; hay 7 problemas." in texts(dialog), timeout=LONG_MS)
        assert "Da 21,4 de 30,0 imágenes por segundo." in texts(dialog)
    finally:
        language.put_on(qapp, "en")
    qtbot.waitUntil(lambda: "4 sensors; 7 things are wrong." in texts(dialog), timeout=LONG_MS)


def test_that_it_was_stopped_is_said_in_another_language_too(qtbot: QtBot, opened: Opening, qapp: QApplication) -> None:
    def check(progress: Progress, cancelled: Cancelled) -> Checkup:  # noqa: ARG001
        raise CancelledByUserError

    dialog = opened(check)
    done(qtbot, dialog)
    language = Language()
    try:
        language.put_on(qapp, "es")
        qtbot.waitUntil(lambda: "La revisión se detuvo." in texts(dialog), timeout=LONG_MS)
    finally:
        language.put_on(qapp, "en")
    qtbot.waitUntil(lambda: "The check was stopped." in texts(dialog), timeout=LONG_MS)


def test_return_closes_it(qtbot: QtBot, opened: Opening) -> None:
    dialog = opened(finding(checkups.all_well()))
    done(qtbot, dialog)
    with qtbot.waitSignal(dialog.accepted, timeout=LONG_MS):
        qtbot.keyClick(dialog, Qt.Key.Key_Return)


def test_everything_that_is_pressed_is_large_enough_for_a_glove(qtbot: QtBot, opened: Opening) -> None:
    dialog = opened(finding(checkups.much_wrong()))
    done(qtbot, dialog)
    buttons = [one for one in dialog.findChildren(QAbstractButton) if one.isVisible()]
    assert len(buttons) == 4
    assert [one.text() for one in buttons if min(one.height(), one.width()) < 40] == []


# the rules


def test_rules_are_installed_after_a_yes(qtbot: QtBot, opened: Opening, tmp_path: Path) -> None:
    machine = Machine(tmp_path)
    dialog = opened(finding(checkups.much_wrong()))
    done(qtbot, dialog)
    qtbot.mouseClick(dialog.let_me, Qt.MouseButton.LeftButton)
    asked = dialog.rules
    assert asked is not None
    assert 'ATTR{idVendor}=="045e"' in asked.rules.toPlainText()
    assert str(tmp_path / "etc/udev/rules.d/60-fruitgui.rules") in asked.rules.toPlainText()
    qtbot.mouseClick(asked.leave, Qt.MouseButton.LeftButton)
    done(qtbot, dialog)
    assert not rules_are_installed(machine)
    qtbot.mouseClick(dialog.let_me, Qt.MouseButton.LeftButton)
    assert dialog.rules is not None
    qtbot.mouseClick(dialog.rules.install, Qt.MouseButton.LeftButton)
    done(qtbot, dialog)
    assert rules_are_installed(machine)
    assert any(text.startswith("The rules are installed.") for text in texts(dialog))


def test_rules_that_cannot_be_installed_are_said(qtbot: QtBot, opened: Opening, tmp_path: Path) -> None:
    dialog = opened(finding(checkups.much_wrong()))
    done(qtbot, dialog)
    (tmp_path / "etc/udev/rules.d").write_text("in the way")
    qtbot.mouseClick(dialog.let_me, Qt.MouseButton.LeftButton)
    assert dialog.rules is not None
    qtbot.mouseClick(dialog.rules.install, Qt.MouseButton.LeftButton)
    done(qtbot, dialog)
    assert any("rules.d" in text and "written" in text for text in texts(dialog))


def test_without_udev_there_is_nothing_to_ask(qtbot: QtBot, opened: Opening, tmp_path: Path) -> None:
    dialog = opened(finding(checkups.much_wrong()))
    done(qtbot, dialog)
    (tmp_path / "etc/udev").rmdir()
    qtbot.mouseClick(dialog.let_me, Qt.MouseButton.LeftButton)
    assert dialog.rules is None
    assert any("no udev" in text for text in texts(dialog))


# words


def _fields(text: str) -> set[str]:
    return {name for _, name, _, _ in string.Formatter().parse(text) if name}


def test_the_window_knows_every_problem_with_all_its_values() -> None:
    words = problem_words()
    assert words.keys() == WORDS.keys()
    for code, (what, remedy) in words.items():
        assert what == WORDS[code][0], code
        assert _fields(remedy) == _fields(WORDS[code][1]), code


def test_what_only_a_driver_knows_is_said_as_it_is() -> None:
    assert said(problem_of(WorldError("of_tomorrow", "It {wobbles}.", "Hold it."))) == ("It {wobbles}.", "Hold it.")
    assert said(problem("slow", rate="9.4", nominal="30.0"))[0] == "It gives 9.4 of 30.0 pictures a second."


def test_a_drivers_error_with_the_code_of_something_else_is_said_as_it_is() -> None:
    assert said(problem_of(WorldError("slow", "It dozes.", "Wake it."))) == ("It dozes.", "Wake it.")


def test_what_the_kinects_driver_says_is_known() -> None:
    errors = [
        faults.not_there("A1", []), faults.not_allowed("A1"), faults.not_obeyed("A1", []), faults.usb_full("A1"),
        faults.hangs("A1"), faults.not_opened("A1", ["LIBUSB_ERROR_BUSY"]),
    ]  # fmt: skip
    assert [error.code for error in errors if error.code not in fault_words()] == []
    said_of = [limit for model in (KINECT_1414, KINECT_1473, KINECT_FOR_WINDOWS) for limit in model.limits]
    assert said_of
    assert [limit for limit in said_of if limit_words(limit) != limit] == [], "English stays as it is"
    assert [limit for limit in said_of if not any(limit.startswith(known) for known in _limits())] == []


# from the connect screen


@pytest.fixture(scope="module")
def rendered() -> FrozenSource:
    return frozen_source(still_scene(3, "opposed", 4, captures=2))


@pytest.fixture
def connected(qtbot: QtBot, tmp_path: Path, rendered: FrozenSource) -> Iterator[Session]:
    session = Session(open_workspace(tmp_path / "line"), sources=frozen_sources(rendered))
    session.source.choose(rendered)
    qtbot.waitUntil(
        lambda: len(session.connected.health) == 2 and all(one.frames for one in session.connected.health.values()),
        timeout=LONG_MS,
    )
    yield session
    assert session.close()
    qtbot.waitUntil(lambda: not session.tasks.running, timeout=LONG_MS)
    session.deleteLater()


def test_the_connect_screen_opens_it(
    qtbot: QtBot, session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fruitgui.gui.steps.connect.checkup_desk.check_up", lambda _plan, _p, _c: checkups.all_well())
    page = ConnectPage(session, theme)
    qtbot.addWidget(page)
    page.show()
    page.entered()
    assert page.check_action in page.other_actions
    page.check_action.trigger()
    dialog = page.checkup.dialog
    assert dialog is not None
    done(qtbot, dialog)
    assert dialog.checkup == checkups.all_well()
    with qtbot.waitSignal(dialog.finished):
        qtbot.mouseClick(dialog.leave, Qt.MouseButton.LeftButton)
    page.left()


def test_sensors_that_run_are_watched_where_they_run(connected: Session, rendered: FrozenSource) -> None:
    feed = connected.connected.feed
    assert feed is not None
    serial = rendered.sensors[0].info.serial
    same, other = RunningSensor(serial), RunningSensor("another")
    others: list[str] = []

    def run(sensors: object, *_: object) -> dict[str, Outcome]:
        assert isinstance(sensors, list)
        others.extend(one.info.serial for one in sensors)
        return {"another": Outcome(SensorState.RUNNING)}

    found = MeasuringBeside(feed, run)([same, other], 0.5, no_progress, never_cancelled)
    assert others == ["another"]
    assert same.opened == 0
    assert found[serial].state is SensorState.RUNNING
    assert found[serial].measured is not None
    assert found.keys() == {serial, "another"}
    idle = MeasuringBeside(feed, None)([same, other], 0.2, no_progress, never_cancelled)
    assert idle.keys() == {serial}
