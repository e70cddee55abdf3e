"""The teaching screen on a real store with fruit of a simulated line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QAbstractButton, QMessageBox
from pytestqt.qtbot import QtBot

from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.shots.school import LABELS, RECORDING
from fruitgui.gui.steps.teach.densities import DensitiesDialog
from fruitgui.gui.steps.teach.desk import Pile, Shelf
from fruitgui.gui.steps.teach.page import TeachPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.records.store import Store, open_store
from fruitgui.station.sources import RecordedSource
from fruitgui.station.workflow import State, Step
from tests.schools import FRUIT, nameless_school

LONG_MS = 120_000

pytestmark = pytest.mark.xdist_group("teach page")


@pytest.fixture(scope="module")
def schoolhouse(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return nameless_school(tmp_path_factory)


@pytest.fixture
def page(qtbot: QtBot, taught: Session, theme: Theme) -> Iterator[TeachPage]:
    made = TeachPage(taught, theme)
    made.resize(1072, 580)
    made.show()
    made.entered()
    _rest(qtbot, made)
    yield made
    made.left()
    _rest(qtbot, made)
    made.close()
    made.deleteLater()


def _rest(qtbot: QtBot, page: TeachPage) -> None:
    """Wait until all that was asked is answered, and all that was changed is saved."""
    qtbot.waitUntil(
        lambda: not page.room.busy and not any(one.busy for one in page.findChildren(Queries)), timeout=LONG_MS
    )


def _kinds(store: Store) -> list[str | None]:
    return [one.kind for one in store.teaching.briefs()]


def _name_all(qtbot: QtBot, page: TeachPage, folder: Path) -> None:
    page.room.import_labels(RECORDING, folder / LABELS)
    qtbot.waitUntil(lambda: page.room.desk.can_look_through, timeout=LONG_MS)
    _rest(qtbot, page)


def test_a_fresh_line_says_what_will_appear_here(qtbot: QtBot, session: Session, theme: Theme) -> None:
    empty = TeachPage(session, theme)
    qtbot.addWidget(empty)
    empty.show()
    _rest(qtbot, empty)
    assert empty.empty.isVisible()
    assert not empty.choices.open.isEnabled(), "nothing can come in before the sensors are calibrated"
    assert "Connect" in empty.hint, "what comes first of all"
    assert empty.main_action is empty.way_to(Step.CONNECT)


def test_keys_name_and_move_on_and_each_is_on_the_disk(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    assert len(page.model.keys) == FRUIT
    first = page.grid.chosen()
    page.kinds.new.setFocus()
    qtbot.keyClicks(page.kinds.new, "lemon")
    qtbot.keyClick(page.kinds.new, Qt.Key.Key_Return)
    assert page.grid.hasFocus(), "keys name fruit again"
    second = page.grid.chosen()
    assert second
    assert second != first
    qtbot.keyClick(page.grid, Qt.Key.Key_1)
    qtbot.keyClick(page.grid, Qt.Key.Key_0)
    _rest(qtbot, page)
    assert sorted(one for one in _kinds(taught.store) if one) == ["lemon", "lemon", "unknown"]
    with open_store(taught.workspace.folder) as other:
        assert other.teaching.waiting() == FRUIT - 3
    assert taught.marks.kinds == ("lemon",)
    assert taught.taught is not None
    assert taught.taught.kinds["lemon"][1] == 2


def test_undo_and_redo_follow_the_store_even_by_the_toast(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    key = page.grid.chosen()[0]
    page.room.name([key], "lemon")
    message = taught.messages.history[-1]
    assert message.what == "Named: Lemon."
    assert message.act is not None
    message.act()
    _rest(qtbot, page)
    assert taught.store.teaching.waiting() == FRUIT
    assert page.grid.chosen() == [key], "what was taken back is shown again"
    assert not page.choices.undo.isEnabled()
    page.choices.redo.trigger()
    _rest(qtbot, page)
    assert taught.store.teaching.get(key).fruit.kind == "lemon"
    page.choices.redo.trigger()
    _rest(qtbot, page)
    assert taught.store.teaching.waiting() == FRUIT - 1


def test_several_are_named_at_once_and_let_wait_again(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    page.grid.selectAll()
    page.room.name(page.grid.chosen()[:5], "pear")
    page._look_at(Shelf(Pile.NAMED, "pear"))
    assert len(page.model.keys) == 5
    page.grid.selectAll()
    qtbot.keyClick(page.grid, Qt.Key.Key_Backspace)
    _rest(qtbot, page)
    assert taught.store.teaching.waiting() == FRUIT
    assert page.empty.isVisible()


def test_a_kind_that_was_renamed_is_gone_at_the_next_start(
    qtbot: QtBot, taught: Session, page: TeachPage, theme: Theme
) -> None:
    page.grid.selectAll()
    keys = page.grid.chosen()
    page.room.name(keys[:3], "lmeon")
    page.room.name(keys[3:5], "pear")
    page._look_at(Shelf(Pile.NAMED, "lmeon"))
    page.grid.setFocus()
    qtbot.keyClick(page.grid, Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    page.room.name(page.grid.chosen(), "lemon")
    _rest(qtbot, page)
    assert page.room.desk.order == ("lmeon", "pear", "lemon"), "undoing may bring it back"
    qtbot.waitUntil(lambda: not taught.saving)
    again = TeachPage(taught, theme)
    qtbot.addWidget(again)
    qtbot.waitUntil(lambda: bool(again.room.desk.fruit))
    _rest(qtbot, again)
    assert again.room.desk.order == ("pear", "lemon")


def test_a_click_and_a_press_are_enough(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    page.room.name(page.grid.chosen(), "lemon")
    place = page.grid.visualRect(page.model.index(2)).center()
    qtbot.mouseClick(page.grid.viewport(), Qt.MouseButton.LeftButton, pos=place)
    (key,) = page.grid.chosen()
    assert page.model.row(key) == 2
    qtbot.mouseClick(page.kinds.buttons["lemon"], Qt.MouseButton.LeftButton)
    _rest(qtbot, page)
    assert taught.store.teaching.get(key).fruit.kind == "lemon"


def test_measures_are_typed_of_the_fruit_that_is_shown(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    (key,) = page.grid.chosen()
    qtbot.waitUntil(lambda: "±" in page.panel.fitted.text())
    page.panel.volume.setFocus()
    qtbot.keyClicks(page.panel.volume, "112,5")
    qtbot.keyClick(page.panel.volume, Qt.Key.Key_Return)
    qtbot.keyClicks(page.panel.mass, "101")
    qtbot.keyClick(page.panel.mass, Qt.Key.Key_Return)
    _rest(qtbot, page)
    fruit = taught.store.teaching.get(key).fruit
    assert (fruit.volume_ml, fruit.mass_g, fruit.kind) == (112.5, 101.0, None), "digits were typed, no kind was given"
    assert "0.90" in page.panel.density.text()
    assert page.grid.hasFocus()


def test_pictures_come_with_outline_and_depth(qtbot: QtBot, page: TeachPage) -> None:
    key = page.model.keys[0]
    qtbot.waitUntil(lambda: page.model.views(key) is not None, timeout=LONG_MS)
    views = page.model.views(key)
    assert views
    assert not views[0].colour.isNull()
    assert not views[0].depth.isNull()
    assert views[0].outline.count() > 8
    before = page.grid.grab().toImage()
    page.choices.see_depth.trigger()
    assert page.grid.grab().toImage() != before


def test_a_model_suggests_and_finds_a_wrong_label(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    assert not page.choices.suggest.isEnabled()
    _name_all(qtbot, page, taught.workspace.folder)
    desk = page.room.desk
    lemons = desk.keys(Shelf(Pile.NAMED, "lemon"))
    page.room.clear(lemons[:1])
    page.room.name(lemons[1:2], "red apple")
    page.choices.suggest.trigger()
    qtbot.waitUntil(lambda: not page.room.looking, timeout=LONG_MS)
    guess = desk.guess(lemons[0])
    assert guess is not None
    assert guess.kind == "lemon"
    assert lemons[1] in desk.keys(Shelf(Pile.DOUBTFUL))
    page._look_at(Shelf(Pile.DOUBTFUL))
    page.grid.choose_row(page.model.row(lemons[1]))
    qtbot.keyClick(page.grid, Qt.Key(ord(next(line.key for line in desk.lines() if line.kind == "lemon"))))
    _rest(qtbot, page)
    assert lemons[1] not in desk.keys(Shelf(Pile.DOUBTFUL))
    assert taught.store.teaching.get(lemons[1]).fruit.kind == "lemon"


def test_labels_go_out_and_come_in_again(qtbot: QtBot, taught: Session, page: TeachPage, tmp_path: Path) -> None:
    _name_all(qtbot, page, taught.workspace.folder)
    named = _kinds(taught.store)
    assert None not in named
    page.room.export(RECORDING, tmp_path / "out.csv")
    qtbot.waitUntil(lambda: (tmp_path / "out.csv").exists() and not taught.tasks.running, timeout=LONG_MS)
    page.room.clear(list(page.room.desk.fruit))
    _rest(qtbot, page)
    page.room.import_labels(RECORDING, tmp_path / "out.csv")
    qtbot.waitUntil(lambda: _kinds(taught.store) == named and not taught.tasks.running, timeout=LONG_MS)
    _rest(qtbot, page)


def test_a_recording_that_is_opened_twice_adds_nothing_twice(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    page.room.lessons.open(taught.workspace.folder / RECORDING)
    assert page.main_action is page.choices.stop
    qtbot.waitUntil(lambda: not page.room.lessons.running, timeout=LONG_MS)
    _rest(qtbot, page)
    assert len(taught.store.teaching.briefs()) == FRUIT
    assert "were here already" in taught.messages.history[-1].what


def test_a_recording_comes_in_and_can_be_stopped(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    page.room.remove(list(page.room.desk.fruit))
    _rest(qtbot, page)
    page.room.lessons.open(taught.workspace.folder / RECORDING)
    qtbot.waitUntil(lambda: len(page.room.desk.fruit) > 0, timeout=LONG_MS)
    page.choices.stop.trigger()
    qtbot.waitUntil(lambda: not page.room.lessons.running, timeout=LONG_MS)
    _rest(qtbot, page)
    assert len(page.model.keys) == len(taught.store.teaching.briefs()) > 0


def test_the_line_is_watched_until_it_is_enough(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    assert not page.choices.watch.isEnabled(), "no sensors run"
    taught.source.choose(RecordedSource(taught.workspace.folder / RECORDING, speed=4.0, looped=True))
    qtbot.waitUntil(page.choices.watch.isEnabled, timeout=LONG_MS)
    page.choices.watch.trigger()
    assert page.main_action is page.choices.stop
    qtbot.waitUntil(lambda: len(page.room.desk.fruit) > FRUIT, timeout=LONG_MS)
    page.choices.stop.trigger()
    qtbot.waitUntil(lambda: not page.room.lessons.running, timeout=LONG_MS)
    _rest(qtbot, page)
    (line,) = [one for one in page.room.sources(named=False) if one != RECORDING]
    assert line.startswith("Line, ")
    assert taught.connected.feed is not None, "the sensors run on"


def test_thousands_are_laid_out_a_page_at_a_time(qtbot: QtBot, page: TeachPage) -> None:
    fruit = page.room.desk.fruit[page.model.keys[0]]
    page.room.desk.lay_out([replace(fruit, key=key) for key in range(3000, 0, -1)], ())
    page._show()
    assert len(page.model.keys) == 3000
    assert page.model.rowCount() < 1000
    page.grid.choose_row(page.model.row(1))
    assert page.grid.chosen() == [1]
    page.grid.choose_row(0)
    page.grid.scrollToBottom()
    _rest(qtbot, page)


def test_removing_asks_once(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    page.choices.remove.trigger()
    box = page.findChild(QMessageBox)
    assert isinstance(box, QMessageBox)
    button = next(one for one in box.buttons() if one.text() == "Remove")
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    _rest(qtbot, page)
    assert len(taught.store.teaching.briefs()) == FRUIT - 1


def test_another_screen_can_ask_for_a_fruit(taught: Session, page: TeachPage) -> None:
    key = page.model.keys[4]
    page.room.name([key], "lemon")
    taught.taught_wanted.emit(key)
    assert page.grid.chosen() == [key]
    assert page.shelves.shelf == Shelf(Pile.NAMED, "lemon")


def test_teaching_is_done_when_every_kind_is_full(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    _name_all(qtbot, page, taught.workspace.folder)
    state = taught.states()[Step.TEACH]
    assert state.state is State.READY
    assert taught.states()[Step.TRAIN].state is State.READY


def test_everything_that_is_pressed_is_large_enough_for_a_glove(page: TeachPage) -> None:
    page.room.name(page.grid.chosen(), "lemon")
    page._look_at(Shelf(Pile.NAMED))
    for one in page.findChildren(QAbstractButton):
        if one.isVisible() and one.focusPolicy() != Qt.FocusPolicy.NoFocus:
            assert min(one.width(), one.height()) >= 40, one.accessibleName()
            assert one.accessibleName() or one.text()
    assert page.grid.visualRect(page.model.index(0)).width() >= 100
    assert page.grid.indexAt(QPoint(40, 40)).isValid()


def test_a_density_is_typed_for_a_kind_and_kept(qtbot: QtBot, taught: Session, page: TeachPage) -> None:
    assert not page.choices.weigh.isEnabled(), "there is no kind yet"
    page.room.name([page.grid.chosen()[0]], "lemon")
    _rest(qtbot, page)
    page.choices.weigh.trigger()
    (dialog,) = page.findChildren(DensitiesDialog)
    field = dialog.fields["lemon"]
    qtbot.keyClicks(field, "9,7")
    assert not dialog.save.isEnabled()
    assert "Lemon" in dialog._wrong.text()
    field.clear()
    qtbot.keyClicks(field, "0,97")
    with qtbot.waitSignal(taught.kinds.changed):
        dialog.save.click()
    assert taught.kinds.densities_g_ml == {"lemon": 0.97}
    qtbot.waitUntil(lambda: not taught.saving)
    kept = taught.workspace.kinds.load().value
    assert kept is not None
    assert kept.typed_densities() == {"lemon": 0.97}
    page.choices.weigh.trigger()
    again = page.findChildren(DensitiesDialog)[-1]
    assert again.typed == {"lemon": 0.97}
    again.reject()
