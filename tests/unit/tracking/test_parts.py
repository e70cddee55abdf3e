"""The parts of tracking, each by itself."""

from __future__ import annotations

import numpy as np
import pytest

from fruitgui.simulation.motion import constant
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.clocks import estimate_clock_offsets
from fruitgui.tracking.consider import ConsiderFilter
from fruitgui.tracking.estimate import estimate_belt
from fruitgui.tracking.field import FieldOfView
from fruitgui.tracking.matching import ClosestPair, OptimalAssignment, Pairs
from fruitgui.tracking.measured import measured
from fruitgui.tracking.paper import PaperFilter, preset_errors
from fruitgui.tracking.presets import paper_preset
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.trail import Entry, thinned
from fruitgui.tracking.voting import common_shift
from tests.unit.tracking.line import Line, Piece, opposed, pieces

POSE = np.diag([0.0015**2] * 3 + [0.002**2] * 3)


@pytest.mark.parametrize("speed_m_s", [0.03, 0.1, 0.4, 0.9])
def test_belt_velocity_is_found_with_no_prior(speed_m_s: float) -> None:
    line = Line(opposed(), pieces(24, 2, first_m=-0.7), constant(speed_m_s).travel_m, duration_s=6.0)
    motion = estimate_belt(line.observations(), line.rig)
    assert motion is not None
    error = motion.velocity_m_s - line.table.world.turn(np.array([speed_m_s, 0.0, 0.0]))
    assert np.linalg.norm(error) < max(0.01, 0.04 * speed_m_s)


def test_no_fruit_decide_no_velocity() -> None:
    line = Line(opposed(), [], constant(0.1).travel_m, duration_s=2.0)
    assert estimate_belt(line.observations(), line.rig) is None


@pytest.mark.parametrize("offset_s", [0.0, 0.35, -1.6])
def test_clock_offset_is_found_from_the_pattern_of_the_fruit(offset_s: float) -> None:
    line = Line(opposed(), pieces(21, 3), constant(0.4).travel_m, duration_s=6.0, clock={"s2": offset_s})
    observations = line.observations()
    belt = estimate_belt([one for one in observations if one.sensor == "s1"], line.rig)
    assert belt is not None
    estimate = estimate_clock_offsets(observations, line.rig, belt)["s2"]
    assert estimate.decided
    assert abs(estimate.offset_s + offset_s) < 3.0 * estimate.std_s < 0.06


def test_even_fruit_of_one_look_decide_no_clock() -> None:
    laid = pieces(30, 3, lanes=1, even=True)
    for piece in laid:
        piece.color, piece.radius_m, piece.start_m[2] = laid[0].color, 0.035, 0.035
    line = Line(opposed(), laid, constant(0.4).travel_m, duration_s=6.0, clock={"s2": 0.5})
    observations = line.observations()
    belt = BeltMotion(line.table.world.turn(np.array([0.4, 0.0, 0.0])))
    assert not estimate_clock_offsets(observations, line.rig, belt)["s2"].decided


def test_considered_poses_keep_the_filter_honest() -> None:
    """NEES over poses drawn from their covariance: mean 3 for three dimensions, never far above it."""
    nees = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        error = rng.multivariate_normal(np.zeros(6), POSE)
        table = opposed(POSE)
        piece = Piece(0, np.array([0.0, 0.0, 0.035]), 0.035, np.array([200.0, 50.0, 40.0]))
        line = Line(table, [piece], lambda _t: 0.0, duration_s=4.0, pose_error={"s2": error}, seed=seed)
        field, options = FieldOfView.of(line.rig), TrackerSettings(slip_speed_m_s=1e-4)
        tracker, now_s = ConsiderFilter(line.rig, options), 0.0
        for observation in (one for one in line.observations() if one.sensor == "s2" or seed % 2):
            seen, one = measured(observation, line.rig, field), np.zeros(1, dtype=np.intp)
            tracker.predict(observation.time_s - now_s, np.zeros(3))
            now_s = observation.time_s
            tracker.update(one, one, seen) if len(tracker) else tracker.add(one, seen)
        missed = tracker.position_m[0] - line.position_m(piece, now_s)
        nees.append(missed @ np.linalg.solve(tracker.position_covariance_m2[0], missed))
    # The mean of 40 draws of χ²(3) has a standard deviation of sqrt(6 / 40) = 0.39.
    assert 3.0 - 4.0 * 0.39 < np.mean(nees) < 3.0 + 4.0 * 0.39


def test_a_hundred_captures_never_look_surer_than_the_pose() -> None:
    line = Line(
        opposed(POSE), [Piece(0, np.array([0.0, 0.0, 0.03]), 0.03, np.zeros(3))], lambda _t: 0.0, duration_s=20.0
    )
    tracker, field = ConsiderFilter(line.rig, TrackerSettings(slip_speed_m_s=1e-4)), FieldOfView.of(line.rig)
    one = np.zeros(1, dtype=np.intp)
    for observation in (o for o in line.observations() if o.sensor == "s2"):
        seen = measured(observation, line.rig, field)
        tracker.update(one, one, seen) if len(tracker) else tracker.add(one, seen)
    assert np.linalg.eigvalsh(tracker.position_covariance_m2[0]).min() > POSE[5, 5]


