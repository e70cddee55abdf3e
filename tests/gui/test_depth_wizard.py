"""Correcting a sensor's depth in the window: belt, box, ball, belt from higher, result; kept, undone, taken away."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QLabel
from pytestqt.qtbot import QtBot

from fruitgui.calibration.depth.measured import LEAST_RAISED_M, DepthReason, RaisedBoard
from fruitgui.calibration.depth.seeing import see_belt
from fruitgui.calibration.light_drift import LightDrift
from fruitgui.calibration.still import average
from fruitgui.calibration.warmup import Warmth, Warmup
from fruitgui.gui.session import Session
from fruitgui.gui.shots.depth_bench import (
    BALL_M,
    BIASED,
    BOX_M,
    RAISE_M,
    DepthBench,
    bench_distance_m,
    bench_frames,
    frozen_bench,
)
from fruitgui.gui.shots.frozen import frozen_sources
from fruitgui.gui.steps.connect.depth.course import Course, Stage, Typed
from fruitgui.gui.steps.connect.depth.outlook_label import OutlookLabel
from fruitgui.gui.steps.connect.depth.reason_words import reason_words
from fruitgui.gui.steps.connect.depth.wizard import DepthWizard
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.connect.steady_words import correction_text, light, warmth
from fruitgui.gui.steps.connect.words import colour_lock
from fruitgui.gui.theme.theme import Theme
from fruitgui.sensors.sensor import ColorLock
from fruitgui.simulation.depth_bench import depth_bench
from fruitgui.station.depth_watch import Looked
from fruitgui.station.depths import DeviceDepth
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.steadiness import Steadiness
from fruitgui.station.workflow import State, Step
from tests.gui.opened import in_view, session_on

LONG_MS = 60_000
TYPED = Typed(round(1e3 * bench_distance_m()), 1e3 * BOX_M, 1e3 * BALL_M, 1e3 * RAISE_M)


@pytest.fixture
def bench() -> DepthBench:
    return frozen_bench()


@pytest.fixture
def benched(qtbot: QtBot, tmp_path: Path, bench: DepthBench) -> Iterator[Session]:
    with session_on(qtbot, tmp_path / "line", frozen_sources(bench.source)) as made:
        made.source.choose(bench.source)
        qtbot.waitUntil(lambda: bool(made.connected.health) and not made.source.opening, timeout=LONG_MS)
        qtbot.waitUntil(lambda: all(one.frames > 2 for one in made.connected.health.values()), timeout=LONG_MS)
        yield made


@pytest.fixture
def page(qtbot: QtBot, benched: Session, theme: Theme) -> Iterator[ConnectPage]:
    with in_view(qtbot, ConnectPage(benched, theme)) as made:
        yield made


def _begin(qtbot: QtBot, page: ConnectPage, typed: Typed = TYPED) -> DepthWizard:
    button = page.details.buttons["depth"]
    qtbot.waitUntil(button.isEnabled, timeout=LONG_MS)
    qtbot.mouseClick(button, Qt.MouseButton.LeftButton)
    wizard = page.depth_wizard
    assert wizard.course is not None
    wizard.panel.show_typed(typed)
    return wizard


def _take(qtbot: QtBot, wizard: DepthWizard, bench: DepthBench, what: Looked) -> None:
    bench.lay(what)
    qtbot.waitUntil(wizard.choices.take.isEnabled, timeout=LONG_MS)
    assert wizard.course is not None
    before = wizard.course.stage
    wizard.choices.take.trigger()
    qtbot.waitUntil(lambda: wizard.course is not None and wizard.course.stage is not before, timeout=LONG_MS)


def _measure(qtbot: QtBot, page: ConnectPage, bench: DepthBench, typed: Typed = TYPED) -> DepthWizard:
    wizard = _begin(qtbot, page, typed)
    for what in Looked:
        _take(qtbot, wizard, bench, what)
    qtbot.waitUntil(lambda: wizard.course is not None and wizard.course.outcome is not None, timeout=LONG_MS)
    qtbot.waitUntil(lambda: page.main_action in (wizard.choices.keep, wizard.choices.again), timeout=LONG_MS)
    return wizard


def test_belt_box_and_ball_make_a_correction_that_is_kept_undone_and_taken_away(
    qtbot: QtBot, benched: Session, page: ConnectPage, bench: DepthBench
) -> None:
    mount = depth_bench(0, 21, BIASED).rig().mounts["kinect_1"]
    serial = bench.source.sensors[0].info.serial
    benched.save_station(Station("kinect_1", {"kinect_1": StationSensor(serial, mount.pose, mount.surface)}))
    assert benched.states()[Step.CALIBRATE].state is State.DONE
    wizard = _measure(qtbot, page, bench)
    assert wizard.course is not None
    fit = wizard.course.fit
    assert fit is not None
    told = {one.what: one for one in fit.figures}
    assert abs(told["ball"].after_m - BALL_M) < 0.001
    assert abs(told["raised"].after_m - RAISE_M) < 0.002 < abs(told["raised"].before_m - RAISE_M)
    assert page.main_action is wizard.choices.keep
    wizard.choices.keep.trigger()
    assert wizard.course is None
    assert page.main_action is page.calibrate_action, "back at the sensors"
    qtbot.waitUntil(lambda: not benched.saving)
    kept = benched.workspace.depths.load().value
    assert kept is not None
    known = kept.of(serial, "any name")
    assert known is not None
    assert known.depth_correction() == fit.correction
    assert "±" in page.views()[0].correction
    assert benched.states()[Step.CALIBRATE].state is State.REDO
    undo = benched.messages.history[-1].act
    assert undo is not None
    undo()
    assert benched.depths.devices == {}
    assert benched.states()[Step.CALIBRATE].state is State.DONE
    benched.save_depths(kept)
    again = _begin(qtbot, page)
    assert again.choices.remove in page.other_actions
    again.choices.remove.trigger()
    assert benched.depths.of(serial, "") == DeviceDepth()
    assert benched.states()[Step.CALIBRATE].state is State.DONE, "the station was made without it"


def test_a_slip_of_the_pen_is_refused_and_going_back_keeps_nothing(
    qtbot: QtBot, benched: Session, page: ConnectPage, bench: DepthBench
) -> None:
    wizard = _measure(qtbot, page, bench, Typed(TYPED.distance_mm, 184.0, TYPED.diameter_mm))
    assert page.main_action is wizard.choices.again
    assert wizard.choices.keep not in page.other_actions
    assert wizard.result.word.text().startswith("This does not do yet")
    qtbot.waitUntil(lambda: any(text.endswith("Most in doubt: the height of the box.") for text in _shown(wizard)))
    wizard.choices.again.trigger()
    assert wizard.course is not None
    assert wizard.course.stage is Stage.BELT
    wizard.choices.back.trigger()
    assert wizard.course is None
    assert benched.depths.devices == {}


def test_the_preview_marks_what_is_found_and_says_what_is_not(
    qtbot: QtBot, page: ConnectPage, bench: DepthBench
) -> None:
    wizard = _begin(qtbot, page)
    panel = wizard.panel
    qtbot.waitUntil(lambda: panel.preview.found is not None, timeout=LONG_MS)
    assert panel.seen.text().startswith("The belt is seen")
    _take(qtbot, wizard, bench, Looked.BELT)
    qtbot.waitUntil(
        lambda: "not what is typed" in panel.seen.text() or "No flat lid" in panel.seen.text(), timeout=LONG_MS
    )
    assert not wizard.choices.take.isEnabled(), "rails are no box"
    bench.lay(Looked.BOARD)
    qtbot.waitUntil(lambda: panel.seen.text().startswith("The lid is seen"), timeout=LONG_MS)
    panel.show_typed(Typed(0.0, 400.0, 100.0))
    qtbot.waitUntil(lambda: "not what is typed" in panel.seen.text(), timeout=LONG_MS)
    wizard.choices.skip.trigger()
    assert wizard.course is not None
    assert wizard.course.stage is Stage.BALL
    bench.lay(Looked.BALL)
    qtbot.waitUntil(lambda: panel.seen.text().startswith("No ball of 100"), timeout=LONG_MS)
    panel.show_typed(TYPED)
    qtbot.waitUntil(lambda: panel.seen.text() == "The ball is seen.", timeout=LONG_MS)
    wizard.choices.back.trigger()


def _shown(wizard: DepthWizard) -> set[str]:
    return {one.text() for one in wizard.result.findChildren(QLabel) if one.isVisible()}


def _skip(wizard: DepthWizard, stage: Stage) -> None:
    assert wizard.choices.skip in wizard.actions_now
    wizard.choices.skip.trigger()
    assert wizard.course is not None
    assert wizard.course.stage is stage


def test_belt_from_two_heights_is_enough_and_less_is_not_offered(
    qtbot: QtBot, page: ConnectPage, bench: DepthBench
) -> None:
    wizard = _begin(qtbot, page)
    _take(qtbot, wizard, bench, Looked.BELT)
    _skip(wizard, Stage.BALL)
    _skip(wizard, Stage.RAISED)
    assert wizard.choices.skip not in wizard.actions_now, "one height alone tells nothing"
    _take(qtbot, wizard, bench, Looked.RAISED)
    qtbot.waitUntil(lambda: page.main_action is wizard.choices.keep, timeout=LONG_MS)
    assert wizard.course is not None
    fit = wizard.course.fit
    assert fit is not None
    assert fit.decided == ("scale", "offset_m", "radial_2")
    assert "put the sensor back" in page.hint
    said = {"How far the sensor was raised", "one height alone", "all of it"}
    qtbot.waitUntil(lambda: said <= _shown(wizard), timeout=LONG_MS)
    wizard.choices.higher.trigger()
    assert wizard.course.stage is Stage.RAISED
    assert wizard.choices.skip in wizard.actions_now, "one more height is not needed"
    wizard.choices.undo.trigger()
    assert wizard.course.fit is fit
    assert page.main_action is wizard.choices.keep


def test_a_second_height_that_does_not_do_is_said_and_cannot_be_taken(
    qtbot: QtBot, page: ConnectPage, bench: DepthBench
) -> None:
    wizard = _begin(qtbot, page)
    panel = wizard.panel
    _take(qtbot, wizard, bench, Looked.BELT)
    _skip(wizard, Stage.BALL)
    _skip(wizard, Stage.RAISED)
    qtbot.waitUntil(lambda: panel.seen.text() == "The sensor hangs where it was: raise it.", timeout=LONG_MS)
    assert not wizard.choices.take.isEnabled()
    bench.lay(Looked.RAISED)
    qtbot.waitUntil(wizard.choices.take.isEnabled, timeout=LONG_MS)
    assert panel.seen.text().startswith("The belt is seen about 30")
    for typed_mm, said in ((1e3 * LEAST_RAISED_M - 5.0, "too near to each other"), (450.0, "not what is typed")):
        panel.show_typed(replace(TYPED, raised_mm=typed_mm))
        qtbot.waitUntil(lambda said=said: said in panel.seen.text(), timeout=LONG_MS)  # type: ignore[misc]
        assert not wizard.choices.take.isEnabled()
    panel.show_typed(TYPED)
    dark = [replace(one, depth_mm=np.zeros_like(one.depth_mm)) for one in bench_frames(Looked.RAISED)]
    bench.source.sensors[0].frames = dark
    qtbot.waitUntil(lambda: panel.seen.text().startswith("The belt is not seen from there"), timeout=LONG_MS)
    assert not wizard.choices.take.isEnabled()
    wizard.end()


def test_who_lowers_the_sensor_is_told_to_begin_low(qtbot: QtBot, page: ConnectPage, bench: DepthBench) -> None:
    wizard = _begin(qtbot, page)
    assert "can only be lowered" in wizard.panel._rules.text()
    bench.lay(Looked.RAISED)  # hung so high at first
    qtbot.waitUntil(wizard.choices.take.isEnabled, timeout=LONG_MS)
    wizard.choices.take.trigger()
    qtbot.waitUntil(lambda: wizard.course is not None and wizard.course.stage is Stage.BOARD, timeout=LONG_MS)
    _skip(wizard, Stage.BALL)
    _skip(wizard, Stage.RAISED)
    bench.lay(Looked.BELT)
    qtbot.waitUntil(
        lambda: wizard.panel.seen.text().startswith("The sensor hangs lower than at first"), timeout=LONG_MS
    )
    assert not wizard.choices.take.isEnabled()
    wizard.end()


def test_every_step_can_be_undone_and_stopped(
    qtbot: QtBot, benched: Session, page: ConnectPage, bench: DepthBench
) -> None:
    wizard = _begin(qtbot, page)
    assert wizard.choices.undo not in wizard.actions_now
    _take(qtbot, wizard, bench, Looked.BELT)
    _take(qtbot, wizard, bench, Looked.BOARD)
    _skip(wizard, Stage.RAISED)
    bench.lay(Looked.RAISED)
    qtbot.waitUntil(wizard.choices.take.isEnabled, timeout=LONG_MS)
    for choice in (wizard.choices.take, wizard.choices.skip):
        choice.trigger()
        (task,) = benched.tasks.running
        task.cancel()
        qtbot.waitUntil(lambda: not benched.tasks.running, timeout=LONG_MS)
        assert wizard.course is not None
        assert (wizard.course.stage, wizard.course.raised) == (Stage.RAISED, ())
        assert page.main_action is wizard.choices.take
    for stage in (Stage.BALL, Stage.BOARD):
        wizard.choices.undo.trigger()
        assert wizard.course.stage is stage
    assert wizard.course.boards == ()
    assert wizard.course.belt is not None
    wizard.choices.undo.trigger()
    assert wizard.course.belt is None
    assert wizard.choices.undo not in wizard.actions_now
    wizard.end()


def test_what_a_raise_adds_is_said_before_a_person_climbs(qtbot: QtBot) -> None:
    belt, box = (average(list(bench_frames(what))) for what in (Looked.BELT, Looked.BOARD))
    seen = see_belt(belt)
    taken = Course("kinect_1").taken(belt, seen, TYPED).taken(box, None, TYPED)
    label = OutlookLabel()
    qtbot.addWidget(label)
    label.show_raise(300.0)
    label.show_course(taken)
    assert label.text() == "", "not at the stage of the ball"
    label.show_course(taken.passed())
    qtbot.waitUntil(lambda: label.text().startswith("Known so far: scale ±1.0"), timeout=LONG_MS)
    little = label.text()
    label.show_raise(900.0)
    assert label.text() != little
    wrong = replace(taken.passed(), boards=(RaisedBoard(box, 0.4),))
    label.show_course(wrong)
    qtbot.waitUntil(lambda: label.text().startswith("The box is not as high as was typed."), timeout=LONG_MS)


def test_it_rests_while_nobody_looks(qtbot: QtBot, page: ConnectPage) -> None:
    wizard = _begin(qtbot, page)
    qtbot.waitUntil(lambda: wizard._watch is not None and wizard._watch.newest is not None, timeout=LONG_MS)
    watch = wizard._watch
    assert watch is not None
    page.left()
    assert not wizard._draw.isActive()
    assert watch.wait(20.0)
    page.entered()
    assert wizard._draw.isActive()
    wizard.end()


def test_a_sensor_that_is_gone_can_be_measured_no_more(qtbot: QtBot, benched: Session, page: ConnectPage) -> None:
    wizard = _begin(qtbot, page)
    qtbot.waitUntil(wizard.choices.take.isEnabled, timeout=LONG_MS)
    benched.connected.stop()
    qtbot.waitUntil(lambda: not wizard.choices.take.isEnabled(), timeout=LONG_MS)
    wizard.choices.take.trigger()
    assert not benched.tasks.running
    wizard.end()


def test_everything_that_is_pressed_is_large_enough_for_a_glove(qtbot: QtBot, page: ConnectPage) -> None:
    wizard = _begin(qtbot, page)
    shown = [one for one in wizard.findChildren(QAbstractButton) if one.isVisible()]
    assert shown
    assert [one.accessibleName() for one in shown if min(one.height(), one.width()) < 40] == []
    keys = [one.shortcut().toString() for one in wizard.choices.children() if hasattr(one, "shortcut")]
    assert "" not in keys, "everything has a key"
    wizard.end()


@pytest.mark.parametrize(
    "code",
    ["belt_not_seen", "board_not_seen", "ball_not_seen", "not_flat", "scene_moved", "sensor_moved", "height_differs",
     "too_few_heights", "nothing_decided", "typed_disagrees", "implausible",
     "raised_belt_not_seen", "raised_too_little", "raised_differs"],
)  # fmt: skip
def test_every_reason_has_words_and_a_remedy(code: str) -> None:
    what, remedy = reason_words(DepthReason(code, "in the core's words", "in the core's words"))
    assert what
    assert remedy
    assert "core's words" not in what + remedy


def test_words_of_warming_up_and_of_light() -> None:
    drifting = Warmup(Warmth.DRIFTING, 400.0, 0.0, 0.002, 5e-6)
    steady = Warmup(Warmth.STEADY, 4000.0, 1500.0, 0.003, 1e-8)
    assert (warmth("devices", drifting).health, warmth("devices", steady).health) == ("warn", "good")
    assert "0.30" in warmth("devices", drifting).word
    assert "25" in warmth("devices", steady).word
    assert warmth("recording", drifting).health == ""
    assert light("devices", Steadiness()).health == ""
    for drift, health in (
        (LightDrift(1.0, 1.0, 1.0), "good"), (LightDrift(0.5, 1.0, 1.0), "warn"), (LightDrift(2.0, 1.0, 1.0), "warn"),
        (LightDrift(1.0, 1.3, 0.9), "warn"),
    ):  # fmt: skip
        assert light("devices", Steadiness(light=drift)).health == health
    assert [colour_lock("devices", one).health for one in ColorLock] == ["warn", "warn", "", "good"]
    assert colour_lock("recording", ColorLock.UNKNOWN).health == ""
    assert correction_text(None) == correction_text(DeviceDepth()) == "not corrected"
