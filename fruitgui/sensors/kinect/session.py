"""The one thread that calls the library for one open Kinect.

libfreenect waits for ever for a device that does not answer, and its log does
not say of which device a line speaks. So each open device has a context of the
library and a thread of its own, and one that hangs is left behind alone.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from concurrent.futures import TimeoutError as NotInTimeError
from typing import Protocol, TypeVar

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.sensors.kinect.device import Opened
from fruitgui.sensors.kinect.faults import hangs, not_obeyed, not_there

T = TypeVar("T")

OPEN_S, ORDER_S, CLOSE_S = 10.0, 2.0, 1.5
"""Opening some models resets a part of them, which is waited for three seconds, and devices beside it that do not
answer cost a second whenever all are looked at; all else is done in milliseconds."""

_EVENTS_S = 0.01
"""So long an order waits, at most, for the thread to hear it."""


class Handled(Protocol):
    """What the thread handles: a `Device`."""

    @property
    def gone(self) -> bool:
        """Whether it was unplugged."""

    def open(self) -> Opened:
        """Open it."""

    def pump(self, timeout_s: float) -> None:
        """Take in what comes within some time."""

    def close(self) -> None:
        """Give everything back."""


class Session:
    """One device from `open` to `close`; a session is not opened again. Calls to it come from one owner.

    Args:
        device: all of whose calls the session's thread makes.
        serial: of the device.
        end: is called by that thread when nothing comes any more.
    """

    def __init__(self, device: Handled, serial: str, end: Callable[[], None]) -> None:
        self._device, self._serial, self._end = device, serial, end
        self._orders: queue.SimpleQueue[tuple[Callable[[], object], Future[object]]] = queue.SimpleQueue()
        self._opened: Future[Opened] = Future()
        self._stop = threading.Event()
        self._failure: FruitguiError | None = None
        self._stuck = False
        self._thread = threading.Thread(target=self._run, name=f"kinect {serial}", daemon=True)

    @property
    def serial(self) -> str:
        """Of the device."""
        return self._serial

    @property
    def failure(self) -> FruitguiError | None:
        """Why nothing comes any more; None as long as something may."""
        return self._failure

    @property
    def hangs(self) -> bool:
        """Whether the thread should have ended and has not."""
        return self._stop.is_set() and self._thread.is_alive()

    def open(self) -> Opened:
        """Open the device.

        Raises:
            WorldError: it cannot be had, or does not answer in time.
        """
        self._thread.start()
        return self._wait(self._opened, OPEN_S)

    def ask(self, order: Callable[[], T]) -> T:
        """Have something done by the thread; return what comes of it.

        Raises:
            WorldError: the device is gone, does not answer in time (later orders fail at once, until it does), or what
                the order raises.
        """
        if self._stuck:
            raise hangs(self._serial)
        answer: Future[T] = Future()
        self._orders.put((order, answer))  # type: ignore[arg-type]  # an answer to its own order
        if not self._thread.is_alive():
            self._refuse()
        return self._wait(answer, ORDER_S)

    def close(self) -> bool:
        """Close the device; return whether that was done in time, else the thread is left behind."""
        self._stop.set()
        if self._thread.ident is None:
            return True
        self._thread.join(CLOSE_S)
        return not self._thread.is_alive()

    def _wait(self, answer: Future[T], within_s: float) -> T:
        try:
            return answer.result(within_s)
        except NotInTimeError:
            self._stuck = True
            raise self._failure or hangs(self._serial) from None

    def _run(self) -> None:
        try:
            self._opened.set_result(self._device.open())
            self._pump()
        except FruitguiError as error:
            self._failure = error
        except Exception as error:  # noqa: BLE001 - whatever breaks ends this device, never another
            self._failure = not_obeyed(self._serial, (f"{type(error).__name__}: {error}",))
        finally:
            self._finish()

    def _finish(self) -> None:
        try:
            self._device.close()
        except Exception as error:  # noqa: BLE001 - as above
            self._failure = self._failure or not_obeyed(self._serial, (f"{type(error).__name__}: {error}",))
        self._failure = self._failure or _closed(self._serial)
        if not self._opened.done():
            self._opened.set_exception(self._failure)
        self._refuse()
        self._end()

    def _pump(self) -> None:
        while not self._stop.is_set():
            self._stuck = False
            self._obey()
            self._device.pump(_EVENTS_S)
            if self._device.gone:
                raise not_there(self._serial, ())

    def _obey(self) -> None:
        for order, answer in self._waiting():
            try:
                answer.set_result(order())
            except Exception as error:  # noqa: BLE001 - raised where it was asked for
                answer.set_exception(error)

    def _refuse(self) -> None:
        for _, answer in self._waiting():
            answer.set_exception(self._failure or _closed(self._serial))

    def _waiting(self) -> Iterator[tuple[Callable[[], object], Future[object]]]:
        while True:
            try:
                yield self._orders.get_nowait()
            except queue.Empty:
                return


class LeftBehind:
    """Sessions that hang in the library: their devices cannot be opened again until they come back.

    May be used from any thread.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._sessions: list[Session] = []

    def add(self, session: Session) -> None:
        """Leave a session behind."""
        with self._lock:
            self._sessions.append(session)

    def check(self, serial: str) -> None:
        """Say that a device hangs.

        Raises:
            WorldError: it does.
        """
        with self._lock:
            self._sessions = [one for one in self._sessions if one.hangs]
            if any(one.serial == serial for one in self._sessions):
                raise hangs(serial)


def _closed(serial: str) -> WorldError:
    return WorldError("sensor_not_open", f"The Kinect {serial} is not open.", "Open it first.")