def test_paper_filter_follows_the_equations_of_the_source() -> None:
    line = Line(opposed(), pieces(3, 1, first_m=0.0), lambda _t: 0.0, duration_s=0.5)
    field, rig, preset = FieldOfView.of(line.rig), line.rig, paper_preset()
    first, second = (measured(o, rig, field) for o in line.observations()[:2])
    tracker, one = PaperFilter(rig, preset_errors(rig, preset), preset.process_m2), np.zeros(1, dtype=np.intp)
    tracker.add(one, first)
    tracker.predict(0.1, np.array([0.01, 0.0, 0.0]))
    X, P = tracker.position_m[0], tracker.position_covariance_m2[0]
    pose = rig.mounts["s2"].pose.inverse()
    R, T = pose.rotation, pose.translation_m
    X_r = np.kron(np.eye(3), X[None])
    S = R @ P @ R.T + X_r @ np.diag(preset.rotation) @ X_r.T + np.diag(preset.translation_m2)
    S = S + R @ second.covariance_m2[0] @ R.T
    K = P @ R.T @ np.linalg.inv(S)
    Y = pose.apply(second.position_m[0])
    tracker.update(one, one, second)
    np.testing.assert_allclose(tracker.position_m[0], X + K @ (Y - (R @ X + T)), atol=1e-9)
    np.testing.assert_allclose(tracker.position_covariance_m2[0], (np.eye(3) - K @ R) @ P, atol=1e-9)


def test_optimal_assignment_beats_the_closest_pair_where_greed_fails() -> None:
    pairs = Pairs(
        np.array([0, 0, 1]), np.array([0, 1, 0]), np.array([2.0, 6.0, 1.0]), np.zeros(3), np.array([0.2, 0.4, 0.1])
    )
    assert ClosestPair(16.3).match(pairs).tolist() == [False, True, True]
    assert OptimalAssignment(16.3).match(pairs).tolist() == [False, True, True]
    close = Pairs(
        np.array([0, 0, 1]), np.array([0, 1, 0]), np.array([1.0, 20.0, 2.0]), np.zeros(3), np.array([0.1, 0.9, 0.1])
    )
    assert OptimalAssignment(16.3).match(close).tolist() == [True, False, False]


def test_voting_finds_the_shift_of_the_most_in_spite_of_strangers() -> None:
    rng = np.random.default_rng(0)
    tracks = rng.uniform(-0.4, 0.4, (12, 2))
    shift = np.array([0.06, 0.0])
    views = np.vstack([tracks[:8] + shift + rng.normal(scale=0.002, size=(8, 2)), rng.uniform(-0.4, 0.4, (5, 2))])
    residual = views[None] - tracks[:, None]
    everything = np.ones((12, 13))
    found = common_shift(residual, 0.005 * everything, everything, everything > 0)
    assert found is not None
    np.testing.assert_allclose(found.shift_m, [0.06, 0.0], atol=0.003)


def test_thinning_keeps_the_way_even_and_every_sensor() -> None:
    line = Line(opposed(), [Piece(0, np.array([-0.5, 0.0, 0.03]), 0.03, np.zeros(3))], constant(0.1).travel_m)
    entries = [
        Entry(o.time_s, view, view.centre_m, np.eye(3), np.array([0.1 * o.time_s, 0.0, 0.0]), cut=False)
        for o in line.observations()
        for view in o.views
    ]
    kept = thinned(entries, 20)
    assert len(kept) == 20
    assert {entry.view.sensor for entry in kept} == {"s1", "s2"}
    assert (np.diff([entry.time_s for entry in kept]) > 0).all()
    gaps = np.diff([entry.time_s for entry in kept if entry.view.sensor == "s1"])
    assert gaps.max() < 3.0 * np.median(gaps)


def test_preset_is_the_source_s() -> None:
    preset = paper_preset()
    assert len(preset.rotation) == 9
    assert preset.rotation[0] == 0.0493
    assert preset.translation_m2 == (0.0878, 0.0862, 0.0501)
    assert preset.process_m2 == 0.001


def test_field_is_the_picture_s_frustum() -> None:
    line = opposed()
    field = FieldOfView.of(line.rig).sensors["s1"]
    turned = line.rig.mounts["s1"].pose.apply(np.array([[0.0, 0.0, 1.0], [0.6, 0.0, 1.0], [0.3, 0.0, 1.0]]))
    depth = field.depth_m(turned)
    half = 319.5 / 580.0
    assert depth[1] == pytest.approx((half - 0.6) / np.hypot(1.0, half), abs=2e-3)
    assert depth[0] > depth[2] > 0 > depth[1]
