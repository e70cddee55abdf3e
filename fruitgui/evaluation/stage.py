"""Simulated recordings of one rig on disk, made side by side: to calibrate on, to train on, to run."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Iterable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from multiprocessing.process import BaseProcess
from pathlib import Path

from fruitgui.progress import Cancelled, Progress, deaf_children, never_cancelled, no_progress, stop_if
from fruitgui.simulation import scenes
from fruitgui.simulation.simulation import Simulation
from fruitgui.simulation.stock import STRANGE

PROCESSES = 2


@dataclass(frozen=True)
class Act:
    """One scene of a stage, small enough to be sent to another process, which renders it.

    Attributes:
        name: of its file, without the ending.
        seed: of the fruit, their places and the noise.
        rig_seed: of the sensors, where they stand and how they err, and of the belt.
        fruit: how many pieces; foreign: how many foreign objects among them.
        speed_m_s: of the belt; zero for a still scene.
        touching: share of fruit that touch another.
        foreign_kinds: foreign objects are drawn from these.
    """

    name: str
    seed: int
    rig_seed: int
    fruit: int
    foreign: int = 0
    speed_m_s: float = 0.0
    touching: float = 0.0
    foreign_kinds: tuple[str, ...] = STRANGE

    @cached_property
    def simulation(self) -> Simulation:
        """The scene with its truth."""
        if self.speed_m_s == 0.0:
            return scenes.still_scene(self.seed, fruit=self.fruit, touching=self.touching, rig_seed=self.rig_seed)
        return scenes.line_scene(
            self.seed, fruit=self.fruit, foreign=self.foreign, speed_m_s=self.speed_m_s, touching=self.touching,
            foreign_kinds=self.foreign_kinds, rig_seed=self.rig_seed,
        )  # fmt: skip

    def path(self, folder: Path) -> Path:
        """Return where its recording lies."""
        return folder / f"{self.name}.mcap"


def _record(act: Act, folder: Path) -> None:
    """Render one act; runs in a process of its own."""
    from fruitgui.station.record_simulated import record_simulation

    record_simulation(act.simulation, act.path(folder))


def record_acts(
    acts: Sequence[Act], folder: Path, progress: Progress = no_progress, cancelled: Cancelled = never_cancelled
) -> None:
    """Write the recordings of all acts into a folder, on both cores.

    Raises:
        CancelledByUserError: `cancelled` said so; what was not begun is not made.
        WorldError: a file cannot be written.
    """
    with ProcessPoolExecutor(PROCESSES, mp_context=multiprocessing.get_context("spawn")) as pool:
        others = set(multiprocessing.active_children())
        with deaf_children():
            jobs = [pool.submit(_record, act, folder) for act in acts]
        try:
            _wait(jobs, progress, cancelled)
        except BaseException:
            _end(jobs, set(multiprocessing.active_children()) - others)
            raise


def _end(jobs: Sequence[Future[None]], renderers: Iterable[BaseProcess]) -> None:
    """Leave undone what is not done: a renderer would go on for half a minute before anyone could leave."""
    for job in jobs:
        job.cancel()
    for renderer in renderers:
        renderer.terminate()


def _wait(jobs: Sequence[Future[None]], progress: Progress, cancelled: Cancelled) -> None:
    while not all(job.done() for job in jobs):
        stop_if(cancelled)
        done = sum(job.done() for job in jobs)
        progress(done / len(jobs), f"Rendering simulated recordings ({done} of {len(jobs)} done)")
        time.sleep(0.1)
    for job in jobs:
        job.result()
