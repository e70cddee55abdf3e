"""Fruit as a line would give them, made up from a seed."""

from __future__ import annotations

import numpy as np

from fruitgui.measurement.fruit import Edges, Quantity, Size
from fruitgui.station.fruit import Fruit
from fruitgui.station.sink import Crop
from fruitgui.tracking.track import PathPoint

KINDS = ("lemon", "red apple", "green apple", "avocado, Chilean")


def made_fruit(number: int, kind: str | None = None, views: int = 12) -> Fruit:
    """Return fruit `number` of a line; the same for the same number."""
    chance = np.random.default_rng(number)
    volume = Quantity(float(chance.uniform(60e-6, 400e-6)), float(chance.uniform(1e-6, 9e-6)))
    length_m = (6 * volume.value / np.pi) ** (1 / 3)
    size = Size(
        volume_m3=Quantity(volume.value * 1.03, volume.std),
        length_m=Quantity(length_m * 1.1, 1e-3),
        diameter_m=Quantity(length_m, 1e-3),
        perimeter_m=Quantity(length_m * 3.3, 2e-3),
        coverage=float(chance.uniform(0.4, 0.9)),
        edges=Edges(("kinect_1", "kinect_2"), chance.normal(size=2), np.eye(2) * 0.1, chance.normal(size=2)),
        spoilt=float(chance.uniform(0, 0.3)),
    )
    return Fruit(
        fruit=number,
        kind=kind or KINDS[number % len(KINDS)],
        kind_probability=float(chance.uniform(0.6, 1.0)),
        size=size,
        volume_m3=volume,
        mass_kg=None if number % 3 == 0 else Quantity(volume.value * 950.0, volume.std * 950.0),
        volume_paper_m3=None,
        views=views,
        path=tuple(
            PathPoint(1.7e9 + number + 0.033 * at, chance.normal(size=3), np.diag(chance.uniform(1e-6, 1e-5, size=3)))
            for at in range(views)
        ),
    )


def made_crops(number: int, views: int = 2) -> tuple[Crop, ...]:
    """Return crops of fruit `number`: no pictures, but bytes of their size."""
    chance = np.random.default_rng(number)
    return tuple(
        Crop(at, "colour", f"kinect_{at + 1}", 0.033 * at, 10 * at, 20, "jpeg", chance.bytes(900))
        for at in range(views)
    )
