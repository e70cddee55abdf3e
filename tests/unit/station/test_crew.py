"""A helper perceives what this process would have, in the same order, and ends with it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import psutil
import pytest

from fruitgui.station import crew as crew_module
from fruitgui.station.crew import Crew, Eye, Task
from tests.unit.perception.spheres import Table, row_of_balls

PATIENCE_S = 60.0
EYE_OF = {"front": (0.035, 0.03), "back": (0.04,)}


def table_of(sensor: str) -> Table:
    return row_of_balls(EYE_OF[sensor], 0.02, tilt_rad=0.3)


def eyes() -> dict[str, Eye]:
    return {
        sensor: Eye(f"station_{sensor}", table_of(sensor).intrinsics, table_of(sensor).surface()) for sensor in EYE_OF
    }


def tasks(crew: Crew, helped: int) -> Iterator[Task]:
    """Yield frames of both sensors in turn until the helper has perceived so many."""
    frames = {sensor: replace(table_of(sensor).frame(), sensor=sensor) for sensor in EYE_OF}
    began_s, number = time.monotonic(), 0
    while crew.helped < helped and time.monotonic() - began_s < PATIENCE_S:
        sensor = ("front", "back")[number % 2]
        yield Task(0.1 * number, replace(frames[sensor], sequence=number, time_s=0.1 * number))
        number += 1


def test_a_helper_sees_the_same_in_the_same_order() -> None:
    with Crew(eyes(), cores=2, alone=4) as crew:
        found = list(crew.perceived(tasks(crew, 6)))
        assert crew.helped >= 6
    assert [task.frame.sequence for task in found] == list(range(len(found)))
    alone = {sensor: eye.perceiver() for sensor, eye in eyes().items()}
    for task in found[:4] + found[-12:]:
        seen = task.observation
        assert seen is not None
        sensor = task.frame.sensor
        assert (seen.sensor, seen.sequence, seen.time_s) == (f"station_{sensor}", task.frame.sequence, task.time_s)
        expected = alone[sensor].observe(replace(task.frame, sensor=f"station_{sensor}"), task.time_s).views
        assert len(seen.views) == len(expected) == len(EYE_OF[sensor])
        for view, other in zip(seen.views, expected, strict=True):
            np.testing.assert_array_equal(view.features, other.features)
            np.testing.assert_array_equal(view.points_m, other.points_m)
            np.testing.assert_array_equal(view.patch, other.patch)


@pytest.mark.skipif(os.name == "nt", reason="kills a process the POSIX way")
def test_a_helper_that_dies_leaves_nothing_undone() -> None:
    before = set(psutil.Process().children())
    with Crew(eyes(), cores=2, alone=2) as crew:
        killed = 0
        for _ in crew.perceived(tasks(crew, 8)):
            if crew.helped >= 3:
                for child in set(psutil.Process().children()) - before:
                    if "resource_tracker" not in " ".join(child.cmdline()):
                        child.kill()
                        killed += 1
                break
        rest = list(crew.perceived(list(tasks_of(20))))
    assert killed == 1
    assert [task.observation is not None for task in rest] == [True] * 20


def tasks_of(number: int) -> Iterator[Task]:
    frame = replace(table_of("back").frame(), sensor="back")
    for sequence in range(number):
        yield Task(0.1 * sequence, replace(frame, sequence=sequence))


def test_one_core_has_no_helper() -> None:
    with Crew(eyes(), cores=1, alone=1) as crew:
        assert all(task.observation is not None for task in crew.perceived(list(tasks_of(4))))
        assert crew.helped == 0


def test_where_no_helper_is_to_be_had_all_is_perceived_here(monkeypatch: pytest.MonkeyPatch) -> None:
    def none_to_be_had(_eyes: object) -> None:
        raise OSError(28, "no space left")

    monkeypatch.setattr(crew_module, "Helper", none_to_be_had)
    with Crew(eyes(), cores=2, alone=1) as crew:
        assert all(task.observation is not None for task in crew.perceived(list(tasks_of(4))))


FOREVER = """
import psutil
from fruitgui.station.crew import Crew
from tests.unit.station.test_crew import eyes, tasks
with Crew(eyes(), cores=2, alone=2) as crew:
    said = False
    for task in crew.perceived(tasks(crew, 10**9)):
        if crew.helped and not said:
            print(*(child.pid for child in psutil.Process().children()), flush=True)
            said = True
"""


@pytest.mark.skipif(os.name == "nt", reason="sends an interrupt the POSIX way")
def test_an_interrupt_ends_both_at_once() -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", FOREVER], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True,
    )  # fmt: skip
    assert process.stdout is not None
    children = [psutil.Process(int(pid)) for pid in process.stdout.readline().split()]
    assert children
    os.killpg(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=PATIENCE_S)
    assert process.returncode != 0
    assert "Process SpawnProcess" not in said
    assert "leaked" not in said
    _, alive = psutil.wait_procs(children, timeout=PATIENCE_S)
    assert not alive
