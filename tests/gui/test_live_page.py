"""The live screen on a recording of a simulated line: what it counts is what crossed."""

from __future__ import annotations

import threading

import pytest
from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtWidgets import QApplication, QLabel, QPushButton, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.errors import WorldError
from fruitgui.gui.closing import ClosingQuestion
from fruitgui.gui.session import Session
from fruitgui.gui.steps.live.end_dialog import EndDialog
from fruitgui.gui.steps.live.lot_dialog import LotDialog
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.steps.lots.hand import Deed, Word
from fruitgui.gui.steps.lots.page import LotsPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.translate import Language
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import Lot, LotPlan
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.restore import READY
from fruitgui.records.store import open_store
from fruitgui.station.live import Phase
from fruitgui.station.workflow import State, Step
from tests.gui.line_recording import FRUIT, LineRecording, line_recording
from tests.unit.station.fruit_made import made_fruit

LONG_MS = 120_000

pytestmark = pytest.mark.xdist_group("live page")


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> LineRecording:
    return line_recording(tmp_path_factory)


@pytest.fixture
def page(qtbot: QtBot, session: Session, theme: Theme) -> LivePage:
    made = LivePage(session, theme)
    qtbot.addWidget(made)
    made.resize(1072, 586)
    made.show()
    made.entered()
    return made


@pytest.fixture
def ready(qtbot: QtBot, session: Session, page: LivePage, recorded: LineRecording) -> LivePage:
    recorded.set_up(session)
    qtbot.waitUntil(lambda: session.connected.feed is not None and not session.tasks.running, timeout=LONG_MS)
    return page


def _start(qtbot: QtBot, session: Session, page: LivePage, name: str = "1184") -> None:
    page.start.trigger()
    qtbot.waitUntil(lambda: page.findChild(LotDialog) is not None)
    dialog = page.findChild(LotDialog)
    assert isinstance(dialog, LotDialog)
    dialog.name.setText(name)
    button = next(one for one in dialog.findChildren(QPushButton) if one.text() == "Start")
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: session.running.running, timeout=LONG_MS)


def _asked_to_end(page: LivePage) -> EndDialog:
    page.end.trigger()
    assert page._question is not None
    return page._question


def _end(qtbot: QtBot, session: Session, page: LivePage) -> None:
    qtbot.mouseClick(_asked_to_end(page).end, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: session.running.lot is None, timeout=LONG_MS)


def _run_to_the_end(qtbot: QtBot, session: Session) -> None:
    def over() -> bool:
        state = session.running.state
        return state is not None and state.phase is Phase.ENDED

    qtbot.waitUntil(over, timeout=LONG_MS)


def test_before_it_is_set_up_the_screen_says_what_comes_first(session: Session, page: LivePage) -> None:
    assert session.states()[Step.LIVE].state is State.TO_DO
    assert not page.body.isVisible()
    assert not page.start.isEnabled()


def test_keys_choose_what_is_drawn_over_the_pictures(qtbot: QtBot, page: LivePage) -> None:
    page.activateWindow()
    qtbot.waitUntil(page.isActiveWindow)
    page.setFocus()
    assert page.overlays["labels"].isChecked()
    qtbot.keyClick(page, Qt.Key.Key_F6)
    assert not page.overlays["labels"].isChecked()
    assert page.overlays["outlines"].isChecked()


def test_a_lot_counts_what_crossed_and_is_kept(qtbot: QtBot, session: Session, ready: LivePage) -> None:
    assert ready.main_action is ready.start
    _start(qtbot, session, ready)
    assert ready.main_action is ready.end
    _run_to_the_end(qtbot, session)
    pictures = ready.body.pictures.pictures.values()
    qtbot.waitUntil(lambda: {one.accessibleDescription() for one in pictures} == {"the last picture of the recording"})
    _end(qtbot, session, ready)
    assert session.running.tally.count_all == FRUIT
    assert ready.body.counts.accessibleDescription() == f"Unknown: {FRUIT}"
    (lot,) = session.store.lots.find(LotQuery()).lots
    assert (lot.lot.name, lot.fruit, lot.lot.ended_s is not None) == ("1184", FRUIT, True)
    assert session.states()[Step.LOTS].state is State.DONE


def test_captions_are_in_another_language_at_once(qtbot: QtBot, qapp: QApplication, ready: LivePage) -> None:
    pictures = ready.body.pictures.pictures.values()
    qtbot.waitUntil(lambda: {one.accessibleDescription() for one in pictures} == {"the last picture of the recording"})
    ready._draw.stop()
    language = Language()
    language.put_on(qapp, "es")
    try:
        QCoreApplication.processEvents()
        assert {one.accessibleDescription() for one in pictures} == {"la última imagen de la grabación"}
    finally:
        language.put_on(qapp, "en")


