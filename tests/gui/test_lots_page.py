"""The lots screen on a real store of some thousand fruit."""

from __future__ import annotations

import shutil
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QElapsedTimer, Qt, QTimer
from PySide6.QtWidgets import QAbstractButton, QComboBox, QFileDialog, QLineEdit, QWidget
from pytestqt.qtbot import QtBot

from fruitgui.gui.session import Session
from fruitgui.gui.steps.lots.fruit_details import WIDEST_PICTURE
from fruitgui.gui.steps.lots.fruit_panel import FruitPanel
from fruitgui.gui.steps.lots.fruit_rows import COLUMNS, Column, Show
from fruitgui.gui.steps.lots.fruit_table import WIDEST_KIND
from fruitgui.gui.steps.lots.hand import Deed
from fruitgui.gui.steps.lots.hand_bar import HandBar
from fruitgui.gui.steps.lots.lot_entry import LotState, Period
from fruitgui.gui.steps.lots.lot_list import ENTRY
from fruitgui.gui.steps.lots.page import LIST_WIDTH, WIDEST_LIST, LotsPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.records.database import Database
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import LotPlan
from fruitgui.records.restore import is_prepared
from fruitgui.records.store import open_store
from fruitgui.records.unpacking import find_backups
from fruitgui.station.workflow import Step
from tests.gui.lots_made import FEW, MANY, fill
from tests.gui.opened import session_on
from tests.unit.station.fruit_made import KINDS, made_fruit

LONGEST_MS = 50.0
LOT = FEW + 1


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("lots")
    fill(folder)
    return folder


@pytest.fixture
def run_session(qtbot: QtBot, tmp_path: Path, written: Path) -> Iterator[Session]:
    shutil.copytree(written, tmp_path / "line")
    with session_on(qtbot, tmp_path / "line") as made:
        yield made


@pytest.fixture
def page(qtbot: QtBot, run_session: Session, theme: Theme) -> Iterator[LotsPage]:
    made = LotsPage(run_session, theme)
    made.resize(1072, 586)
    made.complete()
    made.show()
    made.entered()
    _settled(qtbot, made)
    yield made
    made.left()
    _settled(qtbot, made)
    made.close()
    made.deleteLater()


def _settled(qtbot: QtBot, page: LotsPage) -> None:
    qtbot.waitUntil(lambda: not page.desk.queries.busy, timeout=20_000)


def _names(page: LotsPage) -> list[str]:
    model = page.lots.model
    rows = (model.index(row, 0).data(ENTRY) for row in range(model.rowCount()))
    return [entry.name for entry in rows if entry is not None]


def _at_fruit(qtbot: QtBot, page: LotsPage, show: Show = Show.COUNTED) -> None:
    page.lot.show_fruit()
    table = page.lot.fruit.table
    table.show_box.setCurrentIndex(table.show_box.findData(show))
    _settled(qtbot, page)


def _counts(page: LotsPage) -> dict[str, int]:
    read = page.lot.read
    assert read is not None
    return {one.kind: one.fruit for one in read.figures.kinds}


def test_fruit_are_there_whether_or_not_their_list_was_made_before(
    qtbot: QtBot, run_session: Session, theme: Theme
) -> None:
    page = LotsPage(run_session, theme)
    qtbot.addWidget(page)
    page.show()
    page.entered()
    qtbot.waitUntil(lambda: page.lot.read is not None)
    assert page.findChild(FruitPanel) is None, "nobody has looked at fruit"
    page.lot.show_fruit()
    assert page.lot.at_fruit
    qtbot.waitUntil(lambda: page.lot.fruit.table.model.rowCount() == MANY)
    assert page.lot.fruit.table.kind_box.count() == 1 + len(KINDS)
    page.left()
    _settled(qtbot, page)


