"""`python -m fruitgui.evaluation.benchmark`: how fast, beside named baselines in the same run.

Figures are medians; absolute times say as much about the machine as about the
program, ratios say more.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from fruitgui.evaluation.stage import Act, record_acts
from fruitgui.geometry.plane import Surface

STARTS = 5
# The largest memory that wait4 tells counts the parent's too; the process's own account does not.
_RUN_AND_TELL_PEAK = """
import sys
from pathlib import Path
from fruitgui.cli import main
code = main(sys.argv[1:])
print(*(one for one in Path("/proc/self/status").read_text().splitlines() if one.startswith("VmHWM")))
sys.exit(code)
"""


def main() -> int:
    """Print every figure as it is measured."""
    for figures in (starting, perceiving, simulating, calibrating, running):
        for line in figures():
            sys.stdout.write(line + "\n")
            sys.stdout.flush()
    return 0


def starting() -> Iterator[str]:
    """Time the start of the package and of its help, against Python's own start."""
    bare_s = _median_s(lambda: _python("-c", "pass"))
    import_s = _median_s(lambda: _python("-c", "import fruitgui"))
    help_s = _median_s(lambda: _python("-m", "fruitgui", "--help"))
    yield f"import fruitgui: {import_s:.3f} s, fruitgui --help: {help_s:.3f} s (Python alone: {bare_s:.3f} s)"


def _python(*arguments: str) -> None:
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)  # noqa: S603 - ourselves


def _median_s(job: Callable[[], None]) -> float:
    times = []
    for _ in range(STARTS):
        began_s = time.perf_counter()
        job()
        times.append(time.perf_counter() - began_s)
    return float(np.median(times))


def perceiving() -> Iterator[str]:
    """Time perceiving and tracking one frame with 28 fruit, and Open3D's planes and clusters on the same frame."""
    from fruitgui.perception.benchmark import benchmark

    figures = benchmark()
    track_ms = tracking_ms()
    ours_ms = figures.perceive_ms + track_ms
    yield str(figures)
    yield (
        f"perceived and tracked: {figures.perceive_ms:.1f} + {track_ms:.1f} = {ours_ms:.1f} ms of one core; "
        f"Open3D / ours: {figures.open3d_ms / ours_ms:.0f}"
    )


def tracking_ms(fruit: int = 28, updates: int = 60) -> float:
    """Return the median processor time of one tracker update with so many fruit in view, milliseconds."""
    from fruitgui.geometry.pose import Pose
    from fruitgui.geometry.rig import Mount, Rig
    from fruitgui.perception.benchmark import crowded_frame
    from fruitgui.perception.perceiver import Perceiver
    from fruitgui.tracking.belt import BeltMotion
    from fruitgui.tracking.tracker import Tracker

    frame, surface = crowded_frame(fruit)
    rig = Rig(frame.sensor, {frame.sensor: Mount(frame.sensor, Pose.exact(), surface, frame.intrinsics)})
    seen = Perceiver(frame.sensor, frame.intrinsics, surface).observe(frame, 0.0)
    tracker = Tracker(rig, BeltMotion(np.zeros(3)))
    times = []
    for number in range(updates):
        observation = replace(seen, time_s=0.1 * number)
        began_s = time.process_time()
        tracker.update(observation)
        times.append(time.process_time() - began_s)
    return float(np.median(times[3:])) * 1e3


def simulating() -> Iterator[str]:
    """Time rendering with 20 fruit in view."""
    from fruitgui.simulation.benchmark import render_speed

    speed = render_speed()
    yield (
        f"simulated Kinect frames: {speed.frames_per_cpu_s:.1f} per second of one core, "
        f"{speed.fruit_in_view:.0f} things in view"
    )


def calibrating() -> Iterator[str]:
    """Time self-calibration of two and of eight sensors."""
    from fruitgui.calibration.calibrate import calibrate
    from fruitgui.calibration.result import Calibration
    from fruitgui.simulation import scenes

    for layout, sensors in (("opposed", 2), ("ring", 8)):
        simulation = scenes.still_scene(3, layout=layout, sensors=sensors, fruit=20)
        stills = {
            sensor: [frame for frame in simulation.frames() if frame.sensor == sensor] for sensor in simulation.sensors
        }
        began_s = time.perf_counter()
        result = calibrate(stills)
        took_s = time.perf_counter() - began_s
        word = "accepted" if isinstance(result, Calibration) else "refused"
        yield f"calibrate {sensors} sensors: {took_s:.1f} s ({word})"


def running() -> Iterator[str]:
    """Time `run` on two-sensor recordings, and hold the memory of a long one against a short one.

    One line is told no region and has rails, hands and touching fruit in view: all of it is looked at.
    """
    short = Act("short", 11, 10, 20, speed_m_s=0.1)
    long = Act("long", 12, 10, 60, speed_m_s=0.1)
    cluttered = Act("cluttered", 21, 10, 24, foreign=6, speed_m_s=0.15, touching=0.2, foreign_kinds=("hand",))
    with tempfile.TemporaryDirectory(prefix="fruitgui-benchmark-") as name:
        folder = Path(name)
        record_acts((short, long, cluttered), folder)
        figures, few_mb = _run(short, folder, _surfaces(short))
        yield f"run, {short.fruit} fruit: {figures}"
        figures, many_mb = _run(long, folder, _surfaces(long))
        yield f"run, {long.fruit} fruit: {figures}"
        anywhere = {sensor: replace(surface, region_m=None) for sensor, surface in _surfaces(cluttered).items()}
        figures, _ = _run(cluttered, folder, anywhere)
        yield f"run, {cluttered.fruit} fruit, {cluttered.foreign} hands, both rails inside the region: {figures}"
        yield (
            f"peak memory without the helper's: {few_mb:.0f} MB for {short.fruit} fruit, "
            f"{many_mb:.0f} MB for {long.fruit}"
        )


def _surfaces(act: Act) -> dict[str, Surface]:
    return {sensor: mount.surface for sensor, mount in act.simulation.rig().mounts.items()}


def _run(act: Act, folder: Path, surfaces: Mapping[str, Surface]) -> tuple[str, float]:
    """Run an act in a process of its own; return its figures and its peak memory, MB."""
    from fruitgui.station.station import Station, StationSensor
    from fruitgui.station.station_file import write_station

    station = folder / f"{act.name}.json"
    rig = act.simulation.rig()
    write_station(station, Station(rig.reference, {
        sensor: StationSensor(act.simulation.device(sensor).serial, mount.pose, surfaces[sensor])
        for sensor, mount in rig.mounts.items()
    }))  # fmt: skip
    printed = folder / f"{act.name}.txt"
    with printed.open("w", encoding="utf-8") as out:
        process = subprocess.Popen(  # noqa: S603 - ourselves
            [sys.executable, "-c", _RUN_AND_TELL_PEAK, "run", str(act.path(folder)), "--station", str(station),
             "--report", str(folder / f"{act.name}-report.json")],
            stdout=out,
        )  # fmt: skip
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    told = printed.read_text(encoding="utf-8").splitlines()
    line = next(line for line in told if "frames in" in line)
    peak_kb = next((int(line.split()[1]) for line in told if line.startswith("VmHWM")), 0)
    return (
        f"{line}; {usage.ru_utime + usage.ru_stime:.1f} s of processor time with the helper's",
        peak_kb / 1024,
    )


if __name__ == "__main__":
    sys.exit(main())
