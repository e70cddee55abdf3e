"""The calibrate screen in its states."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from PySide6.QtWidgets import QWidget

from fruitgui.gui.shots.frozen import FrozenSource
from fruitgui.gui.shots.setting_up import SettingUp, setting_up, simulated_rig, sparse_rig
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.calibrate.cloud import Side
from fruitgui.gui.steps.calibrate.page import CalibratePage
from fruitgui.station.workflow import Step


def _page(on: SettingUp) -> CalibratePage:
    assert isinstance(on.page, CalibratePage)  # noqa: S101 - it was opened at this step
    return on.page


@contextmanager
def _nothing(stage: Stage) -> Iterator[QWidget]:
    with setting_up(stage, Step.CALIBRATE, simulated_rig("opposed")) as on:
        yield on.window


@contextmanager
def _preparing(stage: Stage, rig: FrozenSource) -> Iterator[QWidget]:
    with setting_up(stage, Step.CALIBRATE, rig) as on:
        on.connect()
        stage.wait_until(lambda: bool(_page(on).prepare.graph.links))
        _page(on).prepare.switch.show()
        stage.settle()
        yield on.window


@contextmanager
def _calibrated(stage: Stage, rig: FrozenSource, side: Side | None, *, after: bool = True) -> Iterator[QWidget]:
    with setting_up(stage, Step.CALIBRATE, rig) as on:
        on.connect()
        page = _page(on)
        page.calibrate_action.trigger()
        stage.wait_until(lambda: page.main_action is page.keep_action or bool(page.refused.cards))
        if side is not None:
            page.result.cloud.sides[side].click()
            page.result.cloud.when[after].click()
        yield on.window


SCENES: tuple[Scene, ...] = (
    Scene("calibrate-nothing", _nothing),
    Scene("calibrate-prepare", lambda stage: _preparing(stage, simulated_rig("opposed"))),
    Scene("calibrate-prepare-ring", lambda stage: _preparing(stage, simulated_rig("ring"))),
    Scene("calibrate-before", lambda stage: _calibrated(stage, simulated_rig("opposed"), Side.TOP, after=False)),
    Scene("calibrate-good", lambda stage: _calibrated(stage, simulated_rig("opposed"), Side.TOP)),
    Scene("calibrate-side", lambda stage: _calibrated(stage, simulated_rig("ring"), Side.SIDE)),
    Scene("calibrate-refused", lambda stage: _calibrated(stage, sparse_rig(), None)),
)
