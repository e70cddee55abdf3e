"""The training screen in its states."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtWidgets import QWidget

from fruitgui.gui.shots.lessons import Attending, classroom, empty_room
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.train.page import TrainPage
from fruitgui.station.workflow import Step

MISNAMED = 4


@contextmanager
def _nothing(stage: Stage) -> Iterator[QWidget]:
    with empty_room(stage, Step.TRAIN) as on:
        yield on.window


@contextmanager
def _ready(stage: Stage) -> Iterator[QWidget]:
    with classroom(stage, Step.TRAIN) as on:
        on.calm()
        yield on.window


def _misname(on: Attending) -> None:
    """Give some fruit a wrong kind, so that there are mistakes to show."""
    teaching = on.session.store.teaching
    briefs = teaching.briefs()
    kinds = sorted({one.kind for one in briefs if one.kind is not None})
    for one in briefs[:: len(briefs) // MISNAMED]:
        teaching.name([one.key], kinds[(kinds.index(one.kind or kinds[0]) + 1) % len(kinds)])
    on.session.note_taught(teaching.facts())


def _train(on: Attending) -> TrainPage:
    page = on.page_of(TrainPage)
    page.train.trigger()
    on.stage.wait_until(lambda: page.trainer.trained is not None and not page.trainer.busy)
    return page


@contextmanager
def _result(stage: Stage, tab: str) -> Iterator[QWidget]:
    with classroom(stage, Step.TRAIN) as on:
        _misname(on)
        _train(on).result.turn_to(tab)
        on.calm()
        yield on.window


@contextmanager
def _compared(stage: Stage) -> Iterator[QWidget]:
    """A model is in use, another was trained since labels were put right."""
    with classroom(stage, Step.TRAIN) as on:
        _misname(on)
        page = _train(on)
        page.accept.trigger()
        stage.wait_until(lambda: page.trainer.trained is None and not page.trainer.busy)
        for _ in range(MISNAMED):
            on.session.store.teaching.undo()
        on.session.note_taught(on.session.store.teaching.facts())
        _train(on)
        on.calm()
        yield on.window


@contextmanager
def _accepted(stage: Stage) -> Iterator[QWidget]:
    with classroom(stage, Step.TRAIN) as on:
        page = _train(on)
        page.accept.trigger()
        stage.wait_until(lambda: page.trainer.in_use is not None and not page.trainer.busy)
        on.calm()
        yield on.window


SCENES: tuple[Scene, ...] = (
    Scene("train-nothing", _nothing),
    Scene("train-ready", _ready),
    Scene("train-kinds", lambda stage: _result(stage, "kinds")),
    Scene("train-mistakes", lambda stage: _result(stage, "mistakes")),
    Scene("train-curve", lambda stage: _result(stage, "curve")),
    Scene("train-volume", lambda stage: _result(stage, "volume")),
    Scene("train-compared", _compared),
    Scene("train-accepted", _accepted),
)
