"""The simulated rig in a process of its own: frames are rendered ahead, and come when they are due."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
from collections import Counter, deque
from collections.abc import Iterator
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import Any

from fruitgui.errors import WorldError
from fruitgui.frame import U8, U16, Frame, Intrinsics
from fruitgui.sensors.frame_memory import BYTES_PER_PIXEL, frame_maps, lay
from fruitgui.sensors.player import AtSpeed, Pace
from fruitgui.sensors.sensor import Sensor
from fruitgui.sensors.shared import SharedStream
from fruitgui.simulation.projector import Beams, projector_models
from fruitgui.simulation.show import Show, Showing, show_info
from fruitgui.simulation.supply import LineOptions
from fruitgui.simulation.switched import switched_sensors

AHEAD = 10
"""Frames that lie ready: a batch of new fruit, or a busy second core, holds nothing up."""

LEAVE_S = 1.5
POLITE = 5
"""The renderer gives way to the line and the window."""


class SimulatedRig:
    """A rig that does not exist, running in a process beside; give its `sensors` to a feed.

    Constructing starts nothing; the process runs while a sensor is open.

    Args:
        options: of the rig and its line.
        pace: as on the wall unless given.
    """

    def __init__(self, options: LineOptions, pace: Pace | None = None) -> None:
        self.options = options
        self._rendered = Rendered(options, AtSpeed() if pace is None else pace)
        devices = options.setting().devices
        infos = [show_info(device, options) for device in devices]
        models = projector_models(options.rig_seed, [device.sensor for device in devices], options.settling_s)
        self._beams = Beams(devices, models, options.seed)
        self._sensors: tuple[Sensor, ...] = (
            tuple(switched_sensors(self._rendered, self._beams, infos))
            if options.settling_s > 0.0
            else tuple(SharedStream(self._rendered, infos).sensors())
        )

    def sensors(self) -> list[Sensor]:
        """Return the sensors."""
        return list(self._sensors)

    @property
    def beams(self) -> Beams:
        """The truth about its projectors, where they are switched."""
        return self._beams

    @property
    def showing(self) -> Showing:
        """What was last asked to lie before the sensors."""
        return self._rendered.showing

    def show(self, showing: Showing) -> None:
        """Let something else lie before the sensors, from the next frame on. From any thread."""
        self._rendered.show(showing)

    @contextlib.contextmanager
    def standing(self) -> Iterator[None]:
        """Let the belt stand meanwhile, with what lies on it; where something else is shown that stays."""
        before = self.showing
        if before is Showing.LINE:
            self.show(Showing.PAUSED)
        try:
            yield
        finally:
            if self.showing is Showing.PAUSED:
                self.show(before)

    @property
    def belt_s(self) -> float:
        """How long the belt had run when the newest frame given out was captured; with `supply.crossed` the truth."""
        return self._rendered.belt_s


class Rendered:
    """The stream of rendered frames; follows `shared.Stream`."""

    def __init__(self, options: LineOptions, pace: Pace) -> None:
        self._options = options
        self._pace = pace
        cameras = [device.color_camera for device in options.setting().devices]
        self._cameras = {device.sensor: device.color_camera for device in options.setting().devices}
        self._room = BYTES_PER_PIXEL * max(camera.width * camera.height for camera in cameras)
        self._lock = threading.Lock()
        self._process: Any = None
        self._pipe: Connection | None = None
        self._memory: SharedMemory | None = None
        self._ready: deque[tuple[Any, ...]] = deque()
        self._epoch = 0
        self._given: Counter[str] = Counter()
        self._shift_s = self._last_s = 0.0
        self.showing = Showing.LINE
        self.belt_s = 0.0

    def begin(self) -> None:
        """Start the process. Raises `WorldError` where there is none to be had."""
        self.end()
        context = multiprocessing.get_context("spawn")
        try:
            self._memory = SharedMemory(create=True, size=AHEAD * self._room)
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(
                target=render, args=(self._options, theirs, self._memory.name, self._room), daemon=True
            )
            self._process.start()
        except OSError as error:
            self.end()
            raise WorldError(
                "no_process", f"The simulated rig cannot be started: {error}.", "Close other programs and try again."
            ) from error
        theirs.close()
        self._pace.begin()
        self._shift_s = self._last_s
        self._given.clear()
        self._epoch = 0
        self.show(self.showing)

    def show(self, showing: Showing) -> None:
        """Let something else lie before the sensors; what was rendered ahead is let go."""
        with self._lock:
            self.showing = showing
            self._epoch += 1
            if self._pipe is not None:
                with contextlib.suppress(OSError):
                    self._pipe.send((self._epoch, showing))

    def draw(self, timeout_s: float) -> Frame | None:
        """Return the next frame when it is due."""
        if not self._ready and not self._receive(timeout_s):
            return None
        epoch, slot, sensor, time_s, belt_s = self._ready[0]
        if epoch == self._epoch and not self._pace.wait(time_s, timeout_s):
            return None
        self._ready.popleft()
        if epoch != self._epoch:
            self._free(slot)
            self._pace.begin()
            return None
        camera = self._cameras[sensor]
        color, depth_mm = self._maps(slot, camera)
        self._last_s, self.belt_s = self._shift_s + time_s, belt_s
        frame = Frame(sensor, self._given[sensor], self._last_s, color.copy(), depth_mm.copy(), camera)
        self._given[sensor] += 1
        self._free(slot)
        return frame

    def end(self) -> None:
        """End the process; nothing of it stays."""
        with self._lock:
            pipe, self._pipe = self._pipe, None
            if pipe is not None:
                pipe.close()
        if self._process is not None and self._process.pid is not None:
            self._process.terminate()
            self._process.join(LEAVE_S)
        self._process = None
        if self._memory is not None:
            self._memory.close()
            self._memory.unlink()
            self._memory = None
        self._ready.clear()

    def _receive(self, timeout_s: float) -> bool:
        """Take one announcement in; false where none came in time."""
        if self._pipe is None:
            raise _ended()
        try:
            if not self._pipe.poll(timeout_s):
                return False
            said = self._pipe.recv()
        except (EOFError, OSError) as error:
            raise _ended() from error
        if said is None:
            raise StopIteration
        self._ready.append(said)
        return True

    def _free(self, slot: int) -> None:
        with self._lock:
            if self._pipe is not None:
                with contextlib.suppress(OSError):
                    self._pipe.send(slot)

    def _maps(self, slot: int, camera: Intrinsics) -> tuple[U8, U16]:
        assert self._memory is not None  # noqa: S101 - a frame was announced, so it is there
        return frame_maps(self._memory, slot * self._room, camera)


def _ended() -> WorldError:
    return WorldError(
        "simulation_ended", "The process that renders the simulated rig has ended.", "It is started again by itself."
    )


def render(options: LineOptions, pipe: Connection, memory_name: str, room: int) -> None:
    """Render into free slots until the pipe is closed; the main of the process."""
    # An interrupt from the keyboard reaches both processes; it is the other one that ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(OSError, AttributeError):
        os.nice(POLITE)
    memory = SharedMemory(memory_name)
    show, free, epoch = Show(options), list(range(AHEAD)), 0
    try:
        while not show.over:
            while not free or epoch == 0 or pipe.poll():
                said = pipe.recv()
                if isinstance(said, int):
                    free.append(said)
                else:
                    epoch, show.showing = said
            frame = show.frame()
            slot = free.pop()
            lay(frame, memory, slot * room)
            pipe.send((epoch, slot, frame.sensor, frame.time_s, show.belt_s))
        pipe.send(None)
        while True:
            pipe.recv()
    except (EOFError, OSError):
        memory.close()