def test_the_counts_follow_what_a_person_corrects(
    qtbot: QtBot, session: Session, ready: LivePage, theme: Theme
) -> None:
    _start(qtbot, session, ready)
    _run_to_the_end(qtbot, session)
    qtbot.waitUntil(lambda: session.running.tally.count_all == FRUIT)
    lots = LotsPage(session, theme)
    qtbot.addWidget(lots)
    lots.show()
    lots.entered()
    assert session.running.lot is not None
    (fruit, *_) = session.store.fruit.find(FruitQuery(session.running.lot.key)).fruit
    lots.desk.say(Word(Deed.LEAVE_OUT, (fruit.key,), lot=fruit.lot), (fruit,))
    qtbot.waitUntil(lambda: session.running.tally.count_all == FRUIT - 1)
    qtbot.waitUntil(lambda: ready.body.counts.accessibleDescription() == f"Unknown: {FRUIT - 1}")
    lots.left()
    qtbot.waitUntil(lambda: not lots.desk.queries.busy)
    _end(qtbot, session, ready)


def test_a_paused_lot_lets_fruit_pass_uncounted(qtbot: QtBot, session: Session, ready: LivePage) -> None:
    _start(qtbot, session, ready)
    ready.pause.trigger()
    qtbot.waitUntil(lambda: session.running.paused, timeout=LONG_MS)
    assert ready.main_action is ready.resume
    assert ready.body.standing.accessibleName() == "Nothing is counted. Lot 1184 is paused."
    assert ready.body.standing.isVisible()
    _run_to_the_end(qtbot, session)
    state = session.running.state
    assert state is not None
    assert session.running.tally.count_all + state.passed == FRUIT
    assert state.passed > 0


@pytest.mark.parametrize("key", [Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Escape], ids=str)
@pytest.mark.parametrize("on", ["leave", "end"])
def test_a_lot_ends_by_no_key_that_is_pressed_in_passing(
    qtbot: QtBot, session: Session, theme: Theme, key: Qt.Key, on: str
) -> None:
    page = _left_open(qtbot, session, theme, 3)
    dialog = _asked_to_end(page)
    assert dialog._count.text().endswith(": 3")
    assert dialog.focusWidget() is dialog.leave
    button = getattr(dialog, on)
    button.setFocus()
    qtbot.keyClick(button, key)
    assert dialog.result() == EndDialog.DialogCode.Rejected
    assert not dialog.isVisible()
    lot = session.running.lot
    assert lot is not None
    assert session.store.lots.get(lot.key).ended_s is None
    assert _asked_to_end(page) is not dialog, "it can be asked again"


def test_what_is_counted_while_it_is_asked_shows_in_the_question(qtbot: QtBot, session: Session, theme: Theme) -> None:
    page = _left_open(qtbot, session, theme, 3)
    dialog = _asked_to_end(page)
    session.running.tally.count(made_fruit(4, "lemon"), 0.0)
    page._draw_counts()
    assert dialog._count.text().endswith(": 4")


def test_a_lot_that_stands_still_says_so_over_the_counts(qtbot: QtBot, session: Session, theme: Theme) -> None:
    page = _left_open(qtbot, session, theme, 1)
    assert page.body.standing.accessibleName() == "Nothing is counted. Lot 1184 is open; the line stands still."
    assert not page.body.standing.isHidden()
    _end(qtbot, session, page)
    assert page.body.standing.isHidden()


def _left_open(qtbot: QtBot, session: Session, theme: Theme, fruit: int) -> LivePage:
    lot = session.store.lots.start(LotPlan("1184"))
    for number in range(1, fruit + 1):
        session.store.commit(lot.key, made_fruit(number, "lemon"), ())
    session.running.find_open_lot()
    page = LivePage(session, theme)
    qtbot.addWidget(page)
    page.show()
    return page


def test_a_lot_that_was_left_open_is_ended_without_its_sensors(qtbot: QtBot, session: Session, theme: Theme) -> None:
    lot = session.store.lots.start(LotPlan("1184"))
    for number in (1, 2, 3):
        session.store.commit(lot.key, made_fruit(number, "lemon"), ())
    session.running.find_open_lot()
    page = LivePage(session, theme)
    qtbot.addWidget(page)
    assert session.connected.feed is None
    assert session.running.tally.count_all == 3, "what was counted is shown"
    assert page.end in page.other_actions
    _end(qtbot, session, page)
    assert "1184 is ended with 3 fruit" in session.messages.history[-1].what
    ended = session.store.lots.get(lot.key)
    assert ended.ended_s is not None
    assert ended.ran_s(ended.ended_s) < ended.ended_s - ended.started_s, "it stood still since its last fruit"
    assert page.main_action is page.way_to(Step.CONNECT), "nothing was ever connected"


