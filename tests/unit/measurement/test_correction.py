from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fruitgui.errors import InputError
from fruitgui.measurement.correction import VolumeCorrection
from fruitgui.measurement.fruit import Quantity, Size
from fruitgui.measurement.references import Reference, fit_correction


def size_of(volume_m3: float, relative_std: float = 0.03) -> Size:
    extent = Quantity(0.07, 0.001)
    return Size(Quantity(volume_m3, relative_std * volume_m3), extent, extent, extent, 0.6)


def references(
    rng: np.random.Generator, factors: dict[str, float], count: int, spread: float = 0.015
) -> list[Reference]:
    made = []
    for kind, factor in factors.items():
        for _ in range(count):
            true = rng.uniform(100e-6, 400e-6)
            made.append(Reference(kind, size_of(true / factor * np.exp(spread * rng.normal())), true, None))
    return made


def test_factors_are_learned_kind_by_kind() -> None:
    factors = {"lemon": 0.92, "pear": 1.05, "orange": 0.98}
    learned = fit_correction(references(np.random.default_rng(0), factors, 8)).correction
    for kind, factor in factors.items():
        # 1.5 % over √8 fruit is 0.5 %; three of those
        assert learned.volume(kind, size_of(2e-4)).value / 2e-4 == pytest.approx(factor, rel=0.02)


def test_a_kind_with_one_reference_leans_on_the_others() -> None:
    rng = np.random.default_rng(1)
    many = references(rng, {"lemon": 0.9, "orange": 0.9, "pear": 0.9}, 8)
    odd = Reference("apple", size_of(2e-4), 2e-4 * 0.96, None)
    learned = fit_correction([*many, odd]).correction
    factor = learned.volume("apple", size_of(2e-4)).value / 2e-4
    assert 0.9 < factor < 0.96
    assert learned.volume("never seen", size_of(2e-4)).value / 2e-4 == pytest.approx(0.9, abs=0.02)


@pytest.mark.parametrize("wrong", [10.0, 0.1, 1.4])
def test_one_typing_error_changes_nothing(wrong: float) -> None:
    clean = references(np.random.default_rng(2), {"lemon": 0.95, "pear": 1.02}, 6)
    mistyped = Reference("lemon", clean[0].size, clean[0].volume_m3 * wrong, None)
    learned = fit_correction([mistyped, *clean[1:]])
    assert [one.used for one in learned.residuals] == [False] + [True] * 11
    plain = fit_correction(clean[1:]).correction.volume("lemon", size_of(2e-4))
    assert learned.correction.volume("lemon", size_of(2e-4)).value == pytest.approx(plain.value, rel=1e-6)


@settings(deadline=None, max_examples=8)
@given(st.sampled_from([0.01, 0.03, 0.06]), st.integers(0, 1000))
def test_intervals_hold_for_fruit_not_taught(spread: float, seed: int) -> None:
    """Whatever the fit said of itself (3 %), the references correct it."""
    rng = np.random.default_rng(seed)
    factors = {"lemon": 0.93, "pear": 1.04, "orange": 0.97, "apple": 1.0}
    learned = fit_correction(references(rng, factors, 6, spread)).correction
    fresh = references(rng, factors, 60, spread)
    held = [
        abs((corrected := learned.volume(one.kind, one.size)).value - one.volume_m3) < 1.96 * corrected.std
        for one in fresh
    ]
    assert 0.8 < np.mean(held) <= 1.0


def test_without_references_volumes_stay_as_fitted() -> None:
    size = size_of(2e-4)
    assert VolumeCorrection().volume("pear", size) == size.volume_m3
    assert fit_correction([]).correction == VolumeCorrection()
    assert "No reference" in fit_correction([]).lines()[0]


def test_density_is_learned_and_a_weight_then_corrects_volume() -> None:
    rng = np.random.default_rng(3)
    both = [
        Reference("pear", size_of(v / 0.95), v, v * 1010.0 * (1 + 0.005 * rng.normal()))
        for v in rng.uniform(1e-4, 3e-4, 6)
    ]
    weighed = [Reference("pear", size_of(v / 0.95), None, v * 1010.0) for v in rng.uniform(1e-4, 3e-4, 6)]
    learned = fit_correction([*both, *weighed])
    assert len(learned.residuals) == 12
    mass = learned.correction.mass("pear", Quantity(2e-4, 4e-6))
    assert mass is not None
    assert mass.value == pytest.approx(0.202, rel=0.01)
    assert mass.std == pytest.approx(0.202 * np.hypot(0.02, 0.01), rel=0.3)


def test_a_weight_alone_corrects_nothing_where_the_density_is_not_known() -> None:
    learned = fit_correction([Reference("pear", size_of(2e-4), None, 0.21)])
    assert learned.correction == VolumeCorrection()
    assert learned.correction.mass("pear", Quantity(2e-4, 4e-6)) is None


def test_it_survives_being_written_and_read() -> None:
    learned = fit_correction(references(np.random.default_rng(4), {"lemon": 0.9, "pear": 1.1}, 5)).correction
    again = VolumeCorrection.from_dict(json.loads(json.dumps(learned.to_dict())))
    assert again == learned


@pytest.mark.parametrize(
    "spoil",
    [
        {"chance": float("nan")},
        {"chance": "1"},
        {"chance": True},
        {"chance": None},
        {"common": None},
        {"common": {"value": 0.1}},
        {"common": {"value": 5.0, "std": 0.1}},
        {"kinds": []},
        {"kinds": 3},
        {"kinds": {"pear": None}},
        {"kinds": {"pear": {"value": float("inf"), "std": 0.1}}},
        {"densities": {"pear": {"value": -1.0, "std": 0.1}}},
        {"densities": {"pear": []}},
    ],
)
def test_what_cannot_be_a_correction_is_refused(spoil: dict[str, object]) -> None:
    good = fit_correction(references(np.random.default_rng(5), {"lemon": 0.9}, 5)).correction.to_dict()
    with pytest.raises(InputError):
        VolumeCorrection.from_dict({**good, **spoil})


def test_missing_fields_are_refused() -> None:
    for field in ("common", "kinds", "chance", "densities"):
        value = VolumeCorrection().to_dict()
        del value[field]
        with pytest.raises(InputError):
            VolumeCorrection.from_dict(value)


def test_people_are_told_what_it_did() -> None:
    told = fit_correction(references(np.random.default_rng(6), {"lemon": 0.9}, 5))
    assert any("lemon" in line for line in told.lines())
    value = told.value()
    json.dumps(value, allow_nan=False)
    assert len(value["references"]) == 5
