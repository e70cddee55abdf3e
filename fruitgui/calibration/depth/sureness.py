"""What each measurement is worth: how sure scale and offset are by a part of them, and by one more."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fruitgui.calibration.depth.estimate import PLANE_STD_M, Problem, Solution, solve
from fruitgui.calibration.depth.found import found
from fruitgui.calibration.depth.measured import LENS_ASIDE_M, RAISED_STD_M, DepthRefusal, Measurements, Sureness
from fruitgui.frame import F64

TURNED_RAD = float(np.radians(1.0))
"""So much a sensor usually leans otherwise once a hand has raised it."""

USUAL_RAISED_STD_M = float(np.hypot(np.hypot(RAISED_STD_M, LENS_ASIDE_M * TURNED_RAD), 2**0.5 * PLANE_STD_M))


@dataclass(frozen=True, slots=True, eq=False)
class Outlook:
    """What is known of a device while it is still being measured.

    Attributes:
        covariance: (4, 4) of the terms.
        read_m: distance of the belt straight ahead, as read.
    """

    covariance: F64
    read_m: float

    @property
    def now(self) -> Sureness:
        """How sure it is by what was measured so far."""
        return sureness("all", self.covariance, self.read_m)

    def raised(self, raised_m: float) -> Sureness:
        """Return how sure it will be once the sensor was raised by so much as well."""
        return sureness("all", with_raise(self.covariance, raised_m), self.read_m)


def outlook(measured: Measurements) -> Outlook | DepthRefusal:
    """Return what is known by the measurements so far, or why one of them does not do."""
    problem = found(measured)
    if isinstance(problem, DepthRefusal):
        return problem
    return Outlook(solve(problem).covariance, float(1.0 / problem.belt.coefficients[2]))


def sureness_of(problem: Problem, whole: Solution) -> tuple[Sureness, ...]:
    """Return how sure a depth is by one height, by all heights, by one height and the ball, and by everything."""
    read_m = float(1.0 / problem.belt.coefficients[2])
    one = replace(problem, boards=(), balls=(), raised=())
    parts = {"belt": one}
    if (problem.boards or problem.raised) and problem.balls:
        parts["heights"] = replace(problem, balls=())
        parts["ball"] = replace(one, balls=problem.balls)
    known = {by: solve(part).covariance for by, part in parts.items()}
    return tuple(sureness(by, covariance, read_m) for by, covariance in {**known, "all": whole.covariance}.items())


def sureness(by: str, covariance: F64, read_m: float) -> Sureness:
    """Return how sure terms of a covariance (4, 4) are, and a depth read as so much straight ahead."""
    scale_std, offset_std_m = np.sqrt(np.diag(covariance))[:2]
    return Sureness(by, float(scale_std), float(offset_std_m), depth_std_m(read_m, covariance))


def depth_std_m(read_m: float, covariance: F64) -> float:
    """Return the standard deviation of a corrected depth read as so much straight ahead."""
    ahead = np.array([read_m, 1.0, 0.0, 0.0])
    return float(np.sqrt(ahead @ covariance @ ahead))


def with_raise(covariance: F64, raised_m: float) -> F64:
    """Return the covariance (4, 4) that terms would have once the sensor was raised by so much.

    Two distances that differ by a known length tell the scale, whatever the offset; what hangs on it follows.
    """
    std = USUAL_RAISED_STD_M / raised_m
    of_scale = covariance[:, 0]
    return np.asarray(covariance - np.outer(of_scale, of_scale) / (covariance[0, 0] + std**2))
