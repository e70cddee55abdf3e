from __future__ import annotations

import threading

import pytest

from fruitgui.errors import CancelledByUserError
from fruitgui.frame import Frame
from fruitgui.sensors.feed import Feed
from fruitgui.station.stills import collect_stills
from tests.unit.sensors.scripted import ScriptedSensor, small_frame

pytestmark = pytest.mark.usefixtures("no_leaked_threads")


class _Endless(ScriptedSensor):
    """Gives a frame every hundredth of a second, for ever."""

    _number = 0

    def read(self, timeout_s: float) -> Frame:  # noqa: ARG002
        threading.Event().wait(0.01)
        self._number += 1
        return small_frame(self.info.sensor, self._number)


def test_every_sensor_gives_as_many_as_are_asked_for() -> None:
    feed = Feed([_Endless("a"), _Endless("b")])
    told: list[float] = []
    feed.start()
    try:
        stills = collect_stills(feed, 3, lambda share, _doing: told.append(share))
    finally:
        feed.stop()
    assert {name: len(frames) for name, frames in stills.items()} == {"a": 3, "b": 3}
    assert list(stills) == ["a", "b"]
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_it_can_be_cancelled() -> None:
    feed = Feed([ScriptedSensor("a")])
    feed.start()
    try:
        with pytest.raises(CancelledByUserError):
            collect_stills(feed, 3, cancelled=lambda: True)
    finally:
        feed.stop()
