"""Questions are asked beside the window, the newest of each name is answered, changes are never lost."""

from __future__ import annotations

import threading

import pytest
from pytestqt.qtbot import QtBot

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.gui.queries import Queries


@pytest.fixture
def queries(qapp: object) -> Queries:  # noqa: ARG001 - timers need an application
    return Queries()


def test_an_answer_comes_on_the_windows_thread_the_question_is_asked_on_another(qtbot: QtBot, queries: Queries) -> None:
    threads: list[threading.Thread] = []

    def question() -> int:
        threads.append(threading.current_thread())
        return 7

    def answer(found: int) -> None:
        threads.append(threading.current_thread())
        assert found == 7

    queries.ask("a", question, answer)
    qtbot.waitUntil(lambda: len(threads) == 2)
    assert threads[0] is not threading.main_thread()
    assert threads[1] is threading.main_thread()
    qtbot.waitUntil(lambda: not queries.busy)


def test_of_questions_under_one_name_only_the_newest_is_answered(qtbot: QtBot, queries: Queries) -> None:
    gate, answers, asked = threading.Event(), [], []
    queries.ask("list", lambda: gate.wait(5), lambda _: answers.append("first"))
    for number in range(5):
        queries.ask("list", lambda number=number: asked.append(number), lambda _, number=number: answers.append(number))
    queries.ask("other", lambda: None, lambda _: answers.append("other"))
    gate.set()
    qtbot.waitUntil(lambda: not queries.busy)
    assert answers == [4, "other"]
    assert asked == [4], "questions that wait are not even asked when a newer one comes"


def test_changes_go_first_and_what_takes_long_goes_last(qtbot: QtBot, queries: Queries) -> None:
    gate, done = threading.Event(), []
    queries.ask("first", lambda: gate.wait(5), lambda _: None)
    queries.ask_later("long", lambda: done.append("long"), lambda _: None)
    queries.ask("short", lambda: done.append("short"), lambda _: None)
    queries.change(lambda: done.append("change"), lambda _: None)
    queries.ask_later("long", lambda: done.append("long again"), lambda _: None)
    gate.set()
    qtbot.waitUntil(lambda: not queries.busy)
    assert done == ["change", "short", "long again"]


def test_changes_are_all_made_even_when_the_questions_are_forgotten(qtbot: QtBot, queries: Queries) -> None:
    gate, done, answers = threading.Event(), [], []
    queries.ask("list", lambda: gate.wait(5), lambda _: answers.append("list"))
    for number in range(3):
        queries.change(lambda number=number: done.append(number), lambda _: None)
    queries.rest()
    gate.set()
    qtbot.waitUntil(lambda: not queries.busy)
    assert (done, answers) == ([0, 1, 2], [])


def test_what_fails_is_told_and_the_next_is_asked(qtbot: QtBot, queries: Queries) -> None:
    told: list[FruitguiError] = []
    answers: list[int] = []
    queries.failed.connect(told.append)

    def full() -> int:
        raise WorldError("disk_full", "The disk is full.", "Make room.")

    def mistaken() -> int:
        raise ZeroDivisionError

    queries.ask("a", full, answers.append)
    queries.ask("b", mistaken, answers.append)
    queries.ask("c", lambda: 3, answers.append)
    qtbot.waitUntil(lambda: answers == [3])
    assert [error.code for error in told] == ["disk_full", "unexpected"]
    qtbot.waitUntil(lambda: not queries.busy)


def test_a_job_waits_for_the_changes_before_it_and_closing_for_all(qtbot: QtBot, queries: Queries) -> None:
    gate, done, told, waited = threading.Event(), [], [], threading.Event()
    queries.change(lambda: gate.wait(20), lambda _: told.append("first"))
    queries.change(lambda: done.append("second"), lambda _: told.append("second"))

    def job() -> None:
        queries.wait_for_changes()
        done.append("job")
        waited.set()

    thread = threading.Thread(target=job)
    thread.start()
    assert not waited.wait(0.05)
    gate.set()
    thread.join()
    assert done == ["second", "job"]
    queries.ask("question", lambda: done.append("question"), lambda _: told.append("question"))
    queries.change(lambda: done.append("third"), lambda _: told.append("third"))
    assert queries.finish()
    assert "third" in done
    assert told == ["first", "second", "third"], "what was only asked is not told any more"
    qtbot.waitUntil(lambda: not queries.busy)


def test_the_thread_lingers_for_the_next_question_and_then_ends(
    qtbot: QtBot, queries: Queries, monkeypatch: pytest.MonkeyPatch
) -> None:
    threads: list[threading.Thread] = []

    def ask() -> None:
        queries.ask("a", lambda: threads.append(threading.current_thread()), lambda _: None)
        qtbot.waitUntil(lambda: not queries.busy)

    monkeypatch.setattr("fruitgui.gui.queries.LINGER_S", 60.0)
    ask()
    ask()
    assert threads[0] is threads[1], "beginning a thread costs the window more than a question does"
    monkeypatch.setattr("fruitgui.gui.queries.LINGER_S", 0.0)
    ask()
    assert threads[2] is threads[0]
    qtbot.waitUntil(lambda: not threads[0].is_alive())
    ask()
    assert threads[3] is not threads[0]


def test_one_thread_serves_what_is_asked_again_and_again_and_ends_when_it_is_finished(qtbot: QtBot) -> None:
    queries, threads = Queries(linger_s=600.0), list[threading.Thread]()
    for number in range(3):
        queries.ask("again", threading.current_thread, threads.append)
        qtbot.waitUntil(lambda number=number: len(threads) == number + 1)  # type: ignore[misc]
    assert len(set(threads)) == 1
    assert threads[0].is_alive()
    assert queries.finish()
    threads[0].join(20.0)
    assert not threads[0].is_alive()
