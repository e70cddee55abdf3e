"""Every class of sensors keeps to the one protocol."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fruitgui.frame import Frame
from fruitgui.sensors.kinect.driver import KinectDriver
from fruitgui.sensors.named import NamedSensor
from fruitgui.sensors.player import FlatOut, recorded_sensors
from fruitgui.sensors.recordings import RecordingWriter
from fruitgui.sensors.sensor import Sensor
from fruitgui.simulation.ahead import SimulatedRig
from fruitgui.simulation.supply import LineOptions
from tests.emulated_usb.emulation import MODEL_1473, Emulation, Kinect
from tests.emulated_usb.outside import inside
from tests.emulated_usb.player import Player
from tests.unit.sensors.contract import check_end, check_is_refused, check_waits, next_frame, walk
from tests.unit.sensors.scripted import ScriptedSensor, small_frame

RIG = LineOptions(rig_seed=1, layout="single")


def test_simulated(no_leaked_threads: None) -> None:  # noqa: ARG001
    for sensor in SimulatedRig(RIG, FlatOut()).sensors():
        walk(sensor)


def test_simulated_with_projectors(no_leaked_threads: None) -> None:  # noqa: ARG001
    for sensor in SimulatedRig(replace(RIG, settling_s=0.05), FlatOut()).sensors():
        walk(sensor)


def test_playback(tmp_path: Path, no_leaked_threads: None) -> None:  # noqa: ARG001
    (sensor,) = SimulatedRig(RIG, FlatOut()).sensors()
    sensor.open()
    sensor.start()
    path = tmp_path / "recording.mcap"
    with RecordingWriter(path, [sensor.info]) as writer:
        for _ in range(20):
            writer.write(next_frame(sensor))
    sensor.stop()
    sensor.close()
    for played in recorded_sensors(path, FlatOut(), looped=False):
        walk(played)
        walk(NamedSensor(played, "renamed"))
        check_end(played, frames=20)


@inside
def test_kinect_on_the_emulated_bus(usb: Emulation, tmp_path: Path) -> None:  # noqa: ARG001
    usb.plug_in(Kinect("A1"), Kinect("B2", MODEL_1473))
    with Player(usb, wait_ms=2000):
        for serial in ("A1", "B2"):
            walk(KinectDriver().sensor(serial))
    check_is_refused(KinectDriver().sensor("C3"))
    sensor = KinectDriver().sensor("A1")
    sensor.open()
    sensor.start()
    check_waits(sensor)  # nobody sends anything any more
    sensor.close()


class Steady(ScriptedSensor):
    """Gives small frames for ever, while it runs; or at another time, as a test says."""

    count = 0
    runs = False

    def __init__(self, name: str, always: Callable[[Steady], bool] = lambda _: False) -> None:
        super().__init__(name)
        self._always = always

    def start(self) -> None:
        self.runs = True

    def stop(self) -> None:
        self.runs = False

    def read(self, timeout_s: float) -> Frame:
        if not self.runs and not self._always(self):
            return super().read(timeout_s)
        self.count += 1
        return replace(small_frame("steady", self.count), depth_mm=np.full((6, 8), 900 + self.count, np.uint16))

    def close(self) -> None:
        self.runs, self.closed = False, self.opened


class Spoiled(NamedSensor):
    """A sensor whose frames a test spoils."""

    def __init__(self, sensor: Sensor, spoil: Callable[[Frame], Frame]) -> None:
        super().__init__(sensor, "spoiled")
        self._spoil = spoil

    def read(self, timeout_s: float) -> Frame:
        return self._spoil(super().read(timeout_s))


BUFFER = np.zeros((6, 8), np.uint16)


def into_one_buffer(frame: Frame) -> Frame:
    BUFFER[:] = frame.depth_mm
    return replace(frame, depth_mm=BUFFER)


@pytest.mark.parametrize(
    "spoil",
    [
        lambda frame: replace(frame, sequence=7),
        lambda frame: replace(frame, time_s=-frame.time_s),
        lambda frame: replace(frame, sensor="another"),
        lambda frame: replace(frame, depth_mm=frame.depth_mm // 1000),
        lambda frame: replace(frame, depth_mm=frame.depth_mm.astype(np.float32)),
        lambda frame: replace(frame, color=frame.color[..., 0]),
        lambda frame: replace(frame, intrinsics=replace(frame.intrinsics, fx=1.0)),
        into_one_buffer,
    ],
)
def test_the_walk_sees_what_is_wrong(spoil: Callable[[Frame], Frame]) -> None:
    walk(Spoiled(Steady("steady"), lambda frame: replace(frame, sensor="spoiled")))
    with pytest.raises(AssertionError):
        walk(Spoiled(Steady("steady"), lambda frame: spoil(replace(frame, sensor="spoiled"))))


@pytest.mark.parametrize(
    "always",
    [
        lambda sensor: sensor.opened == 0,
        lambda sensor: sensor.opened > sensor.closed and sensor.count == 0,
        lambda sensor: sensor.opened > sensor.closed and sensor.count > 0,
        lambda sensor: sensor.opened == sensor.closed > 0,
    ],
    ids=["before it is opened", "before it is started", "after it was stopped", "after it was closed"],
)
def test_the_walk_sees_a_sensor_that_gives_what_nobody_asked_for(always: Callable[[Steady], bool]) -> None:
    with pytest.raises(pytest.fail.Exception):
        walk(Steady("steady", always))
