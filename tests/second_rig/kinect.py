"""What a structured-light sensor makes of true depth: steps of disparity, noise, thick edges, shadow, holes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tests.second_rig.bodies import F64

FOCAL_BASELINE_PX_M = 580.0 * 0.075


@dataclass(frozen=True, slots=True)
class Noise:
    """Errors of one device.

    Attributes:
        sigma: random depth error is sigma · z² metres.
        window_px: extent over which errors are alike; white_share: share of the variance that is not.
        standing_share: share of the variance that stays the same from frame to frame.
        step_px: disparity quantisation, 0 for none.
        fattening_px: by how many pixels near things grow over far ones.
        scale_error: depth is wrong by this share.
        holes: share of pixels without a reading, besides grazing, dark and shadowed ones.
        shadow: whether the projector, 75 mm aside, throws one; `projector_side` +1 right, −1 left.
    """

    sigma: float = 1.4e-3
    window_px: float = 1.6
    white_share: float = 0.25
    standing_share: float = 0.2
    step_px: float = 0.125
    fattening_px: float = 0.0
    scale_error: float = 0.0
    holes: float = 0.004
    shadow: bool = True
    projector_side: float = -1.0
    edge_jitter_px: float = 0.4


def read_depth(depth_m: F64, owner: NDArray[np.int32], cosine: F64, brightness: F64, focal_px: float,
               noise: Noise, rng: np.random.Generator, standing: F64) -> NDArray[np.uint16]:  # fmt: skip
    """Return millimetres (0 = none) of a true depth picture.

    `owner` says which thing every pixel shows, `standing` is this device's constant noise pattern.
    """
    z = np.where(np.isfinite(depth_m), depth_m, 0.0)
    z = _jitter(z, noise.edge_jitter_px, rng)
    if noise.fattening_px:
        z = _fatten(z, owner, noise.fattening_px, rng)
    lost = (z < 0.45) | (z > 4.5)
    if noise.shadow:
        lost |= _shadowed(z, focal_px, noise.projector_side)
    lost |= rng.random(z.shape) < noise.holes + np.clip(0.22 - cosine, 0.0, 1.0) * 4.0
    lost |= (brightness < 0.012) & (rng.random(z.shape) < 0.25)
    z = np.where(z > 0.0, z, 1.0)
    moving = _correlated(z.shape, noise, rng)
    error = np.sqrt(noise.standing_share) * standing + np.sqrt(1.0 - noise.standing_share) * moving
    disparity = FOCAL_BASELINE_PX_M / z + error * noise.sigma * FOCAL_BASELINE_PX_M
    if noise.step_px:
        disparity = np.round(disparity / noise.step_px) * noise.step_px
    read = FOCAL_BASELINE_PX_M / disparity * (1.0 + noise.scale_error)
    return np.where(lost, 0.0, np.round(read * 1000.0)).astype(np.uint16)


def standing_noise(shape: tuple[int, ...], noise: Noise, rng: np.random.Generator) -> F64:
    """Return a device's own constant pattern, variance 1."""
    return _correlated(shape, noise, rng)


def _correlated(shape: tuple[int, ...], noise: Noise, rng: np.random.Generator) -> F64:
    import cv2

    white = rng.standard_normal(shape, dtype=np.float32)
    smooth = cv2.GaussianBlur(rng.standard_normal(shape, dtype=np.float32), (0, 0), noise.window_px)
    smooth *= 2.0 * np.sqrt(np.pi) * noise.window_px
    mixed = np.sqrt(noise.white_share) * white + np.sqrt(1.0 - noise.white_share) * smooth
    return np.asarray(mixed, dtype=np.float64)


def _jitter(z: F64, strength_px: float, rng: np.random.Generator) -> F64:
    """Take each pixel from up to a pixel aside: outlines of a real sensor are ragged."""
    import cv2

    if not strength_px:
        return z
    height, width = z.shape
    u, v = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
    aside = [cv2.GaussianBlur(rng.standard_normal(z.shape, dtype=np.float32), (0, 0), 1.0) * 3.5 * strength_px
             for _ in range(2)]  # fmt: skip
    return np.asarray(cv2.remap(z, u + aside[0], v + aside[1], cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE))


def _fatten(z: F64, owner: NDArray[np.int32], width_px: float, rng: np.random.Generator) -> F64:
    """Let near things grow over what lies behind them, by `width_px` on average with a ragged rim."""
    import cv2

    far = np.where(z > 0.0, z, 9.0)
    grown = z
    whole = int(np.floor(width_px))
    for reach in range(1, whole + 2):
        kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * reach + 1, 2 * reach + 1))
        near = cv2.erode(far, kernel)
        other = cv2.dilate(owner.astype(np.float32), kernel) != cv2.erode(owner.astype(np.float32), kernel)
        chance = 1.0 if reach <= whole else width_px - whole
        takes = other & (far - near > 0.004 + 0.006 * reach) & (rng.random(z.shape) < chance)
        grown = np.where(takes & (near < 8.0) & (grown == z), near, grown)
    return np.asarray(grown)


def _shadowed(z: F64, focal_px: float, side: float) -> NDArray[np.bool_]:
    """Return pixels whose place the projector, 75 mm to the side, cannot see past nearer ones of the same row."""
    height, width = z.shape
    seen = z > 0.0
    shift = np.where(seen, focal_px * 0.075 / np.where(seen, z, 1.0), 0.0) * -side
    margin = 1 + int(focal_px * 0.075 / 0.4)
    column = np.clip(np.round(np.arange(width) + shift).astype(np.int64) + margin, 0, width + 2 * margin - 1)
    key = np.arange(height)[:, None] * (width + 2 * margin) + column
    nearest = np.full(height * (width + 2 * margin), np.inf)
    np.minimum.at(nearest, key[seen], z[seen])
    # A step in the picture skips columns of the projector's; its neighbours' nearest closes those gaps.
    table = nearest.reshape(height, -1)
    table = np.minimum(table, np.minimum(np.roll(table, 1, axis=1), np.roll(table, -1, axis=1)))
    return np.asarray(seen & (z > table.reshape(-1)[key] + 0.02))
