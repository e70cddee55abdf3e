"""One sensor's own thread: it opens, reads, takes its turns, and opens again what died."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.feed.health import Pulse, Running, SensorHealth, silent_after_s
from fruitgui.sensors.feed.patience import Patience
from fruitgui.sensors.feed.seat import FreeSeat, Seat, TurnSeat
from fruitgui.sensors.feed.subscription import Arrival
from fruitgui.sensors.feed.turn_keeper import Order, TurnKeeper
from fruitgui.sensors.feed.watched import WatchedSensor
from fruitgui.sensors.sensor import EndOfStreamError, Projector, Sensor, SensorTimeoutError

READ_S = 0.2
"""How long one read may take, or one wait for a turn; a stop is noticed after it."""

REOPEN_AFTER_S, FIRST_FRAME_S = 4.0, 20.0
"""A sensor that gave nothing for so long is closed and opened again; for its first frame it has longer."""

FIRST_TURNS_S, LATER_TURNS_S = 4.0, 1.5
"""While others wait in the dark for a sensor's turn to end it is given up sooner: before and after its first frame."""

FIRST_WAIT_S, ABSENT_WAIT_S, MUTE_WAIT_S = 0.5, 2.0, 8.0
"""Waits before opening again double from the first: to the second where it cannot be opened, and to the last where it
can and gives nothing, which costs others their turns."""


UNHEARD = ("sensor_hangs", "sensor_not_obeyed")
"""Codes of errors of a device that does not do what it is told: if its projector was on, it may be on still."""


@dataclass(frozen=True, slots=True)
class Ears:
    """Who hears of a sensor: of each frame, of its falling silent, and of its end; called on its own thread."""

    frame: Callable[[Arrival], None]
    absent: Callable[[str], None]
    end: Callable[[str], None]


