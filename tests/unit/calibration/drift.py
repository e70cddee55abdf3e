"""A sensor that warms up, and whose light changes: other frames made from those of another sensor."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fruitgui.frame import U8, U16, Frame


@dataclass(frozen=True, slots=True)
class Drift:
    """How a sensor and its light change with its own time.

    Attributes:
        warming: share by which depth is too large at first; what is left of it falls to a third in `warming_s`.
        warming_s: time constant.
        light_from_s: when the light changes.
        light: (red, green, blue) times as much from then on, linear.
    """

    warming: float = 0.0
    warming_s: float = 900.0
    light_from_s: float = 0.0
    light: tuple[float, float, float] = (1.0, 1.0, 1.0)

    def depth_scale(self, time_s: float) -> float:
        """Return by how much depth is too large at a time."""
        return 1.0 + self.warming * float(np.exp(-time_s / self.warming_s))


def drifted(frame: Frame, drift: Drift) -> Frame:
    """Return a frame as it is while its sensor drifts."""
    depth_mm = frame.depth_mm
    if drift.warming:
        depth_mm = np.rint(depth_mm * drift.depth_scale(frame.time_s)).astype(np.uint16)
    return replace(frame, depth_mm=_dithered(frame, depth_mm), color=_relit(frame, drift))


def _dithered(frame: Frame, depth_mm: U16) -> U16:
    """Return depth with readings moved by a millimetre at random, as noise before rounding would."""
    rng = np.random.default_rng([frame.sequence, 71])
    moved = rng.integers(-1, 2, depth_mm.shape)
    return np.where(depth_mm > 1, depth_mm + moved, depth_mm).astype(np.uint16)


def _relit(frame: Frame, drift: Drift) -> U8:
    if frame.time_s < drift.light_from_s or drift.light == (1.0, 1.0, 1.0):
        return frame.color
    gains = np.sqrt(np.array(drift.light, dtype=np.float32))
    return np.clip(np.rint(frame.color * gains), 0, 255).astype(np.uint8)
