from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from fruitgui.calibration.across import Across, Brink, across, brinks
from fruitgui.calibration.borders import Border, borders
from fruitgui.calibration.flat import Shift
from fruitgui.calibration.lines import lines
from fruitgui.calibration.relief import Relief
from tests.unit.calibration.test_borders import striped
from tests.unit.calibration.worlds import OPPOSED

STD_M = 0.0006


@pytest.fixture(scope="module")
def pair() -> tuple[Relief, Relief]:
    return striped("left"), striped("right")


def seen(relief: Relief) -> tuple[Relief, list[Brink]]:
    return relief, brinks(relief, borders(relief), lines(relief))


def true_shift(left: Relief, right: Relief) -> Shift:
    true = right.frame @ OPPOSED["right"].inverse() @ OPPOSED["left"] @ left.frame.inverse()
    x, y = true.translation_m[:2]
    return Shift(float(x), float(y), float(np.arctan2(true.rotation[1, 0], true.rotation[0, 0])))


def edges(
    relief: Relief, places_m: Sequence[float], heights_m: tuple[float, ...] = (0.0,)
) -> tuple[Relief, list[Brink]]:
    """Return straight edges along x at these y, across the middle of what a sensor looks at."""
    along = np.array([1.0, 0.0])
    return relief, [Brink(Border(np.array([0.0, y]), along, 1e-4, 0.4), heights_m) for y in places_m]


def gap_of(said: Across | None, across_m: tuple[float, float] = (0.0, 1.0)) -> float:
    assert said is not None
    return said.gap_m * float(np.sign(said.normal @ np.array(across_m)))


def test_edges_of_a_belt_hold_a_shift_across_them_and_not_along(pair: tuple[Relief, Relief]) -> None:
    left, right = pair
    true = true_shift(left, right)
    along = (right.frame @ OPPOSED["right"].inverse()).rotation[:2, 0]
    along /= np.linalg.norm(along)
    normal = np.array([-along[1], along[0]])
    base = gap_of(across(seen(left), seen(right), true, STD_M), tuple(normal))
    # 0.2 px of 4 mm at both sensors, and the belts' planes (0.05°, seen under 30°)
    assert abs(base) < 0.0015
    for step, moved in ((0.002 * normal, -0.002), (0.02 * along, 0.0)):
        off = Shift(true.x_m + step[0], true.y_m + step[1], true.heading_rad)
        assert gap_of(across(seen(left), seen(right), off, STD_M), tuple(normal)) - base == pytest.approx(
            moved, abs=3e-4
        )


def test_one_edge_alone_says_nothing(pair: tuple[Relief, Relief]) -> None:
    left, _ = pair
    nowhere = Shift(0.0, 0.0, 0.0)
    assert across(edges(left, [0.1]), edges(left, [0.1]), nowhere, STD_M) is None
    assert gap_of(across(edges(left, [0.1, -0.2]), edges(left, [0.101, -0.199]), nowhere, STD_M)) == pytest.approx(
        0.001
    )


def test_edges_that_meet_in_two_ways_say_nothing(pair: tuple[Relief, Relief]) -> None:
    left, _ = pair
    twice = edges(left, [0.1, -0.2, 0.103, -0.197])
    assert across(edges(left, [0.1, -0.2]), twice, Shift(0.0, 0.0, 0.0), 0.002) is None


def test_an_edge_on_a_rail_is_laid_at_the_rails_height(pair: tuple[Relief, Relief]) -> None:
    height_m = 0.05
    places = np.array([0.1, -0.2])
    laid = []
    for relief in pair:
        eye = relief.frame.translation_m
        cast = eye[1] + (places - eye[1]) / (1 - height_m / eye[2])
        laid.append(edges(relief, list(cast), (height_m,)))
    assert gap_of(across(laid[0], laid[1], Shift(0.0, 0.0, 0.0), STD_M)) == pytest.approx(0.0, abs=1e-9)
