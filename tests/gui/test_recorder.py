"""Recording from the window: asked for, seen, stopped and kept, and found again among what can be connected."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton
from pytestqt.qtbot import QtBot

from fruitgui.gui.messages import Level
from fruitgui.gui.pills import recording_pill
from fruitgui.gui.recorder_words import clock_time, recorded_message, room_text, size_text
from fruitgui.gui.session import Session
from fruitgui.gui.shots.frozen import FrozenSource, frozen_source, frozen_sources
from fruitgui.gui.steps.connect.offers import RECORDING, SIMULATED
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.connect.record_dialog import RecordDialog
from fruitgui.gui.theme.theme import Theme
from fruitgui.sensors.recordings import open_recording
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.record_state import Ending, Recorded, RecordPlan, RecordState, Silence
from fruitgui.station.recordings_made import recording_path, recordings_made
from fruitgui.station.sources import RecordedSource
from fruitgui.station.workspace import open_workspace
from tests.gui.opened import session_on

WAIT_MS = 30_000


@pytest.fixture(scope="module")
def rendered() -> FrozenSource:
    return frozen_source(still_scene(3, "opposed", 4, captures=2), shown_as=SIMULATED)


@pytest.fixture
def session(qtbot: QtBot, tmp_path: Path, rendered: FrozenSource) -> Iterator[Session]:
    for sensor in rendered.sensors:
        sensor.silent.clear()
        sensor.broken.clear()
    with session_on(qtbot, tmp_path / "line", frozen_sources(rendered)) as made:
        yield made


@pytest.fixture
def page(qtbot: QtBot, session: Session, theme: Theme) -> ConnectPage:
    made = ConnectPage(session, theme)
    qtbot.addWidget(made)
    made.resize(1072, 580)
    made.show()
    made.entered()
    qtbot.mouseClick(next(row for row in made.chooser.rows if row.offer.key == SIMULATED), Qt.MouseButton.LeftButton)
    made.connect_action.trigger()
    qtbot.waitUntil(lambda: session.connected.feed is not None, timeout=WAIT_MS)
    qtbot.waitUntil(lambda: all(view.condition.health == "good" for view in made.views()), timeout=WAIT_MS)
    return made


def _ask(page: ConnectPage) -> RecordDialog:
    page.recording.action.trigger()
    dialog = page.recording.dialog
    assert dialog is not None
    return dialog


def _ended(qtbot: QtBot, session: Session) -> None:
    qtbot.waitUntil(lambda: session.recorder.plan is None, timeout=WAIT_MS)


def test_recorded_stopped_kept_and_found_again(qtbot: QtBot, session: Session, page: ConnectPage) -> None:
    assert not page.recording.card.isVisible()
    dialog = _ask(page)
    assert dialog.seconds is None
    dialog.name.setText("oranges morning/1")
    dialog.accept()
    path = session.recorder.folder / "oranges-morning-1.mcap"
    assert page.recording.card.isVisible()
    assert not page.recording.action.isEnabled()
    assert not page.change_action.isEnabled(), "the sensors stay as they are"
    assert "being recorded" in page.hint
    qtbot.waitUntil(
        lambda: (state := session.recorder.state) is not None and min(state.frames.values()) >= 3, timeout=WAIT_MS
    )
    assert "MB free" in page.recording.card._room.text() or "GB free" in page.recording.card._room.text()
    qtbot.mouseClick(page.recording.card.stop, Qt.MouseButton.LeftButton)
    _ended(qtbot, session)
    assert not page.recording.card.isVisible()
    assert page.recording.action.isEnabled()
    said = session.messages.history[-1]
    assert said.level is Level.GOOD
    assert "oranges-morning-1 is recorded" in said.what
    frames = [frame for _, frame in open_recording(path).frames()]
    assert {frame.sensor for frame in frames} == {"kinect_1", "kinect_2"}
    page.change_action.trigger()
    qtbot.mouseClick(next(row for row in page.chooser.rows if row.offer.key == RECORDING), Qt.MouseButton.LeftButton)
    listed = page.chooser.form.made.list
    assert listed.isVisible()
    assert listed.count() == 1
    item = listed.item(0)
    assert item.text().startswith("oranges-morning-1\n")
    qtbot.mouseClick(listed.viewport(), Qt.MouseButton.LeftButton, pos=listed.visualItemRect(item).center())
    assert page.chooser.source == RecordedSource(path, looped=True)
    assert page.chooser.form._file_name.text() == path.name
    page.connect_action.trigger()
    qtbot.waitUntil(lambda: not session.source.opening, timeout=WAIT_MS)
    feed = session.connected.feed
    assert feed is not None
    qtbot.waitUntil(lambda: feed.health("kinect_1").frames > 0, timeout=WAIT_MS)


def test_it_ends_by_itself_after_the_length_that_was_chosen(qtbot: QtBot, session: Session, page: ConnectPage) -> None:
    dialog = _ask(page)
    dialog.length.setCurrentIndex(dialog.length.findData(10.0))
    assert dialog.seconds == 10.0
    dialog.reject()
    session.recorder.start("short", 0.7)
    assert page.recording.card._bar.isVisible()
    _ended(qtbot, session)
    assert session.messages.history[-1].level is Level.GOOD
    assert (session.recorder.folder / "short.mcap").exists()


def test_a_name_that_is_taken_gets_a_number_and_nothing_is_written_over(tmp_path: Path) -> None:
    first = recording_path(tmp_path, "a b")
    assert first.name == "a-b.mcap"
    first.touch()
    assert recording_path(tmp_path, "a b").name == "a-b-2.mcap"
    (tmp_path / "a-b-2.mcap.part").touch()
    assert recording_path(tmp_path, "a b").name == "a-b-3.mcap"
    assert recording_path(tmp_path, "../..").name == "recordings.mcap"


def test_closing_the_window_ends_a_recording_and_keeps_it(qtbot: QtBot, tmp_path: Path, rendered: FrozenSource) -> None:
    session = Session(open_workspace(tmp_path / "line"), sources=frozen_sources(rendered))
    session.source.choose(rendered)
    qtbot.waitUntil(lambda: session.connected.feed is not None, timeout=WAIT_MS)
    session.recorder.start("last", None)
    qtbot.waitUntil(
        lambda: (state := session.recorder.state) is not None and sum(state.frames.values()) >= 4, timeout=WAIT_MS
    )
    assert session.close()
    session.deleteLater()
    assert len(list(open_recording(tmp_path / "line" / "recordings" / "last.mcap").frames())) >= 4


def test_what_cannot_be_recorded_is_said(qtbot: QtBot, session: Session, page: ConnectPage) -> None:
    session.recorder.folder.write_text("no folder")
    session.recorder.start("a", None)
    assert session.messages.history[-1].level is Level.BAD
    assert session.recorder.plan is None
    assert not page.recording.recording
    session.connected.stop()
    session.recorder.folder.unlink()
    session.recorder.start("a", None)
    assert session.recorder.plan is None, "nothing runs"
    qtbot.waitUntil(lambda: not page.recording.action.isEnabled())


def test_a_disk_without_room_lets_nobody_begin(qtbot: QtBot, theme: Theme) -> None:
    assert theme.name == "dark"
    dialog = RecordDialog("a", 0, "/there")
    qtbot.addWidget(dialog)
    start = next(button for button in dialog.findChildren(QPushButton) if button.text() == "Record")
    assert not start.isEnabled()
    dialog.show_room(10**9, "/there")
    assert start.isEnabled()
    dialog.name.setText(" ")
    assert not start.isEnabled()


def test_recordings_are_listed_with_their_parts_and_what_was_cut_off(tmp_path: Path) -> None:
    for name, size, made_s in (
        ("lemons.mcap", 10, 3.0), ("lemons_0002.mcap", 20, 4.0), ("lemons_0003.mcap.part", 5, 5.0),
        ("cut.mcap.part", 7, 9.0), ("alone_0002.mcap", 8, 1.0), ("now.mcap.part", 1, 10.0), ("note.txt", 1, 0.0),
    ):  # fmt: skip
        (tmp_path / name).write_bytes(bytes(size))
        os.utime(tmp_path / name, (made_s, made_s))
    made = recordings_made(tmp_path, tmp_path / "now.mcap")
    assert [(one.name, one.size, one.parts, one.cut_off) for one in made] == [
        ("cut", 7, 1, True), ("lemons", 35, 3, True), ("alone_0002", 8, 1, False)
    ]  # fmt: skip
    assert recordings_made(tmp_path / "nowhere") == []


def test_what_went_wrong_with_a_recording_is_said_in_words() -> None:
    good = Recorded((Path("a.mcap"),), {"k1": 10}, 3.0, bytes_written=5_000_000)
    assert recorded_message(good) == ("a is recorded: 3\u2009s, 5\u2009MB.", "", True)
    bad = Recorded(
        (Path("a.mcap"),),
        {"k1": 10},
        3.0,
        Ending.DISK_FULL,
        {"k1": 2},
        {"k1": 7},
        (Silence("k2", 1.0),),
        bytes_written=2 * 10**9,
    )
    what, problems, fine = recorded_message(bad)
    assert not fine
    assert all(
        word in problems
        for word in ("disk is nearly full", "2 pictures were lost", "7 pictures did not come whole", "k2")
    )
    assert "2.0\u2009GB" in what


def test_times_and_sizes_are_those_of_people() -> None:
    assert [clock_time(one) for one in (0.0, 59.9, 61.0, 3661.0)] == ["0:00", "0:59", "1:01", "1:01:01"]
    assert size_text(1.5e9) == "1.5\u2009GB"
    plan = RecordPlan(Path("a.mcap"), 60.0)
    state = RecordState(74.0, 0.5, {"k1": 1}, {}, ("k2",), 10**6, 1, 10**10, 7200.0)
    assert room_text(state) == "10.0\u2009GB free, enough for 2\u2009h 0\u2009min"
    assert (recording_pill(plan, state).text, recording_pill(plan, state).health) == ("1:14", "warn")
    assert recording_pill(plan, None).health == "good"
