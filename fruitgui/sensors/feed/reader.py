"""One sensor's own thread: it opens, reads, and opens again what died."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.feed.health import Pulse, Running, SensorHealth, silent_after_s
from fruitgui.sensors.feed.subscription import Arrival
from fruitgui.sensors.sensor import EndOfStreamError, Sensor, SensorTimeoutError

READ_S = 0.5
"""How long one read may take; a stop is noticed after it."""

REOPEN_AFTER_S, FIRST_FRAME_S = 4.0, 20.0
"""A sensor that gave nothing for so long is closed and opened again; for its first frame it has longer."""

FIRST_WAIT_S, LONGEST_WAIT_S = 0.5, 8.0
"""Waits before opening again double from the first to the longest."""


@dataclass(frozen=True, slots=True)
class Ears:
    """Who hears of a sensor: of each frame, of its falling silent, and of its end; called on its own thread."""

    frame: Callable[[Arrival], None]
    absent: Callable[[str], None]
    end: Callable[[str], None]


class Reader:
    """Reads one sensor on a thread of its own, from `start` to `stop`.

    A driver may raise anything: it is said in the health, the sensor is closed, and opened again after a while.
    """

    def __init__(self, sensor: Sensor, ears: Ears) -> None:
        self.name = sensor.info.sensor
        self._sensor = sensor
        self._ears = ears
        self._nominal_hz = sensor.info.rate_hz
        self._pulse = Pulse()
        self._newest: Frame | None = None
        self._state = Running.STOPPED
        self._error: FruitguiError | None = None
        self._opened = 0
        self._abandoned = False
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    @property
    def newest(self) -> Frame | None:
        """The newest frame."""
        return self._newest

    def start(self) -> None:
        """Start the thread. Once only."""
        self._state = Running.STARTING
        self._thread = threading.Thread(target=self._run, name=f"sensor {self.name}", daemon=True)
        self._thread.start()

    def ask_to_stop(self) -> None:
        """Let the thread end after its present read."""
        self._stop.set()

    def wait(self, timeout_s: float) -> bool:
        """Return whether the thread has ended; one that hangs in its driver is abandoned."""
        if self._thread is None:
            return True
        self._thread.join(max(timeout_s, 0.0))
        self._abandoned = self._thread.is_alive()
        return not self._abandoned

    def health(self) -> SensorHealth:
        """Return how the sensor is, now."""
        now_s = time.monotonic()
        newest_s = self._pulse.newest_s()
        age_s = None if newest_s is None else now_s - newest_s
        state = self._state
        if state is Running.RUNNING and age_s is not None and age_s > silent_after_s(self._nominal_hz):
            state = Running.SILENT
        return SensorHealth(
            sensor=self.name,
            state=state,
            error=self._error,
            rate_hz=self._pulse.rate_hz(now_s),
            nominal_hz=self._nominal_hz,
            frames=self._pulse.frames,
            drops=self._pulse.drops,
            age_s=age_s,
            reopened=max(self._opened - 1, 0),
            abandoned=self._abandoned,
        )

    def _run(self) -> None:
        wait_s = FIRST_WAIT_S
        while not self._stop.is_set():
            before = self._pulse.frames
            error = self._session()
            if error is None:
                break
            self._error, self._state = error, Running.FAILED
            self._ears.absent(self.name)
            wait_s = FIRST_WAIT_S if self._pulse.frames > before else min(2.0 * wait_s, LONGEST_WAIT_S)
            self._stop.wait(wait_s)
        if self._state is not Running.ENDED:
            self._state = Running.STOPPED
        self._ears.end(self.name)

    def _session(self) -> FruitguiError | None:
        """Open and read until told to stop or the end; return what went wrong, if anything."""
        try:
            self._opened += 1
            self._sensor.open()
            self._sensor.start()
            self._read()
        except EndOfStreamError:
            self._state = Running.ENDED
        except FruitguiError as error:
            return error
        except Exception as error:  # noqa: BLE001 - a driver's bug takes down its sensor, never the line
            return _driver_error(self.name, error)
        finally:
            self._close()
        return None

    def _read(self) -> None:
        self._pulse.begin()
        heard_s, patience_s = time.monotonic(), FIRST_FRAME_S
        while not self._stop.is_set():
            try:
                frame = self._sensor.read(READ_S)
            except SensorTimeoutError as error:
                self._say_silent(error, time.monotonic() - heard_s, patience_s)
                continue
            heard_s, patience_s = time.monotonic(), REOPEN_AFTER_S
            self._pulse.beat(frame.sequence, heard_s)
            self._newest = frame
            self._state, self._error = Running.RUNNING, None
            self._ears.frame(Arrival(frame, heard_s))

    def _say_silent(self, error: SensorTimeoutError, silence_s: float, patience_s: float) -> None:
        if silence_s > silent_after_s(self._nominal_hz) and self._state is not Running.STARTING:
            self._state, self._error = Running.SILENT, error
            self._ears.absent(self.name)
        if silence_s > max(patience_s, silent_after_s(self._nominal_hz)):
            raise error

    def _close(self) -> None:
        """Give the device back; what a dead one says to that does not matter."""
        for leave in (self._sensor.stop, self._sensor.close):
            with contextlib.suppress(Exception):
                leave()


def _driver_error(sensor: str, error: Exception) -> WorldError:
    return WorldError(
        "sensor_failed",
        f"Sensor {sensor} failed: {type(error).__name__}: {error}.",
        "It is opened again by itself; if it stays away, unplug it and plug it in again.",
    )
