"""One process that a line runs in, seen from the window's process."""

from __future__ import annotations

import atexit
import contextlib
import multiprocessing
import queue
import threading
from collections.abc import Iterator
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import Any

from fruitgui.progress import deaf_children
from fruitgui.sensors.feed import Arrival, SensorHealth
from fruitgui.sensors.frame_memory import BYTES_PER_PIXEL, lay
from fruitgui.station.live.apart.hang_watch import LOOK_S, HangWatch, Signs
from fruitgui.station.live.apart.inside import run_line
from fruitgui.station.live.apart.messages import Drawn, Healths, NoMore, Start, Stop, Taken, given
from fruitgui.station.live.parcels import receive, send

PLACES = 4
"""Frames that lie between the two: the line has the next one while another is laid down."""

LEAVE_S = 2.0


class Places:
    """Memory for frames that lie between two processes; one owner makes it and gives it back.

    Args:
        pixels: of the largest picture.

    Attributes:
        memory: that is shared. room: from one frame's place in it to the next, bytes.

    Raises:
        OSError: there is no memory to share.
    """

    def __init__(self, pixels: int) -> None:
        self.room = BYTES_PER_PIXEL * pixels
        self.memory = SharedMemory(create=True, size=PLACES * self.room)

    def give_back(self) -> None:
        """Give it back. Any number of times."""
        self.memory.close()
        with contextlib.suppress(FileNotFoundError):  # given back, or swept away by someone else
            self.memory.unlink()


class LineProcess:
    """Runs a line from `begin` to `close`; one thread gives, one hears, any may say stop.

    A line that hangs is ended as if it had died; one that was told to stop has its time for that.

    Args:
        between: where frames are laid; its owner gives it back.

    Attributes:
        hung: whether it was ended because it hung.
    """

    def __init__(self, between: Places) -> None:
        self._between = between
        self._places: queue.SimpleQueue[int | None] = queue.SimpleQueue()
        for place in range(PLACES):
            self._places.put(place)
        self._lock = threading.Lock()
        self._gone = self._listens = self.hung = False
        self._answers = self._given = self._taken = 0
        self._unwatched = threading.Event()
        self._watcher = threading.Thread(target=self._watch, name="line watched", daemon=True)
        self._pipe: Connection | None = None
        self._process: Any = None

    def begin(self, start: Start) -> None:
        """Start the process. Raises `OSError` where there is none to be had."""
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        # Not a daemon, which could have no helpers; so it is not ended by itself when the program ends in a hurry.
        atexit.register(self.close)
        self._process = context.Process(target=run_line, args=(start, theirs), name="line")
        with deaf_children():
            self._process.start()
        theirs.close()
        self._watcher.start()

    def give(self, arrival: Arrival, lot: int | None) -> bool:
        """Hand a frame over, as soon as there is a place; return whether there was a line to take it.

        Raises:
            TypeError, ValueError: the frame has not the size that it says, or is larger than a place.
        """
        place = self._places.get()
        if place is None:
            self._places.put(None)
            return False
        try:
            lay(arrival.frame, self._between.memory, place * self._between.room)
        except BaseException:
            self._places.put(place)
            raise
        self._given += 1
        return self._say(given(arrival, place, lot))

    def tell(self, healths: tuple[SensorHealth, ...]) -> None:
        """Say how the sensors are."""
        self._say(Healths(healths))

    def no_more(self) -> None:
        """Say that no frame will come."""
        self._say(NoMore())

    def stop(self, until_s: float, lot: int | None) -> None:
        """Say that the line is to end."""
        self._unwatched.set()
        self._say(Stop(until_s, lot))

    def heard(self) -> Iterator[Any]:
        """Give what the line says, one thing after the other, until its process is gone."""
        pipe = self._pipe
        assert pipe is not None  # noqa: S101 - opened when the process was started
        try:
            while True:
                message = self._received(pipe)
                if isinstance(message, Taken):
                    self._taken += 1
                    self._places.put(message.place)
                    continue
                self._answers += isinstance(message, Drawn)
                yield message
        except (EOFError, OSError):
            self._gone = True
            self._places.put(None)
        finally:
            pipe.close()

    def close(self) -> None:
        """End the process, whatever it does. Any number of times."""
        atexit.unregister(self.close)
        self._gone = True
        self._places.put(None)
        self._unwatched.set()
        process = self._process
        if process is not None and process.pid is not None:
            self._watcher.join()
            process.join(0.0)
            if process.is_alive():
                process.kill()
            process.join(LEAVE_S)

    @property
    def pid(self) -> int | None:
        """Of the process; None before it was started."""
        return None if self._process is None else self._process.pid

    def _received(self, pipe: Connection) -> Any:  # noqa: ANN401 - one of the messages
        self._listens = True
        try:
            return receive(pipe)
        finally:
            self._listens = False

    def _watch(self) -> None:
        """End the process if it hangs: whoever hears it hears its end."""
        watch = HangWatch()
        while not self._unwatched.wait(LOOK_S):
            if watch.look(Signs(self._answers, self._given, self._taken, self._listens)):
                self.hung = True
                self._process.kill()
                return

    def _say(self, message: object) -> bool:
        pipe = self._pipe
        if pipe is None or self._gone:
            return False
        try:
            with self._lock:
                send(pipe, message)
        except OSError:
            return False
        return True
