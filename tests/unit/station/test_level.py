"""A sensor that feels which way is down."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.station.live.level import LevelWatch

G = np.array([0.4, 9.6, -1.8])
NOISE_M_S2 = 9.81 * np.radians(0.3)


def felt(watch: LevelWatch, seconds: int, turn_deg: float, rng: np.random.Generator) -> list[float | None]:
    down = rotation_from_vector(np.radians(turn_deg) * np.array([0.0, 0.0, 1.0])) @ G
    said = []
    for _ in range(seconds):
        x, y, z = down + rng.normal(0.0, NOISE_M_S2, 3)
        said.append(watch.feel("a", (x, y, z)))
    return said


def test_a_shaking_sensor_that_stands_is_left_in_peace() -> None:
    assert not any(felt(LevelWatch(), 8 * 3600, 0.0, np.random.default_rng(1)))


@pytest.mark.parametrize("turn_deg", [2.5, -4.0, 30.0])
def test_one_that_was_turned_is_told_within_seconds(turn_deg: float) -> None:
    rng = np.random.default_rng(2)
    watch = LevelWatch()
    assert not any(felt(watch, 60, 0.0, rng))
    said = felt(watch, 10, turn_deg, rng)[-1]
    assert said is not None
    assert np.degrees(said) == pytest.approx(abs(turn_deg), abs=1.0)


def test_what_is_no_gravity_is_not_believed() -> None:
    watch = LevelWatch()
    felt(watch, 20, 0.0, np.random.default_rng(3))
    for nonsense in ((0.0, 0.0, 0.0), (90.0, 0.0, 0.0), (float("nan"), 9.8, 0.0)):
        assert not any(watch.feel("a", nonsense) for _ in range(20))
