"""The tracker on a reduced line: every fruit once, whatever the belt and the sensors do."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fruitgui.errors import InputError
from fruitgui.perception.view import Observation
from fruitgui.simulation.motion import SpeedProfile, stop_and_start
from fruitgui.tracking.belt import BeltMotion
from fruitgui.tracking.mode import paper_mode
from fruitgui.tracking.settings import TrackerSettings
from fruitgui.tracking.track import Track
from fruitgui.tracking.tracker import Tracker
from tests.unit.tracking.line import Line, Piece, Table, chain, opposed, pieces


def piece_of(track: Track) -> int:
    """Return the number of the piece that most of the track's sightings show."""
    return Counter(int(sighting.view.features[0]) for sighting in track.sightings).most_common(1)[0][0]


def follow(line: Line, tracker: Tracker | None = None) -> list[Track]:
    tracker = tracker or Tracker(line.rig)
    finished = [track for observation in line.observations() for track in tracker.update(observation)]
    return finished + tracker.finish()


def counted(line: Line) -> list[int]:
    return sorted(piece_of(track) for track in follow(line))


def crossing(count: int, speed_m_s: float, seed: int = 0, table: Table | None = None, **changes: object) -> Line:
    """Return a line that runs until its last fruit has left."""
    laid = pieces(count, seed)
    length_m = 1.3 - min(piece.start_m[0] for piece in laid)
    line = Line(table or opposed(), laid, lambda t: speed_m_s * t, duration_s=length_m / speed_m_s, seed=seed)
    for name, value in changes.items():
        setattr(line, name, value)
    return line


@pytest.mark.parametrize("speed_m_s", [0.2, 0.8])
def test_counts_every_fruit_once_at_any_speed(speed_m_s: float) -> None:
    assert counted(crossing(15, speed_m_s)) == list(range(15))


@settings(max_examples=3, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    seed=st.integers(0, 10_000),
    speed_m_s=st.floats(0.1, 0.7),
    noise_m=st.floats(0.001, 0.005),
    rate_hz=st.sampled_from([5.0, 7.0, 12.0]),
)
def test_counts_every_fruit_once_on_any_line(seed: int, speed_m_s: float, noise_m: float, rate_hz: float) -> None:
    line = crossing(9, speed_m_s, seed, noise_m=noise_m, lasting_m=noise_m, rate_hz=rate_hz)
    assert counted(line) == list(range(9))


@pytest.mark.parametrize("sensor", ["s1", "s2"])
def test_a_silent_sensor_loses_nothing_that_the_other_saw(sensor: str) -> None:
    line = crossing(18, 0.4, seed=2, silent={sensor: (3.0, 6.0)})
    assert counted(line) == list(range(18))


def _in_one_row(count: int, seed: int) -> list[Piece]:
    """Return fruit of one look, one behind the other: whoever mistakes one for the next is told nothing by its look."""
    rng = np.random.default_rng(seed)
    starts = np.cumsum(rng.uniform(0.2, 0.45, count))
    color = np.array([225.0, 200.0, 60.0])
    return [
        Piece(i, np.array([-0.6 - start, rng.uniform(-0.1, 0.1), 0.033]), 0.033, color)
        for i, start in enumerate(starts.tolist())
    ]


@pytest.mark.parametrize("seed", [100, 101, 102])
def test_what_passed_while_no_sensor_gave_anything_is_not_taken_for_what_was_there_before(seed: int) -> None:
    blind = (7.0, 11.0)
    line = Line(opposed(), _in_one_row(16, seed), lambda t: 0.4 * t, duration_s=22.0, seed=seed)
    line.silent = dict.fromkeys(line.rig.mounts, blind)
    observations = line.observations()
    whole = Counter(int(view.features[0]) for one in observations for view in one.views if view.whole)
    tracks = follow(line)
    pure = [{int(sighting.view.features[0]) for sighting in track.sightings} for track in tracks]
    assert all(len(shown) == 1 for shown in pure)
    assert sorted(piece_of(track) for track in tracks) == sorted(piece for piece, views in whole.items() if views >= 3)
    assert 0 < len(whole) < 16, "none passed unseen"


