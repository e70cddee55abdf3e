"""Frames that come late, in pieces, twice, or not at all."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.sensors.recordings import open_recording
from fruitgui.sensors.recordings.merge import Merge
from fruitgui.sensors.recordings.pairing import Pairing
from fruitgui.sensors.recordings.raw import RawMessage
from tests.unit.sensors import ros_files as ros

SECOND = 10**9
PERIOD = SECOND // 10


def message(stamp_ns: int) -> RawMessage:
    return RawMessage("/t", "t", "cdr", stamp_ns, b"x" * 100)


def merged(
    arrivals: list[tuple[str, int]], offsets_s: dict[str, float] | None = None
) -> tuple[list[tuple[str, int]], Merge]:
    """Return (sensor, stamp) as they leave, colour and depth arriving together, and the merge."""
    offsets = {sensor: round(seconds * SECOND) for sensor, seconds in (offsets_s or {}).items()}
    merge = Merge(offsets)
    left = []
    for sensor, stamp in arrivals:
        for depth in (False, True):
            left += [(name, pair.time_ns) for name, pair in merge.add(sensor, stamp, message(stamp), depth=depth)]
    left += [(name, pair.time_ns) for name, pair in merge.finish()]
    return left, merge


def shuffled_within(stamps: list[int], reach_ns: int, seed: int) -> list[int]:
    """Delay each stamp by up to `reach_ns`: it then arrives after at most that much newer ones."""
    draw = np.random.default_rng(seed)
    return [stamp for _, stamp in sorted((stamp + draw.uniform(0, reach_ns), stamp) for stamp in stamps)]


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 10**6), sensors=st.integers(1, 4), count=st.integers(1, 80), reach_s=st.floats(0, 2.0))
def test_up_to_two_seconds_late_nothing_is_lost_and_all_is_in_order(
    seed: int, sensors: int, count: int, reach_s: float
) -> None:
    every = [(n * PERIOD + s * PERIOD // 7 + SECOND, f"s{s}") for n in range(count) for s in range(sensors)]
    names = dict(every)
    arrivals = shuffled_within([stamp for stamp, _ in every], int(reach_s * SECOND), seed)
    left, _ = merged([(names[stamp], stamp) for stamp in arrivals])
    assert left == [(names[stamp], stamp) for stamp in sorted(arrivals)]


def test_later_than_two_seconds_is_dropped_and_counted() -> None:
    stamps = [n * PERIOD for n in range(1, 60)]
    late = stamps.pop(10)
    left, merge = merged([("a", stamp) for stamp in [*stamps[:45], late, *stamps[45:]]])
    assert left == [("a", stamp) for stamp in stamps]
    assert merge.dropped("a")["more than 2 s late"] == 1


def test_a_silent_sensor_keeps_nobody_waiting() -> None:
    """b falls silent after 3 s; what a shows 6 s later has left, except the last four seconds."""
    merge = Merge({})
    left: list[tuple[str, int]] = []
    for n in range(1, 91):
        for sensor in ("a", "b") if n <= 30 else ("a",):
            for depth in (False, True):
                stamp = n * PERIOD
                left += [(name, pair.time_ns) for name, pair in merge.add(sensor, stamp, message(stamp), depth=depth)]
    newest = max(stamp for _, stamp in left)
    assert newest >= 90 * PERIOD - 2.5 * SECOND
    assert sum(name == "b" for name, _ in left) == 30
    assert left == sorted(left, key=lambda one: one[1])


def test_a_sensor_that_comes_back_is_in_order_again() -> None:
    arrivals = [(sensor, n * PERIOD) for n in range(1, 120) for sensor in "ab" if sensor == "a" or not 30 < n < 80]
    left, merge = merged(arrivals)
    assert sorted(left, key=lambda one: one[1]) == left
    assert len(left) == len(arrivals)
    assert not any(merge.dropped("a").values())


@pytest.mark.parametrize("ahead_s", [-1.9, 1.9, 0.3])
def test_clocks_that_differ_by_less_than_two_seconds_are_merged_by_their_stamps(ahead_s: float) -> None:
    shift = round(ahead_s * SECOND)
    arrivals = [(s, n * PERIOD + 100 * SECOND + (shift if s == "b" else 0)) for n in range(80) for s in ("a", "b")]
    left, _ = merged(arrivals)
    assert [stamp for _, stamp in left] == sorted(stamp for _, stamp in arrivals)
    offset_left, _ = merged(arrivals, {"b": -ahead_s})
    assert [name for name, _ in offset_left] == [name for name, _ in arrivals]


def test_clocks_that_have_nothing_in_common_lose_nothing() -> None:
    arrivals = [(s, n * PERIOD + (10**6 * SECOND if s == "b" else SECOND)) for n in range(80) for s in ("a", "b")]
    left, _ = merged(arrivals)
    assert len(left) == 160
    for name in "ab":
        own = [stamp for sensor, stamp in left if sensor == name]
        assert own == sorted(own)


def test_one_stamp_far_in_the_future_does_not_end_the_recording() -> None:
    arrivals = [("a", n * PERIOD) for n in range(1, 80)]
    left, _ = merged([*arrivals[:30], ("a", 10**6 * SECOND), *arrivals[30:]])
    assert left == [*arrivals, ("a", 10**6 * SECOND)]


def test_slow_recordings_lose_nothing() -> None:
    """One frame every five seconds: longer than any waiting."""
    arrivals = [(sensor, n * 5 * SECOND) for n in range(1, 12) for sensor in ("a", "b")]
    left, _ = merged(arrivals)
    assert [stamp for _, stamp in left] == [stamp for _, stamp in arrivals]


def test_a_repeated_message_is_one_frame() -> None:
    left, merge = merged([("a", n * PERIOD) for n in (1, 2, 2, 3, 3, 3, 4)])
    assert [stamp // PERIOD for _, stamp in left] == [1, 2, 3, 4]
    assert merge.dropped("a")["stamped like another"] == 3


def paired(color: list[float], depth: list[float]) -> tuple[list[float], int]:
    """Return (depth stamps of the pairs, unmatched) of streams stamped in periods."""
    pairing = Pairing()
    arrivals = sorted([(stamp, False) for stamp in color] + [(stamp, True) for stamp in depth])
    for stamp, is_depth in arrivals:
        pairing.add(round(stamp * PERIOD), message(0), depth=is_depth)
    pairs = pairing.take(10**18)
    return [round(pair.time_ns / PERIOD, 3) for pair in pairs], pairing.unmatched


def steps(count: int, shift: float = 0.0, *, missing: tuple[int, ...] = ()) -> list[float]:
    return [n + shift for n in range(1, count + 1) if n not in missing]


@pytest.mark.parametrize("shift", [0.0, 0.2, -0.3, 0.49, -0.49])
def test_nearest_stamp_within_half_a_frame(shift: float) -> None:
    got, unmatched = paired(steps(20, shift), steps(20))
    assert got == steps(20)
    assert unmatched == 0


def test_farther_than_half_a_frame_stays_alone() -> None:
    got, unmatched = paired(steps(20, 0.3, missing=(7,)), steps(20, missing=(12,)))
    assert got == steps(20, missing=(7, 12))
    assert unmatched == 2


def test_the_same_stamp_goes_before_a_near_one() -> None:
    got, unmatched = paired([1, 1.3, 2, 3, 4], [1, 2, 3, 4])
    assert got == [1, 2, 3, 4]
    assert unmatched == 1


def test_a_colour_camera_that_runs_on_between_turns_loses_no_frame() -> None:
    got, unmatched = paired([n / 3 for n in range(3, 61)], steps(19))
    assert got == steps(19)
    assert unmatched == 0


def test_stamps_of_a_real_device_jitter() -> None:
    draw = np.random.default_rng(3)
    color = [n + draw.normal(0.25, 0.05) for n in range(1, 101)]
    depth = [n + draw.normal(0.0, 0.05) for n in range(1, 101)]
    got, unmatched = paired(color, depth)
    assert len(got) == 100
    assert unmatched == 0


def test_dropped_frames_are_told_with_their_cause(tmp_path: Path) -> None:
    messages = [m for n in range(10) for m in ros.frameset("k1", 1.0 + n / 10)]
    without_one_color = [m for k, m in enumerate(messages) if k != 3 * 4 + 1]
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", without_one_color))
    assert len(list(recording.frames())) == 9
    assert recording.tally.dropped("k1") == 1
    assert recording.warnings == ["r.mcap: 1 frame of k1 left out: colour without depth or depth without colour."]


def test_frames_that_are_all_stamped_zero_take_the_time_of_recording(tmp_path: Path) -> None:
    messages = [
        ros.Message(m.topic, m.kind, m.log_s, {**m.fields, "stamp_ns": 0})
        for n in range(5)
        for m in ros.frameset("k1", 3.0 + n / 10)
    ]
    recording = open_recording(ros.write_mcap(tmp_path / "r.mcap", messages))
    assert [time_s for time_s, _ in recording.frames()] == pytest.approx([3.0, 3.1, 3.2, 3.3, 3.4])
    assert "stamps every frame 0" in recording.warnings[0]


def test_negative_and_zero_stamps(tmp_path: Path) -> None:
    messages = [m for n in range(-3, 4) for m in ros.frameset("k1", n / 10)]
    read = list(open_recording(ros.write_mcap(tmp_path / "r.mcap", messages)).frames())
    assert [time_s for time_s, _ in read] == pytest.approx([n / 10 for n in range(-3, 4)])
