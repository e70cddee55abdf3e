"""The projectors as they are measured, in the states worth seeing."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
from PySide6.QtWidgets import QWidget

from fruitgui.calibration.projectors.glimpse import Level
from fruitgui.calibration.projectors.interference import Interference
from fruitgui.calibration.projectors.settling import Refusal, Settled
from fruitgui.gui.shots.frozen import frozen_source, with_projectors
from fruitgui.gui.shots.setting_up import setting_up
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.connect.projectors.dialog import ProjectorsDialog
from fruitgui.gui.tasks import Job, TaskRunner
from fruitgui.progress import Cancelled, Progress, stop_if
from fruitgui.sensors.turns import Light, Settling, turns
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.projectors import MeasuredSettling, Projectors
from fruitgui.station.tried import Pair, Tried
from fruitgui.station.turn_plan import TurnPlan
from fruitgui.station.workflow import Step

PERIOD_S = 1 / 30


def made_plan(measured: Projectors | None) -> TurnPlan:
    """Return the turns of three Kinects by careful guesses, or by what was measured."""
    settling = Settling() if measured is None else next(iter(measured.settlings.values())).settling()
    names = ("kinect_1", "kinect_2", "kinect_3")
    schedule = turns(dict.fromkeys(names, Light(PERIOD_S, settling)), None)
    rate = schedule.rate_hz(names[0], 30.0)
    return TurnPlan(
        schedule, False, dict.fromkeys(names, 30.0), dict.fromkeys(names, rate),
        0.74 / schedule.longest_wait_s(names[0], 30.0),
    )  # fmt: skip


def made_result() -> Tried:
    """Return what measuring three Kinects came to, of which one had not warmed up."""
    settled = [_settled(0.088, 2, 0.062), _settled(0.121, 3, 0.071)]
    seen = (Interference(0.062, 0.171, 1.6, 2.4, 2e-4), Interference(0.071, 0.083, 1.7, 1.8, 2e-4))
    measured = MeasuredSettling.model_validate({
        "settle_s": 0.121, "discard_frames": 3, "steady_s": 0.104, "holes": 0.07, "trials": 5,
        "when": "2026-05-04T10:11:12Z",
    })  # fmt: skip
    return Tried(
        {"kinect_1": settled[0], "kinect_2": settled[1], "kinect_3": Refusal.UNSTEADY},
        (Pair(("kinect_1", "kinect_2"), seen),),
        Projectors(settlings={"A1": measured, "A2": measured}),
    )


def _settled(settle_s: float, frames: int, holes: float) -> Settled:
    level = Level(holes, 2e-4, 1.6, np.zeros((1, 1), np.float32), 0.02, 1.2, 0.02)
    return Settled(settle_s, frames, settle_s - 0.5 * PERIOD_S, 5, level)


def _at_once(progress: Progress, cancelled: Cancelled) -> Tried:  # noqa: ARG001 - it was made before
    return made_result()


def _goes_on(progress: Progress, cancelled: Cancelled) -> Tried:
    progress(0.42, "kinect_1 + kinect_2")
    while True:
        stop_if(cancelled)
        time.sleep(0.02)


@contextmanager
def _dialog(stage: Stage, measure: Job[Tried], until: Callable[[ProjectorsDialog], bool] | None) -> Iterator[QWidget]:
    tasks = TaskRunner()
    dialog = ProjectorsDialog(measure, 2, made_plan, tasks, stage.theme)
    dialog.show()
    if until is not None:
        dialog.begin.click()
        stage.wait_until(lambda: until(dialog))
    try:
        yield dialog
    finally:
        dialog.reject()
        dialog.deleteLater()
        tasks.close()
        tasks.deleteLater()
        stage.settle()


@contextmanager
def _turns(stage: Stage) -> Iterator[QWidget]:
    rig = with_projectors(frozen_source(still_scene(3, layout="opposed", captures=2)))
    with setting_up(stage, Step.CONNECT, rig) as on:
        on.connect()
        assert isinstance(on.page, ConnectPage)  # noqa: S101 - it was opened at this step
        yield on.window


SCENES = (
    Scene("connect-turns", _turns),
    Scene("connect-projectors", partial(_dialog, measure=_at_once, until=None)),
    Scene(
        "connect-projectors-measuring",
        partial(_dialog, measure=_goes_on, until=lambda dialog: dialog.working.share > 0),
    ),
    Scene("connect-projectors-result", partial(_dialog, measure=_at_once, until=lambda dialog: not dialog.busy)),
)
