"""Memory that was let go does not stay with the process."""

from __future__ import annotations

import platform
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np
import psutil
import pytest

from fruitgui import heap
from fruitgui.heap import MOST_HEAPS, give_back, keep_few_heaps

PIECE, PIECES = 100_000, 1000
"""Bytes, and how many: too small for the system to hold each by itself."""

only_gnus = pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="not GNU's C library")


def resident_mb() -> float:
    return float(psutil.Process().memory_info().rss / 1e6)


@only_gnus
def test_what_is_free_between_what_is_held_is_given_back() -> None:
    made = [np.ones(PIECE, np.uint8) for _ in range(PIECES)]
    held = made[::10]
    before_mb = resident_mb()
    del made
    assert give_back()
    given_mb = before_mb - resident_mb()
    assert given_mb > 0.5 * 0.9 * PIECE * PIECES / 1e6
    assert all((one == 1).all() for one in held)


@only_gnus
@pytest.mark.parametrize(("first", "heaps"), [("", range(5, 10)), ("keep_few_heaps()", range(1, MOST_HEAPS + 1))])
def test_threads_share_a_few_heaps(first: str, heaps: range) -> None:
    program = f"""
import ctypes, os, threading
from fruitgui.heap import keep_few_heaps
{first}
library, all_there = ctypes.CDLL(None), threading.Barrier(9)
library.malloc.restype = ctypes.c_void_p
def work():
    library.malloc(1000)
    all_there.wait()
threads = [threading.Thread(target=work) for _ in range(8)]
for thread in threads:
    thread.start()
all_there.wait()
library.fopen.restype = ctypes.c_void_p
out = ctypes.c_void_p(library.fopen(b"/dev/stdout", b"w"))
library.malloc_info(0, out)
library.fflush(out)
"""
    told = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=60)
    assert len(ElementTree.fromstring(told.stdout).findall("heap")) in heaps  # noqa: S314 - our own process says it


def test_where_the_system_cannot_nothing_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(heap.sys, "platform", "darwin")
    heap._own.cache_clear()
    try:
        assert not give_back()
        assert not keep_few_heaps()
    finally:
        heap._own.cache_clear()
