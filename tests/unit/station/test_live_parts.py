"""The parts of the live line that own no thread."""

from __future__ import annotations

import gc
import multiprocessing
import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Mount, Rig
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.simulation.device import KINECT_COLOR
from fruitgui.simulation.show import Show
from fruitgui.simulation.supply import LineOptions
from fruitgui.station.live.above import FromAbove, pictured_spreads, spreads_of
from fruitgui.station.live.bump import BumpWatch, looks_moved
from fruitgui.station.live.crops import LONGEST_PX, MOST_SENSORS, MOST_TRACKS, Album, coded
from fruitgui.station.live.intake import ClockWatch
from fruitgui.station.live.parcels import receive, send
from fruitgui.station.live.warnings import MOST, Warnings
from tests.unit.perception.spheres import Ball, Table

SURFACE = Surface(Plane(np.array([0.0, 0.0, -1.0]), 1.0))
MOUNT = Mount("left", Pose.exact(), SURFACE, KINECT_COLOR)


def test_a_clock_set_anew_is_followed_on() -> None:
    watch = ClockWatch(2.0)
    assert watch.leap_s("left", 100.0, 10.0) == 0.0
    assert watch.leap_s("left", 100.2, 10.3) == 0.0
    assert watch.leap_s("left", 5.0, 10.4) == pytest.approx(95.3)
    assert watch.leap_s("left", 5.2 + 95.3, 10.6) == 0.0
    assert watch.leap_s("left", 5000.0, 11.6) == pytest.approx(101.5 - 5000.0)


def test_frames_that_come_late_do_not_make_a_new_clock() -> None:
    watch = ClockWatch(2.0)
    assert watch.leap_s("left", 100.0, 10.0) == 0.0
    assert watch.leap_s("left", 100.2, 19.0) == 0.0
    assert watch.leap_s("left", 109.0, 19.1) == 0.0
    assert watch.leap_s("left", 113.0, 19.2) == pytest.approx(109.1 - 113.0)
    assert watch.leap_s("right", 0.0, 19.0) == 0.0
    assert watch.leap_s("right", 30.0, 49.0) == 0.0
    assert ClockWatch(float("inf")).leap_s("left", -1e9, 1.0) == 0.0


def test_x_runs_along_the_belts_motion_seen_from_above() -> None:
    rig = Rig("left", {"left": MOUNT})
    above = FromAbove(rig)
    for heading in (0.3, 2.0, -2.9):
        velocity = 0.2 * np.array([np.cos(heading), np.sin(heading), 0.0])
        above.head_along(velocity)
        places = above.places_m(np.stack([np.array([0.1, 0.2, 0.9]), np.array([0.1, 0.2, 0.9]) + velocity]))
        assert places[1] - places[0] == pytest.approx([0.2, 0.0], abs=1e-9)
        assert above.footprints_m["left"].shape[1] == 2


def test_a_standing_belt_turns_nothing() -> None:
    above = FromAbove(Rig("left", {"left": MOUNT}))
    before = above.pose
    above.head_along(np.zeros(3))
    above.head_along(None)
    assert above.pose is before


@given(st.floats(-1.5, 1.5), st.floats(0.001, 0.05), st.floats(0.1, 1.0))
def test_an_ellipse_holds_what_its_covariance_says(angle: float, major: float, ratio: float) -> None:
    R = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    covariance = R @ np.diag([major**2, (ratio * major) ** 2]) @ R.T
    other, spread = spreads_of(np.array([[0.0, 0.0], [1.0, 2.0]]), np.array([np.eye(2), covariance]))
    assert other.major == other.minor == pytest.approx(np.sqrt(5.991))
    assert spread.major == pytest.approx(major * np.sqrt(5.991), rel=1e-6)
    assert spread.minor == pytest.approx(ratio * major * np.sqrt(5.991), rel=1e-6)
    if ratio < 0.95:
        assert np.cos(2 * (spread.angle_rad - angle)) == pytest.approx(1.0, abs=1e-6)


def test_a_spread_in_a_picture_is_that_of_many_projected_places() -> None:
    turned = Pose(rotation_from_vector(np.array([0.1, 0.4, -0.2])), np.array([0.2, -0.1, 0.1]))
    mount = Mount("left", turned, SURFACE, KINECT_COLOR)
    position = turned.apply(np.array([0.1, -0.05, 1.1]))
    covariance = np.diag([4e-6, 1e-6, 9e-6])
    behind, spread = pictured_spreads(
        KINECT_COLOR, mount.pose.inverse(), np.array([turned.apply(np.array([0.0, 0.0, -1.0])), position]),
        np.array([covariance, covariance]),
    )  # fmt: skip
    assert behind is None
    assert spread is not None
    rng = np.random.default_rng(1)
    places = rng.multivariate_normal(position, covariance, 20_000)
    pixels = KINECT_COLOR.project(turned.inverse().apply(places))
    (many,) = spreads_of(pixels.mean(axis=0)[None], np.cov(pixels.T)[None])
    assert (spread.x, spread.y) == pytest.approx((many.x, many.y), abs=0.1)
    assert (spread.major, spread.minor) == pytest.approx((many.major, many.minor), rel=0.05)


