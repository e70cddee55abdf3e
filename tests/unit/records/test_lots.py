from __future__ import annotations

from pathlib import Path

import pytest

from fruitgui.errors import InputError
from fruitgui.records.lot import NOT_RUNNING, Lot, LotPlan, Pause
from fruitgui.records.lots import Lots
from fruitgui.records.migrating import RECORDS, bring_up_to_date
from fruitgui.records.steady_clock import SteadyClock
from fruitgui.records.store import Store, open_store
from tests.unit.records.conftest import Clock
from tests.unit.station.fruit_made import made_crops, made_fruit


def test_a_lot_keeps_what_it_was_started_with(store: Store, clock: Clock) -> None:
    plan = LotPlan(
        " 1184 ", "Fundo El Peñón", "export", "wet", "kinect_1", '{"schema": 1}', "models/model-0001.fruit",
        {"small": [0, 80]}, ("left", "right"),
    )  # fmt: skip
    lot = store.lots.start(plan)
    assert store.lots.get(lot.key) == lot
    assert (lot.name, lot.grower, lot.recipe, lot.note) == ("1184", "Fundo El Peñón", "export", "wet")
    assert (lot.size_bands, lot.outlets) == ({"small": [0, 80]}, ("left", "right"))
    assert lot.started_s == clock.now_s
    assert store.lots.station_text(lot.key) == '{"schema": 1}'
    store.lots.end(lot.key)
    again = store.lots.start(LotPlan("1185", station_text='{"schema": 1}'))
    assert again.station_sha256 == lot.station_sha256


def test_only_one_lot_runs_at_a_time(store: Store, lot: Lot) -> None:
    with pytest.raises(InputError) as caught:
        store.lots.start(LotPlan("1185"))
    assert caught.value.code == "lot_open"
    assert store.lots.open_lot() == lot
    store.lots.end(lot.key)
    assert store.lots.open_lot() is None
    with pytest.raises(InputError):
        store.lots.pause(lot.key)


def test_pauses_are_left_out_of_the_time_that_it_ran(store: Store, lot: Lot, clock: Clock) -> None:
    clock.now_s += 100
    assert store.lots.pause(lot.key).paused
    assert store.lots.pause(lot.key).pauses == (Pause(clock.now_s, None, "asked"),)
    clock.now_s += 50
    assert not store.lots.resume(lot.key).paused
    assert store.lots.resume(lot.key).ran_s(clock.now_s + 20) == 120
    clock.now_s += 20
    store.lots.pause(lot.key)
    clock.now_s += 30
    ended = store.lots.end(lot.key)
    assert not ended.paused
    assert ended.ran_s(clock.now_s + 1000) == 120


def test_a_clock_set_back_makes_no_negative_times(store: Store, lot: Lot, clock: Clock) -> None:
    store.lots.pause(lot.key)
    clock.now_s -= 3600
    assert store.lots.resume(lot.key).pauses[0].to_s == lot.started_s
    assert store.lots.end(lot.key).ran_s(clock.now_s) == 0


def test_a_lot_found_open_goes_on_without_the_time_in_between(store: Store, lot: Lot, clock: Clock) -> None:
    clock.now_s += 10
    store.commit(lot.key, made_fruit(1), ())
    counted_s = clock.now_s
    clock.now_s += 3600
    taken_up = store.lots.take_up(lot.key)
    assert taken_up.pauses == (Pause(counted_s, clock.now_s, NOT_RUNNING),)
    assert store.commit(lot.key, made_fruit(1), ()).number == 2


def test_a_lot_found_open_ends_when_its_last_fruit_passed(store: Store, lot: Lot, clock: Clock) -> None:
    clock.now_s += 10
    store.commit(lot.key, made_fruit(1), ())
    counted_s = clock.now_s
    clock.now_s += 3600
    ended = store.lots.end_left_open(lot.key)
    assert ended.pauses == (Pause(counted_s, clock.now_s, NOT_RUNNING),)
    assert (ended.ended_s, ended.ran_s(clock.now_s)) == (clock.now_s, 10)
    with pytest.raises(InputError):
        store.lots.end_left_open(lot.key)