def test_a_lot_that_was_left_open_is_taken_up_again(
    qtbot: QtBot, session: Session, ready: LivePage, theme: Theme
) -> None:
    _start(qtbot, session, ready)
    _run_to_the_end(qtbot, session)
    session.close()
    again = Session(session.workspace)
    try:
        again.running.find_open_lot()
        page = LivePage(again, theme)
        qtbot.addWidget(page)
        again.start_sensors()
        qtbot.waitUntil(lambda: again.connected.feed is not None and not again.tasks.running, timeout=LONG_MS)
        assert page.main_action is page.take_up
        page.take_up.trigger()
        qtbot.waitUntil(lambda: again.running.running, timeout=LONG_MS)
        assert again.running.tally.count_all >= FRUIT
        _run_to_the_end(qtbot, again)
        qtbot.waitUntil(lambda: again.running.tally.count_all == 2 * FRUIT, timeout=LONG_MS)
    finally:
        assert again.close()
        again.deleteLater()


def test_taking_the_sensors_away_stops_the_line_and_keeps_the_lot(
    qtbot: QtBot, session: Session, ready: LivePage
) -> None:
    _start(qtbot, session, ready)
    session.connected.stop()
    qtbot.waitUntil(lambda: session.running.paused and not session.tasks.running, timeout=LONG_MS)
    assert not session.running.running
    assert session.running.lot is not None
    assert ready.main_action is ready.take_up


def test_however_often_it_is_pressed_one_line_counts(qtbot: QtBot, session: Session, ready: LivePage) -> None:
    _start(qtbot, session, ready)
    session.connected.stop()
    qtbot.waitUntil(lambda: session.running.paused and not session.tasks.running, timeout=LONG_MS)
    session.start_sensors()
    qtbot.waitUntil(lambda: session.connected.feed is not None and not session.tasks.running, timeout=LONG_MS)
    for _ in range(3):
        ready.take_up.trigger()
    qtbot.waitUntil(lambda: session.running.running and not session.tasks.running, timeout=LONG_MS)
    lines = [one for one in threading.enumerate() if one.name == "line gives"]
    assert len(lines) == 1, "each would count every fruit into the lot"
    _run_to_the_end(qtbot, session)
    assert session.running.tally.count_all == FRUIT


def test_closing_before_a_line_that_is_there_was_told_of_leaves_none(
    qtbot: QtBot, session: Session, ready: LivePage
) -> None:
    assert ready.main_action is ready.start
    session.start_lot(LotPlan("1184"))

    def starting() -> list[threading.Thread]:
        return [one for one in threading.enumerate() if one.name.startswith("task Starting")]

    qtbot.waitUntil(lambda: bool(starting()), timeout=LONG_MS)
    for one in starting():
        one.join(LONG_MS / 1000)  # while the window's thread is told nothing
    assert session.close()
    assert not [one.name for one in threading.enumerate() if one.name.startswith("line ")]


def test_no_lot_begins_while_a_backup_waits_to_be_put_in_place(session: Session, ready: LivePage) -> None:
    waiting = session.workspace.folder / READY
    waiting.mkdir()
    session.start_lot(LotPlan("1184"))
    assert not session.tasks.running
    assert "backup is put in place at the next start" in session.messages.history[-1].what
    assert session.connected.feed is not None, "the sensors run on"
    waiting.rmdir()
    assert ready.main_action is ready.start


FULL = WorldError("disk_full", "The disk is full.", "Make room.")


def _full(*_given: object) -> None:
    raise FULL


def test_a_pause_that_cannot_be_kept_is_none(
    qtbot: QtBot, session: Session, ready: LivePage, monkeypatch: pytest.MonkeyPatch
) -> None:
    _start(qtbot, session, ready)
    lot = session.running.lot
    assert lot is not None
    with monkeypatch.context() as full:
        full.setattr(session.store.lots, "pause", _full)
        ready.pause.trigger()
        qtbot.waitUntil(lambda: not session.tasks.running, timeout=LONG_MS)
    assert "disk is full" in session.messages.history[-1].what
    assert not session.running.paused
    _run_to_the_end(qtbot, session)
    _end(qtbot, session, ready)
    assert session.running.tally.count_all == FRUIT, "the screen said that the lot was running"


