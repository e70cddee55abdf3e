"""Lengths before and after: what a person can compare with what was typed."""

from __future__ import annotations

import numpy as np

from fruitgui.calibration.depth.estimate import PLANE_STD_M, RESTING_STD_M, Problem
from fruitgui.calibration.depth.measured import Figure, SeenBall, SeenFlat
from fruitgui.calibration.depth.seeing import sphere_depth_m
from fruitgui.frame import F64
from fruitgui.sensors.depth_correction import DepthCorrection


def figures_of(problem: Problem, correction: DepthCorrection) -> tuple[Figure, ...]:
    """Return every typed length as the device has it without and with a correction, and how flat the belt is."""
    before, after = _Reading(problem, DepthCorrection()), _Reading(problem, correction)
    figures = []
    if problem.distance_m is not None:
        figures.append(Figure("distance", problem.distance_m, before.distance_m, after.distance_m, PLANE_STD_M))
    for number, (_, told) in enumerate(problem.boards):
        lengths = (told.height_m, before.heights_m[number], after.heights_m[number])
        figures.append(Figure("height", *lengths, 2**0.5 * PLANE_STD_M))
    for number, (_, told_raised) in enumerate(problem.raised):
        lengths = (told_raised.raised_m, before.raised_m[number], after.raised_m[number])
        figures.append(Figure("raised", *lengths, 2**0.5 * PLANE_STD_M))
    for number, (_, told_ball) in enumerate(problem.balls):
        (first, _), (second, std_m) = before.balls_m[number], after.balls_m[number]
        figures.append(Figure("ball", told_ball.diameter_m, first, second, std_m))
    figures.append(Figure("flatness", 0.0, before.flatness_m, after.flatness_m, PLANE_STD_M))
    return tuple(figures)


class _Reading:
    """What the readings come to with a correction; nothing typed goes in, only that the ball rests on the belt."""

    def __init__(self, problem: Problem, correction: DepthCorrection) -> None:
        belt, self.flatness_m = _plane(problem.belt, correction)
        self.distance_m = float(1.0 / belt[2])
        self.heights_m = []
        for seen, _ in problem.boards:
            board, _ = _plane(seen, correction)
            ray = seen.rays.mean(axis=0)
            self.heights_m.append(_over_m(belt, ray / (board @ ray)))
        higher = [_plane(seen, correction)[0] for seen, _ in problem.raised]
        self.raised_m = [float(1.0 / np.linalg.norm(one) - 1.0 / np.linalg.norm(belt)) for one in higher]
        self.balls_m = [_diameter_m(ball, belt, correction) for ball, _ in problem.balls]


def corrected_inverse(rays: F64, inverse: F64, correction: DepthCorrection) -> F64:
    """Return inverse depths (N,) with a correction applied."""
    r2 = rays[:, 0] ** 2 + rays[:, 1] ** 2
    scales = correction.scale + correction.radial_2 * r2 + correction.radial_4 * r2**2
    return np.asarray(1.0 / (scales / inverse + correction.offset_m))


def _plane(flat: SeenFlat, correction: DepthCorrection) -> tuple[F64, float]:
    """Return the best plane's a, and how far tiles lie from it (root mean square, m along the line of sight)."""
    inverse = corrected_inverse(flat.rays, flat.inverse, correction)
    plane = np.asarray(np.linalg.lstsq(flat.rays, inverse, rcond=None)[0])
    off_m = 1.0 / inverse - 1.0 / (flat.rays @ plane)
    return plane, float(np.sqrt(np.mean(off_m**2)))


def _diameter_m(ball: SeenBall, belt: F64, correction: DepthCorrection) -> tuple[float, float]:
    """Return the diameter of a ball that rests on the belt, and its standard deviation."""
    from scipy.optimize import least_squares

    inverse = corrected_inverse(ball.rays, ball.inverse, correction)
    normal = -belt / np.linalg.norm(belt)

    def misses(x: F64) -> F64:
        centre, radius_m = ball.centre_m + 0.01 * x[:3], ball.radius_m * (1.0 + 0.1 * x[3])
        off = (1.0 / sphere_depth_m(ball.rays, centre, radius_m) - inverse) / ball.std
        rests = (normal @ centre + 1.0 / np.linalg.norm(belt) - radius_m) / np.hypot(RESTING_STD_M, PLANE_STD_M)
        return np.append(off, rests)

    found = least_squares(misses, np.zeros(4), method="lm")
    spread = np.linalg.inv(found.jac.T @ found.jac)[3, 3] ** 0.5
    return 2.0 * ball.radius_m * (1.0 + 0.1 * float(found.x[3])), 0.2 * ball.radius_m * float(spread)


def _over_m(plane: F64, point_m: F64) -> float:
    return float((1.0 - plane @ point_m) / np.linalg.norm(plane))
