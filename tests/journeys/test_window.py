"""The seven steps as an operator walks them, in the real program, from an empty folder to a lot and back to it."""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import time
from collections import Counter
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from fruitgui.gui.steps.belt.page import BeltPage
from fruitgui.gui.steps.calibrate.page import CalibratePage
from fruitgui.gui.steps.connect.offers import SIMULATED
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.live.end_dialog import EndDialog
from fruitgui.gui.steps.live.lot_dialog import LotDialog
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.steps.lots.page import LotsPage
from fruitgui.gui.steps.teach.page import TeachPage
from fruitgui.gui.steps.train.page import TrainPage
from fruitgui.records.lot_search import LotQuery
from fruitgui.records.store import open_store
from fruitgui.simulation.show import Showing
from fruitgui.simulation.supply import LineOptions
from fruitgui.station.live import Phase
from fruitgui.station.workflow import State, Step
from tests.window.guard import Guard, guard
from tests.window.operating import Operator, operate
from tests.window.patience import qtbot
from tests.window.resting_rig import RestingRig, Shop

__all__ = ["guard", "qtbot"]

pytestmark = [pytest.mark.xdist_group("window journey"), pytest.mark.usefixtures("no_leaked_threads")]

KINDS = ("lemon", "red_apple", "chilean_avocado")
OPTIONS = LineOptions(rig_seed=21, seed=8, speed_m_s=0.25, rate_hz=5.0, kinds=KINDS, fruit=18)
ENOUGH_FRAMES, ENOUGH_FRUIT = 8, 3
CLOSED_S = 10.0


@pytest.fixture
def shop(monkeypatch: pytest.MonkeyPatch) -> Shop:
    made = Shop(OPTIONS)
    monkeypatch.setattr("fruitgui.gui.session.Sources", made.sources)
    return made


def test_an_operator_walks_the_seven_steps(qtbot: QtBot, shop: Shop, guard: Guard, tmp_path: Path) -> None:
    folder = tmp_path / "line"

    def first_day(operator: Operator) -> None:
        assert operator.window.step is Step.CONNECT, "a new line begins at the beginning"
        with guard.looking():
            connect(operator)
            calibrate(operator)
            set_the_belt(operator)
            teach(operator, shop)
            train(operator)
            connect(operator, again=True)
            run_a_lot(operator, shop, "1184")
            look_at_lots(operator, shop)
            connect(operator, again=True)
            start_lot(operator, "1185")
            operator.wait(lambda: operator.session.running.tally.count_all >= ENOUGH_FRUIT)
        leave(operator)

    def second_day(operator: Operator) -> None:
        assert operator.window.step is Step.LIVE, "a finished line opens where work goes on"
        with guard.looking():
            take_up(operator)

    assert operate(qtbot, folder, first_day) == 0
    with open_store(folder) as store:
        kept = {line.lot.name: line for line in store.lots.find(LotQuery()).lots}
    assert kept["1184"].fruit == OPTIONS.fruit
    assert kept["1185"].lot.ended_s is None
    assert operate(qtbot, folder, second_day) == 0
    with open_store(folder) as store:
        (line, _) = store.lots.find(LotQuery()).lots
    assert line.lot.ended_s is not None
    assert line.fruit >= kept["1185"].fruit
    assert not guard.caught, "\n".join(guard.caught)


def connect(operator: Operator, *, again: bool = False) -> None:
    page = operator.go(Step.CONNECT, ConnectPage)
    if again:
        operator.press(page.change_action)
    operator.click(next(row for row in page.chooser.rows if row.offer.key == SIMULATED))
    operator.press(page.connect_action)
    operator.wait(lambda: _frames(operator) >= 2)
    assert state_of(operator, Step.CONNECT) is State.DONE


def calibrate(operator: Operator) -> None:
    page = operator.go(Step.CALIBRATE, CalibratePage)
    operator.click(page.prepare.switch.buttons[Showing.STILL])
    before = _frames(operator)
    operator.wait(lambda: _frames(operator) >= before + ENOUGH_FRAMES)
    operator.press(page.calibrate_action)
    operator.press(page.keep_action)
    assert state_of(operator, Step.CALIBRATE) is State.DONE


def set_the_belt(operator: Operator) -> None:
    page = operator.go(Step.BELT, BeltPage)
    if not page.side.fixed.isChecked():
        operator.click(page.side.fixed)
    operator.type(page.side.speed.box, f"{OPTIONS.speed_m_s:.3f}")
    operator.press(page.save_action)
    assert state_of(operator, Step.BELT) is State.DONE


def let_run(operator: Operator) -> None:
    page = operator.go(Step.BELT, BeltPage)
    operator.click(page.side.switch.buttons[Showing.LINE])