def test_fruit_that_waited_are_kept_after_the_end(store: Store, lot: Lot) -> None:
    store.lots.end(lot.key)
    assert store.commit(lot.key, made_fruit(1), ()).number == 1


def test_a_lot_that_is_none_takes_no_fruit(store: Store) -> None:
    with pytest.raises(InputError) as caught:
        store.commit(99, made_fruit(1), ())
    assert caught.value.code == "no_such_lot"


def test_crops_come_back_as_they_were_and_age_out_without_the_fruit(store: Store, lot: Lot, clock: Clock) -> None:
    old = store.commit(lot.key, made_fruit(1), made_crops(1))
    clock.now_s += 5 * 86_400
    new = store.commit(lot.key, made_fruit(2), made_crops(2))
    kept = store.crops.of("fruit", old.key)
    assert [(one.number, one.sensor, one.data) for one in kept] == [
        (one.number, one.sensor, one.data) for one in made_crops(1)
    ]
    assert store.crops.first("fruit", [old.key, new.key])[new.key].data == made_crops(2)[0].data
    assert store.crops.age_out(days=3) == 2
    assert store.crops.of("fruit", old.key) == ()
    assert len(store.crops.of("fruit", new.key)) == 2


def test_crops_that_aged_out_give_their_room_back(store: Store, lot: Lot, clock: Clock) -> None:
    for number in range(200):
        store.commit(lot.key, made_fruit(number), made_crops(number))
    with store._pictures.connected() as connection:
        before = connection.exec_driver_sql("PRAGMA page_count").scalar_one()
    clock.now_s += 10 * 86_400
    assert store.crops.age_out(days=1) == 400
    with store._pictures.connected() as connection:
        after = connection.exec_driver_sql("PRAGMA page_count").scalar_one()
    assert after < before / 10


def test_a_computer_whose_clock_says_another_year_lets_no_picture_go(store: Store, lot: Lot, clock: Clock) -> None:
    store.commit(lot.key, made_fruit(1), made_crops(1))
    (fruit,) = store.fruit.walk(lot.key)
    clock.now_s += 20 * 365 * 86_400
    assert store.crops.age_out(90) == 0
    assert store.crops.of("fruit", fruit.key)


class Stepped:
    """A computer's clock that is set, beside seconds that go on evenly."""

    def __init__(self) -> None:
        self.even_s, self.set_by_s = 0.0, 1.8e9

    def day(self) -> float:
        return self.even_s + self.set_by_s

    def even(self) -> float:
        return self.even_s


@pytest.mark.parametrize("leap_s", [-7200.0, 7200.0, -1e9])
def test_a_clock_that_is_set_while_a_lot_runs_changes_none_of_its_times(tmp_path: Path, leap_s: float) -> None:
    computer = Stepped()
    clock = SteadyClock(computer.day, computer.even)
    database = bring_up_to_date(tmp_path / RECORDS.file, RECORDS)
    lots = Lots(database, clock)
    lot = lots.start(LotPlan("1184"))
    computer.even_s += 600
    lots.pause(lot.key)
    computer.set_by_s += leap_s
    computer.even_s += 60
    resumed = lots.resume(lot.key)
    computer.even_s += 600
    assert resumed.ran_s(clock()) == 1200
    assert lots.end(lot.key).ran_s(clock()) == 1200
    assert lots.start(LotPlan("1185")).started_s == computer.day(), "between lots it is taken over"
    database.close()


def test_a_lot_that_is_taken_up_after_the_clock_was_set_back_loses_no_time(tmp_path: Path) -> None:
    computer = Stepped()
    with open_store(tmp_path, computer.day) as store:
        lot = store.lots.start(LotPlan("1184"))
        computer.even_s += 3600
        store.commit(lot.key, made_fruit(1), ())
    computer.set_by_s -= 7200
    with open_store(tmp_path, computer.day) as store:
        store.lots.take_up(lot.key)
        computer.even_s += 1800
        store.commit(lot.key, made_fruit(2), ())
        first, second = store.fruit.walk(lot.key)
        assert second.counted_s == first.counted_s + 1800
        assert store.lots.end(lot.key).ran_s(store.now_s()) == 5400
