"""When the line says that a sensor is away."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.sensors.feed.health import Running, SensorHealth
from fruitgui.sensors.sensor import SensorTimeoutError
from fruitgui.station.live.above import FromAbove
from fruitgui.station.live.intake import LIVE, PLAYED
from fruitgui.station.live.sensor_watch import LOOK_S, SensorWatch
from tests.unit.station.test_blind import LEFT_RIGHT


class Watched:
    """Two sensors whose states a test sets, and what was said of them."""

    def __init__(self, away: tuple[Running, ...] = LIVE.away) -> None:
        above = cast("FromAbove", SimpleNamespace(footprints_m=LEFT_RIGHT, along=True))
        self.said: list[tuple[str, tuple[str, ...]]] = []
        self.state = dict.fromkeys(LEFT_RIGHT, Running.RUNNING)
        self.error: dict[str, FruitguiError] = {}
        self.leaps = dict.fromkeys(LEFT_RIGHT, 0)
        self.useless: set[str] = set()
        self.watch = SensorWatch(
            {name: name for name in LEFT_RIGHT},
            above,
            away,
            lambda code, _, sensors: self.said.append((code, sensors)),
        )
        self._now_s = 100.0

    def look(self) -> None:
        self._now_s += LOOK_S
        self.watch.look(self._health, self._now_s)

    def _health(self, name: str) -> SensorHealth:
        return SensorHealth(
            name, self.state[name], self.error.get(name), clock_leaps=self.leaps[name], useless=name in self.useless
        )

    def look_for(self, span_s: float) -> None:
        until_s = self._now_s + span_s
        while self._now_s < until_s:
            self.look()


def test_one_that_is_away_is_named_at_once_and_once() -> None:
    watched = Watched()
    watched.look()
    watched.state["right"] = Running.FAILED
    watched.look()
    assert watched.watch.blind is not None
    assert watched.watch.blind.sensors == ("right",)
    watched.look_for(10.0)
    assert watched.said == [("part_blind", ("right",))]


def test_one_whose_silence_tells_nothing_is_not_called_away() -> None:
    watched = Watched(away=PLAYED.away)
    watched.state["right"] = Running.SILENT
    watched.look_for(10.0)
    watched.state["right"], watched.error["right"] = Running.FAILED, SensorTimeoutError("right", 4.0)
    watched.look_for(10.0)
    assert watched.watch.blind is None
    assert watched.said == []
    watched.error["right"] = WorldError("recording_damaged", "Its file is damaged.", "Record again.")
    watched.look()
    assert watched.said == [("part_blind", ("right",))]


def test_one_that_goes_away_again_or_while_another_is_away_is_said_anew() -> None:
    watched = Watched()
    watched.state["right"] = Running.SILENT
    watched.look()
    watched.state["left"] = Running.SILENT
    watched.look()
    watched.state = dict.fromkeys(LEFT_RIGHT, Running.RUNNING)
    watched.look()
    watched.state["right"] = Running.SILENT
    watched.look()
    assert [sorted(sensors) for _, sensors in watched.said] == [["right"], ["left", "right"], ["right"]]


def test_each_leap_of_a_clock_is_said_but_none_of_before_the_line() -> None:
    watched = Watched()
    watched.leaps["right"] = 4
    watched.look_for(1.0)
    assert watched.said == []
    watched.leaps["left"] += 1
    watched.leaps["right"] += 2
    watched.look_for(1.0)
    assert sorted(watched.said) == [("clock_jumped", (name,)) for name in ("left", "right", "right")]


def test_one_whose_pictures_are_all_of_no_use_is_away() -> None:
    watched = Watched()
    for _ in range(2):
        watched.useless = {"left"}
        watched.look_for(1.0)
        assert watched.watch.blind is not None
        watched.useless = set()
        watched.look()
        assert watched.watch.blind is None
    assert [code for code, _ in watched.said] == 2 * ["part_blind"]


def test_one_that_was_away_is_not_said_to_have_given_too_few_pictures_meanwhile() -> None:
    watched, velocity_m_s = Watched(), np.array([0.5, 0.0, 0.0])

    def see(from_s: float, every_s: float) -> None:
        for number in range(12):
            watched.watch.see("left", from_s + number * every_s, velocity_m_s)

    see(0.0, 0.1)
    watched.state["left"] = Running.SILENT
    watched.look()
    watched.state["left"] = Running.RUNNING
    watched.look()
    see(60.0, 0.1)
    assert watched.watch.sparse is None
    see(90.0, 1.0)
    assert watched.watch.sparse is not None
    watched.state["left"] = Running.SILENT
    watched.look()
    assert watched.watch.sparse is None, "it gives nothing now: that is another matter"
    assert [code for code, _ in watched.said] == ["part_blind", "part_sparse", "part_blind"]
