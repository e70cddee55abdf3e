"""What the window adds up of a lot, in memory that does not grow with it."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from fruitgui.gui.steps.live.tally import BINS, STEP_ML, Tally
from fruitgui.measurement.fruit import Quantity
from fruitgui.station.fruit import Fruit
from tests.unit.station.fruit_made import made_fruit

EVERY_S = 0.3
MANY = 20_000
BYTES_PER_FRUIT = 1.0


def _fruit(volume_ml: float, kind: str = "lemon", made: Fruit = made_fruit(1)) -> Fruit:  # noqa: B008 - frozen
    return replace(made, kind=kind, volume_m3=Quantity(volume_ml * 1e-6, 1e-6))


def test_the_histogram_is_that_of_the_volumes_themselves() -> None:
    chance, tally = np.random.default_rng(1), Tally()
    volumes = {"lemon": chance.normal(110.0, 9.0, 900), "avocado": chance.normal(190.0, 25.0, 500)}
    for kind, values in volumes.items():
        for value in values:
            tally.count(_fruit(float(value), kind), 0.0)
    shown = tally.histogram()
    assert shown is not None
    together = np.concatenate(list(volumes.values()))
    low, high = np.quantile(together, [0.005, 0.995])
    assert shown.low_ml < low
    assert shown.high_ml > high
    width = (shown.high_ml - shown.low_ml) / BINS
    assert width / STEP_ML == pytest.approx(round(width / STEP_ML)), "a bin is some whole steps"
    for kind, values in volumes.items():
        expected = np.histogram(np.clip(values, shown.low_ml, shown.high_ml), BINS, (shown.low_ml, shown.high_ml))[0]
        np.testing.assert_array_equal(shown.counts[kind], expected)


def test_nothing_is_shown_before_the_first() -> None:
    assert Tally().histogram() is None


def test_one_fruit_has_a_histogram_about_it() -> None:
    tally = Tally()
    tally.count(_fruit(110.0), 0.0)
    shown = tally.histogram()
    assert shown is not None
    assert shown.low_ml < 110.0 < shown.high_ml
    assert shown.counts["lemon"].sum() == 1


def test_a_tally_that_nobody_looks_at_does_not_grow_with_the_fruit() -> None:
    tally, fruit = Tally(), [_fruit(100.0 + STEP_ML * at) for at in range(200)]

    def count(first: int) -> int:
        for number in range(first, first + MANY):
            tally.count(fruit[number % len(fruit)], EVERY_S * number)
        return tracemalloc.get_traced_memory()[0]

    tracemalloc.start()
    try:
        before = count(0)
        assert count(MANY) - before < BYTES_PER_FRUIT * MANY
    finally:
        tracemalloc.stop()
    assert tally.count_all == 2 * MANY
