"""What neighbours found leads to others, and what does not close is doubted; links are made by hand."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from fruitgui.calibration.arbitrary import Link
from fruitgui.calibration.guesses import differ, rigid
from fruitgui.calibration.network import Pair, starts, trusted, without_contradicted, without_strays
from fruitgui.calibration.study import real_pose
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector


def poses(count: int, seed: int = 1) -> list[Pose]:
    rng = np.random.default_rng(seed)
    return [Pose(rotation_from_vector(rng.normal(size=3)), rng.uniform(-1, 1, 3)) for _ in range(count)]


def link(pose: Pose, std_m: float = 1e-3, doubt: str = "", score: float = 0.5) -> Link:
    held = Pose(pose.rotation, pose.translation_m, std_m**2 * np.eye(6))
    return Link(held, held, (score, score), (0.0, 0.0), doubt)


def network(count: int) -> tuple[list[Pose], dict[Pair, Link]]:
    fixed = poses(count)
    return fixed, {(a, b): link(real_pose(fixed[a], fixed[b])) for a, b in combinations(range(count), 2)}


def test_a_rigid_motion_is_found_from_its_points() -> None:
    pose = poses(1)[0]
    points = np.random.default_rng(2).normal(size=(9, 3))
    found = rigid(points, pose.apply(points))
    assert found.rotation == pytest.approx(pose.rotation)
    assert found.translation_m == pytest.approx(pose.translation_m)


def test_right_links_are_all_kept() -> None:
    _, links = network(5)
    assert without_contradicted(links) == links


def test_a_wrong_link_is_doubted_and_it_alone() -> None:
    fixed, links = network(5)
    turned = rotation_from_vector(np.array([0.0, 0.0, np.pi]))
    right = real_pose(fixed[1], fixed[3])
    links[1, 3] = link(Pose(turned @ right.rotation, right.translation_m))
    found = without_contradicted(links)
    assert [pair for pair, one in found.items() if one.doubt] == [(1, 3)]
    assert "close" in found[1, 3].doubt


def test_in_a_lone_loop_that_fails_the_worst_link_goes() -> None:
    fixed, links = network(3)
    links[0, 1] = link(Pose(np.eye(3), np.ones(3)), score=0.3)
    found = without_contradicted(links)
    assert [pair for pair, one in found.items() if one.doubt] == [(0, 1)]
    assert not differ(trusted(found)[2, 0], real_pose(fixed[2], fixed[0]))


def test_neighbours_lead_to_a_pair_that_found_nothing_along_the_firmest_path() -> None:
    fixed, links = network(4)
    links[0, 3] = replace(links[0, 3], pose=None, start=None, doubt="too little overlap")
    crooked = Pose(np.eye(3), np.array([0.01, 0.0, 0.0])) @ real_pose(fixed[0], fixed[1])
    links[0, 1] = link(crooked, std_m=0.05)
    found = starts(links, 4)
    assert found.keys() == links.keys()
    right = real_pose(fixed[0], fixed[3])
    assert found[0, 3].translation_m == pytest.approx(right.translation_m, abs=1e-9)


def test_views_without_a_trusted_link_get_no_start() -> None:
    _, links = network(4)
    lonely = {pair: replace(one, doubt="contradicted") if 3 in pair else one for pair, one in links.items()}
    assert {pair for pair in starts(lonely, 4) if 3 in pair} == set()


def test_a_pair_that_rests_beside_its_place_is_a_stray_and_noise_alone_makes_none() -> None:
    fixed = poses(6)
    rng = np.random.default_rng(7)
    links = {}
    for a, b in combinations(range(6), 2):
        right = real_pose(fixed[a], fixed[b])
        links[a, b] = link(Pose(right.rotation, right.translation_m + rng.normal(scale=0.001, size=3)))
    assert not any(one.doubt for one in without_strays(links).values())
    beside = links[2, 4].pose
    assert beside is not None
    links[2, 4] = link(Pose(beside.rotation, beside.translation_m + np.array([0.0, 0.015, 0.0])))
    assert not any(one.doubt for one in without_contradicted(links).values())
    assert [pair for pair, one in without_strays(links).items() if one.doubt] == [(2, 4)]
