"""What the window says for as long as it holds, and what of the disk."""

from __future__ import annotations

from dataclasses import dataclass, replace

import pytest
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


def test_what_is_blind_stands_until_it_is_seen_again(
    qtbot: QtBot, session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch
) -> None:
    bar = TopBar(theme)
    qtbot.addWidget(bar)
    watch = HealthWatch(session, bar, bar)
    running = Running(LiveState(Phase.RUNNING, blind=LEFT))
    monkeypatch.setattr(session, "running", running)
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
    qtbot: QtBot, qapp: QApplication, session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch
) -> None:
    bar, language = TopBar(theme), Language()
    qtbot.addWidget(bar)
    watch = HealthWatch(session, bar, bar)
    monkeypatch.setattr(session, "running", Running(LiveState(Phase.RUNNING, blind=LEFT)))
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
    qtbot: QtBot, session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch
) -> None:
    bar = TopBar(theme)
    qtbot.addWidget(bar)
    watch = HealthWatch(session, bar, bar)
    ticked, running = session.running.ticked, Running(LiveState(Phase.RUNNING))
    monkeypatch.setattr(session, "running", running)
    for count in (1, 1, 2):
        running.state = LiveState(Phase.RUNNING, warnings=(LiveWarning("mostly_unknown", "", (), count),))
        ticked.emit()
    first, second = session.messages.history
    assert first.stays
    assert "belt" in first.what
    assert "train again" in first.remedy
    assert second.says_as(first)
    watch.stop()


def test_a_clock_is_said_to_leap_each_time(
    qtbot: QtBot, session: Session, theme: Theme, monkeypatch: pytest.MonkeyPatch
) -> None:
    bar = TopBar(theme)
    qtbot.addWidget(bar)
    watch = HealthWatch(session, bar, bar)
    ticked, running = session.running.ticked, Running(LiveState(Phase.RUNNING))
    monkeypatch.setattr(session, "running", running)
    for count in (1, 1, 2):
        running.state = LiveState(Phase.RUNNING, warnings=(LiveWarning("clock_jumped", "", ("kinect_1",), count),))
        ticked.emit()
    said = [one.what for one in session.messages.history]
    assert said == 2 * ["The clock of kinect_1 leapt: fruit of this moment may be missing or twice."]
    watch.stop()
