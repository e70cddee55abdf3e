"""Where many pixels are left out, fruit are where they were and look as they did."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.perception import FEATURE_NAMES, pixels
from fruitgui.perception.view import FruitView
from tests.unit.perception.spheres import Ball, Table, views

COLOURS = ((200, 60, 40), (60, 160, 50), (220, 180, 40))


def crowd() -> Table:
    """Return 24 balls of three sizes, 45 000 pixels of them."""
    places = [(x * 0.11 - 0.275, y * 0.095 - 0.14) for x in range(6) for y in range(4)]
    balls = tuple(Ball(x, y, 0.028 + 0.006 * (n % 3), COLOURS[n // 3 % 3]) for n, (x, y) in enumerate(places))
    return Table(balls, height_m=0.75, tilt_rad=0.0)


def by_place(found: tuple[FruitView, ...]) -> list[FruitView]:
    return sorted(found, key=lambda view: view.box_px)


def test_leaving_out_pixels_changes_nothing_beyond_the_noise(monkeypatch: pytest.MonkeyPatch) -> None:
    table = crowd()
    thinned = by_place(views(table))
    monkeypatch.setattr(pixels, "ENOUGH_PIXELS", 10**9)
    full = by_place(views(table))
    assert len(full) == len(thinned) == 24
    assert sum(len(view.points_m) for view in thinned) < 0.6 * sum(len(view.points_m) for view in full)
    apart = np.array([one.centre_m - other.centre_m for one, other in zip(thinned, full, strict=True)])
    sigma = np.sqrt([np.trace(view.centre_covariance_m2) for view in full])
    assert (np.linalg.norm(apart, axis=1) < 0.3 * sigma).all()
    assert [view.height_m for view in thinned] == pytest.approx([view.height_m for view in full], abs=0.002)
    features = np.array([view.features for view in full])
    moved = np.abs(np.array([view.features for view in thinned]) - features)
    # Balls of one size differ in their features by noise alone; balls are so even that some hardly do.
    noise = np.maximum(np.array([features[n::3].std(axis=0) for n in range(3)]).mean(axis=0), 0.02)
    assert [name for name, far in zip(FEATURE_NAMES, np.median(moved, axis=0) > noise, strict=True) if far] == []
