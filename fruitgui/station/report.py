"""The report of a run, `fruitgui.report/1`: units for people, conversions only here."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from fruitgui.files import write_json
from fruitgui.frame import F64
from fruitgui.measurement.fruit import Quantity
from fruitgui.station.fruit import Fruit

SCHEMA = "fruitgui.report/1"
ML_PER_M3 = 1e6
G_PER_KG = 1e3
MM_PER_M = 1e3


def fruit_value(fruit: Fruit) -> dict[str, Any]:
    """Return one fruit as the report has it."""
    value: dict[str, Any] = {
        "id": fruit.fruit,
        "kind": fruit.kind,
        "kind_probability": fruit.kind_probability,
        **_quantity("volume", "ml", fruit.volume_m3, ML_PER_M3),
    }
    if isfinite(fruit.volume_shared_m3):
        value["volume_shared_std_ml"] = fruit.volume_shared_m3 * ML_PER_M3
    if fruit.volume_paper_m3 is not None:
        value["volume_paper_ml"] = fruit.volume_paper_m3 * ML_PER_M3
    if fruit.mass_kg is not None:
        value |= _quantity("mass", "g", fruit.mass_kg, G_PER_KG)
        if isfinite(fruit.mass_shared_kg):
            value["mass_shared_std_g"] = fruit.mass_shared_kg * G_PER_KG
    return value | {
        **_quantity("perimeter", "mm", fruit.size.perimeter_m, MM_PER_M),
        **_quantity("length", "mm", fruit.size.length_m, MM_PER_M),
        **_quantity("diameter", "mm", fruit.size.diameter_m, MM_PER_M),
        "views": fruit.views,
        "first_seen_s": fruit.first_seen_s,
        "last_seen_s": fruit.last_seen_s,
        "path": [
            {
                "time_s": point.time_s,
                "position_m": point.position_m.tolist(),
                "covariance_m2": point.covariance_m2.tolist(),
            }
            for point in fruit.path
        ],
    }


def _quantity(name: str, unit: str, quantity: Quantity, factor: float) -> dict[str, float]:
    return {f"{name}_{unit}": quantity.value * factor, f"{name}_std_{unit}": quantity.std * factor}


def report_value(
    reference: str,
    fruit: Sequence[Fruit],
    sensors: Sequence[Mapping[str, Any]],
    velocity_m_s: F64 | None,
    warnings: Sequence[str],
    timing: Mapping[str, Any],
) -> dict[str, Any]:
    """Return the whole report; `counts` sums to the list of fruit."""
    return {
        "schema": SCHEMA,
        "reference_sensor": reference,
        "warnings": list(warnings),
        "sensors": [dict(sensor) for sensor in sensors],
        "counts": dict(sorted(Counter(one.kind for one in fruit).items())),
        "belt": {"velocity_m_s": None if velocity_m_s is None else velocity_m_s.tolist()},
        "fruit": [fruit_value(one) for one in fruit],
        "timing": dict(timing),
    }


def write_report(path: Path, report: Mapping[str, Any]) -> None:
    """Write the report, whole or not at all.

    Raises:
        WorldError: it cannot be written there.
    """
    write_json(path, dict(report))


def summary_lines(report: Mapping[str, Any]) -> list[str]:
    """Return the report's totals as lines for a person."""
    lines = [f"{len(report['fruit'])} fruit"]
    for kind, count in report["counts"].items():
        volumes = np.array([one["volume_ml"] for one in report["fruit"] if one["kind"] == kind])
        lines.append(f"  {kind:<20} {count:>5}   {volumes.mean():7.1f} ml each   {volumes.sum() / 1e3:8.3f} l in all")
    timing = report["timing"]
    rate = timing["frames"] / timing["wall_s"] if timing["wall_s"] else 0.0
    lines.append(
        f"{timing['frames']} frames in {timing['wall_s']:.1f} s ({rate:.0f} per second); "
        f"perceived and tracked in {timing['frame_ms']['p50']:.1f} ms each (median)"
    )
    return lines
