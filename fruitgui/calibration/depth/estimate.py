"""All measurements of one device put into one least squares problem: terms, boards, belt and balls together.

Known of the device is what is usual of its make, as a prior; every board may bow a little, and every typed length is as
sure as it was typed. What the readings do not decide stays where the prior has it, and its uncertainty shows that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fruitgui.calibration.depth.measured import LENS_ASIDE_M, BallOnBelt, RaisedBoard, RaisedSensor, SeenBall, SeenFlat
from fruitgui.calibration.depth.seeing import read_turn_rad, sphere_depth_m, sphere_slopes
from fruitgui.frame import F64
from fruitgui.sensors.depth_correction import DepthCorrection

USUAL = DepthCorrection()
PRIOR_STD = (0.02, 0.02, 0.03, 0.05)
"""Standard deviations of scale, offset (m), radial terms among devices as sold: they differ by centimetres at range
(Boehm 2014; Clarkson et al. 2013), and bend planes by as much in the picture's corners."""

BOW_STD_M = 0.0007
"""How far a belt between its rollers or a carton's lid may bow over its length, and nobody sees it."""

PLANE_STD_M = 0.0002
"""What lens and registration shift a plane by, and no residual shows (see `surface.BENT_M`)."""

RESTING_STD_M = 0.0005
"""A ball dents a belt, or lies on a crumb."""

TERM_COUNT, FLAT_COUNT, BALL_COUNT = 4, 6, 4


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """What is to be explained.

    Attributes:
        belt: as read. boards, balls: as read, each with what was typed of it. raised: the belt as read from higher.
        distance_m, distance_std_m: typed, of the belt straight ahead; None where it was not.
        free: which of the four terms are fitted.
    """

    belt: SeenFlat
    boards: Sequence[tuple[SeenFlat, RaisedBoard]]
    balls: Sequence[tuple[SeenBall, BallOnBelt]]
    distance_m: float | None
    distance_std_m: float
    raised: Sequence[tuple[SeenFlat, RaisedSensor]] = ()
    free: tuple[bool, ...] = (True, True, True, True)

    @property
    def flats(self) -> list[SeenFlat]:
        """The belt, then the boards, then the belt from higher."""
        return [self.belt, *(seen for seen, _ in self.boards), *(seen for seen, _ in self.raised)]


@dataclass(frozen=True, slots=True, eq=False)
class Solution:
    """What explains it best.

    Attributes:
        terms: (4,) of the correction. covariance: (4, 4); of terms that were not free, as of the prior.
        bows_m: largest bow of each flat thing.
        typed: what was typed and how far, in its standard deviations, it is from the rest: (what, number, deviations).
    """

    terms: F64
    covariance: F64
    bows_m: tuple[float, ...]
    typed: tuple[tuple[str, int, float], ...]

    @property
    def correction(self) -> DepthCorrection:
        """The terms as a correction."""
        scale, offset_m, radial_2, radial_4 = (float(one) for one in self.terms)
        return DepthCorrection(scale, offset_m, radial_2, radial_4)


def solve(problem: Problem) -> Solution:
    """Return the best explanation (Gauss–Newton, all unknowns in units of what is usual)."""
    from scipy.optimize import least_squares

    unknowns = _Unknowns(problem)
    start = np.zeros(unknowns.count)
    found = least_squares(unknowns.residuals, start, unknowns.jacobian, method="lm", xtol=1e-12, ftol=1e-12)
    inverse = np.linalg.inv(found.jac.T @ found.jac)
    free = np.array(problem.free)
    prior = np.array(PRIOR_STD)
    covariance = np.diag(prior**2)
    scaled = inverse[:TERM_COUNT, :TERM_COUNT] * np.outer(prior, prior)
    covariance[np.ix_(free, free)] = scaled[np.ix_(free, free)]
    return Solution(unknowns.terms(found.x), covariance, unknowns.bows_m(found.x), unknowns.typed(found.x))


