"""Measuring the projectors in the window, on scripted sensors that settle and blind each other."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from fruitgui.gui.session import Session
from fruitgui.gui.shots.frozen import frozen_sources
from fruitgui.gui.steps.connect.page import ConnectPage
from fruitgui.gui.steps.connect.projectors.dialog import ProjectorsDialog
from fruitgui.gui.theme.theme import Theme
from fruitgui.station import projector_job
from fruitgui.station.projectors import Projectors
from fruitgui.station.sources import Connected, Make, Sources
from fruitgui.station.written import read_written
from tests.gui.opened import in_view, session_on
from tests.unit.sensors.lit_room import LitRoom, LitSensor

LONG_MS = 60_000


class LitSource:
    """Two scripted sensors as a source; follows `Source`."""

    kind = "lit"

    def __init__(self) -> None:
        self.room = LitRoom()
        self.sensors = [LitSensor(f"kinect_{one}", self.room, settle_s=0.04) for one in (1, 2)]

    def value(self) -> dict[str, Any]:
        return {"kind": self.kind}

    def connect(self) -> Connected:
        return Connected(list(self.sensors))


@pytest.fixture
def source() -> LitSource:
    return LitSource()


@pytest.fixture
def session(qtbot: QtBot, tmp_path: Path, source: LitSource) -> Iterator[Session]:
    makes = (*frozen_sources().makes, Make(source.kind, lambda: [source], lambda _value: source))
    with session_on(qtbot, tmp_path / "line", Sources(makes)) as session:
        session.source.choose(source)
        qtbot.waitUntil(lambda: session.connected.feed is not None, timeout=LONG_MS)
        yield session


@pytest.fixture
def page(qtbot: QtBot, session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch) -> Iterator[ConnectPage]:
    monkeypatch.setattr(projector_job, "TRIALS", 3)
    with in_view(qtbot, ConnectPage(session, theme)) as page:
        yield page


def test_what_is_measured_and_kept_is_gone_by_at_once_and_after_a_restart(
    qtbot: QtBot, session: Session, page: ConnectPage, source: LitSource, tmp_path: Path
) -> None:
    before = page.turns.result.text()
    dialog = _opened(qtbot, page)
    assert not dialog.keep.isVisible()
    qtbot.mouseClick(dialog.begin, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: dialog.working.share > 0.1, timeout=LONG_MS)
    assert not dialog.begin.isEnabled()
    qtbot.waitUntil(lambda: not dialog.busy, timeout=LONG_MS)
    words = "\n".join(one.text() for one in dialog.findChildren(type(dialog._title)))
    assert "kinect_1 beside kinect_2" in words
    assert "blinded" in words
    qtbot.mouseClick(dialog.keep, Qt.MouseButton.LeftButton)
    assert set(session.projectors.settlings) == {"S-kinect_1", "S-kinect_2"}
    feed = session.connected.feed
    assert feed is not None
    assert feed.schedule.settling("kinect_1") == session.projectors.settlings["S-kinect_1"].settling()
    qtbot.waitUntil(lambda: page.turns.result.text() not in ("", before), timeout=LONG_MS)
    path = tmp_path / "line" / "projectors.json"
    qtbot.waitUntil(lambda: path.exists() and read_written(path, Projectors) == session.projectors, timeout=LONG_MS)
    assert source.room.most_lit == 2  # while they were tried together, and never after it
    source.room.most_lit = 0
    qtbot.waitUntil(lambda: len(source.room.order()) > 40, timeout=LONG_MS)
    assert source.room.most_lit <= 1


def test_the_way_to_it_is_in_view_in_the_least_window(qtbot: QtBot, page: ConnectPage) -> None:
    button = page.turns.measure
    qtbot.waitUntil(button.isVisible, timeout=LONG_MS)
    qtbot.waitUntil(lambda: page.turns.result.height() > 0 and bool(page.turns.result.text()), timeout=LONG_MS)
    assert button.visibleRegion().boundingRect() == button.rect()


def test_stopping_and_closing_in_the_middle_change_nothing(qtbot: QtBot, session: Session, page: ConnectPage) -> None:
    dialog = _opened(qtbot, page)
    qtbot.mouseClick(dialog.begin, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: dialog.busy and bool(dialog.working.doing.text()), timeout=LONG_MS)
    qtbot.mouseClick(dialog.stop, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: not dialog.busy, timeout=LONG_MS)
    assert "stopped" in dialog._note.text()
    assert dialog.tried is None
    qtbot.mouseClick(dialog.begin, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: dialog.busy, timeout=LONG_MS)
    dialog.reject()
    qtbot.waitUntil(lambda: not session.tasks.running, timeout=LONG_MS)
    assert session.projectors == Projectors()


def test_a_sensor_that_goes_meanwhile_is_told_with_what_to_do(
    qtbot: QtBot, page: ConnectPage, source: LitSource, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(projector_job, "LONGEST_SILENCE_S", 0.5)
    dialog = _opened(qtbot, page)
    qtbot.mouseClick(dialog.begin, Qt.MouseButton.LeftButton)
    qtbot.waitUntil(lambda: dialog.busy, timeout=LONG_MS)
    source.sensors[1].gone.set()
    qtbot.waitUntil(lambda: not dialog.busy, timeout=LONG_MS)
    assert "kinect_2" in dialog._note.text()
    assert "cable" in dialog._note.text()
    dialog.reject()


def _opened(qtbot: QtBot, page: ConnectPage) -> ProjectorsDialog:
    qtbot.waitUntil(page.turns.measure.isVisible, timeout=LONG_MS)
    page.turns.measure.click()
    dialog = page.projectors.dialog
    assert dialog is not None
    assert dialog.isVisible()
    return dialog
