"""From a source to fruit counted, as the operator's window goes, without a window."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fruitgui.sensors.feed import Feed
from fruitgui.sensors.recordings import open_recording
from fruitgui.simulation.show import Showing
from fruitgui.simulation.supply import LineOptions, crossed
from fruitgui.station.belt_job import measure_belt
from fruitgui.station.calibrate_job import calibrate_stills
from fruitgui.station.judging import FEATURES
from fruitgui.station.live import FLAT_OUT, Counting, LiveLine, Phase
from fruitgui.station.model import read_model
from fruitgui.station.record_job import record_feed
from fruitgui.station.record_state import Ending, RecordPlan, RecordState
from fruitgui.station.run_job import RunOptions, run_recording
from fruitgui.station.source import RecordingSource
from fruitgui.station.sources import Connected, RecordedSource, SimulatedSource
from fruitgui.station.station import Station
from fruitgui.station.station_file import write_station
from fruitgui.station.stills import collect_stills
from fruitgui.station.train_job import train_recordings
from fruitgui.station.waiting import BufferedSink
from tests.journeys.conftest import Stage
from tests.unit.station.memory_sink import MemorySink

pytestmark = [pytest.mark.xdist_group("stage"), pytest.mark.usefixtures("no_leaked_threads")]

FRUIT = 12
OPTIONS = LineOptions(rig_seed=21, seed=8, speed_m_s=0.2, rate_hz=5.0, fruit=FRUIT)


@contextmanager
def running(connected: Connected) -> Iterator[Feed]:
    feed = Feed(connected.sensors)
    feed.start()
    try:
        yield feed
    finally:
        assert feed.stop() == ()


@pytest.fixture(scope="module")
def calibrated() -> Station:
    """The station, calibrated from frames of the running rig."""
    connected = SimulatedSource(OPTIONS, flat_out=True).connect()
    assert connected.rig is not None
    connected.rig.show(Showing.STILL)
    with running(connected) as feed:
        stills = collect_stills(feed, 10)
        serials = {sensor: info.serial for sensor, info in feed.infos.items()}
    outcome = calibrate_stills(stills, "kinect_1", serials)
    assert outcome.station is not None, outcome.reasons
    return outcome.station


def run_to_the_end(feed: Feed, line: LiveLine) -> None:
    """Start the line before its sensors, so that it misses nothing, and let it come to its end."""
    line.start()
    feed.start()
    try:
        assert line.wait(240.0)
        assert line.state.phase is Phase.ENDED
    finally:
        assert line.stop()
        assert feed.stop() == ()


def test_from_a_source_to_counts_that_equal_the_truth(stage: Stage, calibrated: Station, tmp_path: Path) -> None:
    station, model = tmp_path / "station.json", tmp_path / "model.fruit"
    write_station(station, calibrated)
    lessons = [(RecordingSource(Path(stage.path("training.mcap"))), Path(stage.path("labels.csv")))]
    train_recordings(lessons, station, model)
    connected = SimulatedSource(OPTIONS, flat_out=True).connect()
    feed, sink = Feed(connected.sensors), MemorySink()
    line = LiveLine(feed, calibrated, read_model(model, FEATURES), Counting(BufferedSink(sink)), 7, FLAT_OUT)
    run_to_the_end(feed, line)
    assert connected.rig is not None
    truth = crossed(OPTIONS, connected.rig.belt_s)
    assert len(truth) == FRUIT
    state = line.state
    assert state.counted == len(sink.kept) == FRUIT
    assert state.skipped == 0
    assert not any(state.dropped.values())
    assert [warning.code for warning in state.warnings] == []
    assert {counted.lot for counted, _ in sink.kept} == {7}
    said = Counter(counted.fruit.kind for counted, _ in sink.kept)
    true = Counter(thing.kind for thing in truth)
    assert (said & true).total() >= FRUIT - 1
    volume_m3 = sum(thing.volume_m3 for thing in truth)
    assert sum(counted.fruit.volume_m3.value for counted, _ in sink.kept) == pytest.approx(volume_m3, rel=0.06)
    speed_m_s = float(np.linalg.norm(state.belt_velocity_m_s)) if state.belt_velocity_m_s is not None else 0.0
    assert speed_m_s == pytest.approx(0.2, abs=0.01)
    for counted, crops in sink.kept:
        assert {crop.content for crop in crops} == {"colour", "depth", "outline"}
        assert {crop.sensor for crop in crops} <= {"kinect_1", "kinect_2"}
        assert counted.fruit.views >= 3


def test_a_recording_through_the_line_counts_what_running_it_counts(
    stage: Stage, calibrated: Station, tmp_path: Path
) -> None:
    path, station = Path(stage.path("line.mcap")), tmp_path / "station.json"
    write_station(station, calibrated)
    shares: list[float] = []
    report = run_recording(RecordingSource(path), station, RunOptions(), lambda share, _: shares.append(share))
    assert shares == sorted(shares)
    assert shares[0] == 0.0
    assert shares[-1] > 0.7
    feed, sink = Feed(RecordedSource(path, speed=0.0).connect().sensors), MemorySink()
    run_to_the_end(feed, LiveLine(feed, calibrated, None, Counting(BufferedSink(sink)), 1, FLAT_OUT))
    volumes_ml = sorted(counted.fruit.volume_m3.value * 1e6 for counted, _ in sink.kept)
    assert volumes_ml == pytest.approx(sorted(one["volume_ml"] for one in report["fruit"]), rel=1e-6)


def test_the_belts_speed_is_measured_from_what_passes(calibrated: Station) -> None:
    connected = SimulatedSource(replace(OPTIONS, fruit=None), flat_out=True).connect()
    with running(connected) as feed:
        motion = measure_belt(feed, calibrated, longest_s=120.0)
    assert motion is not None
    assert motion.speed_m_s == pytest.approx(0.2, abs=0.012)


def test_what_runs_can_be_recorded_and_played(calibrated: Station, tmp_path: Path) -> None:
    path = tmp_path / "taken.mcap"
    connected = SimulatedSource(replace(OPTIONS, fruit=None), flat_out=True).connect()
    enough = threading.Event()

    def watch(state: RecordState) -> None:
        if sum(state.frames.values()) >= 30:
            enough.set()

    with running(connected) as feed:
        recorded = record_feed(feed, RecordPlan(path), watch, enough.is_set)
    assert sum(recorded.frames.values()) >= 30
    assert recorded.ended is Ending.STOPPED
    sensors = {one.info.sensor: one.info.serial for one in RecordedSource(path).connect().sensors}
    assert sensors == {name: sensor.serial for name, sensor in calibrated.sensors.items()}
    frames = [frame for _, frame in open_recording(path).frames()]
    assert len(frames) == sum(recorded.frames.values())


def test_what_is_recorded_beside_the_running_line_is_what_it_saw(calibrated: Station, tmp_path: Path) -> None:
    path, station = tmp_path / "beside.mcap", tmp_path / "station.json"
    write_station(station, calibrated)
    feed, sink = Feed(SimulatedSource(OPTIONS, flat_out=True).connect().sensors), MemorySink()
    line = LiveLine(feed, calibrated, None, Counting(BufferedSink(sink)), 1, FLAT_OUT)
    waits = threading.Event()
    with ThreadPoolExecutor(1) as beside:
        recording = beside.submit(record_feed, feed, RecordPlan(path), lambda _: waits.set())
        assert waits.wait(30.0)
        run_to_the_end(feed, line)
        recorded = recording.result(60.0)
    assert recorded.ended is Ending.SENSORS_ENDED
    assert not any(recorded.lost.values())
    assert sum(recorded.frames.values()) == line.state.frames
    report = run_recording(RecordingSource(path), station, RunOptions())
    assert len(report["fruit"]) == len(sink.kept) == FRUIT