def test_a_belt_that_stood_while_no_sensor_gave_anything_is_found_where_it_was_left() -> None:
    line = Line(opposed(), pieces(15, 4), stop_and_start(0.3, 4.0, 3.0, 0.3).travel_m, duration_s=15.0, seed=4)
    line.silent = dict.fromkeys(line.rig.mounts, (4.1, 6.9))
    assert counted(line) == list(range(15))


@pytest.mark.parametrize(
    "travel_m",
    [
        stop_and_start(0.3, 4.0, 3.0, 0.3).travel_m,
        stop_and_start(0.4, 3.0, 2.0, 0.01).travel_m,
        SpeedProfile((0.0, 3.0, 3.5, 6.0, 6.5), (0.15, 0.15, 0.5, 0.5, 0.25)).travel_m,
    ],
    ids=["stops", "stops at once", "changes speed"],
)
def test_follows_a_belt_that_changes(travel_m: Callable[[float], float]) -> None:
    line = Line(opposed(), pieces(15, 4), travel_m, duration_s=15.0, seed=4)
    assert counted(line) == list(range(15))


def test_fruit_that_stand_with_the_belt_stay_the_same_tracks_and_keep_few_sightings() -> None:
    profile = stop_and_start(0.3, 4.5, 20.0, 0.3)
    line = Line(opposed(), pieces(6, 1), profile.travel_m, duration_s=34.0, seed=1)
    tracks = follow(line)
    assert sorted(piece_of(track) for track in tracks) == list(range(6))
    assert max(len(track.sightings) for track in tracks) <= 100
    assert max(track.path[-1].time_s - track.path[0].time_s for track in tracks) > 18.0


def test_clutter_and_missing_views_make_no_fruit_and_lose_none() -> None:
    assert counted(crossing(18, 0.2, seed=3, dropout=0.2, clutter=0.3)) == list(range(18))


@pytest.mark.parametrize("merging", [{"s1": 0.3, "s2": 0.3}, {"s1": 0.9, "s2": 0.1}], ids=["both", "one sensor"])
def test_groups_that_are_not_always_separated_count_by_the_majority(merging: dict[str, float]) -> None:
    line = crossing(30, 0.2, seed=1, merging=merging)
    line.pieces = pieces(30, 1, touching=0.35)
    assert len(follow(line)) == 30


def test_evenly_spaced_fruit_of_one_look_on_a_fast_belt() -> None:
    laid = pieces(18, 5, even=True)
    for piece in laid:
        piece.color, piece.radius_m = laid[0].color, 0.035
    line = Line(opposed(), laid, lambda t: 0.4 * t, duration_s=8.0)
    assert counted(line) == list(range(18))


def test_a_chain_of_sensors_sees_one_fruit_once() -> None:
    assert counted(crossing(12, 0.3, table=chain(), duration_s=10.0)) == list(range(12))


def test_a_rocking_and_a_sliding_fruit_stay_one_track_each() -> None:
    line = crossing(9, 0.15)
    line.pieces[3].slip = lambda t: np.array([0.0, 0.006 * np.sin(7.0 * t), 0.0])
    line.pieces[5].slip = lambda t: np.array([-0.012 * t, 0.004 * t, 0.0])
    assert counted(line) == list(range(9))


def test_a_part_of_the_machine_is_no_fruit() -> None:
    line = crossing(9, 0.2)
    for piece in line.pieces:
        piece.start_m[0] += 0.5
    still = Piece(99, np.array([0.1, 0.3, 0.02]), 0.03, np.array([90.0, 90.0, 90.0]))
    still.slip = lambda t: np.array([-line.travelled(t), 0.0, 0.0])
    line.pieces.append(still)
    assert counted(line) == list(range(9))


def test_fruit_in_view_at_the_end_count_if_seen_whole_three_times() -> None:
    line = crossing(3, 0.1)
    line.pieces = [
        Piece(0, np.array([-0.1, 0.0, 0.035]), 0.035, np.array([200.0, 50.0, 40.0])),
        Piece(1, np.array([-0.86, 0.0, 0.035]), 0.035, np.array([60.0, 150.0, 40.0])),
    ]
    line.duration_s = 3.0
    tracks = follow(line)
    whole = {i: sum(v.whole and v.features[0] == i for o in line.observations() for v in o.views) for i in (0, 1)}
    assert whole[0] >= 3 > whole[1]
    assert [piece_of(track) for track in tracks] == [0]


