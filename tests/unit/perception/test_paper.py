"""The source's own formulas, on bodies whose answer is known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.perception.paper import (
    PAPER_FEATURE_NAMES,
    ellipse_perimeter,
    hull_volume_m3,
    paper_features,
    paper_perimeter_m,
    paper_view_features,
    paper_volume_m3,
    with_mirror_image,
)
from tests.unit.perception.spheres import row_of_balls, views


def front_half(radius_m: float, centre_m: tuple[float, float, float], count: int = 4000) -> np.ndarray:
    """Points evenly over the half of a ball that faces the origin."""
    i = np.arange(count) + 0.5
    height, angle = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    ring = np.sqrt(1 - height**2)
    ball = np.column_stack([ring * np.cos(angle), ring * np.sin(angle), height])
    sight = np.array(centre_m) / np.linalg.norm(centre_m)
    return ball[ball @ sight <= 0] * radius_m + centre_m


@settings(max_examples=25, deadline=None)
@given(st.floats(0.02, 0.06), st.tuples(st.floats(-0.4, 0.4), st.floats(-0.3, 0.3), st.floats(0.7, 1.5)))
def test_a_half_ball_and_its_mirror_image_make_the_ball(radius: float, centre: tuple[float, float, float]) -> None:
    """The mirror stands at the 97th percentile of depth, 3 % of a radius before the equator: 4.4 % less volume."""
    volume = paper_volume_m3(front_half(radius, centre).astype(np.float32))
    assert volume == pytest.approx(4 / 3 * np.pi * radius**3 * (1 - 1.5 * 0.03), rel=0.02)


def test_what_spans_no_volume_has_none() -> None:
    assert hull_volume_m3(np.zeros((0, 3))) == 0.0
    assert hull_volume_m3(np.array([[0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1.0]])) == 0.0
    assert with_mirror_image(np.zeros((0, 3), np.float32)).shape == (0, 3)


@settings(max_examples=25, deadline=None)
@given(st.floats(0.01, 0.1), st.floats(0.2, 1.0))
def test_the_perimeter_of_an_ellipse_is_its_arc(a: float, ratio: float) -> None:
    b = a * ratio
    t = np.linspace(0, 2 * np.pi, 20001)
    arc = np.hypot(np.diff(a * np.cos(t)), np.diff(b * np.sin(t))).sum()
    assert ellipse_perimeter(a, b) == pytest.approx(arc, rel=1e-4)


def test_a_view_of_a_ball_has_its_perimeter_and_thirty_two_features() -> None:
    table = row_of_balls((0.036,), 0.0, tilt_rad=0.4)
    view = views(table)[0]
    assert paper_perimeter_m(view, table.intrinsics) == pytest.approx(2 * np.pi * 0.036, rel=0.06)
    features = paper_view_features(view, table.intrinsics)
    assert features.shape == (32,) == (len(PAPER_FEATURE_NAMES),)
    assert np.isfinite(features).all()
    assert 0.2 < features[31] < 1.0


def test_histograms_count_the_patch_and_the_cube_divides_the_volume() -> None:
    red = np.full((40, 40, 3), (255, 0, 0), np.uint8)
    features = paper_features(red, 0.25, 2e-4, 4e-4)
    assert features[:30].reshape(3, 10).sum(axis=1) == pytest.approx([1, 1, 1])
    assert features[0] == 1.0
    assert features[19] == 1.0
    assert features[29] == 1.0
    assert features[30] == pytest.approx(0.25)
    assert features[31] == pytest.approx(0.5)
