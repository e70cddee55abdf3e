from __future__ import annotations

import pytest

from fruitgui.station.timing import Stopwatch


def test_percentiles_are_those_of_the_frames() -> None:
    watch = Stopwatch()
    for milliseconds in range(1, 101):
        watch.frame(milliseconds * 1e-3)
    value = watch.value()
    assert value["frames"] == 100
    assert value["frame_ms"]["p50"] == pytest.approx(50, abs=0.2)
    assert value["frame_ms"]["p99"] == pytest.approx(99, abs=0.2)


def test_stages_are_means_per_frame_and_nothing_is_no_trouble() -> None:
    watch = Stopwatch()
    assert watch.value()["frame_ms"] == {"p50": 0.0, "p99": 0.0}
    for _ in range(4):
        watch.frame(1e-3)
        watch.add("perceive", 0.002)
    with watch.stage("track"):
        pass
    assert watch.value()["stages_ms"]["perceive"] == pytest.approx(2.0)
    assert watch.value()["stages_ms"]["track"] >= 0.0


def test_a_frame_that_took_for_ever_is_still_counted() -> None:
    watch = Stopwatch()
    watch.frame(1e6)
    assert watch.frames == 1
