from __future__ import annotations

import numpy as np
import pytest

from fruitgui.calibration.flat import Shift
from fruitgui.calibration.graph import LOOP_BOUND, Edge, groups, solve

PLACES = {
    "a": Shift(0.0, 0.0, 0.0),
    "b": Shift(0.8, 0.1, 3.0),
    "c": Shift(1.5, -0.3, -1.2),
    "d": Shift(0.4, 1.0, 0.5),
}
COVARIANCE = np.diag([4e-8, 4e-8, 1e-7])


def edge(source: str, target: str, error: tuple[float, float, float] = (0.0, 0.0, 0.0), weight: float = 100.0) -> Edge:
    true = PLACES[target].inverse().after(PLACES[source])
    return Edge(source, target, Shift(*error).after(true), COVARIANCE, weight)


def test_groups_are_what_edges_link() -> None:
    assert groups(list("abcd"), [edge("b", "a"), edge("d", "c")]) == [("a", "b"), ("c", "d")]


@pytest.mark.parametrize("reference", list("abc"))
def test_chain_is_composed_to_any_reference(reference: str) -> None:
    solution = solve(reference, [edge("b", "a"), edge("c", "b")])
    for sensor, place in solution.places.items():
        true = PLACES[reference].inverse().after(PLACES[sensor])
        assert place.apart(true, np.zeros((1, 2)))[0] < 1e-9
    assert solution.paths["c" if reference == "a" else "a"][-1] == reference


def test_a_loop_shares_its_misclosure() -> None:
    ring = [edge("b", "a", (1e-4, 0, 0)), edge("c", "b"), edge("d", "c"), edge("d", "a")]
    solution = solve("a", ring)
    assert not solution.dropped
    assert solution.places["b"].apart(PLACES["b"], np.zeros((1, 2)))[0] < 1e-4


def test_one_wrong_edge_among_many_is_dropped() -> None:
    full = [edge("b", "a"), edge("c", "a"), edge("d", "a"), edge("c", "b"), edge("d", "b"), edge("d", "c")]
    wrong = edge("c", "b", (0.1, 0.0, 0.5), weight=30.0)
    solution = solve("a", [*full[:3], wrong, *full[4:]])
    assert solution.dropped == (wrong,)
    assert solution.places["c"].apart(PLACES["c"], np.zeros((1, 2)))[0] < 1e-6


def test_a_triangle_that_does_not_close_and_has_no_weakest_edge_is_not_trusted() -> None:
    solution = solve("a", [edge("b", "a"), edge("c", "a"), edge("c", "b", (0.1, 0.0, 0.0))])
    assert solution.contradiction > LOOP_BOUND


def test_covariance_of_a_chain_adds_up() -> None:
    solution = solve("a", [edge("b", "a"), edge("c", "b")])
    assert np.trace(solution.covariances["c"]) > np.trace(solution.covariances["b"])
    assert (solution.covariances["a"] == 0).all()
