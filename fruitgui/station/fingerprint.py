"""Short names of contents: equal contents have equal fingerprints, so that one can tell what was made from what."""

from __future__ import annotations

import hashlib
import json
from functools import lru_cache
from typing import Any

from fruitgui.station.station import Station
from fruitgui.station.station_file import station_value

DECIMALS = 9
"""Poses are compared to a nanometre and a nanoradian: reading makes rotations orthonormal, which moves last digits."""


def fingerprint(value: Any) -> str:  # noqa: ANN401 - JSON is any
    """Return 16 hexadecimal digits that stand for a JSON value."""
    text = json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@lru_cache(maxsize=4)
def calibration_fingerprint(station: Station) -> str:
    """Return what stands for where the sensors stand over the belt: poses and planes, not the region nor the speed.

    It is asked for whenever the window shows how far each step is; the last few stations' are kept.
    """
    sensors = station_value(station)["sensors"]
    placed = {
        name: {
            "serial": one["serial"],
            "pose": _rounded([one["pose"]["rotation"], one["pose"]["translation_m"]]),
            "plane": _rounded([one["surface"]["normal"], one["surface"]["offset_m"]]),
            "depth_correction": one["depth_correction"],
        }
        for name, one in sensors.items()
    }
    return fingerprint({"reference": station.reference, "sensors": placed})


def _rounded(value: Any) -> Any:  # noqa: ANN401 - numbers in lists in lists
    """Return numbers rounded, without a sign on nothing."""
    return [_rounded(one) for one in value] if isinstance(value, list) else round(value, DECIMALS) + 0.0
