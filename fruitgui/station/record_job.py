"""Recording: the simulated rig to a file, and what is sound of a cut file to a good one."""

from __future__ import annotations

import contextlib
import math
import shutil
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fruitgui.errors import InputError
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.feed import DropOldest, Feed
from fruitgui.sensors.recordings import RecordingWriter, open_recording
from fruitgui.sensors.recordings.recovery import recover
from fruitgui.simulation.simulated import sensor_info
from fruitgui.simulation.simulation import Simulation

FRAMES_HELD = 60
"""Frames of each sensor that wait while the disk is busy."""

DISK_EVERY_S = 1.0


@dataclass(frozen=True, slots=True)
class Recorded:
    """What was written.

    Attributes:
        frames: by sensor.
        seconds: from the first frame to the last.
        warnings: what a person should know.
    """

    frames: dict[str, int]
    seconds: float
    warnings: tuple[str, ...] = ()

    def value(self, path: Path) -> dict[str, Any]:
        """Return the result as JSON."""
        return {
            "recording": str(path),
            "frames": self.frames,
            "seconds": self.seconds,
            "warnings": list(self.warnings),
        }

    def line(self, path: Path) -> str:
        """Return what to tell a person."""
        each = ", ".join(f"{sensor} {frames}" for sensor, frames in self.frames.items())
        return f"{path}: {sum(self.frames.values())} frames over {self.seconds:.1f} s ({each})"


def record_simulation(
    simulation: Simulation,
    out: Path,
    sensors: Sequence[str] | None = None,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Recorded:
    """Render a scene into a recording, whole or not at all.

    Raises:
        InputError: a sensor that the scene does not have.
        WorldError: the file cannot be written.
    """
    wanted = _wanted(simulation, sensors)
    counts = dict.fromkeys(wanted, 0)
    numbers = [at for at, capture in enumerate(simulation.captures) if capture.sensor in counts]
    infos = [sensor_info(simulation, sensor) for sensor in wanted]
    with RecordingWriter(out, infos) as writer:
        for done, number in enumerate(numbers):
            stop_if(cancelled)
            frame = simulation.frame(number)
            writer.write(frame)
            counts[frame.sensor] += 1
            progress(done / len(numbers), f"Recorded {done} frames")
    times_s = [simulation.captures[number].time_s for number in numbers]
    return Recorded(counts, max(times_s, default=0.0) - min(times_s, default=0.0))


def _wanted(simulation: Simulation, sensors: Sequence[str] | None) -> list[str]:
    missing = [name for name in sensors or () if name not in simulation.sensors]
    if missing:
        raise InputError(
            "no_such_sensor",
            f"There is no simulated sensor {missing[0]!r}; there are {', '.join(simulation.sensors)}.",
            "Name some of these.",
        )
    return list(sensors or simulation.sensors)


def record_feed(
    feed: Feed,
    out: Path,
    seconds: float | None,
    least_free_bytes: int,
    progress: Progress = no_progress,
    cancelled: Cancelled = never_cancelled,
) -> Recorded:
    """Record what running sensors give, until the time is up, a person stops it, or the disk is nearly full.

    Depth is written as the devices read it. Whatever ends the recording, what was recorded so far is whole and kept.

    Args:
        feed: of running sensors.
        out: the file.
        seconds: how long; None until `cancelled` says so.
        least_free_bytes: the disk keeps so much room.
        progress, cancelled: as for any job; being cancelled is how a recording is ended.

    Raises:
        WorldError: the file cannot be written.
    """
    counts = dict.fromkeys(feed.sensors, 0)
    warnings: list[str] = []
    began_s, checked_s = time.monotonic(), -math.inf
    queue = feed.subscribe(DropOldest(FRAMES_HELD))
    with contextlib.closing(queue), RecordingWriter(out, feed.infos.values()) as writer:
        while not cancelled() and not queue.over:
            now_s = time.monotonic()
            if seconds is not None and now_s - began_s >= seconds:
                break
            if now_s - checked_s >= DISK_EVERY_S:
                checked_s = now_s
                if shutil.disk_usage(out.resolve().parent).free < least_free_bytes:
                    warnings.append("The disk is nearly full: the recording was ended, and is whole up to there.")
                    break
            arrival = queue.take(0.1)
            if arrival is not None:
                writer.write(arrival.frame)
                counts[arrival.frame.sensor] += 1
                share = 0.0 if seconds is None else (now_s - began_s) / seconds
                progress(share, f"Recorded {writer.frames_written} frames, {writer.bytes_written / 1e6:.0f} MB")
    lost = {sensor: count for sensor, count in queue.dropped.items() if count}
    warnings += [f"{count} frames of {sensor} were lost: the disk was too slow." for sensor, count in lost.items()]
    return Recorded(counts, time.monotonic() - began_s, tuple(warnings))


def record_simulated(
    out: Path,
    seconds: float,
    seed: int,
    sensors: Sequence[str] | None,
    still: bool,
    progress: Progress = no_progress,
) -> Recorded:
    """Record the simulated rig for so many seconds of its own time.

    Raises:
        InputError: a sensor that it does not have.
        WorldError: the file cannot be written.
    """
    from fruitgui.simulation import scenes

    simulation = (
        scenes.still_scene(seed, captures=5) if still else scenes.line_scene(seed, fruit=max(6, round(seconds)))
    )
    return record_simulation(_first(simulation, seconds), out, sensors, progress)


def _first(simulation: Simulation, seconds: float) -> Simulation:
    """Return the scene's first seconds."""
    from dataclasses import replace

    scene = simulation.scene
    end_s = scene.captures[0].time_s + seconds
    return Simulation(replace(scene, captures=tuple(one for one in scene.captures if one.time_s < end_s)))


def recover_recording(cut: Path, out: Path, progress: Progress = no_progress) -> Recorded:
    """Write everything sound of a cut recording into a good one.

    Raises:
        InputError: nothing in it can be read, or not one frame; then nothing is written.
        WorldError: the file cannot be written.
    """
    progress(0.0, f"Reading {cut.name}")
    foreign = _is_foreign(cut)
    saved = recover(cut, out)
    warnings = [f"{saved.bytes_unread} bytes at the end of {cut} could not be used."] if saved.bytes_unread else []
    warnings += [f"{count} damaged parts were left out: {cause}." for cause, count in saved.damaged.items()]
    frames: Counter[str] = Counter()
    times_s: list[float] = []
    if foreign:
        warnings.append(f"{out} holds {saved.messages} messages; name the topics of its sensors with --topics.")
        return Recorded({}, 0.0, tuple(warnings))
    for time_s, frame in open_recording(out).frames():
        frames[frame.sensor] += 1
        times_s.append(time_s)
    return Recorded(dict(frames), max(times_s, default=0.0) - min(times_s, default=0.0), tuple(warnings))


def _is_foreign(path: Path) -> bool:
    """Tell whether the topics of a recording have other names than ours: it is saved without a look at its frames.

    Raises:
        InputError: the names are ours, and not one frame can be read.
    """
    try:
        with contextlib.closing(open_recording(path).frames()) as frames:
            next(frames, None)
    except InputError as error:
        if error.code != "no_sensor":
            raise
        return True
    return False
