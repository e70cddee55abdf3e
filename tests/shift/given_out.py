"""What GNU's C library has given out and not got back."""

from __future__ import annotations

import ctypes

_FIELDS = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost"


class _Info(ctypes.Structure):
    """`struct mallinfo2`, malloc.h."""

    _fields_ = [(name, ctypes.c_size_t) for name in _FIELDS.split()]


def given_out_mb() -> float:
    """Return how much memory is in use, of all heaps and of the large pieces beside them."""
    library = ctypes.CDLL(None)
    library.mallinfo2.restype = _Info
    info = library.mallinfo2()
    return float(info.uordblks + info.hblkhd) / 1e6
