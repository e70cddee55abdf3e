"""A long recording takes no more memory than a short one, but for the records of its fruit."""

from __future__ import annotations

import statistics
import tracemalloc
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from fruitgui.frame import Frame, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.recordings.writer import RecordingWriter
from fruitgui.sensors.sensor import SensorInfo
from fruitgui.station import crew, observing, prelude
from fruitgui.station.run_job import RunOptions, run_recording
from fruitgui.station.source import RecordingSource
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import write_station
from tests.unit.perception.spheres import Ball, Table

SMALL = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
BALLS = ((0.035, (200, 60, 40)), (0.028, (60, 170, 50)), (0.04, (210, 180, 50)))
APART_M, SPEED_M_S, STEP_S = 0.24, 0.24, 0.2
PERIOD = round(len(BALLS) * APART_M / SPEED_M_S / STEP_S)

FEW_PERIODS, MANY_PERIODS = 8, 18
"""The shorter recording is past its beginning: buffers fill and the pace of the belt settles within six periods."""

RECORD_BYTES = 40_000
"""What may stay of one fruit: the eighty points of its path, in the record and in the report."""

SLACK_BYTES = 1_500_000
"""Four frames' worth: which are in hand at a moment is luck. A fifth of what the views take."""


def endless_row() -> list[Frame]:
    """Return the frames of one period of a row of balls that passes without an end."""
    frames = []
    for number in range(PERIOD):
        shift = number * STEP_S * SPEED_M_S
        balls = tuple(
            Ball(place * APART_M + shift, 0.0, *BALLS[place % len(BALLS)])
            for place in range(-12, 12)
            if abs(place * APART_M + shift) < 0.75
        )
        frames.append(Table(balls, tilt_rad=0.0, intrinsics=SMALL, seed=number).frame())
    return frames


def record(folder: Path, frames: list[Frame], periods: int) -> Path:
    path = folder / f"{periods}.mcap"
    with RecordingWriter(path, [SensorInfo("ball", "", "", "1", SMALL, 5.0)]) as writer:
        for number in range(periods * len(frames)):
            writer.write(replace(frames[number % len(frames)], sequence=number, time_s=1e3 + STEP_S * number))
    return path


def level_bytes(recording: Path, station: Path) -> tuple[float, dict[str, Any]]:
    """Return what is held halfway and later, and the report.

    A peak would be luck: it is reached where the scheduler lets the most frames be in hand at once.
    """
    held: list[int] = []
    tracemalloc.start()
    try:
        report = run_recording(
            RecordingSource(recording), station, RunOptions(belt_speed_m_s=SPEED_M_S),
            lambda _, __: held.append(tracemalloc.get_traced_memory()[0]),
        )  # fmt: skip
    finally:
        tracemalloc.stop()
    return statistics.median(held[len(held) // 2 :]), report


def test_memory_does_not_grow_with_the_length_of_a_recording(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(prelude, "LOOK_S", 2.0)
    monkeypatch.setattr(crew, "usable_cores", lambda: 1)
    # How many frames happen to be decoded ahead is the scheduler's: a peak would be compared with luck.
    monkeypatch.setattr(observing, "FRAMES_AHEAD", 1)
    station = tmp_path / "station.json"
    surface = Table((), tilt_rad=0.0, intrinsics=SMALL).surface()
    write_station(station, Station("ball", {"ball": StationSensor("1", Pose.exact(), surface)}))
    frames = endless_row()
    # The first run imports, which is no part of it.
    level_bytes(record(tmp_path, frames, 1), station)
    short, few = level_bytes(record(tmp_path, frames, FEW_PERIODS), station)
    long, many = level_bytes(record(tmp_path, frames, MANY_PERIODS), station)
    more = len(many["fruit"]) - len(few["fruit"])
    assert more == pytest.approx((MANY_PERIODS - FEW_PERIODS) * PERIOD * STEP_S * SPEED_M_S / APART_M, abs=1)
    assert long - short < more * RECORD_BYTES + SLACK_BYTES
