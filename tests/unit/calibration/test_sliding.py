"""Views of boxes on a table, from an independent renderer: what holds them, and what does not."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from fruitgui.calibration.arbitrary import Scan, held_to_m, scan, search, settled
from fruitgui.calibration.still import Still, average
from fruitgui.calibration.study import real_pose
from fruitgui.frame import Frame, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector
from tests.second_rig.arm import ArmPlan, arm, shots

BOXES = ArmPlan(views=3, fruit=0, boxes=6, turn_deg=90.0, above_deg=(40.0, 60.0), distance_m=(0.8, 1.1))
BARE = ArmPlan(views=3, fruit=0, boxes=0, turn_deg=90.0, above_deg=(50.0, 60.0), distance_m=(0.6, 0.7))
GRAIN_M = 0.025


@cache
def seen(plan: ArmPlan) -> tuple[list[Still], list[Pose]]:
    scene, stands = arm(5, plan)
    lens = plan.lens
    camera = Intrinsics(lens.width, lens.height, lens.fx, lens.fy, lens.cx, lens.cy)
    frames = [
        Frame("arm", n, float(n), shot.colour, shot.depth_mm, camera) for n, shot in enumerate(shots(scene, stands))
    ]
    return [average([frame]) for frame in frames], [Pose(stand.rotation, stand.centre_m) for stand in stands]


@cache
def scans(plan: ArmPlan) -> list[Scan]:
    return [scan(still, GRAIN_M) for still in seen(plan)[0]]


def off(pose: Pose, turn_rad: float, shift_m: float) -> Pose:
    """Return a pose that is off by a turn about a point a metre before the sensor, and a shift."""
    turn = rotation_from_vector(turn_rad * np.array([0.6, -0.5, 0.62]))
    middle = np.array([0.0, 0.0, 1.0])
    return Pose(turn @ pose.rotation, turn @ (pose.translation_m - middle) + middle + shift_m * np.array([0.6, 0.8, 0]))


def wrong_by(found: Pose, right: Pose) -> tuple[float, float]:
    return found.distance_to(right, np.array([[0.0, 0.0, 1.0]]))


def test_patches_of_the_table_share_its_normal_and_keep_their_distance() -> None:
    view, pose = scans(BOXES)[0].patches, seen(BOXES)[1][0]
    height = pose.apply(view.points_m)[:, 2]
    table = np.abs(height) < 0.004
    leaning = np.degrees(np.arccos(np.clip(pose.turn(view.normals[table])[:, 2], -1, 1)))
    assert table.sum() > 1000
    assert np.median(leaning) < 0.2
    assert height[table].std() > 0.0002


def test_views_slide_to_where_they_belong() -> None:
    first, second, _ = scans(BOXES)
    right = real_pose(*seen(BOXES)[1][:2])
    found = settled(first, second, off(right, np.radians(0.4), 0.005), right)
    assert found.doubt == ""
    assert found.pose is not None
    moved, turned = wrong_by(found.pose, right)
    assert moved < 0.0015
    assert np.degrees(turned) < 0.1
    assert moved < 4 * held_to_m(found.pose)


def test_a_pair_is_found_from_nothing_and_either_way_round() -> None:
    first, second, _ = scans(BOXES)
    right = real_pose(*seen(BOXES)[1][:2])
    there, back = search(first, second), search(second, first)
    for pose in (there.pose, back.pose.inverse() if back.pose is not None else None):
        assert pose is not None
        assert wrong_by(pose, right)[0] < 0.002


def test_a_wrong_place_is_contradicted_by_what_is_seen_through() -> None:
    first, second, _ = scans(BOXES)
    right = real_pose(*seen(BOXES)[1][:2])
    aside = seen(BOXES)[1][1].inverse() @ Pose(np.eye(3), np.array([0.12, 0.07, 0.0])) @ seen(BOXES)[1][1]
    found = settled(first, second, aside @ right, right)
    assert found.doubt
    assert max(found.through) > 0.02


def test_a_bare_table_holds_nothing_and_says_so() -> None:
    first, second, _ = scans(BARE)
    right = real_pose(*seen(BARE)[1][:2])
    found = settled(first, second, right, right)
    assert found.doubt.startswith(("too little structure", "too little overlap"))
    assert found.pose is None or held_to_m(found.pose) == pytest.approx(np.inf) or held_to_m(found.pose) > 0.005
