"""The guard of the window's thread sees what it is there to see."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest

from fruitgui.files import write_json
from fruitgui.gui.session import Session
from fruitgui.gui.tasks import Task
from fruitgui.progress import Cancelled, Progress
from fruitgui.records.lot_search import LotQuery
from fruitgui.sensors.player import AtSpeed
from tests.window.guard import Guard, guard

__all__ = ["guard"]


def _nothing(progress: Progress, cancelled: Cancelled) -> None:
    """Do nothing."""


def test_the_store_the_disk_and_waits_are_seen(guard: Guard, session: Session, tmp_path: Path) -> None:
    pace = AtSpeed()
    task = Task(lambda: "nothing", _nothing)
    task._thread.start()
    with guard.looking():
        session.store.lots.find(LotQuery())
        write_json(tmp_path / "some.json", {})
        task.wait()
        pace.wait(0.0, 0.0)
    seen = "\n".join(guard.caught)
    for what in ("the store in find", "fsync in written_whole", "join in wait gui/tasks.py", "sleep in wait"):
        assert what in seen


def test_other_threads_may_wait(guard: Guard, session: Session) -> None:
    thread = threading.Thread(target=lambda: session.store.lots.find(LotQuery()))
    with guard.looking():
        thread.start()
    thread.join()
    assert not guard.caught


@pytest.mark.usefixtures("session")
def test_what_was_not_looked_at_is_not_seen(guard: Guard, tmp_path: Path) -> None:
    write_json(tmp_path / "some.json", {})
    assert not guard.caught
