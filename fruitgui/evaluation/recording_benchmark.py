"""`python -m fruitgui.evaluation.recording_benchmark`: what recording costs, beside named baselines in the same run.

Two sensors of 640×480 at 30 frames a second, rendered before: flat out into a file, and live beside the line that
perceives and follows the same frames. Shares of processor time are of one core, in this process: it is the one that
records, and half of the line; the line's helper is a process of its own.
"""

from __future__ import annotations

import argparse
import contextlib
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

from fruitgui.errors import WorldError
from fruitgui.frame import Frame
from fruitgui.sensors.feed import Feed
from fruitgui.sensors.recordings import RecordingWriter
from fruitgui.sensors.recordings.messages import Messages, Stamp
from fruitgui.sensors.recordings.packing import COLOR, COLOR_INFO, DEPTH, DEPTH_INFO, TYPES
from fruitgui.sensors.recordings.writer import stamp_ns
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.simulation.looped import LoopedSensor
from fruitgui.simulation.scenes import line_scene, still_scene
from fruitgui.simulation.simulated import sensor_info
from fruitgui.station.fruit import Fruit
from fruitgui.station.live import Counting, LiveLine
from fruitgui.station.record_job import PACKERS, record_feed
from fruitgui.station.record_state import RecordPlan
from fruitgui.station.sink import CountedFruit, Crop
from fruitgui.station.station import Station
from fruitgui.station.waiting import BufferedSink

SEED, RATE_HZ, ROUND_S = 1, 30.0, 3.0
FLAT_OUT_FRAMES = 600


@dataclass(frozen=True, slots=True, eq=False)
class Rig:
    """Two sensors, a round of their frames, and the station they belong to."""

    infos: tuple[SensorInfo, ...]
    frames: tuple[Frame, ...]
    station: Station

    def sensors(self) -> list[LoopedSensor]:
        """Return them, at their rate."""
        return [
            LoopedSensor(info, [frame for frame in self.frames if frame.sensor == info.sensor]) for info in self.infos
        ]


def main(arguments: Sequence[str] | None = None) -> int:
    """Print every figure as it is measured."""
    parser = argparse.ArgumentParser(description="What recording two sensors costs.")
    parser.add_argument("--seconds", type=float, default=20.0, help="how long each live part lasts (20)")
    seconds = parser.parse_args(arguments).seconds
    rig = rendered_rig()
    with tempfile.TemporaryDirectory(prefix="fruitgui-benchmark-") as name:
        path = Path(name) / "r.mcap"
        for line in (*flat_out(rig, path), *live(rig, path, seconds)):
            sys.stdout.write(line + "\n")
            sys.stdout.flush()
    return 0


def rendered_rig(round_s: float = ROUND_S) -> Rig:
    """Return the rig, with fruit in view in every frame."""
    from fruitgui.station.calibrate_job import calibrate_stills

    still = still_scene(SEED + 1, rig_seed=SEED)
    infos = tuple(replace(sensor_info(still, sensor), rate_hz=RATE_HZ) for sensor in still.sensors)
    stills = {info.sensor: [one for one in still.frames() if one.sensor == info.sensor] for info in infos}
    outcome = calibrate_stills(stills, None, {info.sensor: info.serial for info in infos})
    if outcome.station is None:
        raise WorldError("benchmark_refused", "The benchmark's rig could not be calibrated.", "Report this.")
    line = line_scene(SEED + 2, 40, 0.15, rig_seed=SEED, captures_hz=RATE_HZ)
    middle_s = (line.captures[0].time_s + line.captures[-1].time_s) / 2.0
    chosen = [n for n, one in enumerate(line.captures) if 0.0 <= one.time_s - middle_s < round_s]
    return Rig(infos, tuple(line.frame(number) for number in chosen), outcome.station)


def flat_out(rig: Rig, path: Path) -> Iterator[str]:
    """Time writing frames into a file as fast as it goes; the baseline is the mcap package's own writer."""
    frames = [
        replace(rig.frames[n % len(rig.frames)], sequence=n, time_s=n / (2.0 * RATE_HZ)) for n in range(FLAT_OUT_FRAMES)
    ]
    with timed() as ours, ThreadPoolExecutor(PACKERS) as hands, RecordingWriter(path, rig.infos, hands) as writer:
        for frame in frames:
            writer.write(frame)
    ours_mb = path.stat().st_size / 1e6
    with timed() as theirs:
        write_plainly(path, rig.infos, frames)
    for name, took, size_mb in (
        (f"written flat out, {PACKERS} threads", ours, ours_mb),
        ("baseline, mcap.Writer on one thread", theirs, path.stat().st_size / 1e6),
    ):
        yield (
            f"{name}: {len(frames) / took.wall_s:.0f} frames/s, {took.cpu_s / len(frames) * 1e3:.2f} ms of one core a "
            f"frame, {size_mb * 1e3 / len(frames):.0f} kB a frame"
        )


