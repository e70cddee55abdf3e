"""Still frames from running sensors."""

from __future__ import annotations

import pytest

from fruitgui.errors import CancelledByUserError, WorldError
from fruitgui.sensors.feed import Feed
from fruitgui.station import stills
from fruitgui.station.stills import collect_stills
from tests.unit.sensors.scripted import ScriptedSensor, small_frame

pytestmark = pytest.mark.usefixtures("no_leaked_threads")


def test_as_many_as_asked_of_each_sensor_and_no_more() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    feed = Feed([left, right])
    told: list[float] = []

    def progress(share: float, _doing: str) -> None:
        told.append(share)
        if len(told) == 1:
            left.give(*(small_frame("left", n) for n in range(9)))
            right.give(*(small_frame("right", n) for n in range(4)))

    feed.start()
    try:
        frames = collect_stills(feed, 4, progress)
    finally:
        feed.stop()
    assert [one.sequence for one in frames["right"]] == [0, 1, 2, 3]
    assert len(frames["left"]) == 4
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_a_silent_sensor_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stills, "LONGEST_SILENCE_S", 0.3)
    feed = Feed([ScriptedSensor("left", [small_frame("left", 0)]), ScriptedSensor("right")])
    feed.start()
    try:
        with pytest.raises(WorldError, match=r"Sensor (left|right) gave"):
            collect_stills(feed, 4)
    finally:
        feed.stop()


def test_it_can_be_cancelled() -> None:
    feed = Feed([ScriptedSensor("left")])
    feed.start()
    try:
        with pytest.raises(CancelledByUserError):
            collect_stills(feed, 4, cancelled=lambda: True)
    finally:
        feed.stop()


def test_one_sensor_of_several_is_enough() -> None:
    left, right = ScriptedSensor("left"), ScriptedSensor("right")
    feed = Feed([left, right])
    given: list[float] = []

    def progress(share: float, _doing: str) -> None:
        given.append(share)
        if len(given) == 1:
            left.give(*(small_frame("left", n) for n in range(3)))

    feed.start()
    try:
        frames = collect_stills(feed, 2, progress, sensors={"left"})
    finally:
        feed.stop()
    assert list(frames) == ["left"]
    assert len(frames["left"]) == 2
