"""Frames in memory that two processes share."""

from __future__ import annotations

from multiprocessing.shared_memory import SharedMemory

import numpy as np

from fruitgui.frame import U8, U16, Frame, Intrinsics

BYTES_PER_PIXEL = 5
"""Three of colour, two of depth."""


def frame_maps(memory: SharedMemory, at: int, camera: Intrinsics) -> tuple[U8, U16]:
    """Return colour and depth of a frame that lie in shared memory from a place on; writing them writes there."""
    shape = (camera.height, camera.width)
    color: U8 = np.ndarray((*shape, 3), np.uint8, memory.buf, at)
    return color, np.ndarray(shape, np.uint16, memory.buf, at + 3 * shape[0] * shape[1])


def lay(frame: Frame, memory: SharedMemory, at: int) -> None:
    """Copy a frame's pictures into shared memory, from a place on."""
    color, depth_mm = frame_maps(memory, at, frame.intrinsics)
    color[:], depth_mm[:] = frame.color, frame.depth_mm
