from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.station.fruit import Fruit
from fruitgui.station.report import fruit_value, report_value, summary_lines, write_report
from fruitgui.tracking.track import PathPoint


def fruit(number: int, kind: str, mass_kg: Quantity | None = None) -> Fruit:
    size = Size(Quantity(1e-4, 2e-6), Quantity(0.07, 1e-3), Quantity(0.06, 1e-3), Quantity(0.2, 2e-3), 0.8)
    path = (PathPoint(1.0, np.array([0.1, 0.0, 1.0]), np.eye(3) * 1e-6), PathPoint(2.0, np.zeros(3), np.eye(3)))
    return Fruit(number, kind, 0.9, size, Quantity(1.1e-4, 3e-6), mass_kg, None, 2, path)


def test_units_are_those_of_people() -> None:
    value = fruit_value(fruit(1, "lemon", Quantity(0.12, 0.003)))
    assert value["volume_ml"] == pytest.approx(110.0)
    assert value["volume_std_ml"] == pytest.approx(3.0)
    assert value["mass_g"] == pytest.approx(120.0)
    assert value["length_mm"] == pytest.approx(70.0)
    assert value["perimeter_std_mm"] == pytest.approx(2.0)
    assert (value["first_seen_s"], value["last_seen_s"], value["views"]) == (1.0, 2.0, 2)


def test_what_is_not_known_is_absent() -> None:
    assert not {"mass_g", "mass_std_g", "volume_paper_ml"} & set(fruit_value(fruit(1, "lemon")))


def test_counts_sum_to_the_list_and_the_file_is_the_value(tmp_path: Path) -> None:
    timing = {"frames": 10, "wall_s": 1.0, "frame_ms": {"p50": 1.0, "p99": 2.0}, "stages_ms": {}}
    fruits = [fruit(1, "lemon"), fruit(2, "unknown"), fruit(3, "lemon")]
    value = report_value("k1", fruits, [{"id": "k1", "frames": 10, "dropped": 0}], np.array([0.1, 0, 0]), ["w"], timing)
    assert value["counts"] == {"lemon": 2, "unknown": 1}
    write_report(tmp_path / "r.json", value)
    assert json.loads((tmp_path / "r.json").read_text()) == value
    assert any("lemon" in line for line in summary_lines(value))


def test_a_report_of_nothing_is_a_report() -> None:
    timing = {"frames": 0, "wall_s": 0.0, "frame_ms": {"p50": 0.0, "p99": 0.0}, "stages_ms": {}}
    value = report_value("k1", [], [], None, [], timing)
    assert value["belt"] == {"velocity_m_s": None}
    assert summary_lines(value)
