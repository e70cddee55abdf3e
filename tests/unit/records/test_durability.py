"""What was shown as counted is there, whatever happened."""

from __future__ import annotations

import gc
import os
import sqlite3
import subprocess
import sys
import threading
import tracemalloc
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from fruitgui.errors import WorldError
from fruitgui.records import database
from fruitgui.records.condition import glance
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.lot import Lot, LotPlan
from fruitgui.records.store import Store, open_store
from fruitgui.station.waiting import BufferedSink
from tests.unit.station.fruit_made import made_crops, made_fruit


def _numbers(folder: Path) -> list[int]:
    with sqlite3.connect(folder / "records.sqlite") as connection:
        found = [number for (number,) in connection.execute("SELECT number FROM fruit ORDER BY number")]
    connection.close()
    return found


def test_a_line_killed_at_any_moment_loses_no_fruit_that_it_showed(tmp_path: Path) -> None:
    chance = np.random.default_rng(7)
    shown = 0
    for lines in chance.integers(1, 60, size=5):
        with subprocess.Popen(
            [sys.executable, "-m", "tests.unit.records.counter", str(tmp_path)], stdout=subprocess.PIPE, text=True
        ) as line:
            assert line.stdout is not None
            printed = [int(line.stdout.readline()) for _ in range(lines)]
            line.kill()
            printed += [int(text) for text in line.stdout.read().split()]
        assert printed[0] > shown, "numbering goes on after a crash"
        shown = printed[-1]
        assert _numbers(tmp_path)[:shown] == list(range(1, shown + 1))
    with open_store(tmp_path) as store:
        lot = store.lots.open_lot()
        assert lot is not None
        assert lot.name == "killed"
        counted = store.commit(lot.key, made_fruit(1), ())
        assert counted.number == len(_numbers(tmp_path))


def test_each_commit_waits_for_the_disk(store: Store) -> None:
    with store._records.connected() as connection:
        assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == "wal"
        assert connection.exec_driver_sql("PRAGMA synchronous").scalar() == 2


def test_a_full_database_is_said_and_what_was_counted_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with open_store(tmp_path) as store:
        lot = store.lots.start(LotPlan("full"))
    monkeypatch.setattr(database, "_PRAGMAS", (*database._PRAGMAS, "PRAGMA max_page_count=60"))
    shown: list[int] = []
    with open_store(tmp_path) as store, pytest.raises(WorldError) as caught:
        shown.extend(store.commit(lot.key, made_fruit(number), ()).number for number in range(10_000))
    assert caught.value.code == "disk_full"
    assert shown
    assert _numbers(tmp_path) == shown
    monkeypatch.undo()
    with open_store(tmp_path) as store:
        assert store.commit(lot.key, made_fruit(0), ()).number == shown[-1] + 1


@pytest.fixture
def tiny_disk(tmp_path: Path) -> Path:
    folder = tmp_path / "tiny"
    folder.mkdir()
    if (
        os.geteuid() != 0
        or subprocess.run(
            ["mount", "-t", "tmpfs", "-o", "size=16m", "tmpfs", str(folder)], capture_output=True, check=False
        ).returncode
    ):
        pytest.skip("only root can mount a tiny disk")
    return folder


def test_a_disk_that_may_only_be_read_is_told(tiny_disk: Path, request: pytest.FixtureRequest) -> None:
    request.addfinalizer(lambda: subprocess.run(["umount", "-l", str(tiny_disk)], check=True))
    open_store(tiny_disk).close()
    subprocess.run(["mount", "-o", "remount,ro", str(tiny_disk)], check=True)
    assert [one.state for one in glance(tiny_disk).wrong] == ["unreadable", "unreadable"]
    with pytest.raises(WorldError) as caught:
        open_store(tiny_disk)
    assert caught.value.code == "store_read_only"


def _fill(path: Path) -> None:
    with path.open("wb", buffering=0) as filler, pytest.raises(OSError, match="No space"):
        filler.writelines(bytes(4096) for _ in range(10_000))


def test_counting_goes_on_while_the_disk_is_full_and_catches_up(
    tiny_disk: Path, request: pytest.FixtureRequest
) -> None:
    request.addfinalizer(lambda: subprocess.run(["umount", "-l", str(tiny_disk)], check=True))
    with open_store(tiny_disk) as store:
        lot = store.lots.start(LotPlan("full"))
        sink = BufferedSink(store, clock_s=iter(range(0, 10**9, 10)).__next__)
        _fill(tiny_disk / "filler")
        shown = [one.number for number in range(300) for one in sink.take(lot.key, made_fruit(number), ())]
        assert sink.state.waiting == 300 - len(shown) > 0
        assert sink.state.problem is not None
        assert sink.state.problem.code == "disk_full"
        (tiny_disk / "filler").unlink()
        shown += [one.number for _ in range(3) for one in sink.retry()]
        assert sink.state.problem is None
        assert shown == list(range(1, 301))


