"""Stores of real files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from fruitgui.records.lot import Lot, LotPlan
from fruitgui.records.store import Store, open_store


class Clock:
    """A time of day that goes on only when told."""

    def __init__(self) -> None:
        self.now_s = 1_800_000_000.0

    def __call__(self) -> float:
        return self.now_s


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def store(tmp_path: Path, clock: Clock) -> Iterator[Store]:
    with open_store(tmp_path, clock) as opened:
        yield opened


@pytest.fixture
def lot(store: Store) -> Lot:
    return store.lots.start(LotPlan("1184", "Fundo El Peñón", reference_sensor="kinect_1"))
