"""A process beside the line that perceives frames and measures tracks."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import queue
import signal
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from fruitgui.errors import FruitguiError, WorldError
from fruitgui.frame import Frame
from fruitgui.geometry.rig import Rig
from fruitgui.perception.view import Observation
from fruitgui.station.crew import Eye
from fruitgui.station.judging import Judge, Judgement
from fruitgui.station.live.parcels import receive, send
from fruitgui.station.model import Model
from fruitgui.tracking.track import Track

HANDED = 2
"""Jobs that lie with the process: it has work while its last answer is taken in."""

LEAVE_S = 2.0
POLITE = 5
"""Helpers give way to the window, and to the threads that read sensors."""


@dataclass(frozen=True, slots=True, eq=False)
class Skills:
    """What perceiving and measuring need to know: a worker is made of it in each thread or process."""

    eyes: Mapping[str, Eye]
    rig: Rig
    model: Model | None

    def worker(self) -> Worker:
        """Return a worker; everything that does not depend on the work is worked out here, once."""
        return Worker(self)


class Worker:
    """Perceives and measures, one thing at a time."""

    def __init__(self, skills: Skills) -> None:
        self._perceivers = {sensor: eye.perceiver() for sensor, eye in skills.eyes.items()}
        self._names = {sensor: eye.sensor for sensor, eye in skills.eyes.items()}
        self._judge = Judge(skills.rig, skills.model)

    def do(self, job: Look | Weigh) -> Observation | Judgement:
        """Return what comes of a job."""
        return self.look(job) if isinstance(job, Look) else self.weigh(job)

    def look(self, job: Look) -> Observation:
        """Return what is seen in a frame."""
        frame = job.frame
        named = Frame(
            self._names[frame.sensor], frame.sequence, frame.time_s, frame.color, frame.depth_mm, frame.intrinsics
        )
        return self._perceivers[frame.sensor].observe(named, job.time_s)

    def weigh(self, job: Weigh) -> Judgement:
        """Return what a track is and how large."""
        return self._judge.judge(job.track)


@dataclass(frozen=True, slots=True, eq=False)
class Look:
    """A frame to perceive, and its time in the reference clock."""

    frame: Frame
    time_s: float


@dataclass(frozen=True, slots=True, eq=False)
class Weigh:
    """A track to measure and to name."""

    track: Track


class HelperLostError(WorldError):
    """The process is gone; who asked does the work itself."""

    def __init__(self) -> None:
        super().__init__("helper_lost", "The helping process has ended.", "The line goes on without it.")


class Helper:
    """Hands jobs to a process of its own. Any thread may ask; one owner starts and closes.

    Args:
        skills: what the process works with.
        on_room: called on a thread of the helper's when a job is done, when the process is up, and when it is gone.
    """

    def __init__(self, skills: Skills, on_room: Callable[[], None]) -> None:
        self._skills = skills
        self._on_room = on_room
        self._jobs: queue.Queue[tuple[Look | Weigh, Future[Any]] | None] = queue.Queue()
        self._asked: queue.Queue[Future[Any]] = queue.Queue()
        self._lock = threading.Lock()
        self._outstanding = 0
        self._up = self._lost = False
        self._process: Any = None
        self._pipe: Connection | None = None
        self._threads: tuple[threading.Thread, ...] = ()

    def start(self) -> None:
        """Start the process; where none is to be had, it counts as gone."""
        context = multiprocessing.get_context("spawn")
        try:
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(target=work, args=(self._skills, theirs), daemon=True)
            self._process.start()
        except OSError:
            self._lost = True
            return
        theirs.close()
        self._threads = tuple(
            threading.Thread(target=run, name=f"helper {run.__name__}", daemon=True)
            for run in (self._send_all, self._receive_all)
        )
        for thread in self._threads:
            thread.start()

    @property
    def works(self) -> bool:
        """Whether the process is up and not gone."""
        return self._up and not self._lost

    @property
    def outstanding(self) -> int:
        """How many jobs lie with it."""
        return self._outstanding

    def ask(self, job: Look | Weigh, most: int = HANDED) -> Future[Any] | None:
        """Hand a job over; None where the process is not up, gone, or has `most` jobs already."""
        with self._lock:
            if not self.works or self._outstanding >= most:
                return None
            self._outstanding += 1
        answer: Future[Any] = Future()
        self._jobs.put((job, answer))
        return answer

    def kill(self) -> None:
        """End the process in the middle of whatever it does."""
        if self._process is not None:
            self._process.kill()

    def close(self) -> None:
        """End the process; what it left undone fails with `HelperLostError`. Any number of times."""
        self._give_up()
        self._jobs.put(None)
        if self._process is not None and self._process.pid is not None:
            self._process.terminate()
            self._process.join(LEAVE_S)
            self._process.kill()  # one that stands still is not even terminated
        for thread in self._threads:
            thread.join(LEAVE_S)
        if self._pipe is not None:
            self._pipe.close()

    def _send_all(self) -> None:
        pipe = self._pipe
        assert pipe is not None  # noqa: S101 - opened before this thread was started
        while (asked := self._jobs.get()) is not None:
            job, answer = asked
            self._asked.put(answer)
            try:
                send(pipe, job)
            except OSError:
                self._give_up()
            if self._lost:
                self._fail_all()

    def _receive_all(self) -> None:
        pipe = self._pipe
        assert pipe is not None  # noqa: S101 - opened before this thread was started
        try:
            pipe.recv()
            self._up = True
            self._on_room()
            while True:
                done, error = receive(pipe)
                self._settle(self._asked.get_nowait(), done, error)
        except (EOFError, OSError, queue.Empty):
            self._give_up()
            self._fail_all()

    def _settle(self, answer: Future[Any], done: object, error: str | None) -> None:
        with self._lock:
            self._outstanding -= 1
        self._on_room()
        if error is None:
            answer.set_result(done)
        else:
            answer.set_exception(JobError(error))

    def _give_up(self) -> None:
        with self._lock:
            self._lost = True
        self._on_room()

    def _fail_all(self) -> None:
        with contextlib.suppress(queue.Empty):
            while True:
                answer = self._asked.get_nowait()
                if not answer.done():
                    answer.set_exception(HelperLostError())


class JobError(FruitguiError):
    """A job that failed, wherever it was done."""

    def __init__(self, what: str) -> None:
        super().__init__("job_failed", what, "The line goes on; if this comes often, calibrate again.")


def work(skills: Skills, pipe: Connection) -> None:
    """Do jobs until the pipe is closed; the main of the process."""
    # An interrupt from the keyboard reaches both processes; it is the other one that ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(OSError, AttributeError):
        os.nice(POLITE)
    worker = skills.worker()
    try:
        pipe.send(None)
        while True:
            send(pipe, attempted(worker, receive(pipe)))
    except (EOFError, OSError):
        return


def attempted(worker: Worker, job: Look | Weigh) -> tuple[Observation | Judgement | None, str | None]:
    """Return (what came of a job, None), or (None, what went wrong)."""
    try:
        return worker.do(job), None
    except FruitguiError as error:
        return None, error.what
    except Exception as error:  # noqa: BLE001 - one bad frame or fruit must not end the line; it is said
        return None, f"{type(error).__name__}: {error}"