def test_two_captures_of_one_time_and_a_late_one_are_used() -> None:
    line = crossing(9, 0.3)
    observations = line.observations()
    observations[20:22] = [
        Observation(one.sensor, one.sequence, observations[20].time_s, one.views) if i else one
        for i, one in enumerate(observations[20:22])
    ]
    observations[31], observations[30] = observations[30], observations[31]
    tracker = Tracker(line.rig)
    tracks = [track for observation in observations for track in tracker.update(observation)] + tracker.finish()
    assert sorted(piece_of(track) for track in tracks) == list(range(9))


def test_each_view_of_the_last_observation_is_told_with_its_track() -> None:
    line = crossing(6, 0.3)
    tracker = Tracker(line.rig)
    pieces_seen: dict[int, set[int]] = {}
    for observation in line.observations():
        tracker.update(observation)
        shown = tracker.shown
        assert {id(view) for view, _ in shown} <= {id(view) for view in observation.views}
        assert len({track for _, track in shown}) == len(shown)
        for view, track in shown:
            pieces_seen.setdefault(track, set()).add(int(view.features[0]))
    assert all(len(seen - {-1}) <= 1 for seen in pieces_seen.values())
    assert set().union(*pieces_seen.values()) >= set(range(6))


def test_a_fruit_in_view_can_be_taken_as_if_it_had_left() -> None:
    line = crossing(6, 0.3)
    tracker = Tracker(line.rig)
    for observation in line.observations():
        tracker.update(observation)
        for live in tracker.live:
            track = tracker.so_far(live.track)
            assert track is not None
            assert len(track.path) == len(track.sightings) >= 1
            assert len(track.sightings) <= live.views
    assert tracker.so_far(10**6) is None


def test_numbers_belong_to_the_instance_and_live_shows_what_is_in_view() -> None:
    line = crossing(6, 0.3)
    first, second = Tracker(line.rig), Tracker(line.rig)
    for observation in line.observations()[:40]:
        first.update(observation)
        second.update(observation)
    assert [one.track for one in first.live] == [one.track for one in second.live]
    assert len({one.track for one in first.live}) == len(first.live) > 0
    assert all(np.linalg.eigvalsh(one.covariance_m2).min() > 0 for one in first.live)


def test_a_fruit_that_rolls_over_a_standing_belt_stays_one_track() -> None:
    line = Line(opposed(), [], lambda _t: 0.0, duration_s=4.0)
    line.pieces = [
        Piece(i, np.array([0.3 * i - 0.3, 0.1 * i - 0.1, 0.035]), 0.035, np.array(color))
        for i, color in enumerate([(200.0, 50.0, 40.0), (60.0, 150.0, 40.0), (220.0, 200.0, 60.0)])
    ]
    line.pieces[1].slip = lambda t: np.array([0.0, 0.25 * min(max(t - 1.5, 0.0), 0.8), 0.0])
    assert counted(line) == [0, 1, 2]


def test_an_unknown_sensor_is_told() -> None:
    with pytest.raises(InputError, match="no sensor s9"):
        Tracker(opposed().rig).update(Observation("s9", 0, 0.0, ()))


def test_nothing_seen_is_no_fruit() -> None:
    tracker = Tracker(opposed().rig)
    assert tracker.update(Observation("s1", 0, 0.0, ())) == []
    assert tracker.finish() == []
    assert tracker.belt is None


def test_paper_mode_counts_well_spaced_fruit() -> None:
    line = crossing(6, 0.2)
    line.pieces = [
        Piece(i, np.array([-0.9 - 0.35 * i, 0.0, 0.035]), 0.035, np.array([200.0, 50.0, 40.0])) for i in range(6)
    ]
    line.duration_s = 20.0
    velocity = line.table.world.turn(np.array([0.2, 0.0, 0.0]))
    options = TrackerSettings()
    tracks = follow(line, Tracker(line.rig, BeltMotion(velocity), options, paper_mode(options)))
    assert sorted(piece_of(track) for track in tracks) == list(range(6))
