"""What a device's depth is off by, and taking it off: once, where frames are read."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import NO_DEPTH, U16, Intrinsics


@dataclass(frozen=True, slots=True)
class DepthCorrection:
    """True depth = scale · depth · (1 + Σ radial_k r^(2k)) + offset, r the distance from the optical axis at z = 1.

    Attributes:
        scale: factor, 1 where none.
        offset_m: metres.
        radial: factors of r², r⁴, …
    """

    scale: float = 1.0
    offset_m: float = 0.0
    radial: tuple[float, ...] = ()

    def apply(self, depth_mm: U16, intrinsics: Intrinsics) -> U16:
        """Return corrected depth (height, width), uint16 mm; pixels without a reading stay so."""
        factor: np.float32 | np.ndarray[tuple[int, ...], np.dtype[np.float32]] = np.float32(self.scale)
        if self.radial:
            squared = np.square(intrinsics.rays()).sum(axis=-1)
            series = sum(k * squared ** (power + 1) for power, k in enumerate(self.radial))
            factor = factor * (1 + series).astype(np.float32)
        corrected = np.rint(depth_mm * factor + np.float32(self.offset_m * 1e3)).clip(1, 65535)
        return np.where(depth_mm == NO_DEPTH, NO_DEPTH, corrected).astype(np.uint16)
