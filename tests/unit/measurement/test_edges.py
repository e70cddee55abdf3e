from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.measurement.correction import VolumeCorrection
from fruitgui.measurement.edges import CONSTANT_PX, STRANGE_SIGMAS, learn_fattening, lengths_by_edges, volume_by_edges
from fruitgui.measurement.fruit import Edges, Quantity, Size
from fruitgui.measurement.references import Reference, fit_correction
from fruitgui.measurement.size import measure
from tests.unit.measurement.solids import Solid, track_of

TRUE_M3, OWN_STD, EDGE_STD, SLOPE = 2e-4, 0.01, 0.15, -0.08
TRUE_M, OWN_STD_M, SLOPES_M = np.array([0.08, 0.07, 0.22]), 0.3e-3, np.array([-1.5e-3, -1.5e-3, -4.5e-3])
DEVICES_PX = {"east": 1.2, "west": 0.3}


def size_of(rng: np.random.Generator, sensors: tuple[str, ...] = ("east", "west"), aside_px: float = 0.0) -> Size:
    """Return a fruit as fitted: what its edges are taken for too much, it is taken for too small."""
    error = rng.normal(0.0, EDGE_STD, len(sensors))
    log = SLOPE * float(error.sum()) + rng.normal(0.0, OWN_STD)
    std = float(np.hypot(SLOPE * EDGE_STD * np.sqrt(len(sensors)), OWN_STD))
    edges = Edges(
        sensors,
        np.array([DEVICES_PX[name] for name in sensors]) + error + aside_px,
        EDGE_STD**2 * np.eye(len(sensors)),
        np.full(len(sensors), SLOPE * EDGE_STD**2),
        np.tile(SLOPES_M[:, None] * EDGE_STD**2, len(sensors)),
    )
    lengths = TRUE_M + SLOPES_M * float(error.sum()) + rng.normal(0.0, OWN_STD_M, 3)
    stds = np.hypot(SLOPES_M * EDGE_STD * np.sqrt(len(sensors)), OWN_STD_M)
    value = TRUE_M3 * float(np.exp(log))
    extents = [Quantity(float(one), float(of)) for one, of in zip(lengths, stds, strict=True)]
    return Size(Quantity(value, std * value), *extents, 0.6, edges)


def test_taught_edges_leave_a_volume_only_its_own_error_and_the_interval_holds() -> None:
    rng = np.random.default_rng(1)
    taught = learn_fattening([size_of(rng) for _ in range(25)])
    for name, true_px in DEVICES_PX.items():
        # the median of 25 is known to 1.25 σ / 5
        assert taught[name].value == pytest.approx(true_px, abs=3 * 1.25 * EDGE_STD / 5)
        assert CONSTANT_PX <= taught[name].std < EDGE_STD
    # some seen by one sensor only: each sensor's own fattening counts
    fruit = [size_of(rng, ("east", "west") if k % 3 else ("east",)) for k in range(300)]
    before = np.array([one.volume_m3.value / TRUE_M3 - 1.0 for one in fruit])
    after = [volume_by_edges(one, taught) for one in fruit]
    error = np.array([one.value / TRUE_M3 - 1.0 for one in after])
    spread = np.array([one.std / one.value for one in after])
    assert error.std() < 0.75 * before.std()
    assert 0.93 < np.mean(np.abs(error) < 1.96 * spread) < 1.0
    assert (spread < [one.volume_m3.std / one.volume_m3.value for one in fruit]).all()


def test_taught_edges_leave_lengths_only_their_own_error_and_the_intervals_hold() -> None:
    rng = np.random.default_rng(5)
    taught = learn_fattening([size_of(rng) for _ in range(25)])
    fruit = [size_of(rng, ("east", "west") if k % 3 else ("east",)) for k in range(300)]
    after = [lengths_by_edges(one, taught) for one in fruit]
    for name, true_m in zip(("length_m", "diameter_m", "perimeter_m"), TRUE_M, strict=True):
        before_m = np.array([getattr(one, name).value - true_m for one in fruit])
        error_m = np.array([getattr(one, name).value - true_m for one in after])
        std_m = np.array([getattr(one, name).std for one in after])
        assert error_m.std() < 0.85 * before_m.std()
        assert 0.93 < np.mean(np.abs(error_m) < 1.96 * std_m) < 1.0
    assert [one.volume_m3 for one in after] == [one.volume_m3 for one in fruit]


