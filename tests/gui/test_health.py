"""What the window says for as long as it holds, and what of the disk."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import pytest
from PySide6.QtCore import SignalInstance
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from fruitgui.gui.health import HealthWatch
from fruitgui.gui.pills import disk_pill
from fruitgui.gui.session import Session
from fruitgui.gui.theme.theme import Theme
from fruitgui.gui.top_bar import TopBar
from fruitgui.gui.translate import Language
from fruitgui.station.live import LiveState, LiveWarning, Phase
from fruitgui.station.live.blind import Blind

LEFT = Blind(("kinect_1",), ((0.41, 0.65),), 0.65, 0.3)


@dataclass
class Running:
    """What is asked of a line that runs."""

    state: LiveState | None
    running: bool = True
    lot: None = None


@pytest.fixture
def bar(qtbot: QtBot, theme: Theme) -> TopBar:
    made = TopBar(theme)
    qtbot.addWidget(made)
    return made


@pytest.fixture
def watch(session: Session, bar: TopBar) -> Iterator[HealthWatch]:
    made = HealthWatch(session, bar, bar)
    yield made
    made.stop()


@pytest.fixture
def ticked(session: Session, watch: HealthWatch) -> SignalInstance:  # noqa: ARG001 - it listens before another runs
    return session.running.ticked


@pytest.fixture
def running(
    session: Session,
    ticked: SignalInstance,  # noqa: ARG001 - of the line that runs no more
    monkeypatch: pytest.MonkeyPatch,
) -> Running:
    """A line that runs, in place of the session's own."""
    made = Running(LiveState(Phase.RUNNING))
    monkeypatch.setattr(session, "running", made)
    return made


def test_what_is_blind_stands_until_it_is_seen_again(session: Session, watch: HealthWatch, running: Running) -> None:
    running.state = LiveState(Phase.RUNNING, blind=LEFT)
    for _ in range(3):
        watch.look()
        assert session.messages.standing is not None
        assert "left part of the belt" in session.messages.standing.what
    running.state = replace(LiveState(Phase.RUNNING), blind=None)
    watch.look()
    assert session.messages.standing is None
    running.state = LiveState(Phase.RUNNING, blind=LEFT)
    watch.look()
    running.state = LiveState(Phase.RUNNING, sparse=LEFT)
    watch.look()
    assert session.messages.standing is not None
    assert "too few pictures" in session.messages.standing.what
    running.running = False
    watch.look()
    assert session.messages.standing is None, "no line, nothing that it does not see"


@pytest.mark.usefixtures("qapp")
def test_room_near_the_limit_is_told_to_a_tenth(qapp: QApplication) -> None:  # noqa: ARG001 - translations
    near = disk_pill(1.56, 1.5)
    assert (near.text, near.health) == ("1.6\u2009GB", "warn")
    assert "1.56 GB" in near.tip
    assert "below 1.50 GB" in near.tip
    assert disk_pill(0.4, 0.5).health == "bad"
    assert disk_pill(84.2, 2.0).text == "84\u2009GB"


def test_what_holds_and_the_pills_take_over_another_language_at_once(
    qapp: QApplication, session: Session, watch: HealthWatch, running: Running
) -> None:
    language = Language()
    running.state = LiveState(Phase.RUNNING, blind=LEFT)
    watch.look()
    standing = session.messages.standing
    assert standing is not None
    english = standing.told()
    language.put_on(qapp, "es")
    qapp.processEvents()
    spanish = standing.told()
    language.put_on(qapp, "en")
    qapp.processEvents()
    assert english.what != spanish.what
    assert english.remedy != spanish.remedy
    assert session.messages.standing is not None
    assert session.messages.standing.told() == english


def test_mostly_unknown_fruit_are_said_each_time_and_stay_until_they_are_put_away(
    session: Session, ticked: SignalInstance, running: Running
) -> None:
    for count in (1, 1, 2):
        running.state = LiveState(Phase.RUNNING, warnings=(LiveWarning("mostly_unknown", "", (), count),))
        ticked.emit()
    first, second = session.messages.history
    assert first.stays
    assert "belt" in first.what
    assert "train again" in first.remedy
    assert second.says_as(first)


def test_a_clock_is_said_to_leap_each_time(session: Session, ticked: SignalInstance, running: Running) -> None:
    for count in (1, 1, 2):
        running.state = LiveState(Phase.RUNNING, warnings=(LiveWarning("clock_jumped", "", ("kinect_1",), count),))
        ticked.emit()
    said = [one.what for one in session.messages.history]
    assert said == 2 * ["The clock of kinect_1 leapt: fruit of this moment may be missing or twice."]
