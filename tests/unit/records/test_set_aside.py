"""Unknown fruit of a lot wait to be named; they are counted whether they can be kept for it or not."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.classification.evidence import UNKNOWN, Evidence
from fruitgui.errors import WorldError
from fruitgui.records.lot import Lot
from fruitgui.records.set_aside import SetAside
from fruitgui.records.store import Store
from fruitgui.station.live import Finished
from fruitgui.station.noted import NotedSink
from tests.unit.station.fruit_made import made_fruit


def _finished(number: int, kind: str) -> Finished:
    evidence = Evidence(np.zeros((3, 4), np.float32), np.zeros(2))
    return Finished(made_fruit(number, kind), (), evidence, ("kinect_1",))


def test_unknown_fruit_wait_to_be_named_and_others_do_not(store: Store, lot: Lot) -> None:
    sink, aside = NotedSink(store), SetAside(store.teaching, "Unknown, today")
    sink.then = aside.keep
    for number, kind in enumerate([UNKNOWN, "lemon", UNKNOWN], start=1):
        finished = _finished(number, kind)
        aside.take(finished)
        sink.commit(lot.key, finished.fruit, ())
    assert aside.fruit == store.teaching.waiting() == 2
    assert [one.number for one in sink.drain()] == [1, 2, 3]


def test_a_fruit_that_cannot_be_set_aside_is_counted_all_the_same(
    store: Store, lot: Lot, monkeypatch: pytest.MonkeyPatch
) -> None:
    sink, aside = NotedSink(store), SetAside(store.teaching, "Unknown, today")
    sink.then = aside.keep

    def full(*_: object) -> None:
        raise WorldError("disk_full", "The disk is full.", "Make room.")

    monkeypatch.setattr(store.teaching, "add", full)
    finished = _finished(1, UNKNOWN)
    aside.take(finished)
    assert sink.commit(lot.key, finished.fruit, ()).number == 1
    assert (aside.fruit, aside.lost) == (0, 1)
