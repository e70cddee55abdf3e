"""Parts of one body are one record; fruit that touch never are."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from fruitgui.tracking.bodies import built_like_fruit, one_body
from fruitgui.tracking.resolve import Majority
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.trail import Entry, Trail
from tests.unit.tracking.line import Line, Piece, opposed

LINE = Line(opposed(), [Piece(0, np.array([0.0, 0.0, 0.03]), 0.03, np.zeros(3))], lambda _t: 0.0, duration_s=2.0)
RIG = LINE.rig
VIEW = LINE.observations()[0].views[0]
SKIN, GREEN = (0.42, 0.31), (0.31, 0.46)


def trail(
    number: int, along_m: float, size_m: float, height_m: float, clear: int = 40, color: tuple[float, float] = SKIN
) -> Trail:
    """Return a finished trail whose surface is a disk of its size."""
    looks = np.array([height_m, np.log(size_m), *color, 5.5])
    one = Trail(number, 0.0, looks, size_m, views=clear, whole=clear, clear=clear, expected=clear)
    one.position_m = np.array([along_m, 0.0, 1.0])
    angle, share = np.meshgrid(np.linspace(0.0, 6.28, 24), [0.2, 0.5, 0.8, 1.0])
    ring = 0.5 * size_m * share
    disk = np.stack([ring * np.cos(angle), ring * np.sin(angle), 0.0 * ring], axis=2).reshape(-1, 3)
    one.surface_m = disk + one.position_m
    return one


def frames(first: Trail, second: Trail, apart: tuple[int, int], telling: int = 20) -> None:
    """Let each of two sensors show the trails as two views in so many of its telling frames."""
    for sensor, both in zip(("s1", "s2"), apart, strict=True):
        for n in range(telling):
            first.company_of(second.number).note(sensor, n < both, n >= both, merged=False)


def test_a_finger_that_flickers_beside_a_flat_hand_is_part_of_it() -> None:
    palm, finger = trail(1, 0.0, 0.11, 0.038), trail(2, 0.075, 0.03, 0.028, clear=15)
    frames(palm, finger, (6, 2))
    assert one_body(palm, finger, RIG)


def test_two_halves_that_no_frame_shows_together_are_one_flat_body() -> None:
    left, right = trail(1, 0.0, 0.08, 0.036), trail(2, 0.078, 0.07, 0.034)
    frames(left, right, (0, 0))
    assert one_body(left, right, RIG)


def test_tips_of_a_curled_leaf_are_one_leaf_even_if_always_seen_as_two() -> None:
    tips = trail(1, 0.0, 0.03, 0.015, color=GREEN), trail(2, 0.085, 0.031, 0.017, color=GREEN)
    frames(*tips, (20, 20))
    assert one_body(*tips, RIG)
    speck = trail(4, 0.07, 0.02, 0.0125, color=GREEN)
    assert one_body(tips[0], speck, RIG)
    away = trail(3, 0.16, 0.03, 0.015, color=GREEN)
    assert not one_body(tips[0], away, RIG)


def test_cherries_side_by_side_are_as_many_as_they_are() -> None:
    cherries = trail(1, 0.0, 0.024, 0.021), trail(2, 0.03, 0.025, 0.02)
    frames(*cherries, (20, 20))
    assert not one_body(*cherries, RIG)


@pytest.mark.parametrize("seed", range(5))
def test_fruit_are_never_parts_whatever_the_frames_say(seed: int) -> None:
    rng = np.random.default_rng(seed)
    for _ in range(40):
        sizes = rng.uniform(0.036, 0.12, 2)
        heights = np.maximum(rng.uniform(0.7, 1.0, 2) * sizes, 0.033)
        fruit = [
            trail(n + 1, n * 0.45 * sizes.sum(), size, height)
            for n, (size, height) in enumerate(zip(sizes, heights, strict=True))
        ]
        frames(fruit[0], fruit[1], (int(rng.integers(0, 20)), int(rng.integers(0, 20))))
        assert all(built_like_fruit(one) for one in fruit)
        assert not one_body(fruit[0], fruit[1], RIG)


def test_a_small_fruit_behind_a_big_one_or_beside_a_hand_stays_a_fruit() -> None:
    small = trail(1, 0.07, 0.045, 0.04, clear=12)
    for other in (trail(2, 0.0, 0.1, 0.085), trail(2, 0.0, 0.12, 0.037)):
        frames(small, other, (9, 0))
        assert not one_body(small, other, RIG)
        assert not Majority(TrackerSettings()).is_part(small, [other], RIG)


def test_a_hand_and_its_arm_are_one_body_though_most_frames_cut_the_wrist() -> None:
    hand, arm = trail(1, 0.0, 0.12, 0.032), trail(2, 0.105, 0.085, 0.03)
    frames(hand, arm, (14, 6))
    assert one_body(hand, arm, RIG)
    higher = trail(3, 0.105, 0.085, 0.042)
    frames(hand, higher, (14, 6))
    assert not one_body(hand, higher, RIG)


def test_a_piece_as_big_as_a_fruit_that_few_frames_tear_off_a_hand_is_part_of_it() -> None:
    hand, piece = trail(1, 0.0, 0.12, 0.035), trail(2, 0.075, 0.04, 0.034, clear=14)
    frames(hand, piece, (6, 3))
    piece.shared = 13
    assert not one_body(hand, piece, RIG)
    piece.expected = 50
    assert built_like_fruit(piece)
    assert one_body(hand, piece, RIG)
    assert one_body(piece, hand, RIG)


def test_a_fruit_that_few_frames_part_from_a_heap_of_fruit_is_no_piece_of_it() -> None:
    for height_m, count in ((0.065, 3), (0.05, 4), (0.045, 2)):
        heap = trail(1, 0.0, height_m / 0.9 * count**0.5, 0.95 * height_m)
        fruit = trail(2, 0.05, height_m / 0.9, height_m, clear=14)
        fruit.shared, fruit.expected = 14, 50
        frames(heap, fruit, (5, 2))
        assert not one_body(heap, fruit, RIG)


def test_flat_things_that_one_sensor_always_parts_are_two() -> None:
    cards = trail(1, 0.0, 0.08, 0.03), trail(2, 0.085, 0.08, 0.03)
    frames(*cards, (19, 0))
    assert not one_body(*cards, RIG)


def test_two_bananas_that_no_frame_had_near_each_other_are_two_though_the_belt_is_thought_to_run_askew() -> None:
    """Their surfaces, carried back along a wrong way, seem to touch; hand and arm are larger and may be one."""
    first, second = trail(1, 0.0, 0.074, 0.037), trail(2, 0.077, 0.083, 0.042)
    first.last_s, second.first_s, second.last_s = 4.0, 0.1, 4.2
    assert not one_body(first, second, RIG)
    frames(first, second, (0, 0))
    assert one_body(first, second, RIG)
    hand, arm = trail(3, 0.0, 0.11, 0.038), trail(4, 0.125, 0.14, 0.04)
    hand.last_s = arm.last_s = 4.0
    assert one_body(hand, arm, RIG)


def test_parts_must_touch_and_be_of_one_color() -> None:
    palm = trail(1, 0.0, 0.11, 0.038)
    apart, leaf = trail(2, 0.11, 0.03, 0.028), trail(3, 0.07, 0.03, 0.028, color=(0.2, 0.6))
    assert not one_body(palm, apart, RIG)
    assert not one_body(palm, leaf, RIG)


def test_of_the_parts_of_a_hand_exactly_one_counts_in_whatever_order_they_are_settled() -> None:
    resolver = Majority(TrackerSettings())
    for order in permutations(range(3)):
        parts = [trail(1, 0.0, 0.08, 0.036, 12), trail(2, 0.07, 0.082, 0.038, 14), trail(3, 0.035, 0.032, 0.028, 30)]
        for part in parts:
            view = replace(VIEW, points_m=part.surface_m.astype(np.float32))
            part.entries = [Entry(0.0, view, part.position_m, np.eye(3), np.zeros(3), cut=False)] * 2
        kept: list[Trail] = []
        left = [parts[i] for i in order]
        while left:
            one = left.pop(0)
            if not resolver.is_part(one, [*left, *kept], RIG):
                kept.append(one)
                one.entries = []
        assert len(kept) == 1
