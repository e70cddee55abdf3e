"""What can be connected is asked for beside; what returns is opened again at once."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import pytest

from fruitgui.errors import WorldError
from fruitgui.sensors.drivers import PluggedDevice
from fruitgui.sensors.feed import Feed, Running
from fruitgui.station.found import FoundWatch, Returning
from fruitgui.station.sources import RECORDINGS, SIMULATED, DevicesSource, Sources, devices_of
from tests.unit.sensors.lit_room import LitRoom, LitSensor
from tests.unit.sensors.scripted import until

LONG_S = 30.0


class Shelf:
    """A driver of sensors that a test plugs in and out."""

    def __init__(self, *sensors: LitSensor) -> None:
        self._sensors = sensors
        self.hangs = threading.Event()
        self.asked = 0

    @property
    def make(self) -> str:
        return "lit"

    def problem(self) -> WorldError | None:
        return None

    def devices(self) -> Sequence[PluggedDevice]:
        self.asked += 1
        if self.hangs.is_set():
            until(lambda: not self.hangs.is_set(), LONG_S)
        return [PluggedDevice("lit", "", one.info.serial) for one in self._sensors if not one.gone.is_set()]

    def sensor(self, serial: str) -> LitSensor:
        return next(one for one in self._sensors if one.info.serial == serial)


@pytest.fixture
def room() -> LitRoom:
    return LitRoom()


@pytest.mark.usefixtures("no_leaked_threads")
def test_devices_come_and_go(room: LitRoom) -> None:
    left, right = LitSensor("left", room), LitSensor("right", room)
    watch = FoundWatch(Sources((devices_of(lambda: (Shelf(left, right),)), SIMULATED, RECORDINGS)))
    assert watch.found == []
    watch.ask()
    until(lambda: watch.serials == {"S-left", "S-right"}, LONG_S)
    assert isinstance(watch.found[0], DevicesSource)
    assert watch.found[1].kind == "simulated"
    right.gone.set()
    until(lambda: not watch.asking, LONG_S)
    watch.ask()
    until(lambda: watch.serials == {"S-left"}, LONG_S)


@pytest.mark.usefixtures("no_leaked_threads")
def test_a_driver_that_hangs_holds_up_nobody(room: LitRoom) -> None:
    shelf = Shelf(LitSensor("left", room))
    shelf.hangs.set()
    watch = FoundWatch(Sources((devices_of(lambda: (shelf,)), SIMULATED)))
    for _ in range(5):
        watch.ask()
        assert [source.kind for source in watch.found] == ["simulated"] * len(watch.found)
        assert watch.found
    assert watch.asking
    assert shelf.asked == 1
    shelf.hangs.clear()
    until(lambda: watch.serials == {"S-left"}, LONG_S)
    until(lambda: not watch.asking, LONG_S)


@pytest.mark.usefixtures("no_leaked_threads")
def test_a_driver_with_a_bug_hides_its_devices_only() -> None:
    def drivers() -> tuple[Shelf, ...]:
        raise ZeroDivisionError

    watch = FoundWatch(Sources((devices_of(drivers), SIMULATED)))
    watch.ask()
    until(lambda: not watch.asking, LONG_S)
    assert watch.found
    assert watch.serials == frozenset()


@pytest.mark.usefixtures("no_leaked_threads")
def test_a_sensor_that_returns_is_opened_at_once_and_nobody_is_asked_while_all_run(
    room: LitRoom, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fruitgui.sensors.feed.reader.FIRST_WAIT_S", 3600.0)
    left = LitSensor("left", room)
    shelf = Shelf(left)
    watch = FoundWatch(Sources((devices_of(lambda: (shelf,)),)))
    returning, feed = Returning(watch), Feed([left])
    feed.start()
    try:
        until(lambda: feed.health("left").state is Running.RUNNING, LONG_S)
        returning.look(feed)
        assert shelf.asked == 0
        left.gone.set()
        until(lambda: feed.health("left").state is Running.FAILED, LONG_S)
        returning.look(feed)
        until(lambda: shelf.asked > 0 and not watch.asking, LONG_S)
        returning.look(feed)
        left.gone.clear()
        until(lambda: (returning.look(feed), feed.health("left").state is Running.RUNNING)[1], LONG_S)
    finally:
        feed.stop()
    until(lambda: not watch.asking, LONG_S)
