"""Feels whether sensors that have an accelerometer were turned, however little of the belt they see."""

from __future__ import annotations

from collections import defaultdict, deque

import numpy as np

from fruitgui.frame import F64

SAMPLES = 5
TURNED_RAD = float(np.radians(1.5))
"""A Kinect's accelerometer feels 0.3° at a time: five times the spread of what two means of five differ by."""

_GRAVITY_M_S2 = (5.0, 15.0)
"""What is felt outside of this is a knock or no gravity at all."""


class LevelWatch:
    """Compares which way is down with the first seconds of the line."""

    def __init__(self) -> None:
        self._first: dict[str, list[F64]] = defaultdict(list)
        self._latest: dict[str, deque[F64]] = defaultdict(lambda: deque(maxlen=SAMPLES))

    def feel(self, sensor: str, felt_m_s2: tuple[float, float, float] | None) -> float | None:
        """Take in what a sensor feels, about once a second; return by how many radians it was turned, None if not."""
        if felt_m_s2 is None or not _GRAVITY_M_S2[0] < np.linalg.norm(felt_m_s2) < _GRAVITY_M_S2[1]:
            return None
        down = np.asarray(felt_m_s2, dtype=np.float64)
        first, latest = self._first[sensor], self._latest[sensor]
        if len(first) < SAMPLES:
            first.append(down)
            return None
        latest.append(down)
        if len(latest) < SAMPLES:
            return None
        angle_rad = _angle_rad(np.mean(first, axis=0), np.mean(latest, axis=0))
        return angle_rad if angle_rad > TURNED_RAD else None


def _angle_rad(one: F64, other: F64) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(one, other)), one @ other))
