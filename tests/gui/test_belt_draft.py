from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from fruitgui.gui.steps.belt.draft import added, draft_of, moved, removed, saved_in, undone, with_measured
from fruitgui.gui.steps.belt.measuring import views_text
from fruitgui.gui.steps.belt.projection import Through, above, grid_lines, plan_points
from fruitgui.simulation.device import KINECT_COLOR
from fruitgui.simulation.scenes import bare_belt
from fruitgui.station.belt_setting import PlanMotion, motion_of, region_of, with_region
from fruitgui.station.station import Station, StationSensor

CORNERS = np.array([[-0.5, -0.25], [0.5, -0.25], [0.5, 0.25], [-0.5, 0.25]])


@pytest.fixture(scope="module")
def station() -> Station:
    mounts = bare_belt(7, "opposed").rig().mounts
    made = Station("kinect_1", {name: StationSensor("", one.pose, one.surface) for name, one in mounts.items()})
    return with_region(made, CORNERS)


def test_a_corner_is_moved_and_that_can_be_undone(station: Station) -> None:
    draft = draft_of(station)
    corner = int(np.argmax(draft.corners_m.sum(axis=1)))
    changed = moved(draft, corner, np.array([0.6, 0.3]))
    assert changed.corners_m[corner] == pytest.approx([0.6, 0.3])
    assert undone(changed).corners_m == pytest.approx(draft.corners_m)
    assert undone(draft) is draft


def test_what_would_be_no_region_is_not_taken(station: Station) -> None:
    draft = draft_of(station)
    beyond_the_far_side = (draft.corners_m[1] + draft.corners_m[2]) * 0.7
    assert moved(draft, 0, beyond_the_far_side) is draft
    three = removed(draft, 0)
    assert len(three.corners_m) == 3
    assert removed(three, 0) is three


def test_corners_come_between_two(station: Station) -> None:
    draft = draft_of(station)
    more = added(draft, 3)
    assert len(more.corners_m) == 5
    assert more.corners_m[4] == pytest.approx((draft.corners_m[3] + draft.corners_m[0]) / 2)


@pytest.mark.parametrize("heading_deg", [3.0, -20.0, 170.0, -175.0])
def test_a_measured_motion_is_told_as_a_way_and_a_small_turn(station: Station, heading_deg: float) -> None:
    draft = with_measured(draft_of(station), PlanMotion(0.2, math.radians(heading_deg)))
    assert abs(math.degrees(draft.turned_rad)) <= 90.0
    assert draft.backwards == (abs(heading_deg) > 90)
    kept = motion_of(saved_in(draft, station))
    assert kept is not None
    assert math.cos(kept.heading_rad - math.radians(heading_deg)) == pytest.approx(1.0)
    again = draft_of(saved_in(draft, station))
    assert (again.fixed, again.backwards) == (True, draft.backwards)
    assert again.speed_m_s == pytest.approx(0.2)


def test_a_motion_that_is_not_fixed_is_left_to_the_runs(station: Station) -> None:
    assert saved_in(draft_of(station), station).velocity_m_s is None


def test_heights_that_contradict_each_other_are_a_problem(station: Station) -> None:
    assert replace(draft_of(station), shortest_m=0.1, tallest_m=0.05).problem == "heights"
    assert draft_of(station).problem == ""


def test_from_above_the_heading_lies_to_the_right_and_all_is_in_sight() -> None:
    view = above(CORNERS, math.radians(30.0), 800, 500)
    pixels = view.seen(CORNERS)
    assert (pixels >= 0).all()
    assert (pixels <= [800, 500]).all()
    ahead = view.seen(np.array([[math.cos(math.radians(30.0)), math.sin(math.radians(30.0))], [0.0, 0.0]]))
    assert ahead[0, 0] > ahead[1, 0]
    assert ahead[0, 1] == pytest.approx(ahead[1, 1])
    assert view.plan(pixels) == pytest.approx(CORNERS)


def test_every_view_leads_back_to_the_plan(station: Station) -> None:
    view = Through(station, "kinect_2", KINECT_COLOR)
    assert view.plan(view.seen(CORNERS)) == pytest.approx(CORNERS, abs=1e-6)
    assert plan_points(above(CORNERS, 0.0, 800, 500), 80, 50).shape == (50, 80, 2)


def test_the_grid_runs_along_the_heading() -> None:
    for line in grid_lines(CORNERS, math.radians(20.0)):
        way = line[-1] - line[0]
        angle = math.degrees(math.atan2(way[1], way[0])) % 90.0
        assert angle == pytest.approx(20.0, abs=1e-6)


def test_what_the_core_says_while_it_measures_is_known_here() -> None:
    assert views_text("12 views of passing fruit") == "12 views of passing fruit"
    assert views_text("something else") == "something else"


def test_the_region_on_the_screen_is_the_one_that_is_saved(station: Station) -> None:
    draft = moved(draft_of(station), 0, draft_of(station).corners_m[0] * 1.1)
    assert sorted(map(tuple, np.round(region_of(saved_in(draft, station)), 4))) == sorted(
        map(tuple, np.round(draft.corners_m, 4))
    )
