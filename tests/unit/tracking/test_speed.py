from __future__ import annotations

import numpy as np
import pytest

from fruitgui.tracking.speed import mean_velocity, way_velocity
from fruitgui.tracking.track import PathPoint

VELOCITY = np.array([0.05, -0.2, 0.01])


def path(times_s: np.ndarray, travelled_s: np.ndarray, seed: int = 1) -> list[PathPoint]:
    """A way along `VELOCITY`, known to half a millimetre."""
    rng = np.random.default_rng(seed)
    places = travelled_s[:, None] * VELOCITY + rng.normal(0, 5e-4, (len(times_s), 3))
    return [PathPoint(float(t), place, np.eye(3) * 1e-6) for t, place in zip(times_s, places, strict=True)]


def test_a_steady_belt() -> None:
    times = np.arange(0, 3, 0.05)
    # Two ends known to 0.5 mm over 0.6 m.
    np.testing.assert_allclose(way_velocity(path(times, times)), VELOCITY, atol=4 * np.sqrt(2) * 5e-4 / 3)


def test_captures_of_two_sensors_a_millisecond_apart_spoil_nothing() -> None:
    times = np.sort(np.concatenate([np.arange(0, 3, 0.1), np.arange(0.001, 3, 0.1)]))
    np.testing.assert_allclose(way_velocity(path(times, times)), VELOCITY, atol=1e-3)


def test_while_the_belt_stood_does_not_count() -> None:
    times = np.arange(0, 6, 0.1)
    np.testing.assert_allclose(way_velocity(path(times, np.minimum(times, 2.0))), VELOCITY, atol=3e-3)


@pytest.mark.parametrize("count", [0, 1, 2])
def test_too_short_a_way_says_nothing(count: int) -> None:
    times = 0.1 * np.arange(count)
    assert way_velocity(path(times, times)) is None


def test_a_hand_among_fruit_does_not_count_and_none_is_none() -> None:
    velocities = [VELOCITY, VELOCITY * 1.001, VELOCITY * 0.999, -3 * VELOCITY]
    np.testing.assert_allclose(mean_velocity(velocities), VELOCITY, rtol=2e-3)
    assert mean_velocity([]) is None
