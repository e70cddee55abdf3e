"""Exposure and white balance are held where the device allows, once they have found the light."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.errors import WorldError
from fruitgui.frame import Frame, Intrinsics
from fruitgui.sensors.held_color import SETTLE_S, HeldColor, held
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.sensor import ColorLock, SensorInfo

CAMERA = Intrinsics(8, 6, 8.0, 8.0, 3.5, 2.5)


class _Plain:
    def __init__(self) -> None:
        self.calls: list[str] = []
        self._time_s = 0.0

    @property
    def info(self) -> SensorInfo:
        return SensorInfo("kinect_1", "m", "n", "A1", CAMERA, 30.0, color_lock=ColorLock.LOCKABLE)

    def open(self) -> None: ...

    def start(self) -> None:
        self.calls.append("start")

    def read(self, timeout_s: float) -> Frame:  # noqa: ARG002
        self._time_s += 1.0
        dark = np.zeros((6, 8), np.uint16)
        return Frame("kinect_1", 0, self._time_s, np.zeros((6, 8, 3), np.uint8), dark, CAMERA)

    def projector(self, on: bool) -> None: ...

    def stop(self) -> None: ...

    def close(self) -> None: ...


class _Lockable(_Plain):
    def __init__(self, answer: bool | WorldError = True) -> None:
        super().__init__()
        self._answer = answer

    def lock_color(self, on: bool) -> bool:
        self.calls.append(f"lock {on}")
        if isinstance(self._answer, WorldError):
            raise self._answer
        return self._answer


def _read(sensor: HeldColor, count: int) -> list[ColorLock]:
    locks = []
    for _ in range(count):
        sensor.read(1.0)
        locks.append(sensor.info.color_lock)
    return locks


def test_colours_are_held_once_after_the_light_was_found() -> None:
    device = _Lockable()
    sensor = HeldColor(device)
    sensor.start()
    locks = _read(sensor, 12)
    first = locks.index(ColorLock.LOCKED)
    assert first == int(SETTLE_S)
    assert set(locks[:first]) == {ColorLock.LOCKABLE}
    assert device.calls == ["start", "lock True"]
    assert NamedSensor(sensor, "left").info.color_lock is ColorLock.LOCKED


def test_a_start_finds_the_light_anew() -> None:
    device = _Lockable()
    sensor = HeldColor(device)
    sensor.start()
    _read(sensor, 8)
    sensor.stop()
    sensor.start()
    assert sensor.info.color_lock is ColorLock.LOCKABLE
    assert _read(sensor, 8)[-1] is ColorLock.LOCKED
    assert device.calls == ["start", "lock True", "lock False", "start", "lock True"]


@pytest.mark.parametrize("answer", [False, WorldError("mute", "It does not answer.", "Unplug it.")])
def test_a_device_that_will_not_hold_them_gives_frames_all_the_same(answer: bool | WorldError) -> None:
    device = _Lockable(answer)
    sensor = HeldColor(device)
    sensor.start()
    assert _read(sensor, 12)[-1] is ColorLock.AUTOMATIC
    assert device.calls.count("lock True") == 1, "it is not asked again at every frame"


def test_only_what_can_be_held_is_held() -> None:
    plain, lockable = _Plain(), _Lockable()
    assert held(plain) is plain
    assert isinstance(held(lockable), HeldColor)
