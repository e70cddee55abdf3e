"""Frames perceived on two cores: a helper process takes those that this one has no time for."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import time
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from types import TracebackType
from typing import Self

from fruitgui.frame import Frame, Intrinsics
from fruitgui.geometry.plane import Surface
from fruitgui.perception.perceiver import Perceiver
from fruitgui.perception.settings import PerceptionSettings
from fruitgui.perception.view import Observation
from fruitgui.progress import deaf_children
from fruitgui.sensors.frame_memory import BYTES_PER_PIXEL, frame_maps, lay

WORTH_IT = 40
"""Frames after which a helper is called: shorter recordings are read before it has started."""

HANDED = 3
"""Frames that lie with the helper: it has work while this process measures a fruit."""

WAITING = 8
"""Frames that may be perceived before an earlier one is: they bound the memory."""

LEAVE_S = 5.0


@dataclass(frozen=True, slots=True, eq=False)
class Eye:
    """What a perceiver is made from: a sensor's station id, its camera, the belt as it sees it, and its limits."""

    sensor: str
    intrinsics: Intrinsics
    surface: Surface
    settings: PerceptionSettings = field(default_factory=PerceptionSettings)

    def perceiver(self) -> Perceiver:
        """Return the perceiver."""
        return Perceiver(self.sensor, self.intrinsics, self.surface, self.settings)


@dataclass(slots=True, eq=False)
class Task:
    """One frame on its way.

    Attributes:
        time_s: in the reference clock.
        frame: named as the recording names its sensor.
        observation: what was perceived, None until then. took_s: how long that took.
    """

    time_s: float
    frame: Frame
    observation: Observation | None = None
    took_s: float = 0.0


class Crew:
    """Perceives frames in the order given, here and, once it is worth it, in a process beside.

    Perceiving has no memory, so it does not matter who perceives which frame. The helper ends with `close`, with
    this process, and when it is asked for nothing any more; without it everything is perceived here.

    Args:
        eyes: by the sensor's id in the recording.
        cores: how many there are; the helper needs a second one.
        alone: frames after which the helper is called.

    Attributes:
        helped: frames that the helper perceived.
    """

    def __init__(self, eyes: Mapping[str, Eye], cores: int | None = None, alone: int = WORTH_IT) -> None:
        self._eyes = dict(eyes)
        self._perceivers = {sensor: eye.perceiver() for sensor, eye in eyes.items()}
        self._cores = usable_cores() if cores is None else cores
        self._alone = alone
        self._helper: Helper | None = None
        self.helped = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """End the helper. Any number of times."""
        if self._helper is not None:
            self._helper.close()
            self._helper = None

    def perceived(self, tasks: Iterable[Task]) -> Iterator[Task]:
        """Yield every task, in the order given, with what was perceived in its frame."""
        waiting: deque[Task] = deque()
        done_here = 0
        for task in tasks:
            waiting.append(task)
            if task.observation is None and (self._helper is None or not self._helper.take(task)):
                self._perceive(task)
                done_here += 1
            if done_here == self._alone and self._helper is None and self._cores > 1:
                self._call()
            yield from self._done(waiting, WAITING)
        yield from self._done(waiting, 0)

    def _call(self) -> None:
        """Call the helper; where there is no memory to share, or no process to be had, all goes on without."""
        try:
            self._helper = Helper(self._eyes)
        except OSError:
            self._cores = 1

    def _done(self, waiting: deque[Task], most: int) -> Iterator[Task]:
        """Yield what is done, and wait for the helper while more than `most` are not."""
        while waiting:
            if self._helper is not None:
                done, left = self._helper.collect(wait=len(waiting) > most and waiting[0].observation is None)
                for task in left:
                    self._perceive(task)
                self.helped += done
            if waiting[0].observation is None:
                return
            yield waiting.popleft()

    def _perceive(self, task: Task) -> None:
        began_s = time.perf_counter()
        perceiver = self._perceivers[task.frame.sensor]
        task.observation = perceiver.observe(replace(task.frame, sensor=perceiver.sensor), task.time_s)
        task.took_s = time.perf_counter() - began_s


