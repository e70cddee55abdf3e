from __future__ import annotations

from pathlib import Path

import pytest

from fruitgui.errors import CancelledByUserError, WorldError
from fruitgui.records.condition import check_whole, glance, set_aside
from fruitgui.records.lot import LotPlan
from fruitgui.records.migrating import PICTURES, RECORDS
from fruitgui.records.store import open_store
from tests.unit.station.fruit_made import made_crops, made_fruit


def _work(folder: Path) -> None:
    with open_store(folder) as store:
        lot = store.lots.start(LotPlan("1184"))
        for number in range(30):
            store.commit(lot.key, made_fruit(number), made_crops(number))


def test_an_empty_folder_and_a_sound_store_are_usable(tmp_path: Path) -> None:
    assert [one.state for one in (glance(tmp_path).records, glance(tmp_path).pictures)] == ["missing", "missing"]
    assert glance(tmp_path).usable
    _work(tmp_path)
    condition = glance(tmp_path)
    assert (condition.records.state, condition.pictures.state, condition.wrong) == ("ok", "ok", ())


@pytest.mark.parametrize("file", [RECORDS.file, PICTURES.file])
@pytest.mark.parametrize("place", ["beginning", "middle", "cut off", "empty pages"])
def test_a_damaged_file_is_named_and_kept_and_the_line_starts_anew(tmp_path: Path, file: str, place: str) -> None:
    _work(tmp_path)
    path = tmp_path / file
    data = path.read_bytes()
    half = len(data) // 8192 * 4096
    path.write_bytes(
        {
            "beginning": b"\0" * 100 + data[100:],
            "middle": data[:half] + b"\xa5" * 8192 + data[half + 8192 :],
            "cut off": data[:half],
            "empty pages": data[:4096] + bytes(len(data) - 4096),
        }[place]
    )
    damaged = path.read_bytes()
    condition = glance(tmp_path)
    assert not condition.usable
    (wrong,) = condition.wrong
    assert (wrong.path, wrong.state) == (path, "damaged")
    assert wrong.error is not None
    assert path.name in wrong.error.what
    assert path.read_bytes() == damaged
    aside = set_aside(path)
    assert aside is not None
    assert aside.read_bytes() == damaged
    assert glance(tmp_path).usable
    _work_again(tmp_path)


def _work_again(folder: Path) -> None:
    with open_store(folder) as store:
        lot = store.lots.open_lot() or store.lots.start(LotPlan("1185"))
        store.commit(lot.key, made_fruit(1), made_crops(1))


def test_damage_that_shows_only_while_working_is_told(tmp_path: Path) -> None:
    _work(tmp_path)
    with open_store(tmp_path) as store:
        with (tmp_path / RECORDS.file).open("r+b") as file:
            file.seek(4096)
            file.write(b"\xa5" * 400_000)
        with pytest.raises(WorldError) as caught:
            list(store.fruit.walk(1))
        assert caught.value.code == "store_damaged"


def test_going_through_all_of_a_database_can_be_stopped(tmp_path: Path) -> None:
    _work(tmp_path)
    with pytest.raises(CancelledByUserError):
        check_whole(tmp_path / RECORDS.file, lambda: True)