class Reader:
    """Reads one sensor on a thread of its own, from `start` to `stop`; nobody else calls the sensor.

    A driver may raise anything: it is said in the health, the sensor is closed, and opened again after a while.

    Attributes:
        info: who the sensor is; once it was opened, as the device says.
    """

    def __init__(self, sensor: Sensor, keeper: TurnKeeper, ears: Ears) -> None:
        info = self.info = sensor.info
        self.name = info.sensor
        self._sensor = WatchedSensor(sensor)
        self._takes_turns = info.projector is Projector.SWITCHED
        self._seat: Seat = TurnSeat(self._sensor, keeper) if self._takes_turns else FreeSeat()
        self._keeper = keeper
        self._ears = ears
        self._nominal_hz = info.rate_hz
        self._pulse = Pulse()
        self._patience = Patience()
        self._heard_s: float | None = None
        self._newest: Frame | None = None
        self._state = Running.STOPPED
        self._error: FruitguiError | None = None
        self._tried = self._started = 0
        self._abandoned = False
        self._stop = threading.Event()
        self._again = threading.Event()
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

    def try_again(self) -> None:
        """Open a sensor that failed now, not after a while: it is said to be back."""
        self._again.set()

    def ask_to_stop(self) -> None:
        """Let the thread end after its present read."""
        self._stop.set()
        self._again.set()

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
        state = self._state
        if state is Running.RUNNING and self._patience.owed_s(now_s) > silent_after_s(self._nominal_hz):
            state = Running.SILENT
        error = self._error
        if state is Running.RUNNING and self._is_mute(now_s):
            state, error = Running.SILENT, SensorTimeoutError(self.name, silent_after_s(self._nominal_hz))
        schedule = self._keeper.schedule
        turns = self._takes_turns and schedule.alternates(self.name)
        return SensorHealth(
            sensor=self.name,
            state=state,
            error=error,
            rate_hz=self._pulse.rate_hz(now_s, schedule.cycle_s if turns else 0.0),
            nominal_hz=schedule.rate_hz(self.name, self._nominal_hz) if turns else self._nominal_hz,
            frames=self._pulse.frames,
            drops=self._pulse.drops,
            damaged=self._pulse.damaged,
            clock_leaps=self._pulse.clock_leaps,
            age_s=None if newest_s is None else now_s - newest_s,
            reopened=max(self._tried - 1, 0),
            useless=state is Running.RUNNING and self._patience.useless_s(now_s) > silent_after_s(self._nominal_hz),
            hangs=self._sensor.hangs,
            blinded_by=self._keeper.blinding(self.name) if turns else (),
            color_lock=self._sensor.info.color_lock,
            abandoned=self._abandoned,
        )

    def _run(self) -> None:
        wait_s = FIRST_WAIT_S
        while not self._stop.is_set():
            before = self._pulse.frames
            self._again.clear()
            opened, error = self._session()
            if error is None:
                break
            self._error, self._state = error, Running.FAILED
            self._ears.absent(self.name)
            longest_s = MUTE_WAIT_S if opened else ABSENT_WAIT_S
            wait_s = FIRST_WAIT_S if self._pulse.frames > before else min(2.0 * wait_s, longest_s)
            self._again.wait(0.0 if self._stop.is_set() else wait_s)
        if self._state is not Running.ENDED:
            self._state = Running.STOPPED
        self._ears.end(self.name)

    def _session(self) -> tuple[bool, FruitguiError | None]:
        """Open and read until told to stop or the end; return whether it opened, and what went wrong, if anything."""
        opened = False
        failure: FruitguiError | None = None
        try:
            self._tried += 1
            self._sensor.open()
            opened = True
            self.info = self._sensor.info
            self._seat.prepare()
            self._sensor.start()
            self._started += 1
            self._seat.sit()
            self._read()
        except EndOfStreamError:
            self._state = Running.ENDED
        except FruitguiError as error:
            failure = error
        except Exception as error:  # noqa: BLE001 - a driver's bug takes down its sensor, never the line
            failure = _driver_error(self.name, error)
        self._close()
        (self._seat.be_lost if failure is not None and failure.code in UNHEARD else self._seat.rise)()
        return opened, failure

    def _read(self) -> None:
        self._pulse.begin()
        self._patience.forget()
        heard = False
        while not self._stop.is_set():
            order = self._seat.order(READ_S)
            if order is Order.READ:
                self._patience.expect(time.monotonic())
                heard = self._take() or heard
                self._judge_silence(heard)
            elif order is Order.ON:
                self._pulse.begin_turn()
            else:
                self._patience.rest(time.monotonic())
                self._listen()

    def _take(self) -> bool:
        """Read one frame and hand it on, if it is of use; return whether one came."""
        try:
            frame = self._sensor.read(READ_S)
        except SensorTimeoutError as silence:
            self._heard_s = silence.heard_s
            return False
        self._heard_s = None
        now_s, lit = time.monotonic(), self._seat.light()
        self._patience.hear(now_s, of_use=not frame.damaged)  # one in light that settles is what is to come then
        self._patience.rest(now_s)  # whoever makes this thread wait for room has the sensor owe nothing
        self._state, self._error = Running.RUNNING, None
        self._pulse.number(frame.sequence)
        self._pulse.leap(frame.clock_leaps)
        if frame.damaged:
            self._pulse.damaged += 1
        elif lit is not None and (lit.settled or lit.rehearsed):
            self._seat.keep()
            if not lit.rehearsed:
                self._pulse.beat(now_s)
                self._newest = frame
            self._ears.frame(Arrival(frame, now_s, lit))
        return True

    def _listen(self) -> None:
        """Let go of whatever a sensor still gives in the dark, and hear it fail or fall silent, should it die there."""
        try:
            self._sensor.read(0.0)
        except SensorTimeoutError as silence:
            self._heard_s = silence.heard_s
            if self._is_mute(time.monotonic()):
                self._ears.absent(self.name)

    def _is_mute(self, now_s: float) -> bool:
        """Tell whether nothing at all comes of a sensor that waits for frames: in the dark, colour should."""
        heard_s = self._heard_s
        return heard_s is not None and now_s - heard_s > silent_after_s(self._nominal_hz)

    def _judge_silence(self, heard: bool) -> None:
        owed_s, silent_s = self._patience.owed_s(time.monotonic()), silent_after_s(self._nominal_hz)
        if owed_s > silent_s and self._state is not Running.STARTING and self._state is not Running.FAILED:
            self._state, self._error = Running.SILENT, SensorTimeoutError(self.name, silent_s)
            self._ears.absent(self.name)
        if owed_s > max(self._most_silence_s(heard), silent_s):
            raise SensorTimeoutError(self.name, owed_s)

    def _most_silence_s(self, heard: bool) -> float:
        if self._takes_turns and self._keeper.schedule.alternates(self.name):
            return LATER_TURNS_S if heard or self._started > 1 else FIRST_TURNS_S
        return REOPEN_AFTER_S if heard else FIRST_FRAME_S

    def _close(self) -> None:
        """Give the device back; what a dead one says to that does not matter."""
        for leave in (self._sensor.stop, self._sensor.close):
            with contextlib.suppress(Exception):
                leave()
        self._patience.forget()
        self._heard_s = None


def _driver_error(sensor: str, error: Exception) -> WorldError:
    return WorldError(
        "sensor_failed",
        f"Sensor {sensor} failed: {type(error).__name__}: {error}.",
        "It is opened again by itself; if it stays away, unplug it and plug it in again.",
        values={"sensor": sensor},
    )
