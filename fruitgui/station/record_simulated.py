"""Recording a rig that does not exist: rendered as fast as the machine can, whole or not at all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from fruitgui.errors import InputError
from fruitgui.progress import Cancelled, Progress, never_cancelled, no_progress, stop_if
from fruitgui.sensors.recordings import RecordingWriter
from fruitgui.simulation.simulated import sensor_info
from fruitgui.simulation.simulation import Simulation
from fruitgui.station.record_state import Recorded


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
    lasted_s = max(times_s, default=0.0) - min(times_s, default=0.0)
    return Recorded((out,), counts, lasted_s, bytes_written=writer.bytes_written)


def _wanted(simulation: Simulation, sensors: Sequence[str] | None) -> list[str]:
    missing = [name for name in sensors or () if name not in simulation.sensors]
    if missing:
        raise InputError(
            "no_such_sensor",
            f"There is no simulated sensor {missing[0]!r}; there are {', '.join(simulation.sensors)}.",
            "Name some of these.",
        )
    return list(sensors or simulation.sensors)


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
    scene = simulation.scene
    end_s = scene.captures[0].time_s + seconds
    return Simulation(replace(scene, captures=tuple(one for one in scene.captures if one.time_s < end_s)))
