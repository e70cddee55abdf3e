from __future__ import annotations

import json
import shutil
import sqlite3
import threading
import zipfile
from pathlib import Path

import pytest

from fruitgui.errors import CancelledByUserError, InputError, WorldError
from fruitgui.records import restore as restoring
from fruitgui.records.backup import MANIFEST, back_up, backup_path
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import LotPlan
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.migrating import RECORDS
from fruitgui.records.restore import (
    READY,
    finish_restore,
    forget_restore,
    is_prepared,
    prepare_restore,
    restore,
)
from fruitgui.records.store import open_store
from fruitgui.records.unpacking import check_backup, last_good_backup
from fruitgui.station.live.blind import Blind
from tests.unit.station.fruit_made import made_crops, made_fruit

NOW_S = 1_800_000_000.0


def _work(folder: Path, fruit: int = 20) -> None:
    """Make a workspace with a lot, a station and a model."""
    folder.mkdir(exist_ok=True)
    (folder / "models").mkdir(exist_ok=True)
    (folder / "station.json").write_text(f'{{"of": {fruit}}}')
    (folder / "models" / "model-0001.fruit").write_bytes(b"model" * fruit)
    (folder / "recording.mcap").write_bytes(b"not backed up")
    with open_store(folder) as store:
        lot = store.lots.open_lot() or store.lots.start(LotPlan("1184"))
        for number in range(fruit):
            store.commit(lot.key, made_fruit(number), made_crops(number))


def _count(folder: Path) -> int:
    with open_store(folder) as store:
        (line,) = store.lots.find(LotQuery()).lots
        return line.fruit


def _contents(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and not path.name.endswith(("-wal", "-shm"))
    }


def test_a_workspace_goes_back_to_its_backup_and_what_was_there_is_kept(tmp_path: Path) -> None:
    folder = tmp_path / "line"
    _work(folder, 20)
    path = backup_path(folder, NOW_S)
    backup = back_up(folder, path, NOW_S)
    assert set(backup.files) == {"records.sqlite", "pictures.sqlite", "station.json", "models/model-0001.fruit"}
    _work(folder, 5)
    assert _count(folder) == 25
    aside = restore(folder, path, NOW_S)
    assert _count(folder) == 20
    assert (folder / "station.json").read_text() == '{"of": 20}'
    assert (folder / "recording.mcap").exists()
    assert aside is not None
    assert (aside / "station.json").read_text() == '{"of": 5}'
    assert _count(aside) == 25
    with open_store(folder) as store:
        lot = store.lots.open_lot()
        assert lot is not None
        assert len(store.fruit.story(store.fruit.find(FruitQuery(lot.key)).fruit[-1].key).crops) == 2


def test_an_empty_folder_takes_a_backup(tmp_path: Path) -> None:
    _work(tmp_path / "line")
    back_up(tmp_path / "line", tmp_path / "a.zip")
    (tmp_path / "other").mkdir()
    assert restore(tmp_path / "other", tmp_path / "a.zip", NOW_S) is None
    assert _count(tmp_path / "other") == 20


def test_counting_goes_on_during_a_backup_and_the_backup_is_one_moment(tmp_path: Path) -> None:
    folder = tmp_path / "line"
    _work(folder, 50)
    stop = threading.Event()
    with open_store(folder) as store:
        lot = store.lots.open_lot()
        assert lot is not None
        counted: list[int] = []

        def count() -> None:
            while not stop.is_set():
                counted.append(store.commit(lot.key, made_fruit(len(counted)), made_crops(1)).number)

        counting = threading.Thread(target=count)
        counting.start()
        try:
            back_up(folder, tmp_path / "a.zip")
        finally:
            stop.set()
            counting.join()
    (tmp_path / "other").mkdir()
    restore(tmp_path / "other", tmp_path / "a.zip", NOW_S)
    with open_store(tmp_path / "other") as store:
        numbers = [one.number for one in store.fruit.walk(lot.key)]
        (total,) = [line.fruit for line in store.lots.find(LotQuery()).lots]
    assert counted, "none was counted meanwhile"
    assert numbers == list(range(1, total + 1))
    assert 50 <= total <= counted[-1]


