"""What every test of the window gets: Qt without a screen, the look, and a check that nothing is left behind."""

from __future__ import annotations

import contextlib
import gc
import os
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import pytest
from PySide6.QtCore import QCoreApplication, QEvent
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from fruitgui.gui.messages import Message, Messages
from fruitgui.gui.session import Session
from fruitgui.gui.shots.school import enrolled
from fruitgui.gui.tasks import Job, Task, TaskRunner
from fruitgui.gui.theme.theme import Theme, load_fonts
from fruitgui.gui.told import Words
from tests.gui.both_languages import BothLanguages
from tests.gui.opened import session_on
from tests.window.patience import qtbot

__all__ = ["qtbot"]

END_S = 20.0
NEVER = 1_000_000
"""So often is nothing collected while a test lasts."""


@pytest.fixture(scope="session")
def qapp_args() -> list[str]:
    return ["fruitgui-tests"]


@pytest.fixture
def theme(qapp: QApplication) -> Theme:
    load_fonts()
    look = Theme("dark")
    look.put_on(qapp, "dark")
    return look


@pytest.fixture
def session(qtbot: QtBot, tmp_path: Path) -> Iterator[Session]:
    with session_on(qtbot, tmp_path / "line") as made:
        yield made


@pytest.fixture
def taught(qtbot: QtBot, tmp_path: Path, schoolhouse: Path) -> Iterator[Session]:
    """A session on a copy of a school that the file of tests names."""
    with session_on(qtbot, enrolled(schoolhouse, tmp_path / "line")) as made:
        yield made


def _left(before: set[threading.Thread]) -> list[str]:
    """Return the names of threads that are new and do not end, though they are given time to."""
    until_s = time.monotonic() + END_S
    while (left := set(threading.enumerate()) - before) and time.monotonic() < until_s:
        with contextlib.suppress(RuntimeError):  # it is listed before it can be waited for
            next(iter(left)).join(0.1)
    return sorted(thread.name for thread in left)


@pytest.fixture(autouse=True)
def old_garbage_waits() -> Iterator[None]:
    """Leave what has lived for a while to `nothing_left`: a worker's thread must not be the one to end a widget."""
    young, middle, old = gc.get_threshold()
    gc.set_threshold(young, middle, NEVER)
    yield
    gc.set_threshold(young, middle, old)


@pytest.fixture(autouse=True)
def nothing_left(qapp: QApplication) -> Iterator[None]:
    """Fail a test that leaves a window or a thread behind."""
    threads, windows = set(threading.enumerate()), set(map(id, qapp.topLevelWidgets()))
    yield
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    gc.collect()
    gc.freeze()  # what is there now is no test's own: to look through all of it again takes a fifth of a second
    QCoreApplication.processEvents()
    assert not (left := _left(threads)), f"threads are left: {left}"
    shown = [one for one in qapp.topLevelWidgets() if id(one) not in windows and one.isVisible()]
    assert not shown, f"windows are left: {shown}"


@pytest.fixture(scope="session")
def both_languages(qapp: QApplication) -> BothLanguages:
    return BothLanguages(qapp)


@pytest.fixture(autouse=True)
def worded_when_shown(both_languages: BothLanguages) -> Iterator[None]:
    """Fail a test in which a message, or the name of a job, would stay in its language when another is chosen."""
    say, run = Messages.say, TaskRunner.run
    both_languages.fixed.clear()

    def said(messages: Messages, message: Message) -> None:
        both_languages.hear(message)
        say(messages, message)

    def ran(runner: TaskRunner, name: Words, job: Job[object], *worded: Callable[[str], str]) -> Task[object]:
        both_languages.hear_words(name)
        task = run(runner, name, job, *worded)
        task.progressed.connect(lambda _share, doing: both_languages.hear_doing(task, doing))
        return task

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Messages, "say", said)
        patch.setattr(TaskRunner, "run", ran)
        yield
    assert not both_languages.fixed, f"worded before it is shown: {both_languages.fixed}"
