"""A line and its lot begin together, or neither does."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from pathlib import Path

import pytest

from fruitgui.errors import CancelledByUserError, WorldError
from fruitgui.gui.beginning import LinePlan, begun
from fruitgui.progress import never_cancelled
from fruitgui.records.lot import Lot, LotPlan
from fruitgui.records.store import Store, open_store
from fruitgui.sensors.feed import Feed
from fruitgui.station.live.apart import process
from tests.unit.station.test_live_line import Steady, station

pytestmark = pytest.mark.usefixtures("no_leaked_threads")


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Store]:
    with open_store(tmp_path) as opened:
        yield opened


@pytest.fixture
def feed() -> Iterator[Feed]:
    made = Feed([Steady("left")])
    made.start()
    yield made
    assert made.stop() == ()


PLAN = LinePlan(station("left"), lambda: None)


def test_where_the_store_takes_no_lot_no_line_runs_on(store: Store, feed: Feed) -> None:
    def full() -> Lot:
        raise WorldError("disk_full", "The disk is full.", "Make room.")

    with pytest.raises(WorldError, match="The disk is full"):
        begun(feed, PLAN, store, full, "a source", never_cancelled)
    assert not multiprocessing.active_children()


def test_what_was_cancelled_begins_neither(store: Store, feed: Feed) -> None:
    with pytest.raises(CancelledByUserError):
        begun(feed, PLAN, store, lambda: store.lots.start(LotPlan("1184")), "a source", lambda: True)
    assert store.lots.open_lot() is None
    assert not multiprocessing.active_children()


def test_where_no_process_is_to_be_had_no_lot_is_begun(
    store: Store, feed: Feed, monkeypatch: pytest.MonkeyPatch
) -> None:
    def none_left(_line: object, _start: object) -> None:
        raise BlockingIOError("no more processes")

    monkeypatch.setattr(process.LineProcess, "begin", none_left)
    with pytest.raises(WorldError) as told:
        begun(feed, PLAN, store, lambda: store.lots.start(LotPlan("1184")), "a source", never_cancelled)
    assert told.value.code == "line_not_started"
    assert store.lots.open_lot() is None


def test_both_begin_and_what_comes_is_counted_into_the_lot(store: Store, feed: Feed) -> None:
    made = begun(feed, PLAN, store, lambda: store.lots.start(LotPlan("1184")), "a source", never_cancelled)
    try:
        assert made.lot.name == "1184"
        assert made.line.state.lot == made.lot.key
    finally:
        assert made.line.stop()
