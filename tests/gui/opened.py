"""A session and a page as tests have them: opened, and let go of when the test is over."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

from pytestqt.qtbot import QtBot

from fruitgui.gui.session import Session
from fruitgui.gui.steps.page import StepPage
from fruitgui.station.sources import Sources
from fruitgui.station.workspace import open_workspace

P = TypeVar("P", bound=StepPage)


@contextmanager
def session_on(qtbot: QtBot, folder: Path, sources: Sources | None = None) -> Iterator[Session]:
    """Open a line's folder; what was started on it must end."""
    made = Session(open_workspace(folder), sources=sources)
    yield made
    assert made.close(), "something did not end in time"
    qtbot.waitUntil(lambda: not made.tasks.running)
    made.deleteLater()


@contextmanager
def in_view(qtbot: QtBot, page: P) -> Iterator[P]:
    """Show a page as the least window does."""
    qtbot.addWidget(page)
    page.resize(1072, 580)
    page.show()
    page.entered()
    yield page
    page.left()
