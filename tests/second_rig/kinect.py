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


@dataclass(frozen=True, slots=True, eq=False)
class Fields:
    """Random fields of one device, drawn once, larger than the picture: each capture cuts its own parts out.

    Attributes:
        rough: correlated like depth noise; smooth: like ragged outlines; white: not at all; all variance 1.
        standing: the device's constant pattern, as large as the picture.
    """

    rough: NDArray[np.float32]
    smooth: NDArray[np.float32]
    white: NDArray[np.float32]
    standing: NDArray[np.float32]

    def cut(self, which: NDArray[np.float32], rng: np.random.Generator) -> NDArray[np.float32]:
        """Return a part of a field, as large as the picture, from a random place and perhaps mirrored."""
        height, width = self.standing.shape
        row = int(rng.integers(which.shape[0] - height))
        column = int(rng.integers(which.shape[1] - width))
        part = which[row : row + height, column : column + width]
        return part[:: int(rng.choice([-1, 1])), :: int(rng.choice([-1, 1]))] * np.float32(rng.choice([-1.0, 1.0]))


def fields(shape: tuple[int, int], noise: Noise, rng: np.random.Generator) -> Fields:
    """Draw a device's random fields."""
    wide = (shape[0] + 300, shape[1] + 300)
    rough, smooth = _correlated(wide, noise, rng), _smooth(wide, 1.0, rng)
    white = rng.standard_normal(wide, dtype=np.float32)
    return Fields(rough, smooth, white, _correlated(shape, noise, rng))


def read_depth(depth_m: F64, owner: NDArray[np.int32], cosine: F64, brightness: F64, focal_px: float,
               noise: Noise, rng: np.random.Generator, field: Fields) -> NDArray[np.uint16]:  # fmt: skip
    """Return millimetres (0 = none) of a true depth picture; `owner` says which thing every pixel shows."""
    z = np.where(np.isfinite(depth_m), depth_m, 0.0)
    z = _jitter(z, noise.edge_jitter_px, field, rng)
    if noise.fattening_px:
        z = _fatten(z, owner, noise.fattening_px, rng)
    lost = (z < 0.45) | (z > 4.5)
    if noise.shadow:
        lost |= _shadowed(z, focal_px, noise.projector_side)
    chance = noise.holes + np.clip(0.22 - cosine, 0.0, 1.0) * 4.0 + np.where(brightness < 0.012, 0.25, 0.0)
    lost |= rng.random(z.shape, dtype=np.float32) < chance
    z = np.where(z > 0.0, z, 1.0)
    moving = field.cut(field.rough, rng)
    error = np.sqrt(noise.standing_share) * field.standing + np.sqrt(1.0 - noise.standing_share) * moving
    disparity = FOCAL_BASELINE_PX_M / z + error * noise.sigma * FOCAL_BASELINE_PX_M
    if noise.step_px:
        disparity = np.round(disparity / noise.step_px) * noise.step_px
    read = FOCAL_BASELINE_PX_M / disparity * (1.0 + noise.scale_error)
    return np.where(lost, 0.0, np.round(read * 1000.0)).astype(np.uint16)


def _correlated(shape: tuple[int, int], noise: Noise, rng: np.random.Generator) -> NDArray[np.float32]:
    white = rng.standard_normal(shape, dtype=np.float32)
    smooth = _smooth(shape, noise.window_px, rng)
    mixed = np.sqrt(noise.white_share) * white + np.sqrt(1.0 - noise.white_share) * smooth
    return np.asarray(mixed, dtype=np.float32)


def _smooth(shape: tuple[int, int], window_px: float, rng: np.random.Generator) -> NDArray[np.float32]:
    import cv2

    blurred = cv2.GaussianBlur(rng.standard_normal(shape, dtype=np.float32), (0, 0), window_px)
    return np.asarray(blurred / blurred.std(), dtype=np.float32)


def _jitter(z: F64, strength_px: float, field: Fields, rng: np.random.Generator) -> F64:
    """Take each pixel from a little aside: outlines of a real sensor are ragged."""
    import cv2

    if not strength_px:
        return z
    height, width = z.shape
    u, v = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
    across, down = (strength_px * field.cut(field.smooth, rng) for _ in range(2))
    return np.asarray(cv2.remap(z, u + across, v + down, cv2.INTER_NEAREST, borderMode=cv2.BORDER_REPLICATE))


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
