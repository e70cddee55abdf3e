"""A belt that runs too fast is said once for each lot."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from PySide6.QtCore import QObject

from fruitgui.gui import speed_watch
from fruitgui.gui.session import Session
from fruitgui.gui.speed_watch import SpeedWatch
from fruitgui.records.lot import Lot
from fruitgui.station.live import LiveState, Phase
from fruitgui.station.turn_plan import TurnPlan, turn_plan


@dataclass
class Running:
    """What the watch asks of a line that runs."""

    state: LiveState
    lot: Lot
    running: bool = True


LOT = Lot(7, "1184", "", "", "", "", None, None, {}, (), 1000.0, None, ())


def test_only_what_is_faster_than_the_sensors_follow_is_said_and_once(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    def plan(*_: object) -> TurnPlan:
        return replace(turn_plan({}, {}, None), highest_speed_m_s=0.5)

    monkeypatch.setattr(speed_watch, "plan_of", plan)
    running = Running(LiveState(Phase.RUNNING), LOT)
    monkeypatch.setattr(session, "running", running)
    parent = QObject()
    watch = SpeedWatch(session, parent)
    before = len(session.messages.history)
    for speed_m_s in (None, 0.3, 0.51):
        velocity = None if speed_m_s is None else np.array([0.0, speed_m_s, 0.0])
        running.state = replace(running.state, belt_velocity_m_s=velocity)
        watch.look()
    assert len(session.messages.history) == before
    running.state = replace(running.state, belt_velocity_m_s=np.array([0.0, -0.62, 0.0]))
    for _ in range(3):
        session.connected.health_changed.emit()
    (said,) = session.messages.history[before:]
    assert "0.62\u2009m/s" in said.what
    assert "0.50\u2009m/s" in said.what
    running.lot = replace(LOT, key=8)
    watch.look()
    assert len(session.messages.history) == before + 2
