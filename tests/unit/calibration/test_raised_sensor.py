"""The belt from a second height: what it decides, what it is refused for, and whether what is said of it is true."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.random import Generator

from fruitgui.calibration.depth.estimate import BOW_STD_M, PRIOR_STD, Problem, solve
from fruitgui.calibration.depth.found import found
from fruitgui.calibration.depth.measured import (
    DISTANCE_STD_M,
    LEAST_RAISED_M,
    LENS_ASIDE_M,
    RAISED_STD_M,
    BallOnBelt,
    BareBelt,
    Measurements,
    RaisedBoard,
    RaisedSensor,
    SeenFlat,
    Sureness,
)
from fruitgui.calibration.depth.seeing import read_raised_m, read_turn_rad, see_belt, see_from_higher
from fruitgui.calibration.depth.sureness import sureness, with_raise
from fruitgui.calibration.still import average
from fruitgui.frame import F64
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.simulation.depth_bench import depth_bench
from tests.unit.calibration.depth_stills import BIASED, bare_belt, distance_m, errors_m, fitted, refused, still_of

RAISED_M = 0.30
DEVICES = 60
TILE_STD = 1.2e-4
"""Of a tile's mean inverse depth, 1/m, as read on the bench."""


def _taped() -> BareBelt:
    return bare_belt(distance_m())


def _higher(typed_m: float = RAISED_M) -> RaisedSensor:
    return RaisedSensor(still_of(4, raised_m=RAISED_M), typed_m)


def _problem(measured: Measurements) -> Problem:
    made = found(measured)
    assert isinstance(made, Problem), made
    return made


def test_belt_from_two_heights_and_a_tape_put_depth_right_with_nothing_on_the_belt() -> None:
    made = fitted(Measurements(_taped(), raised=(_higher(),)))
    assert made.decided == ("scale", "offset_m", "radial_2")
    far_m = distance_m()
    for z_m in (far_m + RAISED_M, far_m, far_m - 0.15):
        off_m = np.abs(errors_m(made.correction, z_m)).max()
        assert off_m < 3.0 * made.depth_std_m + 0.001
        assert off_m < np.abs(errors_m(DepthCorrection(), z_m)).max()
    told = {one.what: one for one in made.figures}
    assert abs(told["raised"].after_m - RAISED_M) < 0.002 < abs(told["raised"].before_m - RAISED_M)


def test_a_second_height_tells_the_scale_and_a_tape_the_offset() -> None:
    known = {
        taped: (
            _sure(Measurements(bare_belt(distance_m() if taped else None)), "belt"),
            _sure(Measurements(bare_belt(distance_m() if taped else None), raised=(_higher(),)), "heights"),
        )
        for taped in (True, False)
    }
    for taped, (one, two) in known.items():
        assert two.scale_std < 0.5 * one.scale_std, "the scale is what a second height is for"
        assert (two.offset_std_m < 0.6 * one.offset_std_m) is taped
    assert known[False][1].offset_std_m > 0.95 * PRIOR_STD[1], "without a tape the offset stays what it was"


def _sure(measured: Measurements, by: str) -> Sureness:
    problem = _problem(measured)
    return sureness(by, solve(problem).covariance, float(1.0 / problem.belt.coefficients[2]))


def test_what_each_part_tells_is_said_and_all_together_tell_most() -> None:
    ball = BallOnBelt(still_of(3, ball_m=0.15), 0.15)
    board = RaisedBoard(still_of(2, board_m=0.20), 0.20)
    made = fitted(Measurements(_taped(), (board,), (ball,), (_higher(),)))
    told = {one.by: one for one in made.sureness}
    assert tuple(told) == ("belt", "heights", "ball", "all")
    for one in ("belt", "heights", "ball"):
        assert told["all"].scale_std < told[one].scale_std
        assert told["all"].offset_std_m < told[one].offset_std_m
    assert told["all"].depth_std_m == pytest.approx(made.depth_std_m)
    assert tuple(one.by for one in fitted(Measurements(_taped(), raised=(_higher(),))).sureness) == ("belt", "all")


@pytest.mark.parametrize("taped", [True, False])
def test_what_a_raise_will_bring_is_foretold(taped: bool) -> None:
    before = solve(_problem(Measurements(bare_belt(distance_m() if taped else None)))).covariance
    after = solve(_problem(Measurements(bare_belt(distance_m() if taped else None), raised=(_higher(),)))).covariance
    foretold = np.sqrt(np.diag(with_raise(before, RAISED_M)))
    assert foretold[:2] == pytest.approx(np.sqrt(np.diag(after))[:2], rel=0.2)
    assert np.all(np.linalg.eigvalsh(with_raise(before, 2.0)) > 0.0)


