"""The teaching screen in its states."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtWidgets import QWidget

from fruitgui.gui.shots.lessons import classroom, empty_room
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.teach.desk import Pile, Shelf
from fruitgui.gui.steps.teach.page import TeachPage
from fruitgui.station.workflow import Step

WAITING = 14
"""Fruit that are let wait again, so that there is something to name."""

MISTAKES = 3


@contextmanager
def _nothing(stage: Stage) -> Iterator[QWidget]:
    with empty_room(stage, Step.TEACH) as on:
        yield on.window


@contextmanager
def _first(stage: Stage) -> Iterator[QWidget]:
    with classroom(stage, Step.TEACH) as on:
        page = on.page_of(TeachPage)
        stage.wait_until(lambda: len(page.room.desk.fruit) > 0)
        page.room.clear(list(page.room.desk.fruit))
        on.calm()
        yield on.window


@contextmanager
def _naming(stage: Stage, *, mistakes: int = 0) -> Iterator[QWidget]:
    """Some wait to be named, the model so far has had its say."""
    with classroom(stage, Step.TEACH) as on:
        page = on.page_of(TeachPage)
        stage.wait_until(lambda: len(page.room.desk.fruit) > 0)
        keys = list(page.room.desk.fruit)
        page.room.clear(keys[:WAITING])
        for key in keys[-mistakes:] if mistakes else ():
            order = page.room.desk.order
            kind = page.room.desk.fruit[key].kind or order[0]
            page.room.name([key], order[(order.index(kind) + 1) % len(order)])
        page.room.look_through()
        stage.wait_until(lambda: not page.room.looking)
        if mistakes:
            page.shelves.chosen.emit(Shelf(Pile.DOUBTFUL))
        on.calm()
        yield on.window


@contextmanager
def _review(stage: Stage) -> Iterator[QWidget]:
    with classroom(stage, Step.TEACH) as on:
        page = on.page_of(TeachPage)
        stage.wait_until(lambda: len(page.room.desk.fruit) > 0)
        page.shelves.chosen.emit(Shelf(Pile.NAMED, page.room.desk.order[2]))
        measured = [key for key, one in page.room.desk.fruit.items() if one.measured and page.model.row(key) >= 0]
        page.grid.choose_row(page.model.row(measured[0]))
        on.calm()
        yield on.window


SCENES: tuple[Scene, ...] = (
    Scene("teach-nothing", _nothing),
    Scene("teach-first", _first),
    Scene("teach-naming", _naming),
    Scene("teach-mistakes", lambda stage: _naming(stage, mistakes=MISTAKES)),
    Scene("teach-review", _review),
)