def test_the_newest_lot_is_shown_with_its_figures(page: LotsPage) -> None:
    assert page.lots.model.rowCount() == FEW + 1
    assert _names(page)[:2] == ["1184", "A119"]
    assert page.lot.name.text() == "Lot 1184"
    assert page.lot.about.text() == "Riquelme · recipe Export A · model model-0003"
    assert page.lot.summary.fruit.value.text() == "2\u202f000"
    assert "±" in page.lot.summary.volume.value.text()
    assert _counts(page) == dict.fromkeys(KINDS, MANY // 4)
    volumes = page.lot.summary.spreads.histograms["volume_m3"]
    assert all(f"{kind[:1].upper()}{kind[1:]} 500" in volumes.accessibleName() for kind in KINDS)
    assert page.main_action is page.report_action


def test_a_store_without_lots_says_what_will_appear_and_how(qtbot: QtBot, session: Session, theme: Theme) -> None:
    page = LotsPage(session, theme)
    qtbot.addWidget(page)
    page.entered()
    _settled(qtbot, page)
    assert page.main_action is page.way_to(Step.LIVE)
    assert "live screen" in page._empty._how.text()
    with qtbot.waitSignal(page.step_wanted) as wanted:
        page.way_to(Step.LIVE).trigger()
    assert wanted.args == [Step.LIVE]
    page.left()


def test_lots_are_searched_by_words_and_days(qtbot: QtBot, page: LotsPage) -> None:
    qtbot.keyClicks(page.lots.words, "norte a11")
    qtbot.waitUntil(lambda: page.lots.model.rowCount() == 5)
    assert _names(page) == ["A118", "A116", "A114", "A112", "A110"]
    assert page.lot.name.text() == "Lot 1184", "what is shown stays"
    page.lots.words.setText("nobody")
    qtbot.waitUntil(lambda: page.lots.model.rowCount() == 0)
    assert "No lot was found" in page.lots._empty._what.text()
    page.lots.words.clear()
    qtbot.waitUntil(lambda: page.lots.model.rowCount() == FEW + 1)
    page.lots.period.setCurrentIndex(page.lots.period.findData(Period.CHOSEN))
    first = page.lots.first.date().fromString("2025-06-01", Qt.DateFormat.ISODate)
    page.lots.first.setDate(first)
    page.lots.last.setDate(first.addDays(2))
    qtbot.waitUntil(lambda: page.lots.model.rowCount() == 3)


def test_a_long_list_is_filled_as_it_is_scrolled(qtbot: QtBot, page: LotsPage) -> None:
    view = page.lots.view
    view.verticalScrollBar().setValue(view.verticalScrollBar().maximum())
    qtbot.waitUntil(lambda: page.lots.model.index(FEW, 0).data(ENTRY) is not None)
    assert page.lots.model.index(FEW, 0).data(ENTRY).name == "A000"
    view.setCurrentIndex(page.lots.model.index(FEW, 0))
    qtbot.waitUntil(lambda: page.lot.name.text() == "Lot A000")


def test_fruit_are_sorted_filtered_and_pictured(qtbot: QtBot, page: LotsPage) -> None:
    _at_fruit(qtbot, page)
    table = page.lot.fruit.table
    assert table.model.rowCount() == MANY
    qtbot.waitUntil(lambda: table.model._pictures.keys() >= {fruit.key for fruit in table.chosen()})
    head = table.view.horizontalHeader()
    section = COLUMNS.index(Column.VOLUME)
    head.sectionClicked.emit(section)
    _settled(qtbot, page)
    rows = [table.model.pages.row(number) for number in range(20)]
    volumes = [row.volume_m3.value for row in rows if row is not None and row.volume_m3 is not None]
    assert volumes == sorted(volumes, reverse=True)
    assert table.model.headerData(section, Qt.Orientation.Horizontal).endswith("↓")
    table.kind_box.setCurrentIndex(table.kind_box.findData(KINDS[1]))
    _settled(qtbot, page)
    assert table.model.rowCount() == MANY // 4
    table.view.verticalScrollBar().setValue(table.view.verticalScrollBar().maximum())
    qtbot.waitUntil(lambda: table.model.pages.row(MANY // 4 - 1) is not None)


def test_a_fruit_is_opened_large_and_corrected_by_key(qtbot: QtBot, page: LotsPage) -> None:
    _at_fruit(qtbot, page)
    panel = page.lot.fruit
    panel.table.view.selectRow(4)
    qtbot.keyClick(panel.table.view, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: panel.opened)
    large = panel.large
    assert large.title.text() == "Lemon, No. 5"
    assert large.picture.count == 4, "colour and depth of two sensors"
    assert large.way.accessibleName().startswith("→")
    kinds = page.lot.read.kinds if page.lot.read else ()
    number = kinds.index("red apple")
    large.picture.setFocus()
    qtbot.keyClick(large.picture, Qt.Key(Qt.Key.Key_1.value + number))
    qtbot.waitUntil(lambda: large.title.text() == "Red apple, No. 5")
    assert large.person.text() == "A person named it Red apple."
    assert large.machine.text().startswith("The machine said Lemon")
    qtbot.waitUntil(lambda: _counts(page)["red apple"] == MANY // 4 + 1)
    qtbot.keyClick(large.picture, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    qtbot.waitUntil(lambda: large.title.text() == "Lemon, No. 5")
    qtbot.waitUntil(lambda: _counts(page)["red apple"] == MANY // 4)
    assert len(large.said.text().splitlines()) == 2, "both words stay"
    qtbot.keyClick(large.picture, Qt.Key.Key_PageDown)
    qtbot.waitUntil(lambda: large.title.text().endswith("No. 6"))
    qtbot.keyClick(large.picture, Qt.Key.Key_Backspace)
    qtbot.waitUntil(lambda: not panel.opened)


def test_a_press_on_a_picture_opens_its_fruit(qtbot: QtBot, page: LotsPage) -> None:
    _at_fruit(qtbot, page)
    table = page.lot.fruit.table
    place = table.view.visualRect(table.model.index(2, COLUMNS.index(Column.PICTURE))).center()
    qtbot.mouseClick(table.view.viewport(), Qt.MouseButton.LeftButton, pos=place)
    qtbot.waitUntil(lambda: page.lot.fruit.opened)
    assert page.lot.fruit.large.title.text().endswith("No. 3")


def test_several_fruit_are_left_out_at_once_and_put_back(qtbot: QtBot, page: LotsPage, run_session: Session) -> None:
    _at_fruit(qtbot, page)
    panel = page.lot.fruit
    panel.table.view.setFocus()
    panel.table.view.selectRow(0)
    for _ in range(2):
        qtbot.keyClick(panel.table.view, Qt.Key.Key_Down, Qt.KeyboardModifier.ShiftModifier)
    qtbot.waitUntil(lambda: len(panel.table.chosen()) == 3)
    qtbot.keyClick(panel.table.view, Qt.Key.Key_Delete)
    qtbot.waitUntil(lambda: panel.table.model.rowCount() == MANY - 3)
    assert run_session.messages.history[-1].what == "3 fruit left out."
    qtbot.waitUntil(lambda: page.lot.summary.fruit.value.text() == "1\u202f997")
    assert "3 corrected by hand, 3 of them left out" in page.lot.summary.fruit.more.text()
    _at_fruit(qtbot, page, Show.LEFT_OUT)
    assert panel.table.model.rowCount() == 3
    undo = run_session.messages.history[-1].act
    assert undo is not None
    undo()
    qtbot.waitUntil(lambda: panel.table.model.rowCount() == 0)
    assert run_session.store.lots.totals(LOT)[0].fruit == MANY // 4


def test_a_lot_that_is_looked_at_is_the_one_in_which_a_correction_is_taken_back(
    qtbot: QtBot, page: LotsPage, run_session: Session
) -> None:
    _at_fruit(qtbot, page)
    panel = page.lot.fruit
    panel.table.view.setFocus()
    panel.table.view.selectRow(0)
    qtbot.keyClick(panel.table.view, Qt.Key.Key_Delete)
    qtbot.waitUntil(lambda: _counts(page)["lemon"] == MANY // 4 - 1)
    page.lots.view.setCurrentIndex(page.lots.model.index(1, 0))
    _settled(qtbot, page)
    assert page.lot.read is not None
    assert page.lot.read.figures.lot.key == LOT - 1
    assert not panel.hand.undo.isEnabled(), "nothing was said of this lot"
    qtbot.keyClick(panel.table.view, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    _settled(qtbot, page)
    assert run_session.store.fruit.find(FruitQuery(LOT, which="left_out")).found == 1
    page.lots.view.setCurrentIndex(page.lots.model.index(0, 0))
    _settled(qtbot, page)
    panel.hand.undo.click()
    qtbot.waitUntil(lambda: _counts(page)["lemon"] == MANY // 4)


def test_a_kind_that_is_typed_is_the_one_that_people_would_read_it_as(qtbot: QtBot, theme: Theme) -> None:
    within = QWidget()
    qtbot.addWidget(within)
    bar = HandBar(theme, within)
    bar.setParent(within)
    bar.show_kinds(("lemon", "red apple"), {})
    said: list[tuple[object, ...]] = []
    bar.said.connect(lambda *words: said.append(words))
    bar._menu.actions()[-1].trigger()
    for typed in ("RED_apple", " Lima  dulce"):
        bar._typed(typed)
    bar._dialog.reject()
    assert said == [(Deed.NAME, "red apple", ""), (Deed.NAME, "Lima dulce", "")]


def test_a_fruit_that_was_missed_is_added_and_taken_back(
    qtbot: QtBot, page: LotsPage, run_session: Session, tmp_path: Path
) -> None:
    _at_fruit(qtbot, page)
    panel = page.lot.fruit
    read = page.lot.read
    assert read is not None
    kind = read.kinds[1]
    before = {one.kind: one.fruit for one in run_session.store.lots.totals(LOT)}
    panel.hand._missed.actions()[1].trigger()
    qtbot.waitUntil(lambda: panel.table.model.rowCount() == MANY + 1)
    after = {one.kind: one.fruit for one in run_session.store.lots.totals(LOT)}
    assert after == {**before, kind: before[kind] + 1}
    (added,) = run_session.store.fruit.find(FruitQuery(LOT, which="corrected")).fruit
    assert (added.machine_kind, added.kind, added.number) == (None, kind, MANY + 1)
    page.handing_on.write_table(run_session.store.lots.get(LOT), tmp_path / "a.csv")
    qtbot.waitUntil(lambda: not run_session.tasks.running)
    assert len((tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()) == MANY + 2
    undo = next(one for one in reversed(run_session.messages.history) if one.what.startswith("1 fruit added")).act
    assert undo is not None
    undo()
    qtbot.waitUntil(lambda: panel.table.model.rowCount() == MANY)
    assert {one.kind: one.fruit for one in run_session.store.lots.totals(LOT)} == before


def test_going_through_the_unknown_names_one_after_the_other(
    qtbot: QtBot, page: LotsPage, run_session: Session
) -> None:
    keys = [one.key for one in run_session.store.fruit.find(FruitQuery(LOT, count=4)).fruit]
    run_session.store.corrections.name(keys, "unknown")
    _at_fruit(qtbot, page, Show.UNKNOWN)
    panel = page.lot.fruit
    panel.open_row(0)
    qtbot.waitUntil(lambda: panel.opened)
    for number in range(1, 4):
        panel.hand.said.emit(Deed.NAME, "lemon", "")
        qtbot.waitUntil(lambda number=number: panel.table.model.rowCount() == 4 - number)
        _settled(qtbot, page)
        panel.large.after.click()
        qtbot.waitUntil(lambda number=number: panel.large.title.text() == f"Unknown, No. {number + 1}")


def test_a_note_is_kept_beside_what_holds(qtbot: QtBot, page: LotsPage, run_session: Session) -> None:
    _at_fruit(qtbot, page)
    hand = page.lot.fruit.hand
    qtbot.keyClick(page.lot.fruit.table.view, Qt.Key.Key_N)
    qtbot.waitUntil(lambda: hand._dialog.isVisible())
    hand._dialog.setTextValue("  soft at the stem ")
    hand._dialog.accept()
    _settled(qtbot, page)
    key = run_session.store.fruit.find(FruitQuery(LOT, count=1)).fruit[0].key
    assert [(one.kind, one.note) for one in run_session.store.corrections.of(key)] == [("lemon", "soft at the stem")]


def test_report_and_table_are_written_and_said(
    qtbot: QtBot, page: LotsPage, run_session: Session, tmp_path: Path
) -> None:
    lot = run_session.store.lots.get(LOT)
    page.handing_on.write_report(lot, tmp_path / "a.pdf")
    qtbot.waitUntil(lambda: not run_session.tasks.running)
    page.handing_on.write_table(lot, tmp_path / "a.csv")
    qtbot.waitUntil(lambda: not run_session.tasks.running)
    assert (tmp_path / "a.pdf").read_bytes().startswith(b"%PDF")
    assert len((tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()) == MANY + 1
    assert [message.action for message in run_session.messages.history] == ["Open", "Open"]
    page.handing_on.write_report(lot, tmp_path / "missing" / "a.pdf")
    qtbot.waitUntil(lambda: run_session.messages.history[-1].remedy != "")
    assert "missing" in run_session.messages.history[-1].what


def test_a_file_that_is_there_is_never_replaced_silently(page: LotsPage) -> None:
    page.report_action.trigger()
    dialog = page.handing_on.dialog
    assert dialog is not None
    assert dialog.acceptMode() is QFileDialog.AcceptMode.AcceptSave
    assert not dialog.testOption(QFileDialog.Option.DontConfirmOverwrite)
    assert dialog.defaultSuffix() == "pdf"
    assert Path(dialog.selectedFiles()[0]).name == "lot-1184.pdf"
    dialog.reject()


def test_one_press_backs_up_and_a_backup_is_laid_ready_for_the_next_start(
    qtbot: QtBot, page: LotsPage, run_session: Session
) -> None:
    folder = run_session.workspace.folder
    page.store_menu.back_up_now.trigger()
    qtbot.waitUntil(lambda: not run_session.tasks.running, timeout=20_000)
    (path,) = find_backups(folder)
    assert run_session.messages.history[-1].what == f"{path} holds all of it."
    keys = [one.key for one in run_session.store.fruit.find(FruitQuery(LOT, count=9)).fruit]
    run_session.store.corrections.leave_out(keys)
    page.store_menu._which(str(path))
    question = page.store_menu.question
    assert question is not None
    question.buttons()[0].click()
    qtbot.waitUntil(lambda: not run_session.tasks.running, timeout=20_000)
    assert is_prepared(folder)
    assert run_session.messages.history[-1].action == "Close now"
    assert run_session.store.fruit.find(FruitQuery(LOT, count=0)).found == MANY - 9, "nothing is replaced meanwhile"
    page.left()
    _settled(qtbot, page)
    run_session.store.close()
    with open_store(folder) as again:
        assert again.fruit.find(FruitQuery(LOT, count=0)).found == MANY
    assert list(folder.glob("aside-*")), "what was there is kept"


def test_a_restore_can_be_called_off(qtbot: QtBot, page: LotsPage, run_session: Session) -> None:
    page.store_menu.back_up_now.trigger()
    qtbot.waitUntil(lambda: not run_session.tasks.running, timeout=20_000)
    page.store_menu.lay_ready(find_backups(run_session.workspace.folder)[0])
    qtbot.waitUntil(lambda: not run_session.tasks.running, timeout=20_000)
    page.store_menu.forget.trigger()
    assert not is_prepared(run_session.workspace.folder)


def test_a_lot_that_began_while_a_backup_was_checked_is_not_set_aside(
    qtbot: QtBot, page: LotsPage, run_session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    page.store_menu.back_up_now.trigger()
    qtbot.waitUntil(lambda: not run_session.tasks.running, timeout=20_000)
    monkeypatch.setattr(page.store_menu, "_counting", lambda: True)
    page.store_menu.lay_ready(find_backups(run_session.workspace.folder)[0])
    qtbot.waitUntil(lambda: not run_session.tasks.running, timeout=20_000)
    assert "A lot is running" in run_session.messages.history[-1].what
    assert not is_prepared(run_session.workspace.folder)


def test_a_lot_that_runs_is_followed(qtbot: QtBot, page: LotsPage, run_session: Session) -> None:
    lot = run_session.store.lots.start(LotPlan("1190"))
    page.show_line(lot.key)
    qtbot.waitUntil(lambda: page.lots.model.index(0, 0).data(ENTRY).name == "1190")
    assert page.lots.model.index(0, 0).data(ENTRY).state is LotState.RUNNING
    assert page.lots.view.currentIndex().row() == 1, "the lot that was chosen stays chosen"
    page.choose(lot.key)
    qtbot.waitUntil(lambda: page.lot.lot == lot.key)
    run_session.store.commit(lot.key, made_fruit(1), ())
    page._look.timeout.emit()
    qtbot.waitUntil(lambda: page.lot.summary.fruit.value.text() == "1")
    run_session.store.lots.end(lot.key)


def test_the_windows_thread_never_asks_the_store(
    qtbot: QtBot, run_session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[threading.Thread] = []
    for name in ("reading", "writing"):
        plain = getattr(Database, name)

        def noted(self: Database, plain: object = plain) -> object:
            asked.append(threading.current_thread())
            return plain(self)  # type: ignore[operator]

        monkeypatch.setattr(Database, name, noted)
    page = LotsPage(run_session, theme)
    qtbot.addWidget(page)
    page.show()
    page.entered()
    _settled(qtbot, page)
    _walk(qtbot, page)
    page.left()
    _settled(qtbot, page)
    assert len(asked) > 20
    assert threading.main_thread() not in asked


def _walk(qtbot: QtBot, page: LotsPage) -> None:
    """Do what a person does: look through lots and fruit, sort, open, correct, take back, search."""
    view = page.lots.view
    for row in (3, 9, 0):
        view.setCurrentIndex(page.lots.model.index(row, 0))
        _settled(qtbot, page)
    _at_fruit(qtbot, page)
    panel = page.lot.fruit
    bar = panel.table.view.verticalScrollBar()
    for share in (10, 3, 7, 1, 9, 5):
        bar.setValue(bar.maximum() * share // 10)
        QCoreApplication.processEvents()
    _settled(qtbot, page)
    for column in (Column.VOLUME, Column.SURE, Column.KIND):
        panel.table.view.horizontalHeader().sectionClicked.emit(COLUMNS.index(column))
        _settled(qtbot, page)
    panel.open_row(7)
    qtbot.waitUntil(lambda: panel.opened)
    qtbot.keyClick(panel.large.picture, Qt.Key.Key_2)
    _settled(qtbot, page)
    page.desk.undo(LOT)
    _settled(qtbot, page)
    panel.close_fruit()
    page.lot.show_summary()
    page.lots.words.setText("a1")
    qtbot.waitUntil(lambda: page.lots.model.rowCount() == 20)
    _settled(qtbot, page)


def test_the_windows_thread_is_never_held_for_long(qtbot: QtBot, page: LotsPage) -> None:
    """Its own work between two looks at what happens is measured, not the time that other programs take from it."""
    spent: list[float] = []
    last = [time.thread_time()]

    def beat() -> None:
        now = time.thread_time()
        spent.append((now - last[0]) * 1e3)
        last[0] = now

    timer, clock = QTimer(interval=0), QElapsedTimer()
    timer.timeout.connect(beat)
    clock.start()
    timer.start()
    _walk(qtbot, page)
    timer.stop()
    assert len(spent) > 50
    assert max(spent) < LONGEST_MS, f"longest {max(spent):.0f} ms of {len(spent)} beats in {clock.elapsed()} ms"


def test_everything_that_is_pressed_is_large_enough_for_a_glove_and_named(qtbot: QtBot, page: LotsPage) -> None:
    fields = []
    for turn in (page.lot.show_summary, page.lot.show_fruit):
        turn()
        _settled(qtbot, page)
        fields += [one for kind in (QAbstractButton, QComboBox, QLineEdit) for one in page.findChildren(kind)]
    page.lot.fruit.open_row(0)
    qtbot.waitUntil(lambda: page.lot.fruit.opened)
    fields += page.lot.fruit.large.findChildren(QAbstractButton)
    shown = [one for one in fields if one.isVisible() and not one.objectName().startswith("qt_")]
    assert len(shown) > 8
    small = [one for one in shown if one.height() < 40 or (isinstance(one, QAbstractButton) and one.width() < 40)]
    assert [(one.accessibleName(), one.size()) for one in small] == []
    assert [one for one in shown if not (one.accessibleName() or getattr(one, "text", str)())] == []


def test_a_large_screen_keeps_figures_beside_their_kind_and_names_whole(qtbot: QtBot, page: LotsPage) -> None:
    page.lot.show_fruit()
    _settled(qtbot, page)
    table = page.lot.fruit.table
    narrow = page.lots.width()
    page.resize(3632, 2020)
    head = table.view.horizontalHeader()
    assert head.sectionSize(COLUMNS.index(Column.KIND)) == WIDEST_KIND
    assert head.length() < 1800 < table.view.viewport().width()
    assert not any(table.view.isColumnHidden(number) for number in range(len(COLUMNS)))
    assert (narrow, page.lots.width()) == (LIST_WIDTH, WIDEST_LIST)
    page.lot.fruit.open_row(0)
    qtbot.waitUntil(lambda: page.lot.fruit.opened, timeout=20_000)
    _settled(qtbot, page)
    assert page.lot.fruit.large.picture.width() == WIDEST_PICTURE
    page.resize(1072, 586)
    assert page.lots.width() == LIST_WIDTH
    assert head.length() <= table.view.width(), "nothing is cut off in a small window"
