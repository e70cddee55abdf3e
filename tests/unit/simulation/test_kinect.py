"""Depth errs as the Kinect model says: each effect alone, against its formula."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import F32
from fruitgui.simulation.kinect import PERFECT, DepthModel, NoiseBank, Scan, measure_depth, to_millimetres

SHAPE = (240, 320)


def flat(z_m: float | F32, signal: float = 0.5, facing: float = 1.0) -> Scan:
    full = np.ones(SHAPE, dtype=np.float32)
    return Scan(full * np.float32(1) * z_m, full * np.float32(signal), full * np.float32(facing))


def measured(scan: Scan, model: DepthModel, seed: int = 0) -> F32:
    rng = np.random.default_rng(seed)
    bank = NoiseBank(*SHAPE, model.window_px, rng)
    return measure_depth(scan, model, model.focal_px, None, bank, rng)


def stack(z_m: float, model: DepthModel, count: int = 12) -> F32:
    rng = np.random.default_rng(count)
    bank = NoiseBank(*SHAPE, model.window_px, rng)
    passing = replace(model, fixed_share=0.0)
    return np.stack([measure_depth(flat(z_m), passing, model.focal_px, None, bank, rng) for _ in range(count)])


def step(left_m: float, right_m: float, column: int = 160) -> Scan:
    z = np.full(SHAPE, left_m, dtype=np.float32)
    z[:, column:] = right_m
    return flat(z)


NOISY = replace(PERFECT, step_px=0.125, sigma_px=0.0609)


@pytest.mark.parametrize("z_m", [0.7, 1.0, 1.6])
def test_random_error_grows_with_the_square_of_distance(z_m: float) -> None:
    errors = stack(z_m, NOISY) - z_m
    # Khoshelham & Oude Elberink 2012; 9 × 4 pixels err together, so 12 frames hold about 25 000 of them: 1 %;
    # rounding to steps as wide as two sigma makes sigma depend on where in the step z lies: up to 12 %
    assert errors.std() == pytest.approx(1.4e-3 * z_m**2, rel=0.15)
    assert abs(errors.mean()) < 0.3e-3 * z_m**2


def test_sigma_is_right_on_average_over_places_in_the_step() -> None:
    places = np.linspace(1.0, 1.03, 13)
    variances = [np.var(stack(z, NOISY, 4) - z) / z**4 for z in places]
    assert np.sqrt(np.mean(variances)) == pytest.approx(1.4e-3, rel=0.05)


def test_disparity_comes_in_eighths_of_a_pixel() -> None:
    z = measured(flat(1.0), NOISY)
    eighths = 580 * 0.075 / z[z > 0] * 8
    np.testing.assert_allclose(eighths, np.rint(eighths), atol=1e-3)
    values = np.unique(z)
    assert np.diff(values) == pytest.approx(2.9e-3, rel=0.05)


def test_errors_are_correlated_over_the_matching_window() -> None:
    model = replace(NOISY, step_px=0.0)
    errors = stack(1.0, model, 6) - 1.0
    errors /= errors.std()
    along = [float((errors[:, :, :-lag] * errors[:, :, lag:]).mean()) for lag in (1, 4, 9, 15)]
    # a mean over 9 pixels keeps 1 − lag/9 of its variance in common
    assert along == pytest.approx([8 / 9, 5 / 9, 0.0, 0.0], abs=0.05)
    down = [float((errors[:, :-lag] * errors[:, lag:]).mean()) for lag in (1, 2, 4, 8)]
    assert down == pytest.approx([3 / 4, 1 / 2, 0.0, 0.0], abs=0.05)


@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_a_part_of_the_error_stays_with_the_pixel(share: float) -> None:
    rng = np.random.default_rng(3)
    bank = NoiseBank(*SHAPE, (9, 4), rng)
    model = replace(NOISY, step_px=0.0, fixed_share=share)
    first, second = (measure_depth(flat(1.0), model, 580.0, None, bank, rng) - 1.0 for _ in range(2))
    alike = (first * second).mean() / (first.std() * second.std())
    # 76 800 pixels in windows of 36 are 2100 independent ones: ±0.022
    assert alike == pytest.approx(share, abs=0.1)
    assert first.std() == pytest.approx(1.4e-3, rel=0.08)


def test_shadow_lies_on_the_left_and_is_as_wide_as_the_disparities_differ() -> None:
    # the projector is on the camera's right: a near strip hides the far wall to its left from the light
    model = replace(PERFECT, shadow=1.0)
    behind_left = measured(step(1.2, 0.8), model)
    wide = 580 * 0.075 * (1 / 0.8 - 1 / 1.2)
    dark = np.flatnonzero(behind_left[100] == 0)
    assert dark.max() == 159
    assert len(dark) == pytest.approx(wide, abs=1.5)
    assert (measured(step(0.8, 1.2), model) > 0).all()


@pytest.mark.parametrize("grows_px", [0.0, 0.5, 1.0, 1.5, 2.0])
def test_near_surfaces_grow_over_far_ones(grows_px: float) -> None:
    model = replace(PERFECT, fattening_px=grows_px)
    near_columns = [(measured(step(0.8, 1.2), model, seed) < 1.0).sum(axis=1).mean() for seed in range(6)]
    assert np.mean(near_columns) == pytest.approx(160 + grows_px, abs=0.15)


def test_device_errors_are_constant() -> None:
    model = replace(PERFECT, scale_error=0.006, offset_m=-0.004)
    assert measured(flat(1.2), model) == pytest.approx(1.2 * 1.006 - 0.004, abs=1e-6)
    radius2 = np.linspace(0, 1, SHAPE[1], dtype=np.float32)[None, :] * np.ones(SHAPE, np.float32)
    rng = np.random.default_rng(0)
    bent = replace(PERFECT, radial_error=0.01)
    z = measure_depth(flat(1.0), bent, 580.0, radius2, NoiseBank(*SHAPE, (9, 4), rng), rng)
    assert z[0, 0] == pytest.approx(1.0, abs=1e-6)
    assert z[0, -1] == pytest.approx(1.01, abs=1e-6)


def test_nothing_errs_when_every_effect_is_off() -> None:
    assert measured(flat(1.234), PERFECT) == pytest.approx(1.234, abs=1e-6)
    assert (to_millimetres(measured(flat(1.234), PERFECT)) == 1234).all()


def test_dark_slanted_and_far_surfaces_drop_out() -> None:
    model = replace(PERFECT, dark_infrared=0.02, grazing_cosine=0.14)
    assert (measured(flat(1.0), model) > 0).all()
    # the threshold itself is blotched by a third
    assert (measured(flat(1.0, signal=0.002), model) == 0).mean() > 0.99
    assert (measured(flat(1.0, signal=0.0), model) == 0).mean() > 0.99
    assert 0.2 < (measured(flat(1.0, facing=0.14), model) == 0).mean() < 0.8
    assert (measured(flat(4.2), PERFECT) == 0).all()
    assert (measured(flat(0.45), PERFECT) == 0).all()
    assert (measured(flat(np.float32(np.inf)), DepthModel()) == 0).all()


def test_speckle_takes_its_share_in_small_spots() -> None:
    model = replace(PERFECT, speckle_share=0.01)
    lost = stack(1.0, model, 8) == 0
    assert lost.mean() == pytest.approx(0.01, rel=0.3)
    together = (lost[:, :, 1:] & lost[:, :, :-1]).mean() / lost.mean()
    assert together > 0.3


def test_the_same_chance_gives_the_same_depth() -> None:
    np.testing.assert_array_equal(measured(flat(1.0), DepthModel(), 5), measured(flat(1.0), DepthModel(), 5))
    assert (measured(flat(1.0), DepthModel(), 5) != measured(flat(1.0), DepthModel(), 6)).any()
