"""What the running line sets aside."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.classification.evidence import UNKNOWN, Evidence
from fruitgui.errors import WorldError
from fruitgui.gui.running import NotedSink, SetAside
from fruitgui.gui.session import Session
from fruitgui.records.lot import LotPlan
from fruitgui.station.live import Finished
from tests.unit.station.fruit_made import made_fruit


def _finished(number: int, kind: str) -> Finished:
    evidence = Evidence(np.zeros((3, 4), np.float32), np.zeros(2))
    return Finished(made_fruit(number, kind), (), evidence, ("kinect_1",))


def test_unknown_fruit_wait_to_be_named_and_others_do_not(session: Session) -> None:
    lot = session.store.lots.start(LotPlan("1"))
    sink = NotedSink(session.store)
    sink.aside = SetAside(session.store, "Unknown, today")
    for number, kind in enumerate([UNKNOWN, "lemon", UNKNOWN], start=1):
        finished = _finished(number, kind)
        sink.aside.take(finished)
        sink.commit(lot.key, finished.fruit, ())
    assert sink.aside.fruit == session.store.teaching.waiting() == 2
    assert [one.number for one in sink.drain()] == [1, 2, 3]
    assert sink.drain() == []


def test_a_fruit_that_cannot_be_set_aside_is_counted_all_the_same(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    lot = session.store.lots.start(LotPlan("1"))
    sink = NotedSink(session.store)
    sink.aside = SetAside(session.store, "Unknown, today")

    def full(*_: object) -> None:
        raise WorldError("disk_full", "The disk is full.", "Make room.")

    monkeypatch.setattr(session.store.teaching, "add", full)
    finished = _finished(1, UNKNOWN)
    sink.aside.take(finished)
    assert sink.commit(lot.key, finished.fruit, ()).number == 1
    assert (sink.aside.fruit, sink.aside.lost) == (0, 1)