def test_what_was_not_taught_or_is_another_device_changes_nothing() -> None:
    rng = np.random.default_rng(2)
    taught = learn_fattening([size_of(rng, ("east",)) for _ in range(9)])
    assert set(taught) == {"east"}
    assert learn_fattening([size_of(rng) for _ in range(2)]) == {}
    stranger = size_of(rng, ("west",))
    assert volume_by_edges(stranger, taught) == stranger.volume_m3
    other = size_of(rng, ("east",), aside_px=1.5 * STRANGE_SIGMAS * EDGE_STD)
    assert volume_by_edges(other, taught) == other.volume_m3
    assert lengths_by_edges(stranger, taught) is stranger
    assert lengths_by_edges(other, taught) is other
    assert stranger.edges is not None
    old = replace(size_of(rng), edges=replace(stranger.edges, with_lengths_px_m=None))
    assert lengths_by_edges(old, taught) is old


def test_references_teach_edges_and_the_model_file_keeps_them() -> None:
    rng = np.random.default_rng(3)
    learned = fit_correction([Reference("apple", size_of(rng), TRUE_M3, None) for _ in range(20)]).correction
    again = VolumeCorrection.from_dict(learned.to_dict())
    one = size_of(rng)
    assert set(learned.fattening_px) == set(DEVICES_PX)
    assert again.volume("apple", one) == learned.volume("apple", one)
    old = {key: value for key, value in learned.to_dict().items() if key != "fattening_px"}
    assert VolumeCorrection.from_dict(old).fattening_px == {}


def test_what_references_say_of_volumes_puts_lengths_right_as_far_as_the_fit_ties_them() -> None:
    """Every fruit comes out too narrow, and too small by the square of it; a length that owes nothing stays."""
    rng, narrow = np.random.default_rng(6), 0.98
    volume = Quantity(TRUE_M3 * narrow**2, 0.03 * TRUE_M3 * narrow**2)
    tied = np.array([0.5, 0.5, 0.0]) * TRUE_M * 0.03**2

    def fitted() -> Size:
        extents = [Quantity(float(one * narrow + rng.normal(0.0, 1e-4)), 1e-3) for one in TRUE_M]
        return Size(volume, *extents, 0.6, with_volume_m=tied)

    learned = fit_correction([Reference("apple", fitted(), TRUE_M3, None) for _ in range(20)]).correction
    one = fitted()
    right = learned.lengths("apple", one)
    assert right.length_m.value == pytest.approx(TRUE_M[0], abs=5e-4)
    assert right.diameter_m.value == pytest.approx(TRUE_M[1], abs=5e-4)
    assert right.perimeter_m == one.perimeter_m
    assert right.length_m.std >= one.length_m.std
    assert VolumeCorrection().lengths("apple", one).length_m == one.length_m


def test_what_lone_references_teach_does_not_narrow_the_interval_of_a_fruit_that_neighbours_spoil() -> None:
    rng = np.random.default_rng(4)
    sure = [replace(size_of(rng), volume_m3=Quantity(TRUE_M3, 0.04 * TRUE_M3)) for _ in range(20)]
    learned = fit_correction([Reference("apple", one, TRUE_M3, None) for one in sure]).correction
    stds = [learned.volume("apple", replace(sure[0], spoilt=share)).std for share in (0.0, 0.5, 1.0)]
    assert stds[0] < stds[1] < stds[2]
    loose = replace(learned, chance=2.0)
    assert loose.volume("apple", replace(sure[0], spoilt=1.0)).std == loose.volume("apple", sure[0]).std


def test_a_fit_states_that_fat_edges_and_small_fruit_look_alike() -> None:
    size = measure(*track_of(Solid((0.040, 0.036, 0.036)), 1))
    assert size.edges is not None
    assert len(size.edges.sensors) == 2
    assert (size.edges.with_volume_px < 0.0).all()
    edges, variance = size.edges, (size.volume_m3.std / size.volume_m3.value) ** 2
    assert edges.with_lengths_px_m is not None
    assert (edges.with_lengths_px_m < 0.0).all()
    assert size.with_volume_m is not None
    assert (size.with_volume_m > 0.0).all()
    owed = edges.with_volume_px @ np.linalg.solve(edges.covariance_px2, edges.with_volume_px)
    assert 0.2 * variance < owed < variance
