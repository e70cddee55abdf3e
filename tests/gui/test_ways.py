"""No screen ends without a way on: whatever is missing, it says so and a button leads there."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from fruitgui.gui.pages import page_maker
from fruitgui.gui.session import Session
from fruitgui.gui.step_words import way_words
from fruitgui.gui.steps.belt.page import BeltPage
from fruitgui.gui.steps.calibrate.page import CalibratePage
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.live.page import LivePage
from fruitgui.gui.steps.page import MAIN_KEY, StepPage
from fruitgui.gui.steps.teach.page import TeachPage
from fruitgui.gui.steps.train.page import TrainPage
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.ways import at_root, ways_on
from fruitgui.records.lot import LotPlan
from fruitgui.station.connection import connection_to
from fruitgui.station.connection_changes import referred_to
from fruitgui.station.sources import RecordedSource
from fruitgui.station.workflow import READY, Facts, State, Step, StepState, TaughtFacts, Why, step_states
from tests.gui.line_recording import LineRecording, line_recording

LONG_MS = 120_000

pytestmark = pytest.mark.xdist_group("live page")

Happen = Callable[[Session, LineRecording], None]


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> LineRecording:
    return line_recording(tmp_path_factory)


@pytest.fixture
def made(qtbot: QtBot, session: Session, theme: Theme) -> Iterator[Callable[[Step], StepPage]]:
    pages: list[StepPage] = []

    def make(step: Step) -> StepPage:
        page = page_maker(step)(session, theme)
        qtbot.addWidget(page)
        pages.append(page)
        page.resize(1072, 580)
        page.show()
        page.entered()
        return page

    yield make
    for page in pages:
        page.left()


def _offered(page: StepPage) -> list[str]:
    """Return what can be pressed in the action bar, the main action first."""
    actions = [one for one in (page.main_action, *page.other_actions) if one is not None]
    return [one.text() for one in actions if one.isEnabled() and one.isVisible()]


def _nothing(_session: Session, _recorded: LineRecording) -> None:
    """Nothing was done yet."""


def _only_connected(session: Session, recorded: LineRecording) -> None:
    source = RecordedSource(recorded.path, speed=0.0)
    session.save_connection(connection_to(source.value(), source.connect().sensors))
    session.start_sensors()


def _all_set_up(session: Session, recorded: LineRecording) -> None:
    recorded.set_up(session)


def _recording_gone(session: Session, recorded: LineRecording) -> None:
    """What the line is connected to cannot be opened any more."""
    recorded.set_up(session)
    connection = session.connection
    assert connection is not None
    session.save_connection(connection.model_copy(update={"source": {**connection.source, "path": "/gone/line.mcap"}}))
    session.start_sensors()


def _calibration_old(session: Session, recorded: LineRecording) -> None:
    recorded.set_up(session)
    connection = session.connection
    assert connection is not None
    other = next(one.name for one in connection.sensors if one.name != recorded.station.reference)
    # Played again and again: one that is over is no longer calibrated.
    source = {**connection.source, "looped": True}
    session.save_connection(referred_to(connection, other).model_copy(update={"source": source}))
    session.start_sensors()


def _belt_old(session: Session, recorded: LineRecording) -> None:
    recorded.set_up(session)
    session.save_marks(session.marks.model_copy(update={"belt_calibration": "another"}))


def _lot_left_open(session: Session, recorded: LineRecording) -> None:
    _recording_gone(session, recorded)
    session.running.lot = session.store.lots.start(LotPlan("1184", "", "", "", "kinect_1", None, None))
    session.running.changed.emit()


def _one_kind(session: Session, recorded: LineRecording) -> None:
    recorded.set_up(session)
    session.note_taught(TaughtFacts("f", {"lemon": (60, 12)}))


@pytest.mark.parametrize("step", list(Step))
@pytest.mark.parametrize(
    "happen",
    [_nothing, _only_connected, _all_set_up, _recording_gone, _calibration_old, _belt_old, _lot_left_open, _one_kind],
)
def test_every_screen_in_every_state_says_what_to_do_and_lets_it_be_done(
    qtbot: QtBot,
    session: Session,
    recorded: LineRecording,
    made: Callable[[Step], StepPage],
    happen: Happen,
    step: Step,
) -> None:
    page = made(step)
    happen(session, recorded)
    qtbot.waitUntil(lambda: not session.tasks.running and not session.saving, timeout=LONG_MS)
    if isinstance(page, ConnectPage) and happen is _nothing:
        page.chooser.rows[-1].click()
    assert page.hint
    assert _offered(page), f"{page.hint} But nothing can be pressed."
    states = session.states()
    leads = {way_words(one)[0] for state in (states[step], at_root(step, states)) for one in ways_on(state)[:1]}
    if states[step].state is State.TO_DO:
        assert leads & set(_offered(page)), f"{page.hint} But nothing leads there."
    page.left()
    qtbot.waitUntil(lambda: not session.tasks.running, timeout=LONG_MS)


def test_the_live_screen_leads_to_what_is_missing_one_after_the_other(
    qtbot: QtBot, session: Session, recorded: LineRecording, made: Callable[[Step], StepPage]
) -> None:
    page = made(Step.LIVE)
    assert isinstance(page, LivePage)
    wanted: list[Step] = []
    page.step_wanted.connect(wanted.append)
    assert page.main_action is page.way_to(Step.CONNECT)
    assert page.hint == "First finish the step “Connect”."
    page.way_to(Step.CONNECT).trigger()
    _only_connected(session, recorded)
    qtbot.waitUntil(lambda: session.connected.feed is not None and not session.tasks.running, timeout=LONG_MS)
    assert page.main_action is page.way_to(Step.CALIBRATE)
    page.way_to(Step.CALIBRATE).trigger()
    session.save_station(recorded.station)
    qtbot.waitUntil(lambda: page.main_action is page.way_to(Step.BELT), timeout=LONG_MS)
    recorded.set_up(session)
    qtbot.waitUntil(lambda: session.connected.feed is not None and not session.tasks.running, timeout=LONG_MS)
    assert page.main_action is page.start
    assert "unknown" in page.hint, "it says that there is no model"
    assert page.way_to(Step.TRAIN) in page.other_actions
    assert wanted == [Step.CONNECT, Step.CALIBRATE]


def test_sensors_that_could_not_be_started_are_started_again_by_a_press(
    qtbot: QtBot, session: Session, recorded: LineRecording, made: Callable[[Step], StepPage], tmp_path: Path
) -> None:
    page = made(Step.CONNECT)
    assert isinstance(page, ConnectPage)
    moved = tmp_path / "moved.mcap"
    recorded.set_up(session)
    connection = session.connection
    assert connection is not None
    session.save_connection(connection.model_copy(update={"source": {**connection.source, "path": str(moved)}}))
    session.start_sensors()
    qtbot.waitUntil(lambda: session.source.failure is not None and not session.source.opening, timeout=LONG_MS)
    assert page.main_action is page.start_action
    assert "moved.mcap" in page.hint
    shutil.copy(recorded.path, moved)
    page.start_action.trigger()
    qtbot.waitUntil(lambda: session.source.failure is None and not session.source.opening, timeout=LONG_MS)
    assert session.connected.feed is not None


def test_a_recording_at_its_end_is_started_again_by_a_press(
    qtbot: QtBot, session: Session, recorded: LineRecording, made: Callable[[Step], StepPage]
) -> None:
    page = made(Step.CONNECT)
    assert isinstance(page, ConnectPage)
    recorded.set_up(session)
    qtbot.waitUntil(lambda: page.main_action is page.start_action, timeout=LONG_MS)
    assert page.hint == "The recording is over. Start it again, or connect another source."
    feed = session.connected.feed
    page.start_action.trigger()
    qtbot.waitUntil(lambda: session.connected.feed not in (feed, None), timeout=LONG_MS)


def test_sensors_that_were_stopped_are_told_and_started_again(
    qtbot: QtBot, session: Session, recorded: LineRecording, made: Callable[[Step], StepPage]
) -> None:
    live, connect = made(Step.LIVE), made(Step.CONNECT)
    assert isinstance(live, LivePage)
    assert isinstance(connect, ConnectPage)
    recorded.set_up(session)
    qtbot.waitUntil(lambda: session.connected.feed is not None and not session.tasks.running, timeout=LONG_MS)
    assert live.start.isEnabled()
    session.connected.stop()
    assert not live.start.isEnabled(), "a press would do nothing"
    assert live.hint == "No sensor runs: start them again."
    assert live.way_to(Step.CONNECT) in live.other_actions
    assert connect.main_action is connect.start_action
    assert connect.hint.startswith("No sensor runs.")
    connect.start_action.trigger()
    qtbot.waitUntil(live.start.isEnabled, timeout=LONG_MS)


def test_a_calibration_that_holds_no_more_is_told_where_it_is_mended(
    qtbot: QtBot, session: Session, recorded: LineRecording, made: Callable[[Step], StepPage]
) -> None:
    calibrate, belt = made(Step.CALIBRATE), made(Step.BELT)
    assert isinstance(calibrate, CalibratePage)
    assert isinstance(belt, BeltPage)
    _calibration_old(session, recorded)
    qtbot.waitUntil(lambda: session.states()[Step.CALIBRATE].state is State.REDO, timeout=LONG_MS)
    qtbot.waitUntil(lambda: not session.tasks.running and calibrate.calibrate_action.isEnabled(), timeout=LONG_MS)
    assert calibrate.hint.startswith("Another sensor is the reference now")
    assert belt.main_action is belt.way_to(Step.CALIBRATE)
    assert belt.hint.startswith("Another sensor is the reference now")


def test_teaching_leads_to_sensors_calibration_and_the_line(
    qtbot: QtBot, session: Session, recorded: LineRecording, made: Callable[[Step], StepPage]
) -> None:
    page = made(Step.TEACH)
    assert isinstance(page, TeachPage)
    assert page.main_action is page.way_to(Step.CONNECT)
    assert page.hint == "First finish the step “Connect”."
    _recording_gone(session, recorded)
    qtbot.waitUntil(lambda: session.source.failure is not None and not session.source.opening, timeout=LONG_MS)
    assert page.way_to(Step.CONNECT) in page.other_actions
    assert "connect them" in page.hint


def test_one_kind_is_not_trained_on_but_another_taught(
    session: Session, recorded: LineRecording, made: Callable[[Step], StepPage]
) -> None:
    page = made(Step.TRAIN)
    assert isinstance(page, TrainPage)
    _one_kind(session, recorded)
    assert page.main_action is page.way_to(Step.TEACH)
    assert page.hint == "Teach at least two kinds first."
    assert not page.train.isEnabled()


def test_only_the_main_way_has_a_key(made: Callable[[Step], StepPage]) -> None:
    page = made(Step.LOTS)
    live, connect = page.way_to(Step.LIVE), page.way_to(Step.CONNECT)
    page.offer(live, connect)
    assert (live.shortcut().toString(), connect.shortcut().toString()) == (MAIN_KEY, "")
    page.offer(connect, live)
    assert (live.shortcut().toString(), connect.shortcut().toString()) == ("", MAIN_KEY)


def test_ways_lead_to_what_mends_it() -> None:
    states = step_states(Facts())
    assert {step: ways_on(state) for step, state in states.items() if state.state is State.TO_DO} == {
        Step.CALIBRATE: (Step.CONNECT,), Step.BELT: (Step.CALIBRATE,), Step.TEACH: (Step.BELT,),
        Step.TRAIN: (Step.TEACH,), Step.LIVE: (Step.CONNECT,), Step.LOTS: (Step.LIVE,),
    }  # fmt: skip
    roots = {step: ways_on(at_root(step, states)) for step in Step}
    assert {roots[step] for step in (Step.CALIBRATE, Step.BELT, Step.TEACH, Step.LIVE, Step.LOTS)} == {(Step.CONNECT,)}
    assert ways_on(READY) == ()
    both = (Why("no_model"), Why("sensors_missing", {"sensors": ("left_1",)}))
    assert ways_on(StepState(State.READY, None, both)) == (Step.TRAIN, Step.CONNECT)