def test_a_backup_that_was_stopped_leaves_nothing(tmp_path: Path) -> None:
    _work(tmp_path / "line")
    (tmp_path / "out").mkdir()
    with pytest.raises(CancelledByUserError):
        back_up(tmp_path / "line", tmp_path / "out" / "a.zip", cancelled=lambda: True)
    assert list((tmp_path / "out").iterdir()) == []


def _rewritten(path: Path, name: str, data: bytes | None) -> Path:
    """Return a copy of a zip with one member changed, or left out."""
    changed = path.with_name("changed.zip")
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(changed, "w") as new:
        for info in old.infolist():
            if info.filename != name:
                new.writestr(info, old.read(info))
        if data is not None:
            new.writestr(name, data)
    return changed


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("records.sqlite", b"SQLite format 3\0 or so"),
        ("station.json", None),
        (MANIFEST, None),
        (MANIFEST, b"[]"),
        (MANIFEST, b'{"schema": "fruitgui.backup/9", "made_s": 0, "files": {}}'),
        (MANIFEST, b"{" * 100),
    ],
)
def test_a_backup_that_is_not_whole_is_refused_and_nothing_changes(
    tmp_path: Path, name: str, data: bytes | None
) -> None:
    folder = tmp_path / "line"
    _work(folder)
    back_up(folder, tmp_path / "a.zip")
    before = _contents(folder)
    with pytest.raises(InputError) as caught:
        restore(folder, _rewritten(tmp_path / "a.zip", name, data), NOW_S)
    assert caught.value.code == "bad_backup"
    assert _contents(folder) == before