def test_a_raise_that_is_too_small_is_refused() -> None:
    typed_m = LEAST_RAISED_M - 0.005
    higher = RaisedSensor(still_of(5, raised_m=typed_m), typed_m)
    assert refused(Measurements(_taped(), raised=(higher,))).code == "raised_too_little"


def test_a_sensor_that_was_not_raised_or_by_another_length_is_refused() -> None:
    assert refused(Measurements(_taped(), raised=(RaisedSensor(still_of(7), RAISED_M),))).code == "raised_differs"
    assert refused(Measurements(_taped(), raised=(_higher(0.40),))).code == "raised_differs"


def test_a_raise_that_contradicts_box_and_ball_is_refused() -> None:
    ball = BallOnBelt(still_of(3, ball_m=0.15), 0.15)
    board = RaisedBoard(still_of(2, board_m=0.20), 0.20)
    measured = Measurements(_taped(), (board,), (ball,), (_higher(RAISED_M + 0.012),))
    reason = refused(measured)
    assert (reason.code, reason.about) == ("typed_disagrees", "raised")


def test_a_belt_that_is_not_seen_from_higher_is_refused() -> None:
    still = still_of(4, raised_m=RAISED_M)
    nothing = replace(still, inverse_depth=np.zeros_like(still.inverse_depth))
    made = refused(Measurements(_taped(), raised=(RaisedSensor(nothing, RAISED_M),)))
    assert made.code == "raised_belt_not_seen"


def test_the_belt_is_found_where_more_of_the_floor_is_seen_from_higher() -> None:
    # From 1.2 m this sensor sees most of a narrow belt, from 1.5 m more of the floor than of the belt.
    stills = [
        average(list(depth_bench(1, 0, BIASED, raised_m=raised_m, captures=4, sensor_height_m=(0.7, 1.5)).frames()))
        for raised_m in (0.0, RAISED_M)
    ]
    belt = see_belt(stills[0])
    assert belt is not None
    for typed_m in (RAISED_M, 0.25, 0.35):
        higher = see_from_higher(stills[1], belt, typed_m)
        assert higher is not None
        assert read_raised_m(higher.coefficients, belt.coefficients) == pytest.approx(RAISED_M, abs=0.01)
    floor = see_from_higher(stills[1], belt, 0.9)
    assert floor is not None
    assert read_raised_m(floor.coefficients, belt.coefficients) > 0.7, "the floor is there to be found"
    still_low = see_from_higher(stills[0], belt, RAISED_M)
    assert still_low is not None
    assert abs(read_raised_m(still_low.coefficients, belt.coefficients)) < 0.01


def test_a_sensor_that_was_lowered_sees_the_belt_not_the_floor() -> None:
    belt = see_belt(still_of(4, raised_m=RAISED_M))
    assert belt is not None
    lower = see_from_higher(still_of(1), belt, RAISED_M)
    assert lower is not None
    assert read_raised_m(lower.coefficients, belt.coefficients) == pytest.approx(-RAISED_M, abs=0.01)
    raised = RaisedSensor(still_of(1), RAISED_M)
    assert refused(Measurements(BareBelt(still_of(4, raised_m=RAISED_M)), raised=(raised,))).code == "raised_differs"


def test_a_sensor_that_was_turned_as_it_was_raised_is_believed_less() -> None:
    level = _problem(Measurements(_taped(), raised=(_higher(),)))
    ((seen, told),) = level.raised
    assert read_raised_m(seen.coefficients, level.belt.coefficients) == pytest.approx(RAISED_M, abs=0.01)
    turn = rotation_from_vector(np.array([np.radians(4.0), 0.0, 0.0]))
    turned = replace(seen, coefficients=turn @ seen.coefficients)
    assert read_turn_rad(turned, level.belt) > read_turn_rad(seen, level.belt)
    less = solve(replace(level, raised=((turned, told),))).covariance
    assert less[0, 0] > 1.2 * solve(level).covariance[0, 0]


