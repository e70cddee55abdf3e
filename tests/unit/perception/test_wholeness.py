"""A fruit is whole unless the picture, the sensor's margin, the region or another fruit cuts it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fruitgui.frame import Frame
from tests.unit.perception.spheres import Ball, Table, nearest, perceiver, row_of_balls, views


def test_a_ball_in_the_open_is_whole() -> None:
    assert [view.whole for view in views(row_of_balls((0.035,), 0.0))] == [True]


def test_a_ball_cut_by_the_pictures_edge_is_not() -> None:
    table = row_of_balls((0.035,), 0.0, tilt_rad=0.0)
    ball = table.balls[0]
    edge = Table((Ball(ball.x_m + 0.61, ball.y_m, 0.035),), tilt_rad=0.0)
    assert [view.whole for view in views(edge)] == [False]


def test_a_ball_cut_by_an_empty_margin_is_not() -> None:
    """Registered depth ends before the colour picture does."""
    table = row_of_balls((0.035,), 0.0, tilt_rad=0.0)
    shifted = Table((Ball(table.balls[0].x_m + 0.51, table.balls[0].y_m, 0.035),), tilt_rad=0.0)
    frame = shifted.frame()
    assert [view.whole for view in perceiver(shifted).observe(frame, 0.0).views] == [True]
    depth = frame.depth_mm.copy()
    depth[:, :45] = 0
    assert [view.whole for view in perceiver(shifted).observe(replace(frame, depth_mm=depth), 0.0).views] == [False]


def test_a_ball_that_sticks_out_of_the_region_is_not() -> None:
    table = row_of_balls((0.035,), 0.0, tilt_rad=0.2)
    ball, to_belt = table.balls[0], table.plane().frame()

    def region(reach_m: float) -> np.ndarray:
        square = np.array([[-0.5, -0.5], [reach_m, -0.5], [reach_m, 0.5], [-0.5, 0.5]])
        square += [ball.x_m, ball.y_m]
        return to_belt.inverse().apply(np.hstack([square, np.zeros((4, 1))]))

    assert [view.whole for view in views(replace(table, region_m=region(0.06)))] == [True]
    assert [view.whole for view in views(replace(table, region_m=region(0.015)))] == [False]


def test_a_ball_partly_behind_another_is_not_and_the_front_one_is() -> None:
    front = row_of_balls((0.04,), 0.0, tilt_rad=0.8).balls[0]
    away = 1.0 if _farther(front, 1.0) else -1.0
    behind = Ball(front.x_m, front.y_m + away * 2.05 * np.sqrt(0.04 * 0.035), 0.035)
    table = Table((front, behind), tilt_rad=0.8)
    whole = {nearest(table, view): view.whole for view in views(table)}
    assert whole == {0: True, 1: False}


def _farther(front: Ball, step: float) -> bool:
    table = Table((front, Ball(front.x_m, front.y_m + step * 0.1, 0.03)), tilt_rad=0.8)
    near, far = np.linalg.norm(table.centres_m(), axis=1)
    return bool(far > near)


def test_an_outline_is_free_but_where_something_else_begins() -> None:
    lone = views(row_of_balls((0.035,), 0.0))[0]
    assert len(lone.outline_free) == len(lone.outline_px)
    assert lone.outline_free.all()
    table = row_of_balls((0.035, 0.035), 0.0, tilt_rad=0.3)
    left, right = sorted(views(table), key=lambda view: view.centre_m[0])
    assert left.shared
    for view, towards in ((left, 1.0), (right, -1.0)):
        beside = towards * (view.outline_px[:, 0] - view.outline_px[:, 0].mean())
        far = np.ptp(beside) / 2
        assert view.outline_free[beside < 0.6 * far].all()
        # Where the cut meets the belt a place may look past the other ball.
        assert view.outline_free[beside > 0.95 * far].mean() < 0.1


def test_where_the_picture_ends_an_outline_is_not_free() -> None:
    ball = row_of_balls((0.035,), 0.0, tilt_rad=0.0).balls[0]
    edge = views(Table((Ball(ball.x_m + 0.61, ball.y_m, 0.035),), tilt_rad=0.0))[0]
    at_end = (edge.outline_px[:, 0] < 1) | (edge.outline_px[:, 0] > 638)
    inside = (edge.outline_px[:, 0] > 5) & (edge.outline_px[:, 0] < 634)
    assert at_end.any()
    assert not edge.outline_free[at_end].any()
    assert edge.outline_free[inside].all()


def test_shapes_that_other_sensors_have_work_too() -> None:
    from fruitgui.frame import Intrinsics

    for camera in (
        Intrinsics(320, 240, 262.5, 262.5, 159.5, 119.5),
        Intrinsics(848, 480, 610.0, 610.0, 423.5, 239.5),
        Intrinsics(1280, 720, 910.0, 910.0, 639.5, 359.5),
        Intrinsics(641, 479, 525.0, 525.0, 320.0, 239.0),
    ):
        table = row_of_balls((0.035, 0.03, 0.04), 0.03, intrinsics=camera, tilt_rad=0.5)
        found = views(table)
        assert sorted(nearest(table, view) for view in found) == [0, 1, 2]
        assert all(view.whole for view in found)
        for view in found:
            assert np.linalg.norm(view.centre_m - table.centres_m()[nearest(table, view)]) < 0.006


def test_what_is_no_frame_of_this_camera_is_refused_in_words() -> None:
    import pytest

    from fruitgui.errors import InputError

    table = row_of_balls((0.035,), 0.0)
    small = Frame("ball", 0, 0.0, np.zeros((240, 320, 3), np.uint8), np.zeros((240, 320), np.uint16), table.intrinsics)
    with pytest.raises(InputError, match="320×240"):
        perceiver(table).observe(small, 0.0)


def test_empty_and_blind_frames_hold_nothing() -> None:
    table = Table(())
    assert views(table) == ()
    blind = replace(table.frame(), depth_mm=np.zeros((480, 640), np.uint16))
    assert perceiver(table).observe(blind, 0.0).views == ()
