"""The calibrate screen on a rig that shows the same pictures over and over."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QAbstractButton
from pytestqt.qtbot import QtBot

from fruitgui.gui.session import Session
from fruitgui.gui.shots.frozen import FrozenSource, frozen_source, frozen_sources
from fruitgui.gui.steps.calibrate.cloud import Side
from fruitgui.gui.steps.calibrate.flat_cloud import FlatCloud
from fruitgui.gui.steps.calibrate.page import CalibratePage
from fruitgui.gui.theme.theme import Theme
from fruitgui.sensors.feed import Feed
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.fused_cloud import SensorCloud
from fruitgui.station.workflow import State, Step
from tests.gui.opened import in_view, session_on

LONG_MS = 60_000


@pytest.fixture(scope="module")
def rig() -> FrozenSource:
    return frozen_source(still_scene(3, "opposed", 15, captures=2))


@pytest.fixture(scope="module")
def bare() -> FrozenSource:
    return frozen_source(still_scene(6, "opposed", 1, captures=2, with_rails=False), "bare")


@pytest.fixture
def rigged(qtbot: QtBot, tmp_path: Path, rig: FrozenSource, bare: FrozenSource) -> Iterator[Session]:
    with session_on(qtbot, tmp_path / "line", frozen_sources(rig, bare)) as made:
        yield made


@pytest.fixture
def page(qtbot: QtBot, rigged: Session, theme: Theme) -> Iterator[CalibratePage]:
    with in_view(qtbot, CalibratePage(rigged, theme)) as made:
        yield made
    qtbot.waitUntil(lambda: all(one.name != "outlook" for one in threading.enumerate()), timeout=LONG_MS)


def _connect(qtbot: QtBot, session: Session, source: FrozenSource) -> None:
    session.source.choose(source)
    qtbot.waitUntil(lambda: not session.source.opening, timeout=LONG_MS)
    qtbot.waitUntil(lambda: all(one.frames > 1 for one in session.connected.health.values()), timeout=LONG_MS)


def _calibrate(qtbot: QtBot, session: Session, page: CalibratePage) -> None:
    qtbot.waitUntil(page.calibrate_action.isEnabled, timeout=LONG_MS)
    page.calibrate_action.trigger()
    qtbot.waitUntil(lambda: bool(session.tasks.running))
    qtbot.waitUntil(lambda: not session.tasks.running, timeout=LONG_MS)


def test_without_sensors_it_says_where_to_go(page: CalibratePage) -> None:
    wanted: list[object] = []
    page.step_wanted.connect(wanted.append)
    assert page.nothing.isVisible()
    assert page.main_action is page.way_to(Step.CONNECT)
    page.way_to(Step.CONNECT).trigger()
    assert wanted == [Step.CONNECT]


def test_while_a_sensor_gives_no_pictures_the_way_to_it_is_offered(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource, monkeypatch: pytest.MonkeyPatch
) -> None:
    _connect(qtbot, rigged, rig)
    qtbot.waitUntil(page.calibrate_action.isEnabled, timeout=LONG_MS)
    assert page.way_to(Step.CONNECT) not in page.other_actions
    monkeypatch.setattr(Feed, "newest", lambda *_: None)
    rigged.connected.health_changed.emit()
    assert not page.calibrate_action.isEnabled()
    assert page.way_to(Step.CONNECT) in page.other_actions
    assert "Connect" in page.hint


def test_a_sensor_that_failed_after_its_first_pictures_is_no_sensor_to_calibrate(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, rig)
    qtbot.waitUntil(page.calibrate_action.isEnabled, timeout=LONG_MS)
    rig.sensors[1].broken.set()
    try:
        qtbot.waitUntil(lambda: not page.calibrate_action.isEnabled(), timeout=LONG_MS)
        assert page.way_to(Step.CONNECT) in page.other_actions
    finally:
        rig.sensors[1].broken.clear()
    qtbot.waitUntil(page.calibrate_action.isEnabled, timeout=LONG_MS)


def test_the_meter_tells_what_the_sensors_have_in_common(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, rig)
    assert page.prepare.isVisible()
    qtbot.waitUntil(lambda: "plenty" in page.prepare.sentence.text(), timeout=LONG_MS)
    assert [link.health for link in page.prepare.graph.links] == ["good"]
    watch = page.outlook.watch
    assert watch is not None
    page.left()
    assert page.outlook.watch is None
    qtbot.waitUntil(lambda: not watch.running, timeout=LONG_MS)


def test_calibrating_shows_how_good_it_is_and_is_kept_only_when_told(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, rig)
    _calibrate(qtbot, rigged, page)
    assert page.result.isVisible()
    assert page.result.word.text() in ("Good", "Usable")
    assert [link.figure != "" for link in page.result.graph.links] == [True]
    assert len(page.result.cloud.flat.clouds) == 2
    assert rigged.station is None, "nothing is kept before a person says so"
    assert page.main_action is page.keep_action
    page.keep_action.trigger()
    assert rigged.station is not None
    qtbot.waitUntil(lambda: not rigged.saving, timeout=LONG_MS)
    assert rigged.workspace.station.load().value is not None
    assert rigged.states()[Step.CALIBRATE].state is State.DONE
    assert page.main_action is page.way_to(Step.BELT)
    assert page.result.word.text() in ("Good", "Usable")


def test_the_cloud_is_drawn_beside_the_window_and_what_was_shown_stays_meanwhile(qtbot: QtBot, theme: Theme) -> None:
    flat = FlatCloud(theme)
    qtbot.addWidget(flat)
    flat.resize(400, 300)
    flat.show()
    bare = flat.grab().toImage()
    asked, points_m = [], np.random.default_rng(1).uniform(-0.4, 0.4, (3000, 3)).astype(np.float32)
    cloud = SensorCloud("a", points_m * np.float32(0.3), points_m, np.zeros((3000, 3), np.uint8))
    flat.show_clouds([cloud])
    after = _drawn(qtbot, flat)
    assert after != bare
    gate = threading.Event()
    flat.queries.ask("held up", lambda: asked.append(gate.wait(LONG_MS / 1e3)), lambda _: None)
    flat.look(Side.TOP, after=False)
    assert flat.grab().toImage() == after, "nothing flickers while the other picture is made"
    assert not flat.drawn
    gate.set()
    assert _drawn(qtbot, flat) not in (bare, after)
    assert asked == [True]


def test_before_after_side_and_fade_change_the_picture(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, rig)
    _calibrate(qtbot, rigged, page)
    cloud = page.result.cloud
    pictures = [_drawn(qtbot, cloud.flat)]
    for change in (
        cloud.when[False].click,
        cloud.when[True].click,
        cloud.sides[Side.SIDE].click,
        lambda: cloud.fade.setValue(0),
        lambda: cloud.fade.setValue(cloud.fade.maximum()),
    ):
        change()
        pictures.append(_drawn(qtbot, cloud.flat))
    assert pictures[0] == pictures[2]
    assert all(pictures[one] != pictures[one + 1] for one in range(len(pictures) - 1))
    assert not cloud.all.isChecked(), "who slides wants to see one or two, not all"


def test_a_calibration_can_be_discarded_and_a_kept_one_taken_back(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, rig)
    _calibrate(qtbot, rigged, page)
    page.discard_action.trigger()
    assert rigged.station is None
    assert page.prepare.isVisible()
    _calibrate(qtbot, rigged, page)
    page.keep_action.trigger()
    first = rigged.station
    page.again_action.trigger()
    assert page.prepare.isVisible()
    assert rigged.station is first, "it stays in use until another is kept"
    _calibrate(qtbot, rigged, page)
    page.keep_action.trigger()
    qtbot.waitUntil(lambda: not rigged.saving, timeout=LONG_MS)
    undo = rigged.messages.history[-1].act
    assert undo is not None
    undo()
    qtbot.waitUntil(lambda: not rigged.saving, timeout=LONG_MS)
    taken = rigged.station
    assert taken is not None
    assert first is not None
    assert taken.sensors["kinect_2"].pose.translation_m == pytest.approx(first.sensors["kinect_2"].pose.translation_m)
    qtbot.waitUntil(lambda: not rigged.tasks.running, timeout=LONG_MS)


def test_a_refusal_shows_what_was_seen_and_what_to_put_where(
    qtbot: QtBot, rigged: Session, page: CalibratePage, bare: FrozenSource
) -> None:
    _connect(qtbot, rigged, bare)
    _calibrate(qtbot, rigged, page)
    assert page.refused.isVisible()
    assert page.refused.cards
    assert rigged.station is None
    assert page.main_action is page.calibrate_action
    page.back_action.trigger()
    assert page.prepare.isVisible()


def test_it_can_be_stopped_and_nothing_is_changed(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, rig)
    page.calibrate_action.trigger()
    task = rigged.tasks.running[0]
    qtbot.waitUntil(lambda: task.running)
    task.cancel()
    qtbot.waitUntil(lambda: not rigged.tasks.running, timeout=LONG_MS)
    assert rigged.messages.history[-1].what == "Calibrating was stopped; nothing was changed."
    assert page.prepare.isVisible()
    assert page.calibrate_action.isEnabled()


def test_a_station_that_was_kept_is_shown_with_what_the_sensors_see_now(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource, theme: Theme
) -> None:
    _connect(qtbot, rigged, rig)
    _calibrate(qtbot, rigged, page)
    page.keep_action.trigger()
    other = CalibratePage(rigged, theme)
    qtbot.addWidget(other)
    other.show()
    other.entered()
    qtbot.waitUntil(lambda: len(other.result.cloud.flat.clouds) == 2, timeout=LONG_MS)
    assert other.result.word.text() == page.result.word.text()
    assert not other.result.cloud.when[True].isVisible(), "there is no before"
    other.left()


def test_everything_that_is_pressed_is_large_enough_for_a_glove(
    qtbot: QtBot, rigged: Session, page: CalibratePage, rig: FrozenSource
) -> None:
    _connect(qtbot, rigged, rig)
    page.prepare.switch.show()
    _calibrate(qtbot, rigged, page)
    shown = [one for one in page.findChildren(QAbstractButton) if one.isVisible()]
    assert [one.accessibleName() for one in shown if min(one.height(), one.width()) < 40] == []
    assert all(one.accessibleName() for one in shown)


def _drawn(qtbot: QtBot, flat: FlatCloud) -> QImage:
    """Return how it looks, once what it misses is made."""
    flat.grab()
    qtbot.waitUntil(lambda: flat.drawn, timeout=LONG_MS)
    return flat.grab().toImage()
