"""Groups above the belt: holes are bridged, belt between fruit is not, noise and slivers are nothing."""

from __future__ import annotations

import numpy as np

from fruitgui.frame import U16
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.perception import Perceiver, PerceptionSettings
from fruitgui.perception.limits import depth_limits
from fruitgui.perception.segment import Segmenter
from tests.unit.perception.spheres import KINECT, Ball, Table, row_of_balls, views

FLAT = Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))


def segmenter() -> Segmenter:
    return Segmenter(depth_limits(KINECT, FLAT, PerceptionSettings()), PerceptionSettings())


def belt() -> U16:
    return np.full((480, 640), 1000, np.uint16)


def block(depth: U16, row: int, column: int, size: int, top_mm: int = 40) -> None:
    depth[row : row + size, column : column + size] = 1000 - top_mm


def test_a_gap_of_belt_keeps_neighbours_apart_and_a_gap_without_readings_does_not() -> None:
    apart, bridged = belt(), belt()
    for depth, between in ((apart, 1000), (bridged, 0)):
        block(depth, 200, 200, 40)
        block(depth, 200, 242, 40)
        depth[200:240, 240:242] = between
    assert len(segmenter().groups(apart).contours) == 2
    assert len(segmenter().groups(bridged).contours) == 1


def test_holes_inside_a_fruit_belong_to_it() -> None:
    depth = belt()
    block(depth, 200, 200, 50)
    depth[215:235, 215:235] = 0
    groups = segmenter().groups(depth)
    assert len(groups.contours) == 1
    assert (groups.labels[205:245, 205:245] == 1).all()


def test_speckle_and_threads_are_no_groups() -> None:
    depth = belt()
    depth[::37, ::41] = 960
    depth[100:102, :] = 960
    assert segmenter().groups(depth).contours == ()


def test_the_smallest_fruit_is_found_and_a_third_of_it_is_not() -> None:
    settings = PerceptionSettings()
    size = round(settings.smallest_m * 525)
    depth = belt()
    block(depth, 100, 100, size, 25)
    block(depth, 300, 300, size // 3, 25)
    assert len(segmenter().groups(depth).contours) == 1


def test_a_rail_beside_the_region_is_no_fruit_even_where_noise_carries_it_over_the_edge() -> None:
    """A wall 50 mm high stands on the region's edge; the fruit beside it is seen, the wall is not."""
    table = row_of_balls((0.035,), 0.0, tilt_rad=0.3)
    plane = table.plane()
    centre = plane.frame().apply(table.centres_m()[0])[:2]
    corners = np.array([[-0.6, -0.3], [0.6, -0.3], [0.6, 0.06], [-0.6, 0.06]]) + centre
    region = plane.frame().inverse().apply(np.hstack([corners, np.zeros((4, 1))]))
    wall = tuple(Ball(x, centre[1] + 0.06 + 0.025, 0.025) for x in np.arange(-0.4, 0.4, 0.02))
    both = Table((*table.balls, *wall), tilt_rad=0.3, region_m=region)
    found = views(both)
    assert len(found) == 1
    assert np.linalg.norm(found[0].centre_m - both.centres_m()[0]) < 0.004


def test_long_things_are_not_fruit() -> None:
    depth = belt()
    depth[200:230, 40:600] = 950
    frame = Table((), tilt_rad=0.0).frame()
    perceiver = Perceiver("ball", KINECT, FLAT)
    rail = type(frame)("ball", 0, 0.0, frame.color, depth, KINECT)
    assert perceiver.observe(rail, 0.0).views == ()
