"""Depth as a Kinect v1 measures it, from exact depth.

Sources: Khoshelham & Oude Elberink 2012, "Accuracy and resolution of Kinect
depth data for indoor mapping applications" (disparity, its 1/8-pixel step,
σ_z = 1.4e-3 z² m); Nguyen, Izadi & Lovell 2012, "Modeling Kinect sensor noise"
(edges, grazing surfaces). z = f b / d, all effects act on the disparity d.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, U16, Bools


@dataclass(frozen=True, slots=True)
class DepthModel:
    """How one sensor's depth errs. Every effect is off at 0.

    Attributes:
        focal_px: focal length in which disparity is counted (the device's own 640 × 480 infrared camera).
        baseline_m: from the infrared camera to the projector, along +x.
        step_px: step of the disparity.
        sigma_px: standard deviation of the disparity, step included; 0.0609 is 1.4e-3 z² m.
        window_px: (width, height) of the window over which errors are correlated.
        fixed_share: share of the variance (before rounding) that stays with the pixel from capture to capture, as the
            dot pattern does; averaging captures of a still scene does not lessen it.
        fattening_px: how far near surfaces grow over what is behind them, 0–2.
        scale_error: relative error of depth (0.006 is 0.6 %).
        offset_m: constant error of depth.
        radial_error: relative error of depth at the picture's corner beyond that in the middle (grows with r²).
        speckle_share: share of pixels lost at random, in small spots.
        dark_infrared: returned signal (reflectance × cosine at 1 m, falling with z²) below which pixels drop out.
        grazing_cosine: cosine between normal and line of sight below which pixels drop out.
        shadow: the projector's shadow holds no reading (1) or does (0).
        nearest_m, farthest_m: limits of the range.
    """

    focal_px: float = 580.0
    baseline_m: float = 0.075
    step_px: float = 0.125
    sigma_px: float = 0.0609
    window_px: tuple[int, int] = (9, 4)
    fixed_share: float = 0.5
    fattening_px: float = 1.0
    scale_error: float = 0.0
    offset_m: float = 0.0
    radial_error: float = 0.0
    speckle_share: float = 0.002
    dark_infrared: float = 0.02
    grazing_cosine: float = 0.14
    shadow: float = 1.0
    nearest_m: float = 0.5
    farthest_m: float = 4.0

    @property
    def disparity_m_px(self) -> float:
        """Depth times disparity."""
        return self.focal_px * self.baseline_m

    @property
    def noise_px(self) -> float:
        """Standard deviation of the disparity before it is rounded to its step (uniform error step²/12)."""
        return float(np.sqrt(max(self.sigma_px**2 - self.step_px**2 / 12, 0.0)))


PERFECT = DepthModel(
    step_px=0.0, sigma_px=0.0, fattening_px=0.0, speckle_share=0.0, dark_infrared=0.0, grazing_cosine=0.0, shadow=0.0
)
"""Depth without error, in whole millimetres."""


class NoiseBank:
    """Noise made once and shown through windows at random places: cheap, seeded, the same in every run.

    Attributes:
        smooth: correlated over the matching window, standard deviation 1.
        blotch: correlated over a few pixels, standard deviation 1; decides drop-outs.
        fixed: (height, width) a part of such noise that never changes.
    """

    def __init__(self, height: int, width: int, window_px: tuple[int, int], rng: Generator) -> None:
        import cv2

        self._shape = (height, width)
        shape = (height + 389, width + 521)
        white = rng.standard_normal(shape, dtype=np.float32)
        smooth = cv2.blur(white, window_px)
        self.smooth = smooth / np.float32(smooth.std())
        self.fixed = self.window(self.smooth, rng).copy()
        blotch = cv2.GaussianBlur(rng.standard_normal(shape, dtype=np.float32), (0, 0), 1.2)
        self.blotch = blotch / np.float32(blotch.std())

    def window(self, bank: F32, rng: Generator) -> F32:
        """Return a window (height, width) of a bank at a random place, not to be written."""
        row = int(rng.integers(bank.shape[0] - self._shape[0] + 1))
        column = int(rng.integers(bank.shape[1] - self._shape[1] + 1))
        view: F32 = bank[row : row + self._shape[0], column : column + self._shape[1]]
        return view


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """Exact depth as the infrared camera would see it.

    Attributes:
        z_m: (H, W), inf where nothing.
        signal: (H, W) infrared reflectance × cosine to the camera.
        facing: (H, W) cosine between normal and line of sight.
    """

    z_m: F32
    signal: F32
    facing: F32


def measure_depth(
    scan: Scan, model: DepthModel, pixel_focal_px: float, radius2: F32 | None, bank: NoiseBank, rng: Generator
) -> F32:
    """Return what the sensor says, metres in the infrared camera's pixels, 0 where nothing.

    Args:
        scan: exact depth.
        model: how the sensor errs.
        pixel_focal_px: focal length of the scan's own pixels (differs from the model's at other resolutions).
        radius2: (H, W) squared distance from the picture's middle, 1 in the corner; None where not needed.
        bank: made for the scan's shape.
        rng: the source of chance of this frame.
    """
    z_m = biased(scan.z_m, model, radius2)
    disparity = np.float32(model.disparity_m_px) / z_m
    lost = shadowed(scan.z_m, model, pixel_focal_px) if model.shadow else np.zeros(z_m.shape, dtype=bool)
    if model.fattening_px:
        disparity, grown = fattened(disparity, model.fattening_px, bank.window(bank.smooth, rng))
        lost &= ~grown
    else:
        grown = np.zeros(z_m.shape, dtype=bool)
    lasting, passing = model.noise_px * model.fixed_share**0.5, model.noise_px * (1 - model.fixed_share) ** 0.5
    disparity = disparity + np.float32(passing) * bank.window(bank.smooth, rng)
    disparity += np.float32(lasting) * bank.fixed
    if model.step_px:
        disparity = np.rint(disparity * np.float32(1 / model.step_px)) * np.float32(model.step_px)
    lost |= dropped(scan, model, bank, rng) & ~grown
    disparity[lost] = 0
    with np.errstate(divide="ignore"):
        measured = np.float32(model.disparity_m_px) / disparity
    measured[(measured < model.nearest_m) | (measured > model.farthest_m) | lost] = 0
    return measured


def biased(z_m: F32, model: DepthModel, radius2: F32 | None) -> F32:
    """Return depth with the device's constant errors."""
    scale: F32 | np.float32 = np.float32(1 + model.scale_error)
    if model.radial_error and radius2 is not None:
        scale = scale + np.float32(model.radial_error) * radius2
    return np.asarray(z_m * scale + np.float32(model.offset_m), dtype=np.float32)