def test_a_sensor_keeps_its_plane_when_it_is_raised_on_the_bench() -> None:
    belt, higher = see_belt(still_of(1)), see_belt(still_of(4, raised_m=RAISED_M))
    assert belt is not None
    assert higher is not None
    assert 0.0 < read_turn_rad(higher, belt) < np.radians(3.0), "a hand turns it a little"


def _draw_flat(rng: Generator, terms: F64, plane: F64) -> SeenFlat:
    """Return what a device of given terms reads of a flat thing that bows a little, tile by tile."""
    x, y = (one.ravel() for one in np.meshgrid(np.linspace(-0.45, 0.45, 20), np.linspace(-0.3, 0.3, 14)))
    rays = np.stack([x, y, np.ones_like(x)], axis=1)
    shapes = np.stack([x * x, y * y, x * y], axis=1) / 0.45**2
    flat = np.stack([x, y, np.ones_like(x)], axis=1)
    shapes -= flat @ np.linalg.lstsq(flat, shapes, rcond=None)[0]
    z_m = 1.0 / (rays @ plane) + shapes @ rng.normal(0.0, BOW_STD_M, 3)
    r2 = x**2 + y**2
    inverse = (terms[0] + terms[2] * r2 + terms[3] * r2**2) / (z_m - terms[1]) + rng.normal(0.0, TILE_STD, len(x))
    coefficients = np.asarray(np.linalg.lstsq(rays, inverse, rcond=None)[0])
    return SeenFlat(rays, inverse, np.full(len(x), TILE_STD), np.ones((1, 1), dtype=bool), coefficients)


def _draw_plane(rng: Generator, distance_m: float) -> F64:
    """Return the a of a belt at a distance from a sensor that leans somehow."""
    normal = rotation_from_vector(np.append(rng.normal(0.0, 0.1, 2), 0.0)) @ np.array([0.0, 0.0, 1.0])
    return np.asarray(normal / distance_m)


def _draw_problem(seed: int) -> tuple[Problem, F64]:
    """Return readings of a device drawn from what is usual of its make, every typed length off by a draw."""
    rng = np.random.default_rng([seed, 31])
    terms = np.array([1.0, 0.0, 0.0, 0.0]) + rng.normal(0.0, PRIOR_STD)
    below_m, raised_m = rng.uniform(0.7, 1.3), rng.uniform(LEAST_RAISED_M, 0.5)
    low = _draw_plane(rng, below_m)
    turn = rotation_from_vector(np.append(rng.normal(0.0, 0.015, 2), 0.0))
    high = turn @ low * below_m / (below_m + raised_m)
    belt, higher = _draw_flat(rng, terms, low), _draw_flat(rng, terms, high)
    off_m = np.hypot(RAISED_STD_M, LENS_ASIDE_M * read_turn_rad(higher, belt))
    told = RaisedSensor(still_of(1), raised_m + rng.normal(0.0, off_m))
    taped_m = 1.0 / low[2] + rng.normal(0.0, DISTANCE_STD_M)
    return Problem(belt, (), (), float(taped_m), DISTANCE_STD_M, ((higher, told),)), terms


def test_terms_of_random_devices_are_found_as_sure_as_is_said() -> None:
    misses = []
    for seed in range(DEVICES):
        problem, terms = _draw_problem(seed)
        solution = solve(problem)
        misses.append((solution.terms - terms) / np.sqrt(np.diag(solution.covariance)))
    rms = np.sqrt(np.mean(np.square(misses), axis=0))
    # Of n normal draws the root mean square is 1 ± 1/√2n: beyond four of these, one set of seeds in 4000 would be.
    half = 4.0 / (2.0 * DEVICES) ** 0.5
    assert np.all(np.abs(rms - 1.0) < half), rms
    assert np.abs(misses).max() < 4.5
    assert np.all(np.abs(np.mean(misses, axis=0)) < 4.0 / DEVICES**0.5), "and no term to one side"


def test_random_devices_are_told_better_from_two_heights_than_from_one() -> None:
    scale, offset_m = [], []
    for seed in range(20):
        problem, terms = _draw_problem(seed)
        for raised, kept in ((problem.raised, 1), ((), 0)):
            found_terms = solve(replace(problem, raised=raised)).terms
            scale.append((kept, abs(found_terms[0] - terms[0])))
            offset_m.append((kept, abs(found_terms[1] - terms[1])))
    for errors in (scale, offset_m):
        one, two = (np.mean([error for kept, error in errors if kept == which]) for which in (0, 1))
        assert two < 0.6 * one
