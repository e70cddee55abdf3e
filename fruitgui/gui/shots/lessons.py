"""A window on a school: what the scenes of the screens that teach and train begin with."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TypeVar

from PySide6.QtWidgets import QWidget

from fruitgui.gui.pages import page_maker
from fruitgui.gui.queries import Queries
from fruitgui.gui.session import Session
from fruitgui.gui.shots.school import enrolled, large_class, school
from fruitgui.gui.shots.stage import Stage
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.window import MainWindow
from fruitgui.station.workflow import Step
from fruitgui.station.workspace import open_workspace

P = TypeVar("P", bound=QWidget)


@dataclass(frozen=True, slots=True, eq=False)
class Attending:
    """A window on one step, with what it works on."""

    stage: Stage
    session: Session
    window: MainWindow
    page: StepPage

    def page_of(self, made: type[P]) -> P:
        """Return the page, which is of that class."""
        assert isinstance(self.page, made)  # noqa: S101 - it was opened at this step
        return self.page

    def calm(self) -> None:
        """Wait until everything that was asked is answered and drawn, and put messages away."""
        self.stage.settle()
        self.stage.wait_until(lambda: not any(one.busy for one in self.page.findChildren(Queries)))
        self.stage.settle()
        self.stage.wait_until(lambda: not any(one.busy for one in self.page.findChildren(Queries)))
        self.window.action_bar.follow(self.page)


@contextmanager
def classroom(stage: Stage, step: Step) -> Iterator[Attending]:
    """Open a window at a step, on a line whose fruit are all named."""
    with tempfile.TemporaryDirectory(dir=stage.folder) as folder:
        line = enrolled(_school(stage.folder), Path(folder) / "line")
        with _opened(stage, step, line) as on:
            yield on


@contextmanager
def empty_room(stage: Stage, step: Step) -> Iterator[Attending]:
    """Open a window at a step, on a line that was never taught."""
    with tempfile.TemporaryDirectory(dir=stage.folder) as folder, _opened(stage, step, Path(folder) / "line") as on:
        yield on


@contextmanager
def _opened(stage: Stage, step: Step, folder: Path) -> Iterator[Attending]:
    session = Session(open_workspace(folder))
    pages = {one: page_maker(one)(session, stage.theme) if one is step else StepPage() for one in Step}
    window = MainWindow(stage.theme, session.messages, session.tasks, pages)
    session.states_changed.connect(lambda: window.show_states(session.states()))
    window.show_states(session.states())
    window.top_bar.show_place("Line 2", "")
    window.resize(1280, 720)
    window.go_to(step)
    window.show()
    try:
        yield Attending(stage, session, window, pages[step])
    finally:
        window.close()
        stage.wait_until(lambda: not any(one.busy for one in pages[step].findChildren(Queries)))
        session.close()
        stage.settle()
        window.deleteLater()
        session.deleteLater()
        stage.settle()


@cache
def _school(folder: Path) -> Path:
    """Return the school, rendered once."""
    return school(folder / "school", large_class())
