"""Memory that was let go does not stay with the process."""

from __future__ import annotations

import platform

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from fruitgui.gui import memory
from fruitgui.gui.benchmark.watches import resident_mb
from fruitgui.gui.memory import GivingBack, give_back

PIECE, PIECES = 100_000, 1000
"""Bytes, and how many: too small for the system to hold each by itself."""


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="not GNU's C library")
def test_what_is_free_between_what_is_held_is_given_back() -> None:
    made = [np.ones(PIECE, np.uint8) for _ in range(PIECES)]
    held = made[::10]
    before_mb = resident_mb()
    del made
    assert give_back()
    given_mb = before_mb - resident_mb()
    assert given_mb > 0.5 * 0.9 * PIECE * PIECES / 1e6
    assert all((one == 1).all() for one in held)


def test_it_is_done_beside_the_window(qtbot: QtBot) -> None:
    giving = GivingBack()
    giving.give_back()
    assert giving.queries.busy
    qtbot.waitUntil(lambda: not giving.queries.busy, timeout=20_000)


def test_where_the_system_cannot_nothing_is_done(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory.sys, "platform", "darwin")
    memory._trim.cache_clear()
    try:
        assert not give_back()
    finally:
        memory._trim.cache_clear()
