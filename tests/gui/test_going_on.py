"""That a lot went on is kept once, before anything else is done to it."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from fruitgui.gui.going_on import GoingOn
from fruitgui.gui.queries import Queries
from fruitgui.records.lot import Lot, LotPlan
from fruitgui.records.store import open_store

END_S = 20.0
A_WHILE_S = 0.3
"""Long enough for a thread to come where it must not."""


@pytest.mark.usefixtures("qapp")
def test_what_two_keep_at_once_does_not_end_the_next_pause(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with open_store(tmp_path) as store:
        lot = store.lots.start(LotPlan("1184"))
        store.lots.pause(lot.key)
        owed, resume = GoingOn(store.lots, Queries()), store.lots.resume
        owed.owe(lot.key, store.now_s())
        came = [threading.Event(), threading.Event()]
        goes_on = [threading.Event(), threading.Event()]
        calls = iter(zip(came, goes_on, strict=True))

        def slowly(key: int, since_s: float | None = None) -> Lot:
            here, on = next(calls)
            here.set()
            assert on.wait(END_S)
            return resume(key, since_s)

        monkeypatch.setattr(store.lots, "resume", slowly)
        threads = [threading.Thread(target=owed.keep) for _ in came]
        threads[0].start()
        assert came[0].wait(END_S)
        threads[1].start()
        came[1].wait(A_WHILE_S)
        goes_on[0].set()
        threads[0].join()
        store.lots.pause(lot.key)
        goes_on[1].set()
        threads[1].join()
        assert store.lots.get(lot.key).paused
