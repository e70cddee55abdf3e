"""Chunks unpacked within bounds: no claim of a file is believed before it is met."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any, BinaryIO

from fruitgui.sensors.recordings.raw import MAX_WHOLE_BYTES, MalformedError

_PIECE = 8 * 1024 * 1024
"""More than our own chunks hold: what comes out in one piece need not be put together."""

_PACKED_PIECE = 128 * 1024


class Part:
    """So many bytes of a file, from where it stands, as a file of its own that is only read forward."""

    def __init__(self, file: BinaryIO, length: int) -> None:
        self._file = file
        self._left = length

    def read(self, size: int = -1) -> bytes:
        """Return up to `size` bytes, none at the end."""
        data = self._file.read(self._left if size < 0 else min(size, self._left))
        self._left -= len(data)
        return data


def unpack(kind: str, source: Part, claimed: int, *, cut: bool = False) -> bytes:
    """Return the unpacked bytes of a chunk.

    Args:
        kind: "", "none", "zstd", "lz4" or "bz2".
        source: the packed bytes.
        claimed: how many bytes the file says come out; never more are made.
        cut: the packed bytes end early; what they hold is returned.

    Raises:
        MalformedError: unknown packing, damaged, larger than `MAX_WHOLE_BYTES`, or not as long as claimed.
    """
    if claimed > MAX_WHOLE_BYTES:
        raise MalformedError("a chunk claims to be too large")
    taken: list[bytes] = []
    left = claimed + 1
    packed = source.read(MAX_WHOLE_BYTES + _PACKED_PIECE)
    try:
        for piece in pieces(kind, packed, min(left, _PIECE)):
            taken.append(piece[:left])
            left -= len(taken[-1])
            if left <= 0:
                break
    except MalformedError:
        if not cut:
            raise
    unpacked = taken[0] if len(taken) == 1 else b"".join(taken)
    if not cut and len(unpacked) != claimed:
        raise MalformedError("a chunk is not as long as it claims")
    return unpacked


def pieces(kind: str, source: Part | bytes, size: int = _PIECE) -> Iterator[bytes]:
    """Yield what comes out of packed bytes, up to `size` bytes at a time.

    Bytes that are held already unpack at twice the speed of a part of a file.

    Raises:
        MalformedError: unknown packing, or damaged.
    """
    file = io.BytesIO(source) if isinstance(source, bytes) else source
    if kind in ("", "none"):
        while piece := file.read(size):
            yield piece
    elif kind == "zstd":
        yield from _zstd_pieces(source, size)
    elif kind == "lz4":
        yield from _fed_pieces(_lz4_decompressor(), file, size)
    elif kind == "bz2":
        import bz2

        yield from _fed_pieces(bz2.BZ2Decompressor(), file, size)
    else:
        raise MalformedError(f"a chunk is packed with {kind[:20]!r}, which is not supported")


def _zstd_pieces(source: Part | bytes, size: int) -> Iterator[bytes]:
    import zstandard

    try:
        with zstandard.ZstdDecompressor(max_window_size=2**27).stream_reader(source, read_size=_PACKED_PIECE) as stream:
            while piece := stream.read(size):
                yield piece
    except zstandard.ZstdError as error:
        raise MalformedError("a zstd chunk is damaged") from error


def _lz4_decompressor() -> Any:  # noqa: ANN401 - lz4 has no stubs
    try:
        import lz4.frame
    except ImportError as error:
        raise MalformedError("a chunk is packed with lz4, which is not installed") from error
    return lz4.frame.LZ4FrameDecompressor()


def _fed_pieces(decompressor: Any, source: Part | io.BytesIO, size: int) -> Iterator[bytes]:  # noqa: ANN401
    """Yield the pieces of a decompressor of lz4 or bz2, which is fed."""
    while not decompressor.eof:
        packed = source.read(_PACKED_PIECE) if decompressor.needs_input else b""
        if decompressor.needs_input and not packed:
            return
        try:
            piece = decompressor.decompress(packed, max_length=size)
        except (RuntimeError, OSError, EOFError) as error:
            raise MalformedError("a chunk is damaged") from error
        yield piece
