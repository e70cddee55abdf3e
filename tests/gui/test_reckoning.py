"""What a lot amounts to, while its line counts and a person corrects its fruit."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from fruitgui.gui.queries import Queries
from fruitgui.gui.reckoning import Reckoning
from fruitgui.records.lot import LotPlan
from fruitgui.records.store import Store, open_store
from fruitgui.station.noted import NotedSink
from fruitgui.station.sink import CountedFruit
from tests.unit.station.fruit_made import made_fruit


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with open_store(tmp_path) as made:
        yield made


@pytest.fixture
def queries(qtbot: QtBot) -> Iterator[Queries]:
    made = Queries()
    yield made
    made.finish()
    qtbot.waitUntil(lambda: not made.busy)


def _sums(reckoning: Reckoning) -> dict[str, int]:
    return {kind: one.count for kind, one in reckoning.tally.sums.items()}


def test_what_a_person_corrects_while_the_line_runs_is_in_the_counts(
    qtbot: QtBot, store: Store, queries: Queries
) -> None:
    sink, lot = NotedSink(store), store.lots.start(LotPlan("1184")).key
    reckoning, told = Reckoning(store.lots, queries, (), sink), []
    kept = [sink.commit(lot, made_fruit(number, "lemon"), ()).key for number in range(4)]
    reckoning.count_kept()
    store.corrections.name(kept[:1], "pear")
    store.corrections.leave_out(kept[1:2])
    store.corrections.add(lot, "lime")
    sink.commit(lot, made_fruit(4, "lemon"), ())  # the records have it before the window heard of it
    reckoning.read_again(lot, lambda: told.append(True))
    sink.commit(lot, made_fruit(5, "lemon"), ())
    reckoning.count_kept()  # the window hears of both before the records are read
    qtbot.waitUntil(lambda: bool(told))
    sink.commit(lot, made_fruit(6, "lemon"), ())
    reckoning.count_kept()
    assert _sums(reckoning) == {"lemon": 5, "pear": 1, "lime": 1}
    assert _sums(reckoning) == {one.kind: one.fruit for one in store.lots.totals(lot)}


def test_a_fruit_that_was_read_and_is_heard_of_later_counts_once(qtbot: QtBot, store: Store, queries: Queries) -> None:
    sink, lot = NotedSink(store), store.lots.start(LotPlan("1184")).key
    reckoning, told = Reckoning(store.lots, queries, (), sink), []
    sink.commit(lot, made_fruit(0, "lemon"), ())
    reckoning.read_again(lot, lambda: told.append(True))
    qtbot.waitUntil(lambda: bool(told))
    reckoning.count_kept()
    assert _sums(reckoning) == {"lemon": 1}


def test_no_fruit_is_held_once_it_is_counted(qtbot: QtBot, store: Store, queries: Queries) -> None:
    sink, lot = NotedSink(store), store.lots.start(LotPlan("1184")).key
    reckoning, told = Reckoning(store.lots, queries, (), sink), []
    for number in range(6):
        sink.commit(lot, made_fruit(number, "lemon"), ())
        reckoning.count_kept()
        if number == 2:
            reckoning.read_again(lot, lambda: told.append(True))
        if number == 4:
            qtbot.waitUntil(lambda: bool(told))
    assert _sums(reckoning) == {"lemon": 6}
    gc.collect()
    assert not [one for one in gc.get_objects() if isinstance(one, CountedFruit)]