class Helper:
    """A process that perceives; frames go through memory that both share, what is seen in them through a pipe."""

    def __init__(self, eyes: Mapping[str, Eye]) -> None:
        context = multiprocessing.get_context("spawn")
        self._pixels = {sensor: eye.intrinsics.width * eye.intrinsics.height for sensor, eye in eyes.items()}
        self._room = BYTES_PER_PIXEL * max(self._pixels.values())
        self._memory = SharedMemory(create=True, size=HANDED * self._room)
        self._free = list(range(HANDED))
        self._handed: deque[tuple[int, Task]] = deque()
        self._ready = self._lost = False
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(
            target=help_perceiving, args=(dict(eyes), theirs, self._memory.name, self._room), daemon=True
        )
        try:
            with deaf_children():
                self._process.start()
        except OSError:
            self._give_back()
            raise
        theirs.close()

    def take(self, task: Task) -> bool:
        """Hand a frame over, if the helper is up and has room."""
        if self._lost or not self._free or not self._is_ready():
            return False
        slot = self._free.pop()
        frame = task.frame
        lay(frame, self._memory, slot * self._room)
        self._handed.append((slot, task))
        try:
            self._pipe.send((slot, frame.sensor, frame.sequence, frame.time_s, task.time_s))
        except OSError:
            self._handed.pop()
            self._lost = True
        return not self._lost

    def _is_ready(self) -> bool:
        """Tell whether the helper has started: its first word is nothing."""
        if not self._ready and self._pipe.poll():
            try:
                self._pipe.recv()
            except (EOFError, OSError):
                self._lost = True
            self._ready = not self._lost
        return self._ready

    def collect(self, *, wait: bool) -> tuple[int, list[Task]]:
        """Take what the helper has perceived, at least one frame if told to wait.

        Returns:
            How many frames it perceived, and, should it be gone, those that it leaves undone.
        """
        done = 0
        while self._handed and not self._lost and (wait or self._pipe.poll()):
            wait = False
            try:
                observation, took_s = self._pipe.recv()
            except (EOFError, OSError):
                self._lost = True
                break
            slot, task = self._handed.popleft()
            self._free.append(slot)
            task.observation, task.took_s = observation, took_s
            done += 1
        left = [task for _, task in self._handed] if self._lost else []
        if left:
            self._handed.clear()
        return done, left

    def close(self) -> None:
        """End the process; nothing of it stays."""
        self._pipe.close()
        self._process.terminate()
        self._process.join(LEAVE_S)
        self._give_back()

    def _give_back(self) -> None:
        self._memory.close()
        with contextlib.suppress(FileNotFoundError):  # swept away by someone else
            self._memory.unlink()


def help_perceiving(eyes: Mapping[str, Eye], pipe: Connection, memory_name: str, room: int) -> None:
    """Perceive what comes through the pipe, until it is closed; the main of the helper's process."""
    memory = SharedMemory(memory_name)
    perceivers = {sensor: eye.perceiver() for sensor, eye in eyes.items()}
    try:
        pipe.send(None)
        while True:
            slot, sensor, sequence, frame_time_s, time_s = pipe.recv()
            began_s = time.perf_counter()
            eye = eyes[sensor]
            maps = frame_maps(memory, slot * room, eye.intrinsics)
            frame = Frame(eye.sensor, sequence, frame_time_s, *maps, eye.intrinsics)
            observation = perceivers[sensor].observe(frame, time_s)
            pipe.send((observation, time.perf_counter() - began_s))
    except (EOFError, OSError):
        return


def usable_cores() -> int:
    """Return how many cores this process may use; one where it may start no other."""
    if multiprocessing.current_process().daemon:
        return 1
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