def teach(operator: Operator, shop: Shop) -> None:
    page = operator.go(Step.TEACH, TeachPage)
    operator.press(page.choices.watch)
    operator.wait(lambda: page.room.lessons.running)
    let_run(operator)
    operator.go(Step.TEACH, TeachPage)
    operator.wait(lambda: not page.room.lessons.running and not page.room.busy)
    assert len(page.room.desk.fruit) == OPTIONS.fruit
    while page.model.keys:
        name(operator, page, shop.rigs[-1])
    operator.wait(lambda: not page.room.busy)
    assert set(page.room.desk.order) == set(KINDS)


def name(operator: Operator, page: TeachPage, eye: RestingRig) -> None:
    """Say what the chosen fruit is: by its key, or, where the kind is new, by its name."""
    (key,) = page.grid.chosen()
    views = operator.ask(lambda: operator.session.store.teaching.get(key).fruit.samples)
    kinds = Counter(eye.kind_at(one.sensor, one.time_s, one.u_px, one.v_px) for one in views)
    ((kind, _),) = kinds.most_common(1)
    line = next((one for one in page.room.desk.lines() if one.kind == kind), None)
    if line is None:
        operator.type(page.kinds.new, kind)
        operator.key(page.kinds.new, Qt.Key.Key_Return)
    else:
        operator.key(page.grid, Qt.Key(ord(line.key)))
    operator.wait(lambda: key not in page.model.keys)


def train(operator: Operator) -> None:
    page = operator.go(Step.TRAIN, TrainPage)
    operator.press(page.train)
    operator.press(page.accept)
    operator.wait(lambda: state_of(operator, Step.TRAIN) is State.DONE)


def start_lot(operator: Operator, called: str) -> LivePage:
    page = operator.go(Step.LIVE, LivePage)
    operator.press(page.start)
    dialog = operator.dialog(LotDialog)
    operator.type(dialog.name, called)
    operator.click(next(one for one in dialog.findChildren(QPushButton) if one.text() == "Start"))
    operator.wait(lambda: operator.session.running.running)
    let_run(operator)
    operator.go(Step.LIVE, LivePage)
    return page


def end_lot(operator: Operator, page: LivePage) -> None:
    operator.press(page.end)
    operator.click(operator.dialog(EndDialog).end)


def run_a_lot(operator: Operator, shop: Shop, called: str) -> None:
    page = start_lot(operator, called)
    operator.wait(lambda: _ended(operator))
    end_lot(operator, page)
    operator.wait(lambda: operator.session.running.lot is None)
    shown = Counter(dict(_counts(page.body.counts.accessibleDescription())))
    truth = Counter(fruit.kind for fruit in shop.rigs[-1].crossed())
    assert truth.total() == OPTIONS.fruit
    assert {kind: shown[_name(kind)] for kind in KINDS} == truth
    assert shown.total() == truth.total()


def look_at_lots(operator: Operator, shop: Shop) -> None:
    page = operator.go(Step.LOTS, LotsPage)
    operator.wait(lambda: page.lot.read is not None and not page.desk.queries.busy)
    read = page.lot.read
    assert read is not None
    counts = {one.kind: one.fruit for one in read.figures.kinds if one.fruit}
    assert counts == Counter(fruit.kind for fruit in shop.rigs[-1].crossed())


def leave(operator: Operator) -> None:
    """Close the window while a lot runs and fruit are on the belt."""
    began_s = time.monotonic()
    operator.window.close()
    assert time.monotonic() - began_s < CLOSED_S


def take_up(operator: Operator) -> None:
    page = operator.window.page(Step.LIVE)
    assert isinstance(page, LivePage)
    operator.wait(lambda: _frames(operator) >= 2)
    operator.press(page.take_up)
    operator.wait(lambda: operator.session.running.running)
    assert operator.session.running.tally.count_all >= ENOUGH_FRUIT
    end_lot(operator, page)
    operator.wait(lambda: operator.session.running.lot is None)


def state_of(operator: Operator, step: Step) -> State:
    return operator.session.states()[step].state


def _ended(operator: Operator) -> bool:
    state = operator.session.running.state
    return state is not None and state.phase is Phase.ENDED


def _frames(operator: Operator) -> int:
    """Return how many frames have come of the sensor that gave the fewest."""
    return min((one.frames for one in operator.session.connected.health.values()), default=0)


def _counts(said: str) -> list[tuple[str, int]]:
    return [(name, int(count)) for name, count in (one.rsplit(": ", 1) for one in said.split("; "))]


def _name(kind: str) -> str:
    return kind[:1].upper() + kind[1:].replace("_", " ")