class _Unknowns:
    """What is looked for, as one vector of numbers about 1, and how it explains the readings."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._first_ball = TERM_COUNT + FLAT_COUNT * len(problem.flats)
        self.count = self._first_ball + BALL_COUNT * len(problem.balls)
        self._bend = [_bend(flat) for flat in problem.flats]
        self._plane_units = [float(np.linalg.norm(flat.coefficients)) * 0.01 for flat in problem.flats]

    def terms(self, x: F64) -> F64:
        """Return the four terms."""
        return np.asarray([1.0, 0.0, 0.0, 0.0] + x[:TERM_COUNT] * PRIOR_STD * np.array(self._problem.free))

    def bows_m(self, x: F64) -> tuple[float, ...]:
        """Return the largest bow of each flat thing."""
        return tuple(
            float(np.abs(self._bend[number] @ self._flat(x, number)[1]).max()) for number in range(len(self._bend))
        )

    def typed(self, x: F64) -> tuple[tuple[str, int, float], ...]:
        """Return how far each typed length is from the rest, in its standard deviations."""
        return tuple(self._typed(x))

    def residuals(self, x: F64) -> F64:
        """Return everything that is to be small, each in its standard deviations."""
        terms = self.terms(x)
        parts: list[F64] = [x[:TERM_COUNT]]
        for number, flat in enumerate(self._problem.flats):
            plane, bow = self._flat(x, number)
            z_m = 1.0 / (flat.rays @ plane) + self._bend[number] @ bow
            parts += [(_read(terms, flat.rays, z_m) - flat.inverse) / flat.std, bow / BOW_STD_M]
        for number, (ball, _) in enumerate(self._problem.balls):
            centre, radius_m = self._ball(x, number)
            z_m = sphere_depth_m(ball.rays, centre, radius_m)
            parts.append((_read(terms, ball.rays, z_m) - ball.inverse) / ball.std)
        parts.append(np.array([off for _, _, off in self._typed(x)]))
        return np.concatenate(parts)

    def jacobian(self, x: F64) -> F64:
        """Return how the residuals change with the unknowns: each thing's readings with its own and the terms alone."""
        terms = self.terms(x)
        units = np.array(PRIOR_STD) * self._problem.free
        parts = [np.eye(TERM_COUNT, self.count)]
        for number, flat in enumerate(self._problem.flats):
            plane, bow = self._flat(x, number)
            nearness = flat.rays @ plane
            z_m = 1.0 / nearness + self._bend[number] @ bow
            by_z, by_terms = _read_slopes(terms, flat.rays, z_m)
            by_plane = -flat.rays * (self._plane_units[number] / nearness**2)[:, None]
            by_own = by_z[:, None] * np.hstack([by_plane, self._bend[number] * BOW_STD_M])
            at = TERM_COUNT + FLAT_COUNT * number
            std = flat.std[:, None]
            parts.append(self._rows(by_terms * units / std, by_own / std, at))
            parts.append(np.eye(3, self.count, at + 3))
        for number, (ball, told) in enumerate(self._problem.balls):
            z_m, by_centre, by_radius = sphere_slopes(ball.rays, *self._ball(x, number))
            by_z, by_terms = _read_slopes(terms, ball.rays, z_m)
            by_own = by_z[:, None] * np.column_stack([by_centre * 0.01, by_radius * told.diameter_std_m / 2])
            at = self._first_ball + BALL_COUNT * number
            parts.append(self._rows(by_terms * units / ball.std, by_own / ball.std, at))
        return np.concatenate([*parts, self._typed_slopes(x)])

    def _rows(self, by_terms: F64, by_own: F64, at: int) -> F64:
        """Return rows of the Jacobian that know but the terms and what begins at an unknown."""
        rows = np.zeros((len(by_own), self.count))
        rows[:, :TERM_COUNT] = by_terms
        rows[:, at : at + by_own.shape[1]] = by_own
        return rows

    def _typed_slopes(self, x: F64, step: float = 1e-6) -> F64:
        """Return how far what was typed gets from the rest with each unknown; of few numbers, by differences."""
        offs = [np.array([off for _, _, off in self._typed(moved)]) for moved in (*(x + step * np.eye(len(x))), x)]
        return np.asarray((np.stack(offs[:-1], axis=1) - offs[-1][:, None]) / step)

    def _flat(self, x: F64, number: int) -> tuple[F64, F64]:
        """Return the a of a plane, 1/z = a·(x, y, 1), and the factors of its bow, m."""
        part = x[TERM_COUNT + FLAT_COUNT * number :][:FLAT_COUNT]
        plane = self._problem.flats[number].coefficients + part[:3] * self._plane_units[number]
        return plane, part[3:] * BOW_STD_M

    def _ball(self, x: F64, number: int) -> tuple[F64, float]:
        part = x[self._first_ball + BALL_COUNT * number :][:BALL_COUNT]
        seen, told = self._problem.balls[number]
        return seen.centre_m + part[:3] * 0.01, told.diameter_m / 2 + part[3] * told.diameter_std_m / 2

    def _typed(self, x: F64) -> list[tuple[str, int, float]]:
        problem = self._problem
        belt, _ = self._flat(x, 0)
        offs = []
        if problem.distance_m is not None:
            offs.append(("distance", 0, float((1.0 / belt[2] - problem.distance_m) / problem.distance_std_m)))
        for number, (seen, told) in enumerate(problem.boards, start=1):
            height_m = _rise_m(belt, self._flat(x, number)[0], seen.rays.mean(axis=0))
            std_m = float(np.hypot(told.height_std_m, 2**0.5 * PLANE_STD_M))
            offs.append(("height", number - 1, (height_m - told.height_m) / std_m))
        for number, (seen, told_raised) in enumerate(problem.raised):
            higher, _ = self._flat(x, 1 + len(problem.boards) + number)
            raised_m = float(1.0 / np.linalg.norm(higher) - 1.0 / np.linalg.norm(belt))
            turned_m = LENS_ASIDE_M * read_turn_rad(seen, problem.belt)
            std_m = float(np.hypot(np.hypot(told_raised.raised_std_m, turned_m), 2**0.5 * PLANE_STD_M))
            offs.append(("raised", number, (raised_m - told_raised.raised_m) / std_m))
        for number, (_, told_ball) in enumerate(problem.balls):
            centre, radius_m = self._ball(x, number)
            rests = (_over_m(belt, centre) - radius_m) / float(np.hypot(RESTING_STD_M, PLANE_STD_M))
            off = (2.0 * radius_m - told_ball.diameter_m) / told_ball.diameter_std_m
            offs += [("ball", number, off), ("ball", number, rests)]
        return offs


