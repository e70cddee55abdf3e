from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from fruitgui.measurement.correction import Density, Shift, VolumeCorrection
from fruitgui.measurement.fruit import Edges, Quantity, Size
from fruitgui.measurement.references import Reference, fit_correction
from fruitgui.measurement.shared import shared_mass_std_kg, shared_volume_std_m3
from fruitgui.measurement.size import SYSTEMATIC
from fruitgui.measurement.sums import USUAL_SHARE, SharedSum
from tests.unit.measurement.test_correction import size_of

WORLDS, LOT, TAUGHT = 60, 300, 6
TRUE_M3 = 2e-4


def _added(correction: VolumeCorrection, kind: str, sizes: list[Size]) -> SharedSum:
    total = SharedSum()
    for size in sizes:
        volume = correction.volume(kind, size)
        total += SharedSum.of(volume.value, volume.std, shared_volume_std_m3(correction, kind, size, volume))
    return total


def test_a_lot_s_total_holds_the_truth_as_often_as_its_interval_says() -> None:
    """Kinds are off by some per cent, of which a few references tell; then a lot of 300 fruit is summed up."""
    rng = np.random.default_rng(0)
    held = blind = 0
    for _ in range(WORLDS):
        off = {kind: float(rng.normal(0.0, 0.04)) for kind in ("lemon", "pear", "orange")}

        def fitted(kind: str, off: dict[str, float] = off) -> Size:
            return size_of(TRUE_M3 * math.exp(off[kind] + 0.03 * rng.normal()), 0.03)

        taught = [Reference(kind, fitted(kind), TRUE_M3, None) for kind in off for _ in range(TAUGHT)]
        correction = fit_correction(taught).correction
        total = _added(correction, "lemon", [fitted("lemon") for _ in range(LOT)])
        error = abs(total.quantity.value - LOT * TRUE_M3)
        held += error < 1.96 * total.quantity.std
        blind += error < 1.96 * math.sqrt(total.variance)
    assert 0.88 <= held / WORLDS <= 1.0
    assert blind / WORLDS < 0.5, "as if no two fruit erred together, most intervals miss"


def test_the_shared_part_is_the_doubt_of_the_kind_and_never_more_than_the_whole() -> None:
    taught = VolumeCorrection(Shift(0.0, 0.05), {"lemon": Shift(0.02, 0.012)}, 0.8)
    size = size_of(TRUE_M3, 0.03)
    lemon, other = taught.volume("lemon", size), taught.volume("quince", size)
    share = shared_volume_std_m3(taught, "lemon", size, lemon) / lemon.value
    assert share == pytest.approx(math.hypot(0.012, SYSTEMATIC))
    assert shared_volume_std_m3(taught, "quince", size, other) / other.value == pytest.approx(
        math.hypot(0.05, SYSTEMATIC)
    )
    surely = Quantity(TRUE_M3, 1e-3 * TRUE_M3)
    assert shared_volume_std_m3(taught, "lemon", size, surely) == pytest.approx(surely.std)


def test_without_references_edges_and_about_half_of_the_rest_are_shared() -> None:
    nothing, size = VolumeCorrection(), size_of(TRUE_M3, 0.04)
    part = shared_volume_std_m3(nothing, "unknown", size, size.volume_m3) / size.volume_m3.std
    assert part == pytest.approx(math.hypot(USUAL_SHARE, SYSTEMATIC / 0.04))
    # One sensor whose edges explain three quarters of the volume's variance.
    edges = Edges(("kinect_1",), np.zeros(1), np.array([[0.25]]), np.array([0.5 * 0.04 * math.sqrt(0.75)]))
    edged = replace(size, edges=edges)
    more = shared_volume_std_m3(nothing, "unknown", edged, size.volume_m3) / size.volume_m3.std
    assert more == pytest.approx(math.sqrt(0.75 + 0.25 * USUAL_SHARE**2 + (SYSTEMATIC / 0.04) ** 2))
    assert part < more < 1.0


def test_what_a_mass_shares_has_the_density_in_it() -> None:
    taught = VolumeCorrection(kinds={"lemon": Shift(0.0, 0.01)}, densities={"lemon": Density(950.0, 9.5)})
    volume = taught.volume("lemon", size_of(TRUE_M3, 0.03))
    mass = taught.mass("lemon", volume)
    assert mass is not None
    shared = shared_mass_std_kg(taught, "lemon", mass, volume, 0.01 * volume.value)
    assert shared / mass.value == pytest.approx(math.hypot(0.01, 0.01))
    assert shared < mass.std


def test_sums_of_what_is_shared_do_not_average_out() -> None:
    one = SharedSum.of(2.0, 0.05, 0.03)
    whole = sum([one] * 100, SharedSum())
    assert whole.quantity.value == pytest.approx(200.0)
    assert whole.quantity.std == pytest.approx(math.hypot(10 * 0.04, 100 * 0.03))
    assert one.quantity.std == pytest.approx(0.05), "one fruit is as sure as it is"
    mean = whole.mean(100)
    assert mean is not None
    assert (mean.value, mean.std) == (pytest.approx(2.0), pytest.approx(whole.quantity.std / 100))
    assert SharedSum().mean(0) is None
    assert SharedSum.of(2.0, 0.05).shared == SharedSum.of(2.0, 0.05, math.nan).shared == USUAL_SHARE * 0.05
