"""Stores with lots for the tests of the lots screen, written once and copied."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from fruitgui.frame import U8, U16
from fruitgui.records.lot import LotPlan
from fruitgui.records.store import Store, open_store
from fruitgui.station.live.crops import Cut, coded
from fruitgui.station.sink import Crop
from tests.unit.station.fruit_made import made_fruit

DAY_S = 86_400.0
START_S = 1_740_000_000.0
MANY = 2_000
FEW = 120
SIDE = 60


class Clock:
    def __init__(self, now_s: float) -> None:
        self.now_s = now_s

    def __call__(self) -> float:
        return self.now_s


def crops(number: int) -> tuple[Crop, ...]:
    """Return two views of a bright disc on a belt a metre away."""
    y, x = np.mgrid[:SIDE, :SIDE] - SIDE // 2
    disc = x**2 + y**2 < (SIDE // 3) ** 2
    color: U8 = np.full((SIDE, SIDE, 3), 40, np.uint8)
    color[disc] = (200, 180, 10 * (number % 20))
    depth_mm: U16 = np.full((SIDE, SIDE), 1000, np.uint16)
    depth_mm[disc] -= 60
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    outline = (SIDE // 2 + SIDE // 3 * np.column_stack([np.cos(angle), np.sin(angle)])).astype(np.float32)
    cuts = tuple(
        Cut(sensor, 0.0, (10, 20, 30, 30), 10, 20, color, depth_mm, outline, 1.0) for sensor in ("kinect_1", "kinect_2")
    )
    return coded(cuts)


def run(store: Store, clock: Clock, name: str, grower: str, fruit: int, pictured: int = 0) -> int:
    """Run a lot with a pause, and end it; return its key."""
    lot = store.lots.start(
        LotPlan(name, grower, "Export A", reference_sensor="kinect_1", model="models/model-0003.fruit")
    )
    finished = [(made_fruit(number), crops(number) if number < pictured else ()) for number in range(fruit)]
    store.counting.commit_batch(lot.key, finished)
    clock.now_s += 3600
    store.lots.pause(lot.key)
    clock.now_s += 600
    store.lots.resume(lot.key)
    clock.now_s += 1800
    store.lots.end(lot.key)
    return lot.key


def fill(folder: Path) -> None:
    """Keep a hundred and twenty short lots, a day apart, and a long one of today's."""
    clock = Clock(START_S)
    with open_store(folder, clock) as store:
        for number in range(FEW):
            clock.now_s = START_S + number * DAY_S
            run(store, clock, f"A{number:03d}", ("Fundo Norte", "El Peñón")[number % 2], 1)
        clock.now_s = START_S + FEW * DAY_S
        run(store, clock, "1184", "Riquelme", MANY, pictured=40)
