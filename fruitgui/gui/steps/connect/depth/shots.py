"""Correcting a sensor's depth, stage by stage."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

from PySide6.QtWidgets import QWidget

from fruitgui.gui.shots.depth_bench import BALL_M, BOX_M, RAISE_M, DepthBench, bench_distance_m, frozen_bench
from fruitgui.gui.shots.setting_up import SettingUp, setting_up
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.connect.depth.course import Stage as DepthStage
from fruitgui.gui.steps.connect.depth.course import Typed
from fruitgui.gui.steps.connect.depth.panel import MeasurePanel
from fruitgui.gui.steps.connect.depth.wizard import DepthWizard
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.station.depth_watch import Looked
from fruitgui.station.workflow import Step

LAID = {
    DepthStage.BELT: Looked.BELT,
    DepthStage.BOARD: Looked.BOARD,
    DepthStage.BALL: Looked.BALL,
    DepthStage.RAISED: Looked.RAISED,
}


def _went_on(wizard: DepthWizard, before: DepthStage) -> bool:
    return wizard.course is not None and wizard.course.stage is not before


def _walk(stage: Stage, on: SettingUp, bench: DepthBench, until: DepthStage, typed: Typed) -> None:
    """Walk through the measurement up to a stage."""
    assert isinstance(on.page, ConnectPage)  # noqa: S101 - it was opened at this step
    wizard = on.page.depth_wizard
    on.connect()
    on.page.details.correct_depth.emit()
    wizard.panel.show_typed(typed)
    for here, what in LAID.items():
        bench.lay(what)
        stage.wait_until(wizard.choices.take.isEnabled)
        if here is until:
            return
        wizard.choices.take.trigger()
        stage.wait_until(partial(_went_on, wizard, here))
    stage.wait_until(lambda: wizard.course is not None and wizard.course.outcome is not None)


@contextmanager
def _depth(
    stage: Stage, until: DepthStage, height_mm: float = 1e3 * BOX_M, raised_mm: float = 1e3 * RAISE_M
) -> Iterator[QWidget]:
    bench = frozen_bench()
    typed = Typed(round(1e3 * bench_distance_m()), height_mm, 1e3 * BALL_M, raised_mm)
    with setting_up(stage, Step.CONNECT, bench.source) as on:
        _walk(stage, on, bench, until, typed)
        yield on.window


@contextmanager
def _near(stage: Stage) -> Iterator[QWidget]:
    """Type a second height that is too near to the first."""
    with _depth(stage, DepthStage.RAISED) as window:
        panel = window.findChild(MeasurePanel)
        assert panel is not None  # noqa: S101 - the window has one
        panel.show_typed(replace(panel.typed, raised_mm=150.0))
        stage.wait_until(lambda: "20" in panel.seen.text())
        yield window


SCENES: tuple[Scene, ...] = (
    Scene("connect-depth-belt", partial(_depth, until=DepthStage.BELT)),
    Scene("connect-depth-box", partial(_depth, until=DepthStage.BOARD)),
    Scene("connect-depth-ball", partial(_depth, until=DepthStage.BALL)),
    Scene("connect-depth-raised", partial(_depth, until=DepthStage.RAISED)),
    Scene("connect-depth-near", _near),
    Scene("connect-depth-result", partial(_depth, until=DepthStage.RESULT)),
    Scene("connect-depth-refused", partial(_depth, until=DepthStage.RESULT, height_mm=184.0)),
)
