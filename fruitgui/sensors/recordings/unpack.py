"""Chunks unpacked within bounds: no claim of a file is believed before it is met."""

from __future__ import annotations

import io

from fruitgui.sensors.recordings.raw import MAX_CHUNK_BYTES, MalformedError

_PIECE = 4 * 1024 * 1024


def unpack(kind: str, data: bytes, claimed: int, *, cut: bool = False) -> bytes:
    """Return the unpacked bytes of a chunk.

    Args:
        kind: "", "none", "zstd", "lz4" or "bz2".
        data: the packed bytes.
        claimed: how many bytes the file says come out; never more are made.
        cut: the packed bytes end early; what they hold is returned.

    Raises:
        MalformedError: unknown packing, damaged, or not as long as claimed.
    """
    if claimed > MAX_CHUNK_BYTES:
        raise MalformedError(f"a chunk claims {claimed} bytes")
    if kind in ("", "none"):
        unpacked = data[:claimed] if cut else data
    elif kind == "zstd":
        unpacked = _unpack_zstd(data, claimed, cut)
    elif kind == "lz4":
        unpacked = _unpack_lz4(data, claimed, cut)
    elif kind == "bz2":
        unpacked = _unpack_bz2(data, claimed, cut)
    else:
        raise MalformedError(f"a chunk is packed with {kind[:20]!r}, which is not supported")
    if not cut and len(unpacked) != claimed:
        raise MalformedError("a chunk is not as long as it claims")
    return unpacked


def _unpack_zstd(data: bytes, claimed: int, cut: bool) -> bytes:
    import zstandard

    pieces = []
    left = claimed + 1
    try:
        with zstandard.ZstdDecompressor(max_window_size=2**27).stream_reader(io.BytesIO(data)) as stream:
            while left and (piece := stream.read(min(left, _PIECE))):
                pieces.append(piece)
                left -= len(piece)
    except zstandard.ZstdError as error:
        if not cut:
            raise MalformedError("a zstd chunk is damaged") from error
    return b"".join(pieces)


def _unpack_lz4(data: bytes, claimed: int, cut: bool) -> bytes:
    try:
        import lz4.frame  # type: ignore[import-untyped]
    except ImportError as error:
        raise MalformedError("a chunk is packed with lz4, which is not installed") from error
    try:
        unpacked: bytes = lz4.frame.LZ4FrameDecompressor().decompress(data, max_length=claimed + 1)
    except RuntimeError as error:
        if cut:
            return b""
        raise MalformedError("an lz4 chunk is damaged") from error
    return unpacked


def _unpack_bz2(data: bytes, claimed: int, cut: bool) -> bytes:
    import bz2

    try:
        return bz2.BZ2Decompressor().decompress(data, max_length=claimed + 1)
    except (OSError, EOFError) as error:
        if cut:
            return b""
        raise MalformedError("a bz2 chunk is damaged") from error
