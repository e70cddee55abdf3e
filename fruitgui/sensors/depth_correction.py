"""What a device's depth is off by, taken out once, where frames are read."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from fruitgui.frame import F32, U16, Frame, Intrinsics


@dataclass(frozen=True, slots=True)
class DepthCorrection:
    """True depth of a device's reading z, metres: (scale + radial_2 r² + radial_4 r⁴) z + offset_m.

    r is the distance of the pixel's ray from the optical axis at z = 1.

    Attributes:
        scale: of the depth; 1 is none.
        offset_m: added to the depth.
        radial_2, radial_4: how the scale grows away from the axis.
    """

    scale: float = 1.0
    offset_m: float = 0.0
    radial_2: float = 0.0
    radial_4: float = 0.0

    @property
    def is_none(self) -> bool:
        """Whether nothing is corrected."""
        return self == DepthCorrection()

    def apply(self, depth_mm: U16, intrinsics: Intrinsics) -> U16:
        """Return the corrected depth (height, width), whole millimetres, 0 = no reading."""
        if self.is_none:
            return depth_mm
        if self.radial_2 == 0.0 and self.radial_4 == 0.0:
            return _table(self)[depth_mm]
        corrected = depth_mm.astype(np.float32) * _scales(self, intrinsics) + np.float32(self.offset_m * 1e3)
        return _whole_mm(corrected, depth_mm)

    def corrected(self, frame: Frame) -> Frame:
        """Return a device's own frame with its depth put right."""
        if self.is_none:
            return frame
        return replace(frame, depth_mm=self.apply(frame.depth_mm, frame.intrinsics))


@lru_cache(maxsize=32)
def _table(correction: DepthCorrection) -> U16:
    every_mm = np.arange(65536, dtype=np.uint16)
    corrected = every_mm.astype(np.float32) * np.float32(correction.scale) + np.float32(correction.offset_m * 1e3)
    return _whole_mm(corrected, every_mm)


@lru_cache(maxsize=32)
def _scales(correction: DepthCorrection, intrinsics: Intrinsics) -> F32:
    r2 = np.square(intrinsics.rays()).sum(axis=-1)
    scales: F32 = (correction.scale + correction.radial_2 * r2 + correction.radial_4 * r2**2).astype(np.float32)
    return scales


def _whole_mm(corrected_mm: F32, read_mm: U16) -> U16:
    good = (read_mm > 0) & (corrected_mm >= 0.5) & (corrected_mm < 65534.5)
    return np.where(good, np.rint(corrected_mm), np.float32(0.0)).astype(np.uint16)
