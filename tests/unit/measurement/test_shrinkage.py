from __future__ import annotations

import numpy as np
import pytest

from fruitgui.measurement.shrinkage import between, learned


def test_kinds_left_to_themselves_are_learned_one_by_one_and_kinds_held_together_as_one() -> None:
    information = np.array([3.0, 5.0, 8.0]) * 1e4
    assert learned(information, 1e6) == pytest.approx(3.0, abs=1e-3)
    assert learned(information, 1e-12) == pytest.approx(1.0, abs=1e-3)
    assert 1.0 < learned(information, 2e-5) < 3.0


def test_what_is_learned_is_the_trace_of_what_maps_references_to_their_fitted_values() -> None:
    variances, apart2 = np.array([2.0, 1.0, 4.0]) * 1e-4, 3e-4

    def shrunken(means: np.ndarray) -> np.ndarray:
        weight = 1.0 / (variances + apart2)
        middle = np.average(means, weights=weight)
        return np.asarray((means / variances + middle / apart2) / (1.0 / variances + 1.0 / apart2))

    trace = sum(shrunken(unit)[k] for k, unit in enumerate(np.eye(3)))
    assert learned(1.0 / variances, apart2) == pytest.approx(trace)


def test_kinds_that_differ_more_than_chance_are_drawn_together_less() -> None:
    variances = np.full(4, 1e-4)
    near, _ = between(np.array([0.0, 0.005, -0.005, 0.0]), variances)
    far, (middle, std) = between(np.array([0.0, 0.1, -0.1, 0.04]), variances)
    assert far > 10.0 * near
    assert middle == pytest.approx(0.01, abs=1e-3)
    assert std > 0.01
