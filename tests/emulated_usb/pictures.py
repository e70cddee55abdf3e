"""Pictures to push through an emulated Kinect."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import U8, U16

SHAPE = (480, 640)


def noise(seed: int) -> U16:
    """Return raw depth of all 2048 values at random."""
    return np.random.default_rng(seed).integers(0, 2048, SHAPE, dtype=np.uint16)


def level(raw: int) -> U16:
    """Return raw depth that is the same everywhere; 700 is 0.86 m."""
    return np.full(SHAPE, raw, dtype=np.uint16)


def grey(value: int) -> U8:
    """Return colour's raw pixels, all the same."""
    return np.full(SHAPE, value, dtype=np.uint8)


def belt(count: int) -> tuple[U16, U8]:
    """Return raw depth and colour of a level belt at 0.9 m with a box on it that moves on from picture to picture."""
    raw, bayer = level(706), grey(90)
    left = 40 + 8 * count % 480
    raw[200:280, left : left + 80] = 670
    bayer[200:280, left : left + 80] = 180
    return raw, bayer