def write_plainly(path: Path, infos: Sequence[SensorInfo], frames: Sequence[Frame]) -> None:
    """Write the same messages with the mcap package's own writer, as one does who follows its manual."""
    from mcap.writer import CompressionType, Writer

    messages = Messages()
    with path.open("wb") as file:
        writer = Writer(file, chunk_size=4 * 1024 * 1024, compression=CompressionType.ZSTD)
        writer.start(profile="ros2")
        schemas = {
            name: writer.register_schema(name, "ros2msg", messages.definition(name)) for name in set(TYPES.values())
        }
        channels = {
            (info.sensor, part): writer.register_channel(f"/{info.sensor}/{part}", "cdr", schemas[TYPES[part]])
            for info in infos
            for part in TYPES
        }
        for frame in frames:
            at_ns = stamp_ns(frame.time_s)
            stamp = Stamp(at_ns, f"{frame.sensor}_rgb_optical_frame")
            info = messages.camera_info(stamp, frame.intrinsics)
            for part, pieces in (
                (COLOR_INFO, info),
                (COLOR, messages.color(stamp, frame.color)),
                (DEPTH_INFO, info),
                (DEPTH, messages.depth(stamp, frame.depth_mm)),
            ):
                writer.add_message(channels[frame.sensor, part], at_ns, b"".join(pieces), at_ns, frame.sequence)
        writer.finish()


def live(rig: Rig, path: Path, seconds: float) -> Iterator[str]:
    """Time recording live: alone, and beside the line; the baseline of the latter is the line without recording."""
    for name, with_line, recorded in (
        ("recorded live, no line", False, True),
        ("baseline, the line alone", True, False),
        ("recorded live beside the line", True, True),
    ):
        yield f"{name}: {_live(rig, path if recorded else None, seconds, with_line=with_line)}"


def _live(rig: Rig, path: Path | None, seconds: float, *, with_line: bool) -> str:
    feed = Feed(rig.sensors())
    line = LiveLine(feed, rig.station, None, Counting(BufferedSink(_Nowhere()))) if with_line else None
    feed.start()
    try:
        if line is not None:
            line.start()
            _wait(lambda: line.state.frames > 100)  # the helper is up
        with timed() as took:
            before = 0 if line is None else line.state.frames
            if path is not None:
                done = record_feed(feed, RecordPlan(path, seconds))
            else:
                time.sleep(seconds)
            followed = 0 if line is None else line.state.frames - before
        words = [f"{100.0 * took.cpu_s / took.wall_s:.0f} % of one core"]
        if path is not None:
            words.insert(0, f"{sum(done.frames.values()) / seconds:.1f} frames/s, {sum(done.lost.values())} lost")
            path.unlink()
        if line is not None:
            words.append(f"the line followed {followed / took.wall_s:.1f} frames/s")
        return ", ".join(words)
    finally:
        if line is not None:
            line.stop()
        feed.stop()


def _wait(true: Callable[[], bool]) -> None:
    while not true():
        threading.Event().wait(0.05)


class _Nowhere:
    """Keeps no fruit: none is counted into a lot here."""

    def commit(self, lot: int, fruit: Fruit, crops: Sequence[Crop]) -> CountedFruit:  # noqa: ARG002
        """Number it."""
        return CountedFruit(1, lot, 1, fruit)


@dataclass(slots=True)
class Took:
    """Time on the clock, and of the processor in this process, all threads together."""

    wall_s: float = 0.0
    cpu_s: float = 0.0


@contextlib.contextmanager
def timed() -> Iterator[Took]:
    """Measure what happens inside."""
    took = Took()
    wall_s, cpu_s = time.perf_counter(), time.process_time()
    yield took
    took.wall_s, took.cpu_s = time.perf_counter() - wall_s, time.process_time() - cpu_s


if __name__ == "__main__":
    sys.exit(main())
