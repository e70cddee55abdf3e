from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import cv2
import numpy as np
import pytest

from fruitgui.calibration.flat import Shift
from fruitgui.calibration.relief import relief
from fruitgui.calibration.still import average
from fruitgui.calibration.surface import fit_belt
from fruitgui.calibration.texture import Skin, alike
from fruitgui.frame import F64
from tests.unit.calibration.worlds import CAMERA, OPPOSED, frames_of, scattered

Pattern = Callable[[F64], F64]


def worn(places_m: F64) -> F64:
    """Return wear of a belt at places (…, 2): patches of about a centimetre, a twentieth of its brightness."""
    cells = cv2.GaussianBlur(np.random.default_rng(7).normal(size=(512, 512)), (0, 0), 2.0)
    u, v = ((places_m[..., k] + 1.5) / 0.006 for k in (0, 1))
    found = cv2.remap(cells / cells.std(), u.astype(np.float32), v.astype(np.float32), cv2.INTER_LINEAR)
    return np.asarray(0.05 * found, dtype=np.float64)


def ribbed(places_m: F64) -> F64:
    """Return ribs across the belt every 9 mm."""
    return np.asarray(0.1 * np.sin(2 * np.pi * places_m[..., 0] / 0.009))


def plain(places_m: F64) -> F64:
    return np.zeros(places_m.shape[:-1])


def skin(sensor: str, pattern: Pattern, noise: float = 2.0) -> Skin:
    pose = OPPOSED[sensor]
    rays = np.dstack([CAMERA.rays().astype(np.float64), np.ones((CAMERA.height, CAMERA.width))])
    along = rays @ pose.rotation.T
    places = pose.translation_m + along * (-pose.translation_m[2] / along[..., 2])[..., None]
    rng = np.random.default_rng([*sensor.encode()])
    frames = []
    for frame in frames_of(sensor, pose, scattered(2), seed=4, count=5):
        belt = (frame.color == 70).all(axis=2)
        bright = np.where(belt, 70.0 * (1 + pattern(places[..., :2])), frame.color[..., 0])
        color = np.clip(bright[..., None] + rng.normal(0.0, noise, frame.color.shape), 0, 255).astype(np.uint8)
        frames.append(replace(frame, color=color))
    still = average(frames)
    belt_found = fit_belt(still)
    assert belt_found is not None
    return Skin(relief(still, belt_found))


def true_shift(source: Skin, target: Skin) -> Shift:
    off = target.relief.frame @ OPPOSED["right"].inverse() @ OPPOSED["left"] @ source.relief.frame.inverse()
    x, y = off.translation_m[:2]
    return Shift(float(x), float(y), float(np.arctan2(off.rotation[1, 0], off.rotation[0, 0])))


@pytest.fixture(scope="module")
def pair() -> tuple[Skin, Skin]:
    return skin("left", worn), skin("right", worn)


@pytest.mark.parametrize("off", [(0.0, 0.0, 0.0), (0.003, -0.004, 0.002), (-0.007, 0.002, -0.003)])
def test_wear_brings_a_shift_back_to_a_third_of_a_millimetre(
    pair: tuple[Skin, Skin], off: tuple[float, float, float]
) -> None:
    source, target = pair
    true = true_shift(source, target)
    found = alike(source, target, true.about(np.zeros(2), np.array(off)))
    assert found is not None
    bettered = true.about(np.zeros(2), np.array(off)).about(found.centre_m, found.step)
    corners = true.inverse().apply(found.centre_m + 0.2 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]))
    gaps = np.linalg.norm(bettered.apply(corners) - true.apply(corners), axis=1)
    # pixels are 4 mm wide, and planes tilted by 0.02° move what is seen at 30° by 0.2 mm
    assert gaps.mean() < 0.35e-3
    place = np.append(true.inverse().after(bettered).move_m, bettered.heading_rad - true.heading_rad)
    assert abs(place[2]) < 4 * np.sqrt(found.covariance[2, 2])


def test_another_place_of_the_belt_is_not_alike(pair: tuple[Skin, Skin]) -> None:
    source, target = pair
    true = true_shift(source, target)
    for off in ((0.1, 0.0, 0.0), (0.0, -0.06, 0.0), (0.0, 0.0, np.pi), (0.2, 0.05, 0.3)):
        assert alike(source, target, true.about(np.zeros(2), np.array(off))) is None


@pytest.mark.parametrize("pattern", [plain, ribbed])
def test_a_belt_that_looks_the_same_in_many_places_says_nothing(pattern: Pattern) -> None:
    source, target = skin("left", pattern), skin("right", pattern)
    assert alike(source, target, true_shift(source, target)) is None


def test_views_that_do_not_meet_say_nothing(pair: tuple[Skin, Skin]) -> None:
    assert alike(*pair, Shift(5.0, 0.0, 0.0)) is None
