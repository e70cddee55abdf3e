"""The connect screen in its states."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from PySide6.QtWidgets import QWidget

from fruitgui.gui.shots.setting_up import SettingUp, setting_up, simulated_rig
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.connect.offers import SIMULATED
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.sensors.feed import Running
from fruitgui.station.sources import Sources
from fruitgui.station.workflow import Step


def _page(on: SettingUp) -> ConnectPage:
    assert isinstance(on.page, ConnectPage)  # noqa: S101 - it was opened at this step
    return on.page


@contextmanager
def _nothing(stage: Stage, chosen: str) -> Iterator[QWidget]:
    with setting_up(stage, Step.CONNECT, simulated_rig("opposed")) as on:
        chooser = _page(on).chooser
        chooser.show_found(Sources().found())
        if chosen == SIMULATED:
            next(row for row in chooser.rows if row.offer.key == SIMULATED).click()
        else:
            chooser.take_file(Path("/data/packing/morning.mcap"))
        yield on.window


@contextmanager
def _running(stage: Stage, layout: str, sensors: int) -> Iterator[QWidget]:
    with setting_up(stage, Step.CONNECT, simulated_rig(layout, sensors)) as on:
        on.connect()
        yield on.window


@contextmanager
def _silent(stage: Stage) -> Iterator[QWidget]:
    rig = simulated_rig("opposed")
    with setting_up(stage, Step.CONNECT, rig) as on:
        on.connect()
        rig.sensors[1].silent.set()
        try:
            stage.wait_until(lambda: on.session.connected.health["kinect_2"].state is Running.SILENT)
            _page(on).tiles.chosen.emit("kinect_2")
            yield on.window
        finally:
            rig.sensors[1].silent.clear()


SCENES: tuple[Scene, ...] = (
    Scene("connect-nothing", partial(_nothing, chosen=SIMULATED)),
    Scene("connect-recording", partial(_nothing, chosen="recording")),
    Scene("connect-one", partial(_running, layout="single", sensors=1)),
    Scene("connect-two", partial(_running, layout="opposed", sensors=2)),
    Scene("connect-eight", partial(_running, layout="chain", sensors=8)),
    Scene("connect-silent", _silent),
)
