"""The meter before calibrating, held against what is truly there; every scene is drawn from its seed."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from fruitgui.calibration.outlook import ENOUGH_COMMON, LEAST_COMMON, Outlook, in_common, outlook
from fruitgui.frame import Frame
from fruitgui.simulation.scenes import bare_belt, still_scene
from fruitgui.simulation.simulation import Simulation


def _outlooks(simulation: Simulation) -> dict[str, Outlook]:
    frames: dict[str, list[Frame]] = {}
    for frame in simulation.frames():
        frames.setdefault(frame.sensor, []).append(frame)
    return {sensor: outlook(given) for sensor, given in frames.items()}


@pytest.mark.parametrize("seed", [11, 12, 13])
def test_what_two_sensors_see_of_a_full_belt_is_counted(seed: int) -> None:
    seen = _outlooks(still_scene(seed, "opposed", 15, captures=2))
    assert in_common(seen["kinect_1"], seen["kinect_2"]) >= ENOUGH_COMMON
    assert not any(one.moved for one in seen.values())


@pytest.mark.parametrize("seed", [11, 12])
def test_few_pieces_are_few_and_a_bare_belt_has_none(seed: int) -> None:
    seen = _outlooks(still_scene(seed, "opposed", 3, captures=2))
    assert in_common(seen["kinect_1"], seen["kinect_2"]) < LEAST_COMMON
    bare = _outlooks(bare_belt(seed, captures=2))
    assert {one.things for one in bare.values()} == {0}
    assert all(one.belt for one in bare.values())
    assert in_common(bare["kinect_1"], bare["kinect_2"]) == 0


@pytest.mark.parametrize("seed", [2, 4])
def test_sensors_that_see_nothing_in_common_are_not_taken_for_linked(seed: int) -> None:
    seen = _outlooks(still_scene(seed, "disconnected", 16, captures=2))
    apart = [pair for pair in combinations(seen, 2) if "kinect_3" in pair]
    assert max(in_common(seen[one], seen[other]) for one, other in apart) < LEAST_COMMON


def test_something_that_moves_is_said() -> None:
    seen = _outlooks(still_scene(9, "opposed", 15, captures=4, moved_m=0.03))
    assert any(one.moved for one in seen.values())


def test_the_same_things_are_found_wherever_and_however_turned() -> None:
    rng = np.random.default_rng(5)
    places, looks = rng.uniform(-0.4, 0.4, (9, 2)), rng.uniform(0.0, 30.0, (9, 5))
    R = np.array([[0.0, -1.0], [1.0, 0.0]])
    order = rng.permutation(9)
    first = Outlook("a", True, places, looks, False)
    second = Outlook("b", True, (places @ R.T + [0.3, -0.2])[order], looks[order], False)
    assert in_common(first, second) == 9
    assert in_common(second, first) == 9
    assert in_common(first, Outlook("b", True, np.zeros((0, 2)), np.zeros((0, 5)), False)) == 0
