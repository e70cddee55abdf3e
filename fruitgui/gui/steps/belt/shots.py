"""The belt screen in its states."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache, partial

from PySide6.QtGui import QImage
from PySide6.QtWidgets import QWidget

from fruitgui.frame import Frame
from fruitgui.gui.shots.setting_up import SettingUp, setting_up, simulated_rig
from fruitgui.gui.shots.stage import Scene, Stage
from fruitgui.gui.steps.belt.page import BeltPage
from fruitgui.gui.steps.belt.tool_row import ABOVE
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.belt_setting import PlanMotion, long_axis_rad, region_of, with_motion
from fruitgui.station.calibrate_job import calibrate_stills
from fruitgui.station.station import Station
from fruitgui.station.workflow import Step

SEED = 3


def _page(on: SettingUp) -> BeltPage:
    assert isinstance(on.page, BeltPage)  # noqa: S101 - it was opened at this step
    return on.page


@cache
def made_station(layout: str, *, moving: bool) -> Station:
    """Return the rig that is shown as calibrating finds it; its belt moves to the right, or is not known to move."""
    simulation = still_scene(SEED, layout, 15, captures=3)
    stills: dict[str, list[Frame]] = {}
    for frame in simulation.frames():
        stills.setdefault(frame.sensor, []).append(frame)
    serials = {name: simulation.device(name).serial for name in simulation.sensors}
    station = calibrate_stills(stills, simulation.sensors[0], serials).station
    assert station is not None  # noqa: S101 - this scene can be calibrated
    heading_rad = long_axis_rad(region_of(station))
    return with_motion(station, PlanMotion(0.12, heading_rad)) if moving else station


@contextmanager
def _setting(stage: Stage, layout: str, view: str, *, moving: bool) -> Iterator[QWidget]:
    with setting_up(stage, Step.BELT, simulated_rig(layout)) as on:
        page = _page(on)
        on.connect()
        on.session.save_station(made_station(layout, moving=moving))
        stage.wait_until(lambda: not on.session.saving)
        pictures: list[QImage] = []
        page._backdrop.made.connect(pictures.append)
        page.tools.views[view].click()
        page.side.switch.show()
        stage.wait_until(lambda: bool(pictures))
        yield on.window


@contextmanager
def _nothing(stage: Stage) -> Iterator[QWidget]:
    with setting_up(stage, Step.BELT, simulated_rig("opposed")) as on:
        yield on.window


SCENES: tuple[Scene, ...] = (
    Scene("belt-nothing", _nothing),
    Scene("belt-above", partial(_setting, layout="opposed", view=ABOVE, moving=True)),
    Scene("belt-picture", partial(_setting, layout="opposed", view="kinect_2", moving=True)),
    Scene("belt-ring", partial(_setting, layout="ring", view=ABOVE, moving=False)),
)
