"""A rig that shows the same few rendered pictures over and over: what screens are drawn and tested with."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from fruitgui.errors import WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.sensor import Projector, Sensor, SensorInfo, SensorTimeoutError
from fruitgui.simulation.simulated import sensor_info
from fruitgui.simulation.simulation import Simulation
from fruitgui.station.sources import Connected, Make, Sources

KIND = "frozen"
PERIOD_S = 0.1


class FrozenSensor:
    """Gives its frames again and again, ten a second; follows the `Sensor` protocol.

    It can be told to fall `silent` or to be `broken`, for screens that show that. In the dark it gives nothing.
    """

    def __init__(self, info: SensorInfo, frames: Sequence[Frame]) -> None:
        self._info = info
        self.frames = frames
        self._next = 0
        self._dark = False
        self.silent = threading.Event()
        self.broken = threading.Event()

    @property
    def info(self) -> SensorInfo:
        """Who this is."""
        return self._info

    def open(self) -> None:
        """Take the device. Raises `WorldError` while it is broken."""
        if self.broken.is_set():
            raise WorldError("sensor_gone", f"Sensor {self._info.sensor} is gone.", "Plug it in again.")

    def start(self) -> None:
        """Begin anew."""
        self._next = 0

    def read(self, timeout_s: float) -> Frame:
        """Return the next frame. Raises `SensorTimeoutError` while it is silent, `WorldError` while it is broken."""
        if self.broken.is_set():
            raise WorldError("sensor_gone", f"Sensor {self._info.sensor} is gone.", "Plug it in again.")
        if self.silent.is_set() or self._dark:
            time.sleep(min(timeout_s, PERIOD_S))
            raise SensorTimeoutError(self._info.sensor, timeout_s)
        time.sleep(PERIOD_S)
        frame, number = self.frames[self._next % len(self.frames)], self._next
        self._next += 1
        return replace(frame, sequence=number, time_s=number * PERIOD_S)

    def projector(self, on: bool) -> None:
        """Give frames, or none."""
        self._dark = not on

    def stop(self) -> None:
        """Do nothing."""

    def close(self) -> None:
        """Do nothing."""


@dataclass(frozen=True, slots=True)
class FrozenSource:
    """A frozen rig as a source.

    Attributes:
        name: which.
        sensors: that it gives, every time the same.
    """

    name: str
    sensors: tuple[FrozenSensor, ...] = field(compare=False)
    shown_as: str = KIND

    @property
    def kind(self) -> str:
        """What it passes for."""
        return self.shown_as

    def value(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {"kind": self.shown_as, "name": self.name}

    def connect(self) -> Connected:
        """Return its sensors."""
        sensors: list[Sensor] = list(self.sensors)
        return Connected(sensors)


def frozen_source(simulation: Simulation, name: str = "frozen", shown_as: str = KIND) -> FrozenSource:
    """Return a source whose sensors show a simulation's captures, rendered now."""
    frames: dict[str, list[Frame]] = {sensor: [] for sensor in simulation.sensors}
    for frame in simulation.frames():
        frames[frame.sensor].append(frame)
    infos = {sensor: replace(sensor_info(simulation, sensor), rate_hz=1.0 / PERIOD_S) for sensor in frames}
    sensors = tuple(FrozenSensor(infos[sensor], given) for sensor, given in frames.items())
    return FrozenSource(name, sensors, shown_as)


def with_projectors(rig: FrozenSource) -> FrozenSource:
    """Return a rig of the same pictures whose projectors have to take turns."""
    sensors = (FrozenSensor(replace(one.info, projector=Projector.SWITCHED), one.frames) for one in rig.sensors)
    return replace(rig, sensors=tuple(sensors))


def frozen_sources(*rigs: FrozenSource) -> Sources:
    """Return a list of sources with these rigs beside the usual ones."""
    by_name: Mapping[str, FrozenSource] = {rig.name: rig for rig in rigs}
    kind = rigs[0].kind if rigs else KIND
    usual = [make for make in Sources().makes if make.kind != kind]
    return Sources((*usual, Make(kind, lambda: list(rigs), lambda value: by_name[value["name"]])))
