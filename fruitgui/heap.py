"""How the C library keeps memory that is free: in few heaps, and given back to the system when asked."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
from functools import cache

_MOST_HEAPS_OPTION, MOST_HEAPS = -8, 2
"""M_ARENA_MAX of GNU's C library, and how many heaps are enough."""


def keep_few_heaps() -> bool:
    """Let all threads share a few heaps; tell whether the C library could be told. Before threads are started.

    GNU's C library gives up to eight heaps for each core, one to a thread, and what is free in one is of no use to the
    others: pictures of a megabyte that come on one thread and go on another leave hundreds of megabytes lying about.
    """
    return bool(_own("mallopt")(_MOST_HEAPS_OPTION, MOST_HEAPS))


def give_back() -> bool:
    """Give what is free back to the system; tell whether there was some. Any thread may call."""
    return bool(_own("malloc_trim")(0))


@cache
def _own(name: str) -> Callable[..., int]:
    """Return the C library's own function, which only GNU's has; others need none, and do nothing."""
    if not sys.platform.startswith("linux"):
        return _nothing
    try:
        found: Callable[..., int] = getattr(ctypes.CDLL(None), name)
    except AttributeError:
        return _nothing
    return found


def _nothing(*_given: int) -> int:
    return 0
