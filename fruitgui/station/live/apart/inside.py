"""The line's own process: its end of the pipe, and a line that does not know that it is alone."""

from __future__ import annotations

import contextlib
import os
import queue
import signal
import threading
import time
from collections.abc import Mapping
from dataclasses import replace
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import Any

from fruitgui.errors import FruitguiError
from fruitgui.frame import Frame
from fruitgui.sensors.feed import Arrival, Order, Room, SensorHealth
from fruitgui.sensors.frame_memory import frame_maps
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station.live.apart.messages import (
    Drawn,
    Ended,
    Given,
    Healths,
    Made,
    NoMore,
    NotMade,
    Out,
    Pictured,
    Shifted,
    Start,
    Stop,
    Taken,
)
from fruitgui.station.live.live_line import LiveLine
from fruitgui.station.live.parcels import receive, send
from fruitgui.station.live.state import Finished, LiveState, LiveWarning, Phase, Preview
from fruitgui.station.sink import CountedFruit
from fruitgui.station.waiting import SinkState

POLITE = 3
"""The line gives way to the window; its helpers give way to the line."""

LOOK_S = 0.008
"""How often is looked for something new to tell; the line itself draws as often as anybody sees."""

TELL_S = 0.1
"""What is not drawn (frames, warnings, who is away) is told so often at least."""


class Voice:
    """Says things to the window's process; any thread may."""

    def __init__(self, pipe: Connection) -> None:
        self._pipe = pipe
        self._lock = threading.Lock()

    def say(self, message: object) -> None:
        """Say something. Where nobody listens any more, this process has nothing left to do."""
        try:
            with self._lock:
                send(self._pipe, message)
        except OSError:
            leave()


def leave() -> None:
    """End this process at once: the window's process is gone, and everything durable is its own."""
    os._exit(1)


class Handed:
    """The frames that are handed over, as the line's `Pictures` and its `Arrivals`."""

    def __init__(self, start: Start, voice: Voice) -> None:
        self.infos: Mapping[str, SensorInfo] = dict(start.infos)
        self.sensors = tuple(start.infos)
        self.dropped: dict[str, int] = {}
        self._memory = SharedMemory(start.memory)
        self._place_bytes = start.place_bytes
        self._voice = voice
        self._healths = {one.sensor: one for one in start.healths}
        self._given: queue.Queue[Given | None] = queue.Queue()
        self._over = False

    def hear_health(self, healths: Healths) -> None:
        """Note how the sensors are."""
        self._healths = {one.sensor: one for one in healths.sensors}

    def hear(self, given: Given | None) -> None:
        """Take in a frame; None behind the last."""
        self._given.put(given)

    def health(self, sensor: str) -> SensorHealth:
        """Return how a sensor is, as of a moment ago."""
        return self._healths[sensor]

    def subscribe(self, room: Room, order: Order) -> Handed:
        """Ask for frames; they wait, and are put in order, where the sensors are read."""
        self._voice.say(Made(room, order))
        return self

    def take(self, timeout_s: float) -> Arrival | None:
        """Return the next frame; None where none comes in time, or ever."""
        try:
            given = self._given.get(timeout=0.0 if self._over else timeout_s)
        except queue.Empty:
            return None
        if given is None:
            self._over = True
            return None
        color, depth_mm = frame_maps(self._memory, given.place * self._place_bytes, given.intrinsics)
        color, depth_mm = color.copy(), depth_mm.copy()
        self._voice.say(Taken(given.place))
        frame = Frame(
            given.sensor, given.sequence, given.time_s, color, depth_mm, given.intrinsics, felt_m_s2=given.felt_m_s2,
            clock_leaps=given.clock_leaps,
        )  # fmt: skip
        return Arrival(frame, given.arrived_s, given.lit)

    def shift(self, offsets_s: Mapping[str, float]) -> None:
        """Pass on that clocks were put right."""
        self._voice.say(Shifted(dict(offsets_s)))

    def close(self) -> None:
        """Do nothing: who hands frames over knows which is the last."""

    @property
    def over(self) -> bool:
        """Whether nothing will come."""
        return self._over

    @property
    def waiting(self) -> int:
        """How many frames wait here."""
        return self._given.qsize()


class HandedBack:
    """Gives finished fruit back to be counted: a `Counts` that knows nothing of what became of them."""

    counted = passed = 0
    last: tuple[tuple[CountedFruit, Finished], ...] = ()
    sink_state = SinkState()
    warnings: tuple[LiveWarning, ...] = ()

    def __init__(self, voice: Voice) -> None:
        self._voice = voice

    def count(self, finished: Finished, lot: int | None) -> None:
        """Give a fruit back."""
        self._voice.say(Out(finished, lot))

    def retry(self) -> bool:
        """Do nothing: fruit wait where they are kept."""
        return False


class Inside:
    """A line from its start to its end."""

    def __init__(self, start: Start, pipe: Connection) -> None:
        self._pipe = pipe
        self._voice = Voice(pipe)
        self._stop: queue.SimpleQueue[Stop] = queue.SimpleQueue()
        self._pictures = Handed(start, self._voice)
        counting = HandedBack(self._voice)
        self._line = LiveLine(self._pictures, start.station, start.model, counting, None, start.intake)
        self._pictured: dict[str, Preview] = {}
        self._told, self._told_s = LiveState(Phase.STOPPED), 0.0

    def run(self) -> None:
        """Run until the frames are over and followed, or the other process says stop, or is gone."""
        threading.Thread(target=self._hear_all, name="line hears", daemon=True).start()
        self._line.start()
        stop: Stop | None = None
        while stop is None and not self._line.wait(0.0):
            self._tell()
            with contextlib.suppress(queue.Empty):
                stop = self._stop.get(timeout=LOOK_S)
        if stop is None:
            self._end(done=True)
            self._line.stop()  # its helpers may take their time to leave: by now all is said
        else:
            self._end(self._line.stop(max(stop.until_s - time.monotonic(), 0.0)))

    def _end(self, done: bool) -> None:
        self._told_s = 0.0  # how it ended is told, however shortly after the last word
        self._tell()
        self._voice.say(Ended(done))

    def _hear_all(self) -> None:
        try:
            while True:
                self._hear(receive(self._pipe))
        except (EOFError, OSError):
            leave()

    def _hear(self, message: Any) -> None:  # noqa: ANN401 - one of the messages
        match message:
            case Given():
                self._line.count_into(message.lot)
                self._pictures.hear(message)
            case Healths():
                self._pictures.hear_health(message)
            case NoMore():
                self._pictures.hear(None)
            case Stop():
                self._line.count_into(message.lot)
                self._stop.put(message)

    def _tell(self) -> None:
        """Tell how the line is, and what its sensors' pictures show by now, as far as that is new."""
        previews, before = self._line.previews, self._pictured
        new = tuple(replace(one, color=one.color[:0]) for name, one in previews.items() if before.get(name) is not one)
        if new:
            self._pictured = previews
            self._voice.say(Pictured(new))
        state, now_s = self._line.state, time.monotonic()
        if state.tracks is not self._told.tracks or now_s - self._told_s >= TELL_S:
            self._told, self._told_s = state, now_s
            self._voice.say(Drawn(state))


def run_line(start: Start, pipe: Connection) -> None:
    """Run a line; the main of the process."""
    # An interrupt from the keyboard reaches both processes; it is the other one that ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(OSError, AttributeError):
        os.nice(POLITE)
    try:
        inside = Inside(start, pipe)
    except FruitguiError as error:
        Voice(pipe).say(NotMade(error))
        return
    inside.run()
