"""The estimated centre is the centre, from wherever it is seen, and says honestly how sure it is."""

from __future__ import annotations

import numpy as np
import pytest

from tests.unit.perception.spheres import Ball, Table, nearest, views


def scattered(seed: int, height_m: float, tilt_rad: float) -> Table:
    """Twelve balls of 25–45 mm radius, apart from each other."""
    rng = np.random.default_rng(seed)
    empty = Table((), height_m=height_m, tilt_rad=tilt_rad)
    middle = empty.plane().frame().apply(np.array([0.0, 0.0, height_m / np.cos(tilt_rad)]))
    pitch = 0.13 * height_m
    balls = tuple(
        Ball(middle[0] + i * pitch, middle[1] + j * pitch, rng.uniform(0.025, 0.045))
        for i in (-1.5, -0.5, 0.5, 1.5)
        for j in (-1, 0, 1)
    )
    return Table(balls, height_m=height_m, tilt_rad=tilt_rad, seed=seed)


@pytest.mark.parametrize(("height_m", "tilt_rad"), [(0.7, 0.2), (1.0, 0.5), (1.0, 0.8), (1.5, 0.4)])
def test_centres_of_balls_are_right_within_their_covariance(height_m: float, tilt_rad: float) -> None:
    errors, normalised = [], []
    for seed in range(2):
        table = scattered(seed, height_m, tilt_rad)
        found = views(table)
        assert len(found) == 12
        for view in found:
            error = view.centre_m - table.centres_m()[nearest(table, view)]
            errors.append(error)
            normalised.append(error @ np.linalg.solve(view.centre_covariance_m2, error))
    # A pixel is 1.9 mm wide at 1 m: the middle of a silhouette of forty is known to a fraction of one.
    bias = np.linalg.norm(np.mean(errors, axis=0))
    assert bias < 0.0012 * height_m**2
    assert np.linalg.norm(errors, axis=1).max() < 0.0045 * height_m**2
    # The covariance allows for fruit that are no balls, so balls lie well inside; three would be expected of it.
    assert np.mean(normalised) < 3.0


def test_opposed_sensors_agree_on_the_centre_but_not_on_the_mean_of_the_points() -> None:
    """Turned by half a turn about the belt's normal, each sees the other's hidden half."""
    table = scattered(5, 1.0, 0.7)
    middle = np.mean([[ball.x_m, ball.y_m] for ball in table.balls], axis=0)
    turned = Table(tuple(Ball(*(2 * middle - [b.x_m, b.y_m]), b.radius_m) for b in table.balls), 1.0, 0.7, seed=6)
    to_belt = table.plane().frame()
    there = {nearest(turned, view): view for view in views(turned)}
    centre_gaps, mean_gaps = [], []
    for view in views(table):
        other = there[nearest(table, view)]
        for gaps, here, far in ((centre_gaps, view.centre_m, other.centre_m), (mean_gaps, view.mean_m, other.mean_m)):
            back = to_belt.apply(far)
            back[:2] = 2 * middle - back[:2]
            gaps.append(np.linalg.norm(to_belt.apply(here) - back))
    assert max(centre_gaps) < 0.004
    assert min(mean_gaps) > 0.015


def test_the_top_is_the_top() -> None:
    table = scattered(1, 1.0, 0.3)
    for view in views(table):
        assert view.height_m == pytest.approx(2 * table.balls[nearest(table, view)].radius_m, abs=0.004)


def test_widened_edges_hardly_move_the_centre() -> None:
    """Two pixels of fattening widen the silhouette by a tenth; its middle stays."""
    import cv2

    from fruitgui.frame import Frame
    from tests.unit.perception.spheres import perceiver

    table = scattered(2, 1.0, 0.5)
    frame = table.frame()
    disparity = 1e6 / np.maximum(frame.depth_mm, 1)
    wide = cv2.dilate(disparity, np.ones((5, 5), np.uint8))
    fat = np.where(wide > disparity * 1.012, np.rint(1e6 / wide), frame.depth_mm).astype(np.uint16)
    fattened = Frame(frame.sensor, 0, 0.0, frame.color, fat, frame.intrinsics)
    found = perceiver(table).observe(fattened, 0.0).views
    assert len(found) == 12
    errors = [view.centre_m - table.centres_m()[nearest(table, view)] for view in found]
    assert np.linalg.norm(np.mean(errors, axis=0)) < 0.004
