from __future__ import annotations

from collections.abc import Sequence

from hypothesis import given
from hypothesis import strategies as st

from fruitgui.errors import InputError, WorldError
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import CountedFruit, Crop
from fruitgui.station.waiting import MOST_AT_ONCE, RETRY_S, BufferedSink
from tests.unit.station.fruit_made import made_crops, made_fruit

FULL = WorldError("disk_full", "The disk is full.", "Make room.")


class Shelf:
    """A sink in memory that can be full, or have no room for crops."""

    def __init__(self) -> None:
        self.kept: list[CountedFruit] = []
        self.crops = 0
        self.full = False
        self.no_room_for_crops = False
        self.asked = 0

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:
        self.asked += 1
        if lot == 404:
            raise InputError("no_such_lot", "There is no such lot.", "Start one.")
        if self.full:
            raise FULL
        self.crops += len(crops)
        number = len(self.kept) + 1
        self.kept.append(CountedFruit(number, lot, number, fruit, FULL if self.no_room_for_crops else None))
        return self.kept[-1]


class Clock:
    def __init__(self) -> None:
        self.now_s = 0.0

    def __call__(self) -> float:
        return self.now_s


def test_a_fruit_that_can_be_kept_comes_back_counted_at_once() -> None:
    sink = BufferedSink(Shelf())
    (counted,) = sink.take(1, made_fruit(1), made_crops(1))
    assert counted.fruit.fruit == 1
    assert sink.state.waiting == 0
    assert sink.state.problem is None


def test_fruit_wait_in_order_while_the_disk_is_full_and_none_is_shown_before_it_is_kept() -> None:
    shelf, clock = Shelf(), Clock()
    sink = BufferedSink(shelf, clock_s=clock)
    shelf.full = True
    assert [sink.take(1, made_fruit(number), ()) for number in range(1, 6)] == [()] * 5
    assert sink.state.waiting == 5
    assert sink.state.problem is FULL
    assert shelf.asked == 1, "a full disk is not asked at every fruit"
    shelf.full, clock.now_s = False, RETRY_S
    counted = sink.take(1, made_fruit(6), ())
    assert [one.fruit.fruit for one in counted] == [1, 2, 3, 4, 5, 6]
    assert sink.state.waiting == 0
    assert sink.state.problem is None


def test_what_finds_no_room_in_memory_is_counted_as_lost_and_crops_go_first() -> None:
    shelf = Shelf()
    shelf.full = True
    sink = BufferedSink(shelf, most=5, most_with_crops=2)
    for number in range(8):
        sink.take(1, made_fruit(number), made_crops(number))
    assert (sink.state.waiting, sink.state.without_crops, sink.state.lost) == (5, 3, 3)
    shelf.full = False
    assert [one.fruit.fruit for one in sink.retry()] == [0, 1, 2, 3, 4]
    assert shelf.crops == 2 * len(made_crops(0))


def test_crops_without_room_are_said_and_do_not_stop_the_count() -> None:
    shelf = Shelf()
    shelf.no_room_for_crops = True
    sink = BufferedSink(shelf)
    assert len(sink.take(1, made_fruit(1), made_crops(1))) == 1
    assert sink.state.without_crops == 1
    assert sink.state.problem is FULL


def test_a_fruit_of_no_lot_does_not_hold_up_those_behind_it() -> None:
    sink = BufferedSink(Shelf())
    assert sink.take(404, made_fruit(1), ()) == ()
    assert isinstance(sink.state.problem, InputError)
    assert sink.state.lost == 1
    assert len(sink.take(1, made_fruit(2), ())) == 1


@given(st.lists(st.booleans(), min_size=1, max_size=3 * MOST_AT_ONCE))
def test_however_the_disk_comes_and_goes_each_fruit_is_kept_once_and_in_order(full: list[bool]) -> None:
    shelf = Shelf()
    sink = BufferedSink(shelf, clock_s=iter(range(0, 10**9, 10)).__next__)
    fruit, shown = made_fruit(1), 0
    for shelf.full in full:
        shown += len(sink.take(1, fruit, ()))
        assert shown == len(shelf.kept)
        assert shown + sink.state.waiting <= len(full)
    shelf.full = False
    while sink.state.waiting:
        shown += len(sink.retry())
    assert shown == len(full)
    assert [one.number for one in shelf.kept] == list(range(1, len(full) + 1))