def _read(terms: F64, rays: F64, z_m: F64) -> F64:
    """Return the inverse depth that the device reads at true depths: the correction turned round."""
    scale, offset_m, radial_2, radial_4 = terms
    r2 = rays[:, 0] ** 2 + rays[:, 1] ** 2
    return np.asarray((scale + radial_2 * r2 + radial_4 * r2**2) / (z_m - offset_m))


def _read_slopes(terms: F64, rays: F64, z_m: F64) -> tuple[F64, F64]:
    """Return how `_read` changes with the true depth, (N,), and with the terms, (N, 4)."""
    scale, offset_m, radial_2, radial_4 = terms
    r2 = rays[:, 0] ** 2 + rays[:, 1] ** 2
    nearness = 1.0 / (z_m - offset_m)
    by_offset = (scale + radial_2 * r2 + radial_4 * r2**2) * nearness**2
    return -by_offset, np.stack([nearness, by_offset, r2 * nearness, r2**2 * nearness], axis=1)


def _over_m(plane: F64, point_m: F64) -> float:
    """Return the height of a point over the plane 1/z = a·(x, y, 1), on the sensor's side."""
    return float((1.0 - plane @ point_m) / np.linalg.norm(plane))


def _rise_m(belt: F64, board: F64, ray: F64) -> float:
    """Return how far a board lies above the belt where a ray meets it."""
    return _over_m(belt, ray / (board @ ray))


def _bend(flat: SeenFlat) -> F64:
    """Return the shapes (N, 3) in which a flat thing may bow: squares across its extent, none of them a plane."""
    middle, reach = flat.rays.mean(axis=0), np.ptp(flat.rays, axis=0).max() / 2.0
    x, y = ((flat.rays - middle) / reach)[:, :2].T
    shapes = np.stack([x * x, y * y, x * y], axis=1)
    flatness = np.stack([x, y, np.ones_like(x)], axis=1)
    return np.asarray(shapes - flatness @ np.linalg.lstsq(flatness, shapes, rcond=None)[0])
