"""A scene labelled as by an operator, and how fast it is rendered."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from fruitgui.frame import Intrinsics
from fruitgui.simulation import scenes
from fruitgui.simulation.benchmark import render_speed
from fruitgui.simulation.labels import truth_labels, write_labels

SMALL = Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5)
QUICK = scenes.Conditions(camera=SMALL)


def test_labels_point_at_the_fruit_they_name(tmp_path: Path) -> None:
    sim = scenes.line_scene(4, 6, foreign=2, speed_m_s=0.3, conditions=QUICK)
    rows = truth_labels(sim, per_fruit=2, volume_share=0.5, seed=1)
    truth = {f"f{thing.fruit_id:04d}": thing for thing in sim.truth.fruit}
    assert {row.fruit for row in rows} <= {name for name, thing in truth.items() if not thing.foreign}
    assert len({row.fruit for row in rows}) >= 5
    stamps = {(c.sensor, c.time_s - sim.device(c.sensor).clock_offset_s): c for c in sim.captures}
    for row in rows:
        capture = stamps[row.sensor, row.time_s]
        bodies = sim.in_sight(capture)
        seen = sim.eye(capture.sensor).who(bodies)[round(row.v_px), round(row.u_px)]
        assert f"f{bodies[seen].body.fruit_id:04d}" == row.fruit
        assert row.kind == truth[row.fruit].kind
        assert row.volume_ml in (None, pytest.approx(truth[row.fruit].volume_m3 * 1e6))
    assert 0 < len({row.fruit for row in rows if row.volume_ml is not None}) < 6 or len(rows) < 4
    assert rows == truth_labels(sim, per_fruit=2, volume_share=0.5, seed=1)
    path = tmp_path / "labels.csv"
    write_labels(path, rows)
    with path.open(encoding="utf-8") as file:
        read = list(csv.DictReader(file))
    assert len(read) == len(rows)
    assert [float(line["time_s"]) for line in read] == pytest.approx([row.time_s for row in rows], abs=1e-8)


def test_speed_is_told() -> None:
    speed = render_speed(seed=3, fruit=4, frames=2)
    assert speed.frames == 2
    assert 1 <= speed.fruit_in_view <= 8
    assert speed.frames_per_cpu_s > 1
