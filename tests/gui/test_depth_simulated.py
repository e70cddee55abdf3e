"""Correcting depth end to end: a simulated rig whose devices err in a known way, measured in the window, twice."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from fruitgui.frame import F64
from fruitgui.gui.session import Session
from fruitgui.gui.steps.connect.depth.course import Stage
from fruitgui.gui.steps.connect.depth.wizard import DepthWizard
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.show import SHOWN_RAISE_M, Showing
from fruitgui.simulation.supply import LineOptions
from fruitgui.station.sources import SIMULATED, SimulatedSource, Sources
from tests.gui.opened import in_view, session_on

LONG_MS = 120_000
RIG = LineOptions(rig_seed=5, layout="single", rate_hz=20.0, depth_error=1.0)
SENSOR = "kinect_1"
CORNER_R2 = (320**2 + 240**2) / 580**2


@pytest.fixture
def session(qtbot: QtBot, tmp_path: Path) -> Iterator[Session]:
    with session_on(qtbot, tmp_path / "line", Sources((SIMULATED,))) as session:
        session.source.choose(SimulatedSource(RIG, flat_out=True))
        qtbot.waitUntil(lambda: session.connected.feed is not None, timeout=LONG_MS)
        yield session


@pytest.fixture
def page(qtbot: QtBot, session: Session, theme: Theme) -> Iterator[ConnectPage]:
    with in_view(qtbot, ConnectPage(session, theme)) as page:
        yield page


def _pass(qtbot: QtBot, wizard: DepthWizard, *, take: bool) -> None:
    """Take what a stage is about, or leave it out; wait for what comes next."""
    before = wizard.course
    assert before is not None
    action = wizard.choices.take if take else wizard.choices.skip
    if take:
        qtbot.waitUntil(action.isEnabled, timeout=LONG_MS)
    assert action in wizard.actions_now
    action.trigger()
    qtbot.waitUntil(lambda: wizard.course is not None and wizard.course.stage is not before.stage, timeout=LONG_MS)


def _errors_m(model: DepthModel, correction: DepthCorrection, belt_m: float) -> F64:
    """Return how far depths are off from the belt up to 15 cm above it, and from the middle to the picture's edge."""
    r2, z_m = np.meshgrid(np.linspace(0.0, 0.37, 5), belt_m - np.linspace(0.0, 0.15, 4))
    read = z_m * (1 + model.scale_error + model.radial_error * r2 / CORNER_R2) + model.offset_m
    scales = correction.scale + correction.radial_2 * r2 + correction.radial_4 * r2**2
    return scales * read + correction.offset_m - z_m


@pytest.mark.parametrize("boxed", [True, False])
def test_a_device_that_errs_is_put_right_from_two_heights(
    qtbot: QtBot, session: Session, page: ConnectPage, boxed: bool
) -> None:
    rig = session.source.rig
    assert rig is not None
    button = page.details.buttons["depth"]
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    wizard = page.depth_wizard
    assert wizard.panel.typed.raised_mm == pytest.approx(1e3 * SHOWN_RAISE_M)
    shown = []
    for stage, take in ((Stage.BELT, True), (Stage.BOARD, boxed), (Stage.BALL, True), (Stage.RAISED, True)):
        assert wizard.course is not None
        assert wizard.course.stage is stage
        shown.append(rig.showing)
        _pass(qtbot, wizard, take=take)
    assert shown == [Showing.EMPTY, Showing.BOARD, Showing.BALL, Showing.RAISED]
    qtbot.waitUntil(lambda: wizard.course is not None and wizard.course.outcome is not None, timeout=LONG_MS)
    assert wizard.course is not None
    fit = wizard.course.fit
    assert fit is not None, wizard.course.outcome
    qtbot.waitUntil(lambda: page.main_action is wizard.choices.keep, timeout=LONG_MS)
    assert "put the sensor back" in page.hint
    figures = {one.what: one for one in fit.figures}
    assert set(figures) == {"raised", "ball", "flatness"} | ({"height"} if boxed else set())
    assert abs(figures["raised"].after_m - SHOWN_RAISE_M) < 0.003
    device = RIG.setting().devices[0]
    belt_m = float(device.pose.translation_m[2] / -device.pose.rotation[2, 2])
    before, after = (np.abs(_errors_m(device.depth_model, one, belt_m)) for one in (DepthCorrection(), fit.correction))
    assert after.max() < 3.0 * fit.depth_std_m + 0.001
    assert after.max() < before.max()
    wizard.choices.keep.trigger()
    qtbot.waitUntil(lambda: not session.saving, timeout=LONG_MS)
    assert rig.showing is Showing.LINE, "the sensor hangs where it was"
    known = session.depths.of(device.serial, SENSOR)
    assert known is not None
    assert known.depth_correction() == fit.correction