def test_crops_that_find_no_room_do_not_stop_the_count(store: Store, lot: Lot) -> None:
    with store._pictures.connected() as connection:
        connection.exec_driver_sql("DROP TABLE crop")
    counted = store.commit(lot.key, made_fruit(1), made_crops(1))
    assert counted.number == 1
    assert counted.crops_problem is not None
    assert store.commit(lot.key, made_fruit(2), ()).crops_problem is None


def test_another_program_that_holds_the_file_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(database, "BUSY_S", 0.05)
    with open_store(tmp_path) as store:
        lot = store.lots.start(LotPlan("held"))
        other = sqlite3.connect(tmp_path / "records.sqlite", isolation_level=None)
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(WorldError) as caught:
            store.commit(lot.key, made_fruit(1), ())
        assert caught.value.code == "store_locked"
        assert store.lots.open_lot() == lot, "reading goes on"
        other.execute("ROLLBACK")
        other.close()
        assert store.commit(lot.key, made_fruit(1), ()).number == 1


def test_a_damaged_file_is_told_and_left_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "records.sqlite").write_bytes(b"no database at all" * 1000)
    with pytest.raises(WorldError) as caught:
        open_store(tmp_path)
    assert caught.value.code == "store_damaged"
    assert (tmp_path / "records.sqlite").read_bytes() == b"no database at all" * 1000


def test_records_that_were_emptied_are_told_and_not_begun_anew_unasked(tmp_path: Path) -> None:
    open_store(tmp_path).close()
    (tmp_path / "records.sqlite").write_bytes(b"")
    with pytest.raises(WorldError) as caught:
        open_store(tmp_path)
    assert caught.value.code == "store_damaged"
    assert sorted(path.name for path in tmp_path.glob("*.sqlite")) == ["pictures.sqlite", "records.sqlite"]
    (tmp_path / "pictures.sqlite").unlink()  # nothing was ever in them: a start that was cut off
    open_store(tmp_path).close()


def test_what_is_removed_while_it_is_open_takes_no_fruit_until_it_is_back(tmp_path: Path) -> None:
    line, trash = tmp_path / "line", tmp_path / "trash"
    line.mkdir()
    with open_store(line) as store:
        lot = store.lots.start(LotPlan("1184"))
        store.commit(lot.key, made_fruit(1), ())
        sink = BufferedSink(store)
        line.rename(trash)
        assert sink.take(lot.key, made_fruit(2), ()) == ()
        assert sink.state.problem is not None
        assert sink.state.problem.code == "store_read_only"
        line.mkdir()
        (line / "records.sqlite").write_bytes((trash / "records.sqlite").read_bytes())
        assert sink.retry() == (), "another file lies in its place"
        (line / "records.sqlite").unlink()
        line.rmdir()
        trash.rename(line)
        assert [one.number for one in sink.retry()] == [2]
    with open_store(line) as again:
        assert sum(one.fruit for one in again.lots.totals(lot.key)) == 2


def test_a_missing_folder_is_told(tmp_path: Path) -> None:
    with pytest.raises(WorldError) as caught:
        open_store(tmp_path / "nowhere")
    assert caught.value.code == "store_read_only"


def test_many_threads_count_into_one_lot_without_gaps(store: Store, lot: Lot) -> None:
    numbers: list[int] = []

    def count(seed: int) -> None:
        numbers.extend(store.commit(lot.key, made_fruit(seed * 100 + at), made_crops(at)).number for at in range(15))

    threads = [threading.Thread(target=count, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(numbers) == list(range(1, 61))
    assert sum(total.fruit for total in store.lots.totals(lot.key)) == 60


def test_memory_stays_flat_however_many_are_counted(store: Store, lot: Lot) -> None:
    fruit, crops = made_fruit(1), made_crops(1)

    def count(times: int) -> int:
        for _ in range(times):
            store.counting.commit_batch(lot.key, [(fruit, crops)] * 10)
            store.fruit.find(FruitQuery(lot.key, count=20))
        gc.collect()
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        held = [count(20), count(40), count(40), count(40)]
    finally:
        tracemalloc.stop()
    # What something else in the process takes once is in one round; fruit that are kept would be in each.
    assert min(late - early for early, late in pairwise(held)) < 50_000, "400 fruit weigh some 2 MB"