def shadowed(z_m: F32, model: DepthModel, pixel_focal_px: float) -> Bools:
    """Tell which pixels the projector does not reach.

    A point in column u lies in the projector's column u − f b / z. The
    projector stands on the camera's right, so light goes from right to left
    past a near thing: a point is dark if something further right in its row
    has a projector column left of its own. The shadow falls on the left.
    """
    columns = np.arange(z_m.shape[1], dtype=np.float32)
    projector = columns - np.float32(pixel_focal_px * model.baseline_m) / z_m
    nearest = np.minimum.accumulate(projector[:, ::-1], axis=1)[:, ::-1]
    return np.asarray(projector > nearest + np.float32(0.2))


def fattened(disparity: F32, fattening_px: float, chance: F32, jump_px: float = 0.5) -> tuple[F32, Bools]:
    """Return the disparity with near surfaces grown over far ones by `fattening_px`, and where they did.

    A matching window that straddles an edge takes the disparity of the side
    with more contrast, mostly the nearer. `chance` (H, W), standard normal,
    mixes whole pixels so that a part of a pixel is met on average.
    """
    import cv2

    whole = int(fattening_px)
    grown = _dilated(disparity, whole)
    part = fattening_px - whole
    if part > 0:
        more = chance < NormalDist().inv_cdf(part)
        grown = np.where(more, _dilated(disparity, whole + 1), grown)
    edge = grown > disparity + np.float32(jump_px)
    cv2.copyTo(disparity, (~edge).astype(np.uint8), grown)
    return grown, edge


def _dilated(disparity: F32, radius_px: int) -> F32:
    import cv2

    if radius_px == 0:
        return disparity.copy()
    shape = cv2.MORPH_CROSS if radius_px == 1 else cv2.MORPH_ELLIPSE
    kernel = cv2.getStructuringElement(shape, (2 * radius_px + 1, 2 * radius_px + 1))
    wide: F32 = cv2.dilate(disparity, kernel)
    return wide


def dropped(scan: Scan, model: DepthModel, bank: NoiseBank, rng: Generator) -> Bools:
    """Tell which pixels have no reading: too dark, too slanted, or by chance."""
    blotch = bank.window(bank.blotch, rng)
    strength = scan.signal / (scan.z_m * scan.z_m)
    lost = strength < np.float32(model.dark_infrared) * (1 + np.float32(0.35) * blotch)
    lost |= scan.facing < np.float32(model.grazing_cosine) * (1 + np.float32(0.3) * blotch)
    if model.speckle_share:
        lost |= bank.window(bank.blotch, rng) > np.float32(NormalDist().inv_cdf(1 - model.speckle_share))
    return np.asarray(lost)


def to_millimetres(z_m: F32) -> U16:
    """Return depth in whole millimetres."""
    millimetres: U16 = np.rint(z_m * np.float32(1000)).astype(np.uint16)
    return millimetres
