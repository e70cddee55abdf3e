from __future__ import annotations

import threading

from pytestqt.qtbot import QtBot

from fruitgui.errors import FruitguiError, InputError
from fruitgui.gui.tasks import TaskRunner
from fruitgui.progress import Cancelled, Progress, stop_if


def test_a_job_runs_beside_the_window_and_gives_its_result(qtbot: QtBot) -> None:
    runner = TaskRunner()
    where: list[threading.Thread] = []

    def job(progress: Progress, cancelled: Cancelled) -> int:
        assert not cancelled()
        where.append(threading.current_thread())
        progress(0.5, "half")
        return 42

    task = runner.run(lambda: "count", job)
    assert runner.running == (task,)
    with qtbot.waitSignal(task.ended), qtbot.waitSignal(task.succeeded) as got:
        pass
    assert got.args == [42]
    assert where[0] is not threading.main_thread()
    assert runner.running == ()


def test_progress_is_told_on_the_window_s_thread_and_only_when_it_changes(qtbot: QtBot) -> None:
    runner = TaskRunner()
    go_on = threading.Event()
    told: list[tuple[float, str]] = []

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001
        progress(0.25, "a quarter")
        go_on.wait(10)

    task = runner.run(lambda: "slow", job)
    task.progressed.connect(lambda share, doing: told.append((share, doing)))
    qtbot.waitUntil(lambda: told == [(0.25, "a quarter")])
    with qtbot.waitSignal(task.ended):
        go_on.set()
    assert told == [(0.25, "a quarter")]


def test_cancel_ends_a_job_at_its_next_step(qtbot: QtBot) -> None:
    runner = TaskRunner()
    began = threading.Event()

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001
        began.set()
        while True:
            stop_if(cancelled)

    task = runner.run(lambda: "endless", job)
    qtbot.waitUntil(began.is_set)
    with qtbot.waitSignals([task.cancelled, task.ended]):
        task.cancel()


def test_an_error_that_a_person_can_mend_is_handed_on(qtbot: QtBot) -> None:
    runner = TaskRunner()

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001
        raise InputError("bad_file", "It is empty.", "Name another.")

    task = runner.run(lambda: "read", job)
    with qtbot.waitSignal(task.failed) as got:
        pass
    assert got.args is not None
    error = got.args[0]
    assert isinstance(error, FruitguiError)
    assert error.code == "bad_file"


def test_an_error_that_nobody_foresaw_is_told_with_what_to_do(qtbot: QtBot) -> None:
    runner = TaskRunner()

    def job(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001
        raise ZeroDivisionError("division by zero")

    task = runner.run(lambda: "divide", job)
    with qtbot.waitSignal(task.failed) as got:
        pass
    assert got.args is not None
    assert got.args[0].code == "unexpected"
    assert "ZeroDivisionError" in got.args[0].what
    assert got.args[0].remedy


def test_closing_stops_all_jobs_for_good(qtbot: QtBot) -> None:
    runner = TaskRunner()
    began, told, late = threading.Event(), [], []

    def endless(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001
        began.set()
        while not cancelled():
            pass

    def never(progress: Progress, cancelled: Cancelled) -> None:  # noqa: ARG001
        late.append("began")

    def at_once(progress: Progress, cancelled: Cancelled) -> None:
        pass

    running = runner.run(lambda: "endless", endless)
    qtbot.waitUntil(began.is_set)
    waiting = runner.run(lambda: "has not begun", never)
    assert runner.close()
    after = runner.run(lambda: "after the end", never)
    for task in (running, waiting, after):
        task.succeeded.connect(lambda _: told.append("succeeded"))
        task.ended.connect(lambda: told.append("ended"))
    assert runner.running == ()
    other = TaskRunner()
    with qtbot.waitSignal(other.run(lambda: "of another runner", at_once).ended):
        pass  # begun last, told by the same clock: the others would have been told by now
    assert (told, late) == ([], [])