def test_the_better_view_of_each_sensor_is_kept_and_cut_within_bounds() -> None:
    from dataclasses import replace

    from fruitgui.perception.perceiver import Perceiver

    table = Table((Ball(0.0, 0.0, 0.035, (200, 60, 40)),), tilt_rad=0.0, intrinsics=KINECT_COLOR, seed=1)
    frame = table.frame()
    view = Perceiver(frame.sensor, KINECT_COLOR, table.surface()).observe(frame, 0.0).views[0]
    album = Album()
    album.look(1, replace(view, whole=False), frame)
    album.look(1, view, frame)
    album.look(1, replace(view, area_px=view.area_px + 1), replace(frame, time_s=9.0))
    for number in range(2 * MOST_SENSORS):
        album.look(2, replace(view, sensor=f"s{number}"), frame)
    (best,) = album.take(1)
    assert best.worth == 4.0 * view.area_px
    assert best.time_s == frame.time_s
    assert max(best.color.shape[:2]) <= LONGEST_PX
    assert album.take(1) == ()
    assert len(album.take(2)) == MOST_SENSORS
    colour, depth, outline = coded((best,))
    assert (colour.content, depth.content, outline.content) == ("colour", "depth", "outline")
    assert colour.data.startswith(b"\xff\xd8")
    assert outline.data.startswith(b"\x89PNG")
    for track in range(3 * MOST_TRACKS):
        album.look(track, view, frame)
    assert len(album) <= MOST_TRACKS


def test_warnings_are_bounded_and_counted() -> None:
    warnings = Warnings(["no such sensor"])
    for number in range(3 * MOST):
        warnings.add("frame_skipped", f"text {number}", (f"s{number}",))
    warnings.add("frame_skipped", "again", (f"s{3 * MOST - 1}",))
    said = warnings.all()
    assert said[0].code == "sensor_not_matched"
    assert len(said) == MOST + 1
    assert (said[-1].text, said[-1].count) == ("again", 2)


@pytest.mark.parametrize(("tilt_deg", "lift_m"), [(0.0, 0.0), (0.25, 0.0), (0.0, 0.003), (0.0, -0.003), (1.0, 0.0)])
def test_a_glance_tells_a_belt_that_moved_from_one_that_did_not(tilt_deg: float, lift_m: float) -> None:
    show = Show(LineOptions(rig_seed=4, seed=1))
    for _ in range(40):
        show.frame()
    rig = show.place.rig()
    for _ in range(4):
        frame = show.frame()
        plane = rig.mounts[frame.sensor].surface.plane
        turn = rotation_from_vector(np.radians(tilt_deg) * np.cross(plane.normal, np.array([1.0, 0.0, 0.0])))
        foot = plane.foot(np.array([0.0, 0.0, plane.offset_m]))
        normal = turn @ plane.normal
        moved = Plane(normal, float(-normal @ foot) + lift_m)
        assert looks_moved(frame, moved) == bool(tilt_deg or lift_m)


def through_a_pipe(thing: object) -> Any:  # noqa: ANN401 - whatever was sent
    ours, theirs = multiprocessing.get_context("spawn").Pipe()
    with ours, theirs:
        sending = threading.Thread(target=send, args=(ours, thing))
        sending.start()
        got = receive(theirs)
        sending.join()
    return got


def test_arrays_come_through_the_pipe_as_they_were_and_may_be_written_to() -> None:
    sent = {
        "small": np.arange(5, dtype=np.uint8),
        "after an odd size": np.arange(2000.0).reshape(40, 50),
        "a picture": np.arange(640 * 480 * 3, dtype=np.uint8).reshape(480, 640, 3),
        "turned": np.arange(6).reshape(2, 3).T,
        "every other": np.arange(20)[::2],
        "yes and no": np.array([True, False, True]),
        "none": np.zeros((0, 2)),
        "one": np.array(3.5),
    }
    word, got = through_a_pipe(("look", sent))
    assert word == "look"
    assert got.keys() == sent.keys()
    for name, array in sent.items():
        assert got[name].dtype == array.dtype
        assert np.array_equal(got[name], array)
        assert got[name].flags.aligned
        got[name][...] = 1


def test_what_may_not_be_written_to_comes_through_too() -> None:
    fixed = np.arange(7.0)
    fixed.flags.writeable = False
    assert np.array_equal(through_a_pipe(fixed), fixed)
    assert through_a_pipe("no array") == "no array"


def test_what_came_through_is_no_burden_to_the_collector_of_garbage() -> None:
    def looked_through() -> int:
        gc.collect()
        return sum(isinstance(one, memoryview) for one in gc.get_objects())

    before = looked_through()
    got = through_a_pipe([np.arange(float(size)) for size in range(1, 200)])
    assert looked_through() == before
    assert len({id(array.base) for array in got}) == 1


def test_a_sensor_that_feels_itself_turned_is_named() -> None:
    show = Show(LineOptions(rig_seed=4, seed=1))
    frame = next(one for one in (show.frame() for _ in range(20)) if one.sensor == "kinect_1")
    watch = BumpWatch(show.place.rig())
    for second in range(30):
        felt = (0.0, 9.8, 0.0) if second < 15 else (0.0, 9.6, 1.9)
        watch.see_frame("kinect_1", replace(frame, time_s=float(second), felt_m_s2=felt))
        if second < 15:
            assert not watch.close.stale
    assert list(watch.close.stale) == [("kinect_1",)]
    assert "turned by" in watch.close.stale[("kinect_1",)]
