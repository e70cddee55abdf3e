"""The lots screen in its states."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QWidget

from fruitgui.gui.pages import page_maker
from fruitgui.gui.session import Session
from fruitgui.gui.shots.made_lots import DAY_S, GROWERS, NOW_S, run_lot
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.lots.fruit_rows import Show
from fruitgui.gui.steps.lots.page import LotsPage
from fruitgui.gui.steps.page import StepPage
from fruitgui.gui.window import MainWindow
from fruitgui.records.fruit_search import FruitQuery
from fruitgui.records.store import Store, open_store
from fruitgui.station.live.blind import Blind
from fruitgui.station.workflow import Step
from fruitgui.station.workspace import open_workspace

FRUIT = 1248


class _Clock:
    def __init__(self) -> None:
        self.now_s = NOW_S

    def __call__(self) -> float:
        return self.now_s


def _morning(store: Store, clock: _Clock, name: str = "1184", grower: str = GROWERS[0], fruit: int = FRUIT) -> int:
    """Run a lot of one morning, with a pause for breakfast."""
    lot = run_lot(store, name, grower, fruit, seed=len(name) + fruit, recipe="Export A")
    clock.now_s += 5400
    store.lots.pause(lot)
    clock.now_s += 1500
    store.lots.resume(lot)
    clock.now_s += 2000
    for blind, lasted_s in (
        (Blind(("kinect_2",), ((0.41, 0.65),), 0.65, 0.3), 37),
        (Blind(("kinect_1",), (), 0.65, 0.0), 84),
    ):
        store.spells.note(lot, blind)
        clock.now_s += lasted_s
        store.spells.note(lot, None)
        clock.now_s += 600
    clock.now_s += 1000
    store.lots.pause(lot, "belt cleaned")
    clock.now_s += 420
    store.lots.resume(lot)
    clock.now_s += 5000
    return lot


def _one(store: Store, clock: _Clock) -> None:
    store.lots.end(_morning(store, clock))


def _running(store: Store, clock: _Clock) -> None:
    _many(store, clock)
    clock.now_s = time.time() - 16_600
    _morning(store, clock, "1197", GROWERS[3], 620)


def _many(store: Store, clock: _Clock) -> None:
    for number in range(12):
        clock.now_s = NOW_S - (13 - number) * DAY_S
        lot = run_lot(store, str(1172 + number), GROWERS[number % len(GROWERS)], 40 + 13 * number, number, "Export A")
        clock.now_s += 9000
        store.lots.end(lot)
    clock.now_s = NOW_S
    _one(store, clock)


def _corrected(store: Store, clock: _Clock) -> None:
    _one(store, clock)
    unsure = store.fruit.find(FruitQuery(1, order="kind_probability", count=9)).fruit
    store.corrections.name([one.key for one in unsure[:5]], "red apple", note="seen by hand")
    store.corrections.leave_out([one.key for one in unsure[5:8]], note="counted twice")
    store.corrections.name([unsure[8].key], "quince", who="Ana")


@contextmanager
def _window(stage: Stage, fill: Callable[[Store, _Clock], None] | None) -> Iterator[tuple[MainWindow, LotsPage]]:
    with tempfile.TemporaryDirectory(dir=stage.folder) as folder:
        if fill is not None:
            clock = _Clock()
            with open_store(Path(folder), clock) as store:
                fill(store, clock)
        session = Session(open_workspace(Path(folder)))
        pages: Mapping[Step, StepPage] = {
            one: page_maker(one)(session, stage.theme) if one is Step.LOTS else StepPage() for one in Step
        }
        window = MainWindow(stage.theme, session.messages, session.tasks, pages)
        window.show_states(session.states())
        window.top_bar.show_place("Line 2", "")
        window.go_to(Step.LOTS)
        window.show()
        page = pages[Step.LOTS]
        assert isinstance(page, LotsPage)  # noqa: S101 - it was opened at this step
        try:
            if fill is not None:
                stage.wait_until(lambda: page.lot.read is not None)
            stage.wait_until(lambda: not page.desk.queries.busy)
            yield window, page
        finally:
            window.close()
            stage.wait_until(lambda: not page.desk.queries.busy)
            session.close()
            stage.settle()
            window.deleteLater()
            session.deleteLater()
            stage.settle()


@contextmanager
def _summary(
    stage: Stage, fill: Callable[[Store, _Clock], None] | None, line_lot: int | None = None
) -> Iterator[QWidget]:
    with _window(stage, fill) as (window, page):
        page.show_line(line_lot)
        stage.wait_until(lambda: not page.desk.queries.busy)
        yield window


@contextmanager
def _fruit(stage: Stage, fill: Callable[[Store, _Clock], None], show: Show = Show.COUNTED) -> Iterator[QWidget]:
    with _window(stage, fill) as (window, page):
        page.lot.show_fruit()
        table = page.lot.fruit.table
        table.show_box.setCurrentIndex(table.show_box.findData(show))
        stage.settle()
        stage.wait_until(lambda: not page.desk.queries.busy)
        yield window


@contextmanager
def _open(stage: Stage, fill: Callable[[Store, _Clock], None], show: Show = Show.COUNTED) -> Iterator[QWidget]:
    with _window(stage, fill) as (window, page):
        page.lot.show_fruit()
        table = page.lot.fruit.table
        table.show_box.setCurrentIndex(table.show_box.findData(show))
        stage.wait_until(lambda: not page.desk.queries.busy)
        page.lot.fruit.open_row(2)
        stage.wait_until(lambda: page.lot.fruit.opened)
        yield window


SCENES: tuple[Scene, ...] = (
    Scene("lots-nothing", partial(_summary, fill=None)),
    Scene("lots-one", partial(_summary, fill=_one)),
    Scene("lots-many", partial(_summary, fill=_many)),
    Scene("lots-fruit", partial(_fruit, fill=_one)),
    Scene("lots-corrected", partial(_fruit, fill=_corrected, show=Show.CORRECTED)),
    Scene("lots-open", partial(_open, fill=_one)),
    Scene("lots-open-corrected", partial(_open, fill=_corrected, show=Show.CORRECTED)),
    Scene("lots-running", partial(_summary, fill=_running, line_lot=14)),
)
