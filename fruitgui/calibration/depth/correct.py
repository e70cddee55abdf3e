"""From measurements to a correction, or to reasons why they do not do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.depth.estimate import BOW_STD_M, PRIOR_STD, Problem, Solution, solve
from fruitgui.calibration.depth.figures import figures_of
from fruitgui.calibration.depth.measured import (
    TERMS,
    BallOnBelt,
    DepthFit,
    DepthReason,
    DepthRefusal,
    Measurements,
    RaisedBoard,
    SeenBall,
    SeenFlat,
)
from fruitgui.calibration.depth.seeing import read_rise_m, see_ball, see_belt, see_board
from fruitgui.calibration.still import Still
from fruitgui.frame import F64
from fruitgui.geometry.plane import Plane

DECIDED = 0.5
"""A term is decided where the measurements leave less than this share of what is usual of such devices: they then say
three times as much as the prior does."""

CLEARLY = 3.0
"""The fourth power of r bends where nothing was seen: it is fitted only where it shows in so many deviations."""

FLAT_M = 3.0 * BOW_STD_M
DISAGREES = 4.0
HEIGHT_SHARE = 0.2
"""A board that is read so far off what was typed is another board, or a slip of the pen; no device errs so much."""

STOOD_M = 0.004
"""So far a belt may be from where it was: beyond, the sensor was bumped between two measurements."""

MOST_MOVED = 0.005
"""Share of the picture that may change while frames are taken: edges flicker."""

IMPLAUSIBLE = 3.5


def correct_depth(measured: Measurements) -> DepthFit | DepthRefusal:
    """Return the correction that all measurements of a device ask for, or why there is none."""
    seen = _seen(measured)
    if isinstance(seen, DepthRefusal):
        return seen
    whole = solve(seen)
    free = _decided(whole)
    solution = solve(replace(seen, free=free)) if any(free) else whole
    reasons = [*_disagreements(solution), *_shape(solution), *_undecided(measured, free), *_implausible(solution)]
    if reasons:
        return DepthRefusal(tuple(reasons))
    return _fit(seen, whole, solution, free)


def _seen(measured: Measurements) -> Problem | DepthRefusal:
    stills = [measured.belt.still, *(one.still for one in measured.boards), *(one.still for one in measured.balls)]
    reasons = [reason for still in stills if (reason := _moved(still)) is not None][:1]
    belt = see_belt(measured.belt.still)
    if belt is None:
        return DepthRefusal((*reasons, NO_BELT))
    plane = planes.plane_of(belt.coefficients)
    boards: list[tuple[SeenFlat, RaisedBoard]] = []
    for told in measured.boards:
        board, why = _board(told, belt, plane)
        reasons += [] if why is None else [why]
        boards += [] if board is None else [(board, told)]
    balls: list[tuple[SeenBall, BallOnBelt]] = []
    for told_ball in measured.balls:
        ball = see_ball(told_ball.still, plane, told_ball.diameter_m / 2)
        stood = _stood(told_ball.still, belt)
        if ball is None or stood is not None:
            reasons.append(stood or no_ball(told_ball.diameter_m))
        else:
            balls.append((ball, told_ball))
    if reasons:
        return DepthRefusal(tuple(reasons))
    return Problem(belt, boards, balls, measured.belt.distance_m, measured.belt.distance_std_m)


def _board(told: RaisedBoard, belt: SeenFlat, plane: Plane) -> tuple[SeenFlat | None, DepthReason | None]:
    board = see_board(told.still, plane, told.height_m) if told.height_m > 0 else see_belt(told.still)
    if board is None:
        return None, no_board(told.height_m)
    stood = _stood(told.still, belt) if told.height_m > 0 else None
    if stood is not None:
        return None, stood
    read_m = read_rise_m(board, plane)
    off_m = abs(read_m - told.height_m) - 3.0 * told.height_std_m
    return (board, None) if off_m < HEIGHT_SHARE * abs(told.height_m) else (None, _differs(read_m, told.height_m))


def _moved(still: Still) -> DepthReason | None:
    if still.moved.mean() < MOST_MOVED:
        return None
    return DepthReason("scene_moved", "Something moved while pictures were taken.", "Stop the belt, keep hands away.")


def _stood(still: Still, belt: SeenFlat) -> DepthReason | None:
    """Return a reason if the belt is no longer where it was; where a board hides most of it, nobody can tell."""
    off = still.inverse_depth - planes.rays_of(still) @ belt.coefficients
    near = still.seen & belt.on & (np.abs(off) < 4.0 * planes.ON_PLANE)
    if near.sum() < 0.05 * belt.on.sum():
        return None
    lift_m = float(np.median(off[near]) / np.median(still.inverse_depth[near]) ** 2)
    if abs(lift_m) < STOOD_M:
        return None
    return DepthReason(
        "sensor_moved",
        f"The belt is {abs(lift_m) * 1e3:.0f} mm from where it was at first: the sensor or the belt was bumped.",
        "Begin again with the bare belt.",
    )


def _decided(whole: Solution) -> tuple[bool, ...]:
    std = np.sqrt(np.diag(whole.covariance))
    told = std < DECIDED * np.array(PRIOR_STD)
    clear = np.abs(whole.terms[3]) > CLEARLY * std[3]
    return (bool(told[0]), bool(told[1]), bool(told[2]), bool(told[3] and clear))


def _disagreements(solution: Solution) -> list[DepthReason]:
    worst = max(solution.typed, key=lambda one: abs(one[2]), default=("", 0, 0.0))
    if abs(worst[2]) < DISAGREES:
        return []
    what = {"distance": "The typed distance", "height": "A typed height", "ball": "The typed diameter"}[worst[0]]
    return [
        DepthReason(
            "typed_disagrees",
            f"{what} does not go with the other measurements ({abs(worst[2]):.0f} standard deviations).",
            "Measure once more what was typed; see that the ball lies on the belt itself and the board is not tilted.",
        )
    ]


def _shape(solution: Solution) -> list[DepthReason]:
    if max(solution.bows_m) < FLAT_M:
        return []
    return [
        DepthReason(
            "not_flat",
            f"Belt or board is bowed by {max(solution.bows_m) * 1e3:.0f} mm.",
            "Use a stiff board, or a place where the belt lies on its table.",
        )
    ]


def _undecided(measured: Measurements, free: tuple[bool, ...]) -> list[DepthReason]:
    if not measured.boards and not measured.balls:
        return [
            DepthReason(
                "too_few_heights",
                "There is only one height: scale and offset cannot be told apart.",
                "Put a box of known height under a flat board, or a ball of known diameter on the belt.",
            )
        ]
    if free[0] or free[1]:
        return []
    return [
        DepthReason(
            "nothing_decided",
            "The heights are too small to say more of this sensor than is known of its make.",
            "Use a higher box (15 cm or more), and measure the distance to the belt.",
        )
    ]


def _implausible(solution: Solution) -> list[DepthReason]:
    off = np.abs(solution.terms - np.array([1.0, 0.0, 0.0, 0.0])) / np.array(PRIOR_STD)
    if off.max() < IMPLAUSIBLE:
        return []
    return [
        DepthReason(
            "implausible",
            f"This sensor's depth would be off by {abs(solution.terms[0] - 1) * 100:.0f} % and "
            f"{abs(solution.terms[1]) * 1e3:.0f} mm; no working sensor errs so much.",
            "Check what was typed, and its unit: millimetres.",
        )
    ]


def _fit(problem: Problem, whole: Solution, solution: Solution, free: tuple[bool, ...]) -> DepthFit:
    correction = solution.correction
    read_m = 1.0 / problem.belt.coefficients[2]
    distance_m = correction.scale * read_m + correction.offset_m
    ahead = np.array([read_m, 1.0, 0.0, 0.0])
    prior = np.diag(np.square(PRIOR_STD))
    return DepthFit(
        correction=correction,
        decided=tuple(term for term, one in zip(TERMS, free, strict=True) if one),
        covariance=whole.covariance,
        distance_m=float(distance_m),
        depth_std_before_m=_std_m(ahead, prior),
        depth_std_m=_std_m(ahead, whole.covariance),
        figures=figures_of(problem, correction),
        missing=_missing(free),
    )


def _std_m(ahead: F64, covariance: F64) -> float:
    return float(np.sqrt(ahead @ covariance @ ahead))


def _missing(free: tuple[bool, ...]) -> Mapping[str, str]:
    wanted = {"scale": "height", "offset_m": "distance", "radial_2": "wider"}
    return {term: wanted[term] for term, one in zip(TERMS, free, strict=True) if not one and term in wanted}


NO_BELT = DepthReason("belt_not_seen", "No belt is in view.", "Let the sensor look at the bare belt from 0.5 to 2 m.")


def no_board(height_m: float) -> DepthReason:
    """Return the reason where a board is not found."""
    return DepthReason(
        "board_not_seen",
        f"No flat board {abs(height_m) * 1e3:.0f} mm above the belt is in view.",
        "Lay a flat, dull board or carton of at least 15 × 15 cm level amid the picture.",
    )


def no_ball(diameter_m: float) -> DepthReason:
    """Return the reason where a ball is not found."""
    return DepthReason(
        "ball_not_seen",
        f"No ball of {diameter_m * 1e3:.0f} mm lies on the belt.",
        "Put one dull ball on the bare belt amid the picture, and type its diameter.",
    )


def _differs(read_m: float, typed_m: float) -> DepthReason:
    return DepthReason(
        "height_differs",
        f"The board is typed {typed_m * 1e3:.0f} mm high, but the sensor sees about {read_m * 1e3:.0f} mm.",
        "Type the height of the board's upper side over the belt, in millimetres.",
    )
