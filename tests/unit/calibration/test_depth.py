"""Correcting one device's depth: what is found, what is decided, and what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.calibration.depth.measured import (
    BallOnBelt,
    BareBelt,
    Measurements,
    RaisedBoard,
)
from fruitgui.calibration.depth.seeing import see_ball, see_belt
from fruitgui.calibration.planes import plane_of
from fruitgui.sensors.depth_correction import DepthCorrection
from tests.unit.calibration.depth_stills import BIASED, bare_belt, distance_m, errors_m, fitted, refused, still_of

HEIGHT_M, BALL_M = 0.20, 0.15


def _board(typed_m: float = HEIGHT_M, really_m: float = HEIGHT_M) -> RaisedBoard:
    return RaisedBoard(still_of(2, board_m=really_m), typed_m)


def _ball(typed_m: float = BALL_M) -> BallOnBelt:
    return BallOnBelt(still_of(3, ball_m=BALL_M), typed_m)


def test_belt_box_ball_and_tape_decide_scale_offset_and_bend() -> None:
    made = fitted(Measurements(bare_belt(distance_m()), (_board(),), (_ball(),)))
    assert made.decided == ("scale", "offset_m", "radial_2")
    assert made.missing == {}
    assert made.depth_std_m < 0.2 * made.depth_std_before_m
    far_m = distance_m()
    assert np.abs(errors_m(DepthCorrection(), far_m)).max() > 0.008
    for z_m in (far_m, far_m - HEIGHT_M):
        assert np.abs(errors_m(made.correction, z_m)).max() < 3.0 * made.depth_std_m + 0.001
    assert made.distance_m == pytest.approx(far_m, abs=3.0 * made.depth_std_m)
    told = {one.what: one for one in made.figures}
    assert abs(told["ball"].after_m - BALL_M) < 0.001
    assert abs(told["height"].after_m - HEIGHT_M) < 0.001 < abs(told["height"].before_m - HEIGHT_M)
    assert abs(told["distance"].after_m - far_m) < 0.004
    assert told["flatness"].after_m < 0.7 * told["flatness"].before_m


def test_without_a_tape_the_offset_is_left_alone_and_said_to_be_missing() -> None:
    made = fitted(Measurements(bare_belt(), (_board(),)))
    assert made.decided == ("scale", "radial_2")
    assert made.correction.offset_m == 0.0
    assert made.missing == {"offset_m": "distance"}
    assert made.std("offset_m") > 0.010, "what is known of such devices stays"
    assert abs(made.correction.scale * (1 + BIASED.scale_error) - 1) < 3.0 * made.std("scale")


def test_a_better_typed_height_makes_the_scale_surer() -> None:
    rough = fitted(Measurements(bare_belt(distance_m()), (replace(_board(), height_std_m=0.002),)))
    fine = fitted(Measurements(bare_belt(distance_m()), (replace(_board(), height_std_m=0.0005),)))
    assert fine.std("scale") < 0.5 * rough.std("scale")


def test_a_ball_is_read_by_its_cap_not_by_its_fattened_edge() -> None:
    belt = see_belt(still_of(1))
    assert belt is not None
    ball = see_ball(still_of(3, ball_m=BALL_M), plane_of(belt.coefficients), BALL_M / 2)
    assert ball is not None
    height, width = ball.on.shape
    v, u = np.nonzero(ball.on)
    camera = still_of(1).intrinsics
    radius_px = camera.fx * (BALL_M / 2) / ball.centre_m[2]
    assert np.pi * (0.6 * radius_px) ** 2 < ball.on.sum() < np.pi * (0.9 * radius_px) ** 2
    assert abs(u.mean() - width / 2) < 0.2 * width
    assert abs(v.mean() - height / 2) < 0.2 * height


def test_one_height_is_too_few() -> None:
    assert refused(Measurements(bare_belt(distance_m()))).code == "too_few_heights"


def test_an_empty_belt_has_neither_board_nor_ball() -> None:
    bare = RaisedBoard(still_of(7), HEIGHT_M)
    assert refused(Measurements(bare_belt(), (bare,))).code in ("board_not_seen", "height_differs"), (
        "rails are no board"
    )
    assert refused(Measurements(bare_belt(), balls=(BallOnBelt(still_of(7), BALL_M),))).code == "ball_not_seen"


def test_a_ball_of_another_size_is_not_taken_for_the_one_that_was_typed() -> None:
    assert refused(Measurements(bare_belt(), balls=(_ball(0.07),))).code == "ball_not_seen"


def test_a_slip_of_the_pen_is_noticed() -> None:
    assert refused(Measurements(bare_belt(), (_board(0.30),))).code == "height_differs"
    # Within what could be the device's own error, the ball contradicts.
    assert refused(Measurements(bare_belt(distance_m()), (_board(0.184),), (_ball(),))).code == "typed_disagrees"
    # With nothing to contradict it, what no working device does is not believed.
    assert refused(Measurements(bare_belt(), (_board(0.177),))).code == "implausible"


def test_a_scene_that_moves_and_a_sensor_that_was_bumped_are_refused() -> None:
    board = _board()
    moving = np.zeros(board.still.moved.shape, dtype=bool)
    moving[100:200, 100:200] = True
    shown = RaisedBoard(replace(board.still, moved=moving), HEIGHT_M)
    assert refused(Measurements(bare_belt(), (shown,))).code == "scene_moved"
    still = _ball().still
    inverse = np.where(still.seen, 1.0 / (1.0 / np.maximum(still.inverse_depth, 1e-6) + 0.006), 0.0).astype(np.float32)
    assert refused(
        Measurements(bare_belt(), balls=(BallOnBelt(replace(still, inverse_depth=inverse), BALL_M),))
    ).code == ("sensor_moved")


def test_a_bowed_board_is_refused() -> None:
    board = _board()
    still = board.still
    x, y = np.moveaxis(still.intrinsics.rays(), -1, 0)
    belt = see_belt(still_of(1))
    assert belt is not None
    lid = plane_of(belt.coefficients).height_m(still.points()) > HEIGHT_M / 2
    depth_m = 1.0 / np.maximum(still.inverse_depth, 1e-6) - np.where(lid, 0.06 * (x**2 + y**2), 0.0)
    inverse = np.where(still.seen, 1.0 / depth_m, 0.0).astype(np.float32)
    warped = RaisedBoard(replace(still, inverse_depth=inverse), HEIGHT_M)
    assert refused(Measurements(bare_belt(distance_m()), (warped,))).code == "not_flat"


def test_a_wall_of_fog_is_no_belt() -> None:
    still = still_of(1)
    rng = np.random.default_rng(0)
    fog = rng.uniform(0.3, 1.5, still.inverse_depth.shape).astype(np.float32)
    assert refused(Measurements(BareBelt(replace(still, inverse_depth=fog)), (_board(),))).code == "belt_not_seen"
    nothing = np.zeros_like(still.inverse_depth)
    assert refused(Measurements(BareBelt(replace(still, inverse_depth=nothing)))).code == "belt_not_seen"
