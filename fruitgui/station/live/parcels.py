"""Things with arrays, through a pipe from process to process of ours.

What arrives costs the receiving process little, now and later: all small arrays come in one piece and are places in it.
An array that pickle makes of a buffer hangs on a memory view, which Python's collector of garbage looks through again
and again; tens of thousands of them, as the views of some hundred fruit have, kept the window waiting for 50 ms.
"""

from __future__ import annotations

import io
import pickle
from collections.abc import Sequence
from multiprocessing.connection import Connection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fruitgui.frame import U8

LARGE = 1 << 18
"""Bytes from which on an array goes through the pipe by itself, as it lies in memory: pictures. Copied into one piece
with others, as `Connection.send` does too, they would keep every other thread of the process waiting."""

ALIGNED = 16
"""Small arrays begin at multiples of so many bytes."""


def send(pipe: Connection, thing: object) -> None:
    """Send a thing."""
    arrays: list[pickle.PickleBuffer] = []
    head = pickle.dumps(thing, protocol=5, buffer_callback=arrays.append)
    raw = [array.raw() for array in arrays]
    sizes = [one.nbytes for one in raw]
    pipe.send_bytes(pickle.dumps((head, sizes)))
    if any(size < LARGE for size in sizes):
        pipe.send_bytes(b"".join(_filled_up(one) for one in raw if one.nbytes < LARGE))
    for one in raw:
        if one.nbytes >= LARGE:
            pipe.send_bytes(one)


def receive(pipe: Connection) -> Any:  # noqa: ANN401 - whatever was sent
    """Return what was sent; its arrays may be written to.

    Raises:
        EOFError, OSError: the other end is gone.
    """
    head, sizes = pickle.loads(pipe.recv_bytes())  # noqa: S301 - from our own process
    small = _small(pipe, sizes)
    starts = iter(np.cumsum([0, *(_room(size) for size in sizes if size < LARGE)]).tolist())
    arrays = [_large(pipe, size) if size >= LARGE else small[(at := next(starts)) : at + size] for size in sizes]
    return _Opening(io.BytesIO(head), buffers=arrays).load()


def _room(size: int) -> int:
    return -(-size // ALIGNED) * ALIGNED


def _filled_up(piece: memoryview) -> bytes:
    return bytes(piece).ljust(_room(piece.nbytes), b"\0")


def _small(pipe: Connection, sizes: Sequence[int]) -> U8:
    """Receive all small arrays as one."""
    if all(size >= LARGE for size in sizes):
        return np.empty(0, np.uint8)
    return _large(pipe, sum(_room(size) for size in sizes if size < LARGE))


def _large(pipe: Connection, size: int) -> U8:
    array = np.empty(size, np.uint8)
    pipe.recv_bytes_into(array.data)
    return array


class _Opening(pickle.Unpickler):
    """Makes arrays as places in what was received."""

    def find_class(self, module: str, name: str) -> Any:  # noqa: ANN401 - as pickle has it
        return _placed if name == "_frombuffer" and module.startswith("numpy.") else super().find_class(module, name)


def _placed(buffer: U8 | memoryview, dtype: np.dtype[Any], shape: tuple[int, ...], order: str) -> NDArray[Any]:
    """Return an array in a buffer, which is a memory view where it may not be written to.

    `numpy`'s own function of the same task hangs every array on a memory view.
    """
    piece = buffer if isinstance(buffer, np.ndarray) else np.frombuffer(buffer, np.uint8)
    return piece.view(dtype).reshape(shape, order="F" if order == "F" else "C")