@pytest.mark.parametrize("name", ["../evil.json", "/etc/evil.json", "models/../../evil.fruit", ".hidden.json", "a.txt"])
def test_a_backup_writes_nothing_outside_of_its_place(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "line"
    _work(folder)
    back_up(folder, tmp_path / "a.zip")
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        manifest = json.loads(archive.read(MANIFEST))
    manifest["files"][name] = {"bytes": 1, "sha256": "0" * 64}
    changed = _rewritten(tmp_path / "a.zip", MANIFEST, json.dumps(manifest).encode())
    with pytest.raises(InputError) as caught:
        check_backup(changed)
    assert "no business" in caught.value.what


def test_a_cut_off_or_foreign_file_is_no_backup(tmp_path: Path) -> None:
    _work(tmp_path / "line")
    path = tmp_path / "a.zip"
    back_up(tmp_path / "line", path)
    path.write_bytes(path.read_bytes()[:-200])
    for bad in (path, tmp_path / "missing.zip", tmp_path / "line" / "station.json"):
        with pytest.raises(InputError):
            check_backup(bad)


def test_a_backup_of_a_newer_program_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / "line"
    _work(folder)
    connection = sqlite3.connect(folder / RECORDS.file)
    connection.execute("UPDATE alembic_version SET version_num = '9999'")
    connection.commit()
    connection.close()
    back_up(folder, tmp_path / "a.zip")
    with pytest.raises(WorldError) as caught:
        check_backup(tmp_path / "a.zip")
    assert caught.value.code == "store_newer"


def test_the_last_good_backup_is_found_among_bad_ones(tmp_path: Path) -> None:
    folder = tmp_path / "line"
    _work(folder)
    assert last_good_backup(folder) is None
    good = back_up(folder, backup_path(folder, NOW_S), NOW_S)
    backup_path(folder, NOW_S + 60).write_bytes(b"cut off")
    assert last_good_backup(folder) == good


@pytest.mark.parametrize("moves", range(6))
def test_a_restore_that_was_cut_off_is_finished_by_the_next_start(
    tmp_path: Path, moves: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "line"
    _work(folder, 10)
    back_up(folder, tmp_path / "a.zip")
    _work(folder, 3)
    left = [moves]
    rename = Path.rename

    def cut_off(self: Path, target: Path) -> Path:
        if READY in str(self.parent) or self.parent == folder:
            if left[0] == 0:
                raise KeyboardInterrupt
            left[0] -= 1
        return rename(self, target)

    monkeypatch.setattr(restoring, "finish_restore", lambda _folder: None)
    restore(folder, tmp_path / "a.zip", NOW_S)
    monkeypatch.setattr(Path, "rename", cut_off)
    with pytest.raises(KeyboardInterrupt):
        finish_restore(folder)
    monkeypatch.undo()
    assert _count(folder) == 10
    assert not (folder / READY).exists()
    assert (folder / "station.json").read_text() == '{"of": 10}'
    (aside,) = folder.glob("aside-*")
    assert _count(aside) == 13


def test_pictures_of_other_records_are_not_shown_with_new_fruit(tmp_path: Path) -> None:
    _work(tmp_path, 3)
    for path in tmp_path.glob("records.sqlite*"):
        path.unlink()
    with open_store(tmp_path) as store:
        lot = store.lots.start(LotPlan("new"))
        counted = store.commit(lot.key, made_fruit(1), ())
        assert store.fruit.story(counted.key).crops == ()
    assert (tmp_path / "pictures.damaged-1.sqlite").exists()


def test_a_copy_without_its_shared_memory_is_opened_as_after_a_power_cut(tmp_path: Path) -> None:
    folder, copy = tmp_path / "line", tmp_path / "copy"
    _work(folder, 3)
    copy.mkdir()
    with open_store(folder) as store:
        lot = store.lots.open_lot()
        assert lot is not None
        store.commit(lot.key, made_fruit(1), made_crops(1))
        for path in folder.glob("*.sqlite*"):
            if not path.name.endswith("-shm"):
                shutil.copy(path, copy)
    assert _count(copy) == 4


def test_a_backup_is_laid_ready_while_the_store_is_open_and_put_in_place_at_the_next_start(tmp_path: Path) -> None:
    folder = tmp_path / "line"
    _work(folder, 10)
    back_up(folder, tmp_path / "a.zip")
    _work(folder, 3)
    with open_store(folder) as store:
        prepare_restore(folder, tmp_path / "a.zip", NOW_S)
        assert is_prepared(folder)
        (line,) = store.lots.find(LotQuery()).lots
        assert line.fruit == 13, "nothing is touched while it is open"
        store.commit(line.lot.key, made_fruit(99), ())
    assert _count(folder) == 10
    assert not is_prepared(folder)
    (aside,) = folder.glob("aside-*")
    assert _count(aside) == 14


def test_a_restore_that_was_laid_ready_can_be_called_off(tmp_path: Path) -> None:
    folder = tmp_path / "line"
    _work(folder, 10)
    back_up(folder, tmp_path / "a.zip")
    _work(folder, 3)
    before = _contents(folder)
    for _ in range(2):
        prepare_restore(folder, tmp_path / "a.zip", NOW_S)  # one that was ready before is replaced
    forget_restore(folder)
    forget_restore(folder)
    assert not is_prepared(folder)
    assert _contents(folder) == before
    assert _count(folder) == 13


def test_what_was_not_seen_goes_into_a_backup_and_comes_back(tmp_path: Path) -> None:
    folder = tmp_path / "line"
    _work(folder)
    blind = Blind(("kinect_2",), ((0.41, 0.65),), 0.65, 0.3)
    with open_store(folder) as store:
        lot = store.lots.open_lot()
        assert lot is not None
        store.spells.note(lot.key, blind)
        back_up(folder, tmp_path / "b.zip", NOW_S)
        store.spells.note(lot.key, None)
    restore(folder, tmp_path / "b.zip", NOW_S)
    with open_store(folder) as store:
        restored = store.lots.open_lot()
        assert restored is not None
        assert [(one.blind, one.to_s) for one in restored.spells] == [(blind, None)]
