"""From measurements to a correction, or to reasons why they do not do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fruitgui.calibration.depth import reasons
from fruitgui.calibration.depth.estimate import PRIOR_STD, Problem, Solution, solve
from fruitgui.calibration.depth.figures import figures_of
from fruitgui.calibration.depth.found import found
from fruitgui.calibration.depth.measured import TERMS, DepthFit, DepthRefusal, Measurements
from fruitgui.calibration.depth.sureness import depth_std_m, sureness_of

DECIDED = 0.5
"""A term is decided where the measurements leave less than this share of what is usual of such devices: they then say
three times as much as the prior does."""

CLEARLY = 3.0
"""The fourth power of r bends where nothing was seen: it is fitted only where it shows in so many deviations."""


def correct_depth(measured: Measurements) -> DepthFit | DepthRefusal:
    """Return the correction that all measurements of a device ask for, or why there is none."""
    seen = found(measured)
    if isinstance(seen, DepthRefusal):
        return seen
    whole = solve(seen)
    free = _decided(whole)
    solution = solve(replace(seen, free=free)) if any(free) else whole
    wrong = (
        *reasons.disagreements(solution),
        *reasons.shape(solution),
        *reasons.undecided(measured, free),
        *reasons.implausible(solution),
    )
    if wrong:
        return DepthRefusal(wrong)
    return _fit(seen, whole, solution, free)


def _decided(whole: Solution) -> tuple[bool, ...]:
    std = np.sqrt(np.diag(whole.covariance))
    told = std < DECIDED * np.array(PRIOR_STD)
    clear = np.abs(whole.terms[3]) > CLEARLY * std[3]
    return (bool(told[0]), bool(told[1]), bool(told[2]), bool(told[3] and clear))


def _fit(problem: Problem, whole: Solution, solution: Solution, free: tuple[bool, ...]) -> DepthFit:
    correction = solution.correction
    read_m = 1.0 / problem.belt.coefficients[2]
    distance_m = correction.scale * read_m + correction.offset_m
    prior = np.diag(np.square(PRIOR_STD))
    return DepthFit(
        correction=correction,
        decided=tuple(term for term, one in zip(TERMS, free, strict=True) if one),
        covariance=whole.covariance,
        distance_m=float(distance_m),
        depth_std_before_m=depth_std_m(read_m, prior),
        depth_std_m=depth_std_m(read_m, whole.covariance),
        figures=figures_of(problem, correction),
        sureness=sureness_of(problem, whole),
        missing=_missing(free),
    )


def _missing(free: tuple[bool, ...]) -> Mapping[str, str]:
    wanted = {"scale": "height", "offset_m": "distance", "radial_2": "wider"}
    return {term: wanted[term] for term, one in zip(TERMS, free, strict=True) if not one and term in wanted}
