from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from fruitgui.evaluation.scoring import covered, relative_errors, score, size_errors_mm
from fruitgui.simulation.scenes import line_scene
from fruitgui.simulation.simulation import Simulation


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    return line_scene(3, fruit=6, foreign=1)


def reported(simulation: Simulation, fruit_id: int, shift_m: float = 0.0, volume: float = 1.0) -> dict[str, Any]:
    truth = simulation.truth
    thing = next(one for one in truth.fruit if one.fruit_id == fruit_id)
    path = [
        {"time_s": t, "position_m": (truth.position_m(fruit_id, t) + np.array([shift_m, 0, 0])).tolist()}
        for t in np.linspace(8.0, 12.0, 20)
    ]
    volume_ml = thing.volume_m3 * 1e6
    return {
        "id": fruit_id,
        "path": path,
        "volume_ml": volume * volume_ml,
        "volume_std_ml": 0.02 * volume_ml,
        "length_mm": thing.length_m * 1e3 + 1.0,
    }


def test_a_perfect_report_has_no_fault(simulation: Simulation) -> None:
    fruit = [reported(simulation, one.fruit_id, 0.01) for one in simulation.truth.fruit]
    judged = score(fruit[::-1], simulation.truth)
    assert (judged.lost, judged.double, judged.phantom) == ((), (), ())
    assert all(pair.reported["id"] == pair.true.fruit_id for pair in judged.pairs)
    np.testing.assert_allclose(relative_errors(judged.pairs), 0.0, atol=1e-12)
    np.testing.assert_allclose(size_errors_mm(judged.pairs, "length"), 1.0)
    assert len(size_errors_mm(judged.pairs, "diameter")) == 0


def test_lost_double_and_phantom_fruit_are_told_apart(simulation: Simulation) -> None:
    fruit = [reported(simulation, one.fruit_id) for one in simulation.truth.fruit[1:]]
    fruit += [reported(simulation, 2, 0.02), reported(simulation, 2, 3.0)]
    judged = score(fruit, simulation.truth)
    assert [one.fruit_id for one in judged.lost] == [1]
    assert [one["id"] for one in judged.double] == [2]
    assert len(judged.phantom) == 1


def test_intervals_count_only_what_they_hold(simulation: Simulation) -> None:
    fruit = [reported(simulation, 1, volume=1.03), reported(simulation, 2, volume=1.05)]
    assert covered(score(fruit, simulation.truth).pairs) == 1


def test_an_empty_report_loses_everything(simulation: Simulation) -> None:
    assert len(score([], simulation.truth).lost) == len(simulation.truth.fruit)