def test_a_lot_that_ends_while_the_disk_is_full_loses_nothing(
    qtbot: QtBot, session: Session, ready: LivePage, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as full:
        full.setattr(session.store, "commit", _full)
        _start(qtbot, session, ready)
        _run_to_the_end(qtbot, session)
        qtbot.mouseClick(_asked_to_end(ready).end, Qt.MouseButton.LeftButton)
        qtbot.waitUntil(lambda: session.running.stopped, timeout=LONG_MS)
        lot = session.running.lot
        assert lot is not None
        assert session.store.lots.get(lot.key).ended_s is None
        assert ready.hint.startswith("Lot 1184 is still open")
        assert ready.body.standing.isVisible(), "nothing is counted any more"
        assert (ready.main_action, ready.other_actions) == (ready.end, ())
    _end(qtbot, session, ready)
    assert session.running.tally.count_all == FRUIT
    (kept,) = session.store.lots.find(LotQuery()).lots
    assert (kept.fruit, kept.lot.ended_s is not None) == (FRUIT, True)


def _paused(qtbot: QtBot, session: Session, page: LivePage) -> Lot:
    _start(qtbot, session, page)
    page.pause.trigger()
    qtbot.waitUntil(lambda: session.running.paused, timeout=LONG_MS)
    lot = session.running.lot
    assert lot is not None
    return lot


def test_a_lot_goes_on_though_the_disk_cannot_take_that(
    qtbot: QtBot, session: Session, ready: LivePage, monkeypatch: pytest.MonkeyPatch
) -> None:
    lot = _paused(qtbot, session, ready)
    with monkeypatch.context() as full:
        full.setattr(session.store.lots, "resume", _full)
        ready.resume.trigger()
        qtbot.waitUntil(lambda: not session.running.busy, timeout=LONG_MS)
        assert not session.running.paused
        assert "disk is full" in session.messages.history[-1].what
        qtbot.waitUntil(lambda: session.running.state is not None and session.running.state.lot == lot.key)
        assert session.store.lots.get(lot.key).paused, "as a crash would leave it"
    qtbot.waitUntil(lambda: not session.store.lots.get(lot.key).paused, timeout=LONG_MS)
    _run_to_the_end(qtbot, session)
    _end(qtbot, session, ready)
    (pause,) = session.store.lots.get(lot.key).pauses
    assert pause.to_s is not None
    ended_s = session.store.lots.get(lot.key).ended_s
    assert ended_s is not None
    assert pause.to_s < ended_s


def test_what_a_lot_still_owes_the_disk_is_kept_before_its_end(
    qtbot: QtBot, session: Session, ready: LivePage, monkeypatch: pytest.MonkeyPatch
) -> None:
    lot = _paused(qtbot, session, ready)
    monkeypatch.setattr(session.running._owed, "try_again", lambda: None)
    with monkeypatch.context() as full:
        full.setattr(session.store.lots, "resume", _full)
        ready.resume.trigger()
        qtbot.waitUntil(lambda: not session.running.busy, timeout=LONG_MS)
    since_s = session.running.lot.pauses[-1].to_s if session.running.lot is not None else None
    _run_to_the_end(qtbot, session)
    _end(qtbot, session, ready)
    kept = session.store.lots.get(lot.key)
    assert [one.to_s for one in kept.pauses] == [since_s]
    assert kept.ended_s is not None


def test_closing_tells_which_fruit_wait_for_the_disk(
    qtbot: QtBot, session: Session, ready: LivePage, monkeypatch: pytest.MonkeyPatch
) -> None:
    window = QWidget()
    qtbot.addWidget(window)
    window.show()
    question = ClosingQuestion(window, lambda: session.running.unkept)
    assert not question.keeps_open()
    with monkeypatch.context() as full:
        full.setattr(session.store, "commit", _full)
        _start(qtbot, session, ready)
        _run_to_the_end(qtbot, session)
        assert question.keeps_open()
        assert question.dialog is not None
        assert question.dialog.stay.isDefault()
        said = [one.text() for one in question.dialog.findChildren(QLabel)]
        assert f"Fruit that wait for the disk: {FRUIT}" in said
        question.dialog.reject()
        assert window.isVisible()
        assert question.keeps_open(), "it is asked again"
        question.dialog.leave.click()
        assert not window.isVisible()
        assert not question.keeps_open()
    assert session.close(), "there was room again"
    with open_store(session.workspace.folder) as store:
        (kept,) = store.lots.find(LotQuery()).lots
    assert kept.fruit == FRUIT
