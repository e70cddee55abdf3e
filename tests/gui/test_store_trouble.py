"""A store that cannot be opened is named, and every way out of it keeps what is there."""

from __future__ import annotations

import contextlib
import sqlite3
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication, QDialog
from pytestqt.qtbot import QtBot

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.gui.app import Application
from fruitgui.gui.session import Session
from fruitgui.gui.store_trouble import StoreTrouble, opened
from fruitgui.records.backup import back_up, backup_path
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.store import Store, open_store
from fruitgui.station.workspace import open_workspace
from tests.gui.lots_made import START_S, Clock, run

pytestmark = pytest.mark.usefixtures("theme")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a workspace with a backup of four fruit, three more counted since, and a damaged database."""
    place, clock = tmp_path / "line", Clock(START_S)
    place.mkdir()
    with open_store(place, clock) as store:
        run(store, clock, "1184", "", 4)
    back_up(place, backup_path(place, START_S), START_S)
    with open_store(place, clock) as store:
        run(store, clock, "1185", "", 3)
    damage(place)
    return place


def damage(place: Path) -> None:
    (place / "records.sqlite").write_bytes(b"scratched " * 3000)


def _fruit(store: Store) -> dict[str, int]:
    return {line.lot.name: line.fruit for line in store.lots.find(LotQuery()).lots}


def _error(folder: Path) -> FruitguiError:
    with pytest.raises(WorldError) as raised:
        open_store(folder)
    return raised.value


@pytest.fixture
def dialog(qtbot: QtBot, folder: Path) -> Iterator[StoreTrouble]:
    made = StoreTrouble(folder, _error(folder))
    made.show()
    qtbot.waitUntil(lambda: not made.busy, timeout=20_000)
    yield made
    made.done(0)
    made.deleteLater()


def test_what_is_damaged_is_named_and_the_last_good_backup_offered(dialog: StoreTrouble, folder: Path) -> None:
    assert str(folder / "records.sqlite") in dialog._place.text()
    assert "records.sqlite is damaged" in dialog._what.text()
    assert dialog.restore.isVisible()
    assert dialog.restore.isDefault()
    assert dialog.restore.text().startswith("Restore the backup of 19 Feb 2025")
    buttons = (dialog.restore, dialog.anew, dialog.again, dialog.leave)
    assert min(button.height() for button in buttons) >= 40
    assert all(button.width() >= button.sizeHint().width() for button in buttons), "words are cut off"


def test_restoring_goes_back_to_the_backup_and_keeps_what_was_damaged(
    qtbot: QtBot, dialog: StoreTrouble, folder: Path
) -> None:
    dialog.restore.click()
    qtbot.waitUntil(lambda: dialog.result() == QDialog.DialogCode.Accepted, timeout=20_000)
    with open_store(folder) as store:
        assert _fruit(store) == {"1184": 4}
    (aside,) = folder.glob("aside-*")
    assert (aside / "records.sqlite").read_bytes().startswith(b"scratched")


def test_beginning_anew_keeps_the_damaged_file_beside(dialog: StoreTrouble, folder: Path) -> None:
    dialog.anew.click()
    assert dialog.result() == QDialog.DialogCode.Accepted
    with open_store(folder) as store:
        assert _fruit(store) == {}
    kept = [path for path in folder.iterdir() if path.is_file() and path.read_bytes().startswith(b"scratched")]
    assert len(kept) == 1


def test_without_a_good_backup_none_is_offered(qtbot: QtBot, folder: Path) -> None:
    for path in (folder / "backups").iterdir():
        path.write_bytes(path.read_bytes()[:-100])
    dialog = StoreTrouble(folder, _error(folder))
    qtbot.addWidget(dialog)
    dialog.show()
    qtbot.waitUntil(lambda: not dialog.busy, timeout=20_000)
    assert not dialog.restore.isVisible()
    assert dialog.anew.isVisible()
    assert "no good backup" in dialog._state.text()


def test_a_store_that_another_program_holds_is_waited_for_and_never_set_aside(qtbot: QtBot, tmp_path: Path) -> None:
    error = WorldError("store_locked", "Another program holds records.sqlite.", "Close it.", file=tmp_path / "records")
    dialog = StoreTrouble(tmp_path, error)
    qtbot.addWidget(dialog)
    dialog.show()
    assert not dialog.anew.isVisible()
    assert not dialog.restore.isVisible()
    dialog.again.click()
    assert dialog.result() == QDialog.DialogCode.Accepted


def test_records_of_a_newer_program_are_left_as_they_are_and_a_backup_of_this_one_is_offered(
    qtbot: QtBot, tmp_path: Path
) -> None:
    folder, clock = tmp_path / "line", Clock(START_S)
    folder.mkdir()
    with open_store(folder, clock) as store:
        run(store, clock, "1184", "", 4)
    back_up(folder, backup_path(folder, START_S), START_S)
    with contextlib.closing(sqlite3.connect(folder / "records.sqlite")) as connection, connection:
        connection.execute("UPDATE alembic_version SET version_num = '9999'")
    newer = (folder / "records.sqlite").read_bytes()
    dialog = StoreTrouble(folder, _error(folder))
    qtbot.addWidget(dialog)
    dialog.show()
    qtbot.waitUntil(lambda: not dialog.busy, timeout=20_000)
    assert "newer version" in dialog._what.text()
    assert not dialog.anew.isVisible(), "they are sound"
    assert dialog.restore.isVisible()
    assert not dialog.restore.isDefault(), "starting the newer program loses nothing"
    assert (folder / "records.sqlite").read_bytes() == newer
    dialog.restore.click()
    qtbot.waitUntil(lambda: dialog.result() == QDialog.DialogCode.Accepted, timeout=20_000)
    with open_store(folder) as store:
        assert _fruit(store) == {"1184": 4}
    (aside,) = folder.glob("aside-*")
    assert (aside / "records.sqlite").read_bytes() == newer


def test_opening_is_tried_again_until_it_goes_well(qtbot: QtBot, folder: Path) -> None:
    seen: list[StoreTrouble] = []

    def trouble(error: FruitguiError) -> StoreTrouble:
        made = StoreTrouble(folder, error)
        seen.append(made)
        look = QTimer(made, interval=20)
        look.timeout.connect(lambda: made.restore.click() if made.restore.isVisible() else None)
        look.start()
        return made

    with opened(lambda: open_store(folder), trouble) as store:
        assert _fruit(store) == {"1184": 4}
    assert len(seen) == 1
    qtbot.waitUntil(lambda: not seen[0].isVisible())


def test_the_program_asks_before_its_window_opens(qtbot: QtBot, qapp: QApplication, folder: Path) -> None:
    asked: list[str] = []

    def give_up() -> None:
        shown = qapp.activeModalWidget()
        if isinstance(shown, StoreTrouble):
            asked.append(shown._place.text())
            shown.reject()

    look = QTimer(interval=20)
    look.timeout.connect(give_up)
    look.start()
    with pytest.raises(WorldError):
        Application(qapp, folder)
    look.stop()
    assert len(asked) == 1
    assert str(folder) in asked[0]
    qtbot.waitUntil(lambda: qapp.activeModalWidget() is None)


def test_giving_up_changes_nothing_and_says_why(folder: Path) -> None:
    before = (folder / "records.sqlite").read_bytes()

    def trouble(error: FruitguiError) -> StoreTrouble:
        made = StoreTrouble(folder, error)
        QTimer.singleShot(0, made, made.reject)
        return made

    with pytest.raises(WorldError) as raised:
        opened(lambda: Session(open_workspace(folder)), trouble)
    assert raised.value.code == "store_damaged"
    assert (folder / "records.sqlite").read_bytes() == before


def test_a_second_window_on_one_line_is_refused_until_the_first_is_closed(tmp_path: Path) -> None:
    first = Session(open_workspace(tmp_path / "line"))
    with pytest.raises(WorldError) as raised:
        Session(open_workspace(tmp_path / "line"))
    assert raised.value.code == "line_open"
    assert first.close()
    assert Session(open_workspace(tmp_path / "line")).close()
