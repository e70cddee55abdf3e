"""Belt, boards and balls looked for in all pictures of a device; what is not there is said."""

from __future__ import annotations

import numpy as np

from fruitgui.calibration import planes
from fruitgui.calibration.depth import reasons
from fruitgui.calibration.depth.estimate import Problem
from fruitgui.calibration.depth.measured import (
    LEAST_RAISED_M,
    BallOnBelt,
    DepthReason,
    DepthRefusal,
    Measurements,
    RaisedBoard,
    RaisedSensor,
    SeenBall,
    SeenFlat,
)
from fruitgui.calibration.depth.seeing import (
    CLOSE_SHARE,
    read_raised_m,
    read_rise_m,
    see_ball,
    see_belt,
    see_board,
    see_from_higher,
)
from fruitgui.calibration.still import Still
from fruitgui.geometry.plane import Plane

STOOD_M = 0.004
"""So far a belt may be from where it was: beyond, the sensor was bumped between two measurements."""

MOST_MOVED = 0.005
"""Share of the picture that may change while frames are taken: edges flicker."""


def found(measured: Measurements) -> Problem | DepthRefusal:
    """Return everything that was measured as it was read, or why something is not there."""
    moved = [reason for still in _stills(measured) if (reason := _moved(still)) is not None][:1]
    belt = see_belt(measured.belt.still)
    if belt is None:
        return DepthRefusal((*moved, reasons.NO_BELT))
    plane = planes.plane_of(belt.coefficients)
    boards = [_board(told, belt, plane) for told in measured.boards]
    balls = [_ball(told, belt, plane) for told in measured.balls]
    raised = [_higher(told, belt) for told in measured.raised]
    wrong = [one for one in (*boards, *balls, *raised) if isinstance(one, DepthReason)]
    if moved or wrong:
        return DepthRefusal((*moved, *wrong))
    return Problem(
        belt,
        [(seen, told) for seen, told in zip(boards, measured.boards, strict=True) if isinstance(seen, SeenFlat)],
        [(seen, told) for seen, told in zip(balls, measured.balls, strict=True) if isinstance(seen, SeenBall)],
        measured.belt.distance_m,
        measured.belt.distance_std_m,
        [(seen, told) for seen, told in zip(raised, measured.raised, strict=True) if isinstance(seen, SeenFlat)],
    )


def _stills(measured: Measurements) -> list[Still]:
    boards, balls, raised = measured.boards, measured.balls, measured.raised
    return [
        measured.belt.still,
        *(one.still for one in boards),
        *(one.still for one in balls),
        *(one.still for one in raised),
    ]


def _board(told: RaisedBoard, belt: SeenFlat, plane: Plane) -> SeenFlat | DepthReason:
    board = see_board(told.still, plane, told.height_m)
    if board is None:
        return reasons.no_board(told.height_m)
    stood = _stood(told.still, belt)
    if stood is not None:
        return stood
    read_m = read_rise_m(board, plane)
    close = _close(read_m, told.height_m, told.height_std_m)
    return board if close else reasons.height_differs(read_m, told.height_m)


def _ball(told: BallOnBelt, belt: SeenFlat, plane: Plane) -> SeenBall | DepthReason:
    stood = _stood(told.still, belt)
    if stood is not None:
        return stood
    ball = see_ball(told.still, plane, told.diameter_m / 2)
    return reasons.no_ball(told.diameter_m) if ball is None else ball


def _higher(told: RaisedSensor, belt: SeenFlat) -> SeenFlat | DepthReason:
    if told.raised_m < LEAST_RAISED_M:
        return reasons.raised_too_little(told.raised_m)
    higher = see_from_higher(told.still, belt, told.raised_m)
    if higher is None:
        return reasons.NO_BELT_FROM_HIGHER
    read_m = read_raised_m(higher.coefficients, belt.coefficients)
    close = _close(read_m, told.raised_m, told.raised_std_m)
    return higher if close else reasons.raised_differs(read_m, told.raised_m)


def _close(read_m: float, typed_m: float, std_m: float) -> bool:
    return abs(read_m - typed_m) - 3.0 * std_m < CLOSE_SHARE * typed_m


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
