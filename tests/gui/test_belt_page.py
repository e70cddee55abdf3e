"""The belt screen on a rig that shows the same pictures over and over."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QAbstractButton
from pytestqt.qtbot import QtBot

from fruitgui.gui.session import Session
from fruitgui.gui.shots.frozen import FrozenSource, frozen_source, frozen_sources
from fruitgui.gui.steps.belt import backdrop
from fruitgui.gui.steps.belt.page import BeltPage
from fruitgui.gui.steps.belt.tool_row import ABOVE
from fruitgui.gui.theme.theme import Theme
from fruitgui.simulation.scenes import line_scene
from fruitgui.simulation.simulation import Simulation
from fruitgui.station import belt_job
from fruitgui.station.belt_setting import motion_of, onto_plan, with_region
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.workflow import State, Step
from tests.gui.opened import in_view, session_on

LONG_MS = 60_000
SPEED_M_S = 0.15
CORNERS = np.array([[-0.35, -0.2], [0.35, -0.2], [0.35, 0.2], [-0.35, 0.2]])


@pytest.fixture(scope="module")
def line() -> Simulation:
    """Return a line before one sensor, from when fruit are in the middle of the picture."""
    whole = line_scene(5, 24, SPEED_M_S, layout="single", captures_hz=10.0, per_metre=16.0, restless=0.0)
    times = [capture.time_s for capture in whole.captures]
    begin = len(times) // 3
    object.__setattr__(whole.scene, "captures", whole.scene.captures[begin : begin + 60])
    return Simulation(whole.scene)


@pytest.fixture(scope="module")
def rig(line: Simulation) -> FrozenSource:
    return frozen_source(line)


@pytest.fixture(scope="module")
def station(line: Simulation) -> Station:
    mounts = line.rig().mounts
    sensors = {name: StationSensor(line.device(name).serial, one.pose, one.surface) for name, one in mounts.items()}
    return with_region(Station("kinect_1", sensors), CORNERS)


@pytest.fixture
def rigged(qtbot: QtBot, tmp_path: Path, rig: FrozenSource) -> Iterator[Session]:
    with session_on(qtbot, tmp_path / "line", frozen_sources(rig)) as made:
        yield made


@pytest.fixture
def page(qtbot: QtBot, rigged: Session, theme: Theme) -> Iterator[BeltPage]:
    with in_view(qtbot, BeltPage(rigged, theme)) as made:
        yield made


@pytest.fixture
def running(qtbot: QtBot, rigged: Session, page: BeltPage, rig: FrozenSource, station: Station) -> BeltPage:
    rigged.source.choose(rig)
    qtbot.waitUntil(lambda: not rigged.source.opening, timeout=LONG_MS)
    qtbot.waitUntil(lambda: all(one.frames > 0 for one in rigged.connected.health.values()), timeout=LONG_MS)
    rigged.save_station(station)
    qtbot.waitUntil(lambda: not rigged.saving, timeout=LONG_MS)
    return page


def _drag(qtbot: QtBot, page: BeltPage, corner: int, by: QPoint) -> None:
    spot = page.canvas.spot(corner)
    assert spot is not None
    start = spot.toPoint()
    qtbot.mousePress(page.canvas, Qt.MouseButton.LeftButton, pos=start)
    qtbot.mouseMove(page.canvas, start + by / 2)
    qtbot.mouseMove(page.canvas, start + by)
    qtbot.mouseRelease(page.canvas, Qt.MouseButton.LeftButton, pos=start + by)


def _corners(page: BeltPage) -> np.ndarray:
    assert page.draft is not None
    return page.draft.corners_m


def test_without_a_calibration_it_says_where_to_go(page: BeltPage) -> None:
    wanted: list[object] = []
    page.step_wanted.connect(wanted.append)
    assert page.nothing.isVisible()
    page.way_to(Step.CALIBRATE).trigger()
    assert wanted == [Step.CALIBRATE]


@pytest.mark.parametrize("view", [ABOVE, "kinect_1"])
def test_a_corner_is_dragged_with_a_finger_saved_for_the_sensors_and_marked_done(
    qtbot: QtBot, rigged: Session, running: BeltPage, view: str
) -> None:
    running.tools.views[view].click()
    visible = [number for number in range(4) if running.canvas.spot(number) is not None]
    before = _corners(running).copy()
    middle = running.canvas.rect().center()
    spot = running.canvas.spot(visible[0])
    assert spot is not None
    inwards = (QPoint(middle) - spot.toPoint()) / 8
    _drag(qtbot, running, visible[0], inwards)
    after = _corners(running)
    assert np.abs(after - before)[visible[0]].max() > 0.005
    assert np.delete(after, visible[0], axis=0) == pytest.approx(np.delete(before, visible[0], axis=0))
    assert rigged.states()[Step.BELT].state is State.READY
    running.save_action.trigger()
    assert rigged.states()[Step.BELT].state is State.DONE
    qtbot.waitUntil(lambda: not rigged.saving, timeout=LONG_MS)
    kept = rigged.workspace.station.load().value
    assert kept is not None
    for name, one in kept.sensors.items():
        assert one.surface.region_m is not None
        assert onto_plan(kept, name, one.surface.region_m) == pytest.approx(after, abs=1e-4)
    assert running.main_action is running.way_to(Step.TEACH)


def test_one_drag_is_one_change_that_is_undone_at_once(qtbot: QtBot, running: BeltPage) -> None:
    before = _corners(running).copy()
    _drag(qtbot, running, 0, QPoint(24, 12))
    assert not np.allclose(_corners(running), before)
    running.undo_action.trigger()
    assert _corners(running) == pytest.approx(before)
    assert not running.undo_action.isEnabled()


def test_the_keys_alone_choose_move_add_and_remove_corners(qtbot: QtBot, running: BeltPage) -> None:
    canvas = running.canvas
    canvas.setFocus()
    assert canvas.corner == 0
    qtbot.keyClick(canvas, Qt.Key.Key_Space)
    assert canvas.corner == 1
    before = _corners(running).copy()
    qtbot.keyClick(canvas, Qt.Key.Key_Right)
    step = np.linalg.norm(_corners(running) - before, axis=1)
    assert step == pytest.approx([0.0, 0.005, 0.0, 0.0], abs=1e-6)
    qtbot.keyClick(canvas, Qt.Key.Key_Up, Qt.KeyboardModifier.ShiftModifier)
    assert np.linalg.norm(_corners(running) - before, axis=1)[1] == pytest.approx(0.05, abs=0.006)
    qtbot.keyClick(canvas, Qt.Key.Key_Insert)
    assert len(_corners(running)) == 5
    qtbot.keyClick(canvas, Qt.Key.Key_Delete)
    qtbot.keyClick(canvas, Qt.Key.Key_Delete)
    qtbot.keyClick(canvas, Qt.Key.Key_Delete)
    assert len(_corners(running)) == 3
    assert not running.tools.tools["remove"].isEnabled()


def test_the_belt_is_measured_from_fruit_that_pass(qtbot: QtBot, rigged: Session, running: BeltPage) -> None:
    qtbot.mouseClick(running.side.measure_button, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: bool(rigged.tasks.running))
    assert not running.side.measure_button.isEnabled()
    qtbot.waitUntil(lambda: not rigged.tasks.running, timeout=LONG_MS)
    draft = running.draft
    assert draft is not None
    assert draft.fixed
    assert draft.speed_m_s == pytest.approx(SPEED_M_S, rel=0.1)
    assert running.side.measured.text().startswith("Measured: 0.1")
    assert " ± " in running.side.measured.text()
    running.save_action.trigger()
    assert rigged.station is not None
    kept = motion_of(rigged.station)
    assert kept is not None
    assert kept.speed_m_s == pytest.approx(draft.speed_m_s, abs=1e-3)


def test_what_is_typed_is_not_called_measured(rigged: Session, running: BeltPage) -> None:
    assert running.side.measured.text() == "Every run measures it anew from its first fruit."
    running.side.fixed.click()
    running.side.speed.show_value(0.2)
    running.side.backwards.click()
    assert running.side.measured.text() == "As it is typed here."
    running.save_action.trigger()
    assert rigged.station is not None
    kept = motion_of(rigged.station)
    assert kept is not None
    assert kept.speed_m_s == pytest.approx(0.2)


def test_heights_are_kept_in_the_station_and_must_not_contradict(rigged: Session, running: BeltPage) -> None:
    running.side.tallest.show_value(12.0)
    assert not running.save_action.isEnabled()
    assert "taller" in running.hint
    running.side.tallest.show_value(90.0)
    running.save_action.trigger()
    assert rigged.station is not None
    assert rigged.station.fruit_heights_m == pytest.approx((0.025, 0.09))


def test_leaving_saves_and_the_message_takes_it_back(qtbot: QtBot, rigged: Session, running: BeltPage) -> None:
    before = _corners(running).copy()
    _drag(qtbot, running, 0, QPoint(30, 10))
    running.left()
    assert rigged.states()[Step.BELT].state is State.DONE
    qtbot.waitUntil(lambda: not rigged.saving, timeout=LONG_MS)
    undo = rigged.messages.history[-1].act
    assert undo is not None
    undo()
    qtbot.waitUntil(lambda: not rigged.saving, timeout=LONG_MS)
    assert _corners(running) == pytest.approx(before, abs=1e-5)
    assert rigged.states()[Step.BELT].state is State.READY


def test_nothing_is_saved_where_nothing_was_changed(rigged: Session, running: BeltPage, station: Station) -> None:
    running.left()
    assert rigged.station is station
    assert rigged.states()[Step.BELT].state is State.READY


def test_pictures_come_in_both_views_and_are_made_beside_the_window(
    qtbot: QtBot, running: BeltPage, monkeypatch: pytest.MonkeyPatch
) -> None:
    threads: list[threading.Thread] = []
    for name in ("mosaic_of", "image_of"):
        real = getattr(backdrop, name)

        def made(*given: Any, real: Callable[..., Any] = real) -> Any:  # noqa: ANN401 - whatever it takes and gives
            threads.append(threading.current_thread())
            return real(*given)

        monkeypatch.setattr(backdrop, name, made)
    for view in (ABOVE, "kinect_1"):
        running.tools.views[view].click()
        qtbot.waitUntil(lambda: not running.canvas._image.isNull())
    assert len(threads) >= 2
    assert threading.main_thread() not in threads


def test_everything_that_is_pressed_is_large_enough_for_a_glove(running: BeltPage) -> None:
    running.side.switch.show()
    shown = [one for one in running.findChildren(QAbstractButton) if one.isVisible()]
    assert [one.accessibleName() for one in shown if min(one.height(), one.width()) < 40] == []
    assert all(one.accessibleName() or one.text() for one in shown)


def test_sensors_that_fall_silent_are_named_and_not_taken_for_an_empty_belt(
    qtbot: QtBot, rigged: Session, running: BeltPage, rig: FrozenSource, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(belt_job, "LONGEST_SILENCE_S", 0.5)
    rig.sensors[0].silent.set()
    try:
        running.side.measure.emit()
        qtbot.waitUntil(lambda: running.motion.busy)
        qtbot.waitUntil(lambda: not running.motion.busy, timeout=LONG_MS)
    finally:
        rig.sensors[0].silent.clear()
    assert rigged.messages.history[-1].what == "kinect_1 gives no pictures."
