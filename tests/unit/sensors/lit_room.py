"""Sensors with projectors in one room: each sees nothing until its own light has settled, and badly where two shine."""

from __future__ import annotations

import threading
import time
from itertools import count, pairwise

import numpy as np

from fruitgui.errors import WorldError
from fruitgui.frame import U16, Frame, Intrinsics
from fruitgui.sensors.sensor import Projector, SensorInfo, SensorTimeoutError

CAMERA = Intrinsics(40, 30, 40.0, 40.0, 19.5, 14.5)
COLOR = np.zeros((30, 40, 3), np.uint8)
BELT_MM = 1000


class LitRoom:
    """What shines in it, and everything that was ever switched."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._lit: dict[str, float] = {}
        self.log: list[tuple[float, str, bool]] = []
        self.most_lit = 0

    def switch(self, sensor: str, on: bool) -> None:
        with self._lock:
            if on != (sensor in self._lit):
                self.log.append((time.monotonic(), sensor, on))
            if on:
                self._lit.setdefault(sensor, time.monotonic())
            else:
                self._lit.pop(sensor, None)
            self.most_lit = max(self.most_lit, len(self._lit))

    def lit(self) -> dict[str, float]:
        with self._lock:
            return dict(self._lit)

    def order(self) -> list[str]:
        """Return who was switched on, in order."""
        with self._lock:
            return [sensor for _, sensor, on in self.log if on]

    def alternates(self) -> bool:
        """Tell whether nobody was switched on twice in a row."""
        return all(one != other for one, other in pairwise(self.order()))


class LitSensor:
    """One sensor of a room; a test pulls its plug, lets it hang, or fall silent."""

    def __init__(
        self, name: str, room: LitRoom, *, rate_hz: float = 50.0, settle_s: float = 0.0,
        projector: Projector = Projector.SWITCHED,
    ) -> None:  # fmt: skip
        self._name = name
        self._room = room
        self._rate_hz = rate_hz
        self._settle_s = settle_s
        self._projector = projector
        self._numbers = count()
        self._wanted = True
        self._started = False
        self._owner: int | None = None
        self.gone = threading.Event()
        self.deaf = threading.Event()
        self.mute = threading.Event()
        self.damaged = threading.Event()
        self.hang_in = ""
        self.hung = threading.Event()
        self.let_go = threading.Event()
        self.calls: list[str] = []
        self.threads: set[int] = set()

    @property
    def info(self) -> SensorInfo:
        return SensorInfo(
            self._name, "test", "lit", f"S-{self._name}", CAMERA, self._rate_hz, projector=self._projector
        )

    def open(self) -> None:
        self._called("open")

    def start(self) -> None:
        self._called("start")
        self._started = True
        self._shine()

    def projector(self, on: bool) -> None:
        self._called("on" if on else "off")
        if self.deaf.is_set():
            raise WorldError("sensor_not_obeyed", f"Sensor {self._name} does not do what it is told.", "Unplug it.")
        self._wanted = on
        self._shine()

    def stop(self) -> None:
        self._called("stop", dies=False)
        self._started = self._started and self.deaf.is_set()
        self._shine()

    def close(self) -> None:
        self._called("close", dies=False)

    def read(self, timeout_s: float) -> Frame:
        self._called("read")
        since_s = self._room.lit().get(self._name)
        if since_s is None or self.mute.is_set() or timeout_s < 1 / self._rate_hz:
            self.gone.wait(timeout_s)
            self._check()
            raise SensorTimeoutError(self._name, timeout_s)
        self.gone.wait(1 / self._rate_hz)
        self._check()
        return Frame(
            self._name, next(self._numbers), time.monotonic(), COLOR, self._depth(since_s), CAMERA,
            damaged=self.damaged.is_set(),
        )  # fmt: skip

    def _depth(self, since_s: float) -> U16:
        """Holes fade away while the light settles; a tenth more where another one shines."""
        left = max(1.0 - (time.monotonic() - since_s) / self._settle_s, 0.0) if self._settle_s else 0.0
        holes = 0.05 + 0.6 * left + 0.1 * (len(self._room.lit()) > 1)
        depth = np.full(CAMERA.width * CAMERA.height, BELT_MM, np.uint16)
        depth[: round(holes * depth.size)] = 0
        return depth.reshape(CAMERA.height, CAMERA.width)

    def _shine(self) -> None:
        self._room.switch(self._name, self._started and self._wanted and not self.gone.is_set())

    def _called(self, what: str, *, dies: bool = True) -> None:
        self.calls.append(what)
        self.threads.add(threading.get_ident())
        if self.hang_in == what:
            self.hung.set()
            self.let_go.wait(60.0)
        if dies:
            self._check()

    def _check(self) -> None:
        if self.gone.is_set():
            self._room.switch(self._name, False)
            raise WorldError("sensor_gone", f"Sensor {self._name} is gone.", "Plug it in.")


def holes(depth_mm: U16) -> float:
    return float((depth_mm == 0).mean())
