"""Short names of contents: equal contents have equal fingerprints, so that one can tell what was made from what."""

from __future__ import annotations

import hashlib
import json
from typing import Any

from fruitgui.station.station import Station
from fruitgui.station.station_file import station_value


def fingerprint(value: Any) -> str:  # noqa: ANN401 - JSON is any
    """Return 16 hexadecimal digits that stand for a JSON value."""
    text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def calibration_fingerprint(station: Station) -> str:
    """Return what stands for where the sensors stand over the belt: poses and planes, not the region nor the speed."""
    sensors = station_value(station)["sensors"]
    placed = {
        name: {
            "serial": one["serial"],
            "pose": {"rotation": one["pose"]["rotation"], "translation_m": one["pose"]["translation_m"]},
            "plane": {"normal": one["surface"]["normal"], "offset_m": one["surface"]["offset_m"]},
            "depth_correction": one["depth_correction"],
        }
        for name, one in sensors.items()
    }
    return fingerprint({"reference": station.reference, "sensors": placed})
