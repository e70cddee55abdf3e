from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from fruitgui.frame import Frame
from fruitgui.geometry.plane import Surface
from fruitgui.simulation.device import KINECT_COLOR
from fruitgui.simulation.scenes import bare_belt
from fruitgui.station.belt_mosaic import mosaic_of
from fruitgui.station.belt_setting import (
    MOST_CORNERS,
    PlanMotion,
    area_m2,
    long_axis_rad,
    looked_at,
    motion_of,
    off_plan,
    onto_plan,
    region_of,
    region_problem,
    seen_at,
    with_motion,
    with_region,
)
from fruitgui.station.fingerprint import calibration_fingerprint
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.station_file import read_station, write_station

CORNERS = np.array([[-0.5, -0.2], [0.6, -0.25], [0.55, 0.25], [-0.45, 0.2]])


@pytest.fixture(scope="module")
def station() -> Station:
    mounts = bare_belt(7, "ring").rig().mounts
    return Station("kinect_1", {name: StationSensor("", one.pose, one.surface) for name, one in mounts.items()})


def test_a_region_is_the_same_place_for_every_sensor_and_lies_on_its_plane(station: Station) -> None:
    changed = with_region(station, CORNERS)
    for name, one in changed.sensors.items():
        region = one.surface.region_m
        assert region is not None
        assert np.abs(one.surface.plane.height_m(region)).max() < 1e-9
        assert onto_plan(changed, name, region) == pytest.approx(CORNERS, abs=1e-6)
    assert region_of(changed) == pytest.approx(region_of(with_region(changed, region_of(changed))), abs=1e-5)
    assert area_m2(region_of(changed)) == pytest.approx(area_m2(CORNERS), rel=1e-3)


def test_neither_region_nor_motion_is_part_of_the_calibration(station: Station) -> None:
    changed = with_motion(with_region(station, CORNERS), PlanMotion(0.2, 0.3))
    assert calibration_fingerprint(changed) == calibration_fingerprint(station)


def test_a_round_region_is_drawn_with_few_corners_that_hold_most_of_it(station: Station) -> None:
    angles = np.linspace(0.0, 2.0 * math.pi, 40, endpoint=False)
    circle = 0.4 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    found = region_of(with_region(station, circle))
    assert len(found) <= MOST_CORNERS
    assert area_m2(found) == pytest.approx(area_m2(circle), rel=0.15)


def test_regions_of_sensors_are_taken_together(station: Station) -> None:
    along = np.array([0.4, 0.0])
    left, right = CORNERS - along, CORNERS + along
    sensors = dict(with_region(station, left).sensors)
    one = sensors["kinect_2"]
    sensors["kinect_2"] = StationSensor("", one.pose, Surface(one.surface.plane, off_plan(station, "kinect_2", right)))
    together = region_of(Station("kinect_1", sensors))
    assert together[:, 0].min() == pytest.approx(left[:, 0].min(), abs=0.02)
    assert together[:, 0].max() == pytest.approx(right[:, 0].max(), abs=0.02)


def test_without_any_region_there_is_one_to_begin_with(station: Station) -> None:
    sensors = {name: StationSensor("", one.pose, Surface(one.surface.plane)) for name, one in station.sensors.items()}
    assert region_problem(region_of(Station("kinect_1", sensors))) == ""


@pytest.mark.parametrize("seed", range(5))
def test_a_calibration_is_the_same_after_it_was_written_and_read(seed: int, tmp_path: Path) -> None:
    mounts = bare_belt(seed, "ring").rig().mounts
    made = Station("kinect_1", {name: StationSensor("", one.pose, one.surface) for name, one in mounts.items()})
    path = tmp_path / "station.json"
    write_station(path, made)
    assert calibration_fingerprint(read_station(path)) == calibration_fingerprint(made)


@pytest.mark.parametrize("heading_deg", [0.0, 40.0, 179.0, -100.0])
def test_a_motion_on_the_plan_is_kept(station: Station, heading_deg: float) -> None:
    assert motion_of(station) is None
    kept = motion_of(with_motion(station, PlanMotion(0.17, math.radians(heading_deg))))
    assert kept is not None
    assert kept.speed_m_s == pytest.approx(0.17)
    assert math.degrees(kept.heading_rad) == pytest.approx(heading_deg)
    assert motion_of(with_motion(with_motion(station, kept), None)) is None


@pytest.mark.parametrize(
    ("corners", "problem"),
    [
        (CORNERS, ""),
        (CORNERS[:2], "few"),
        (CORNERS[[0, 2, 1, 3]], "crossed"),
        (CORNERS * 0.05, "small"),
    ],
)
def test_what_is_no_region_is_said(corners: np.ndarray, problem: str) -> None:
    assert region_problem(corners) == problem


def test_the_longer_side_is_found() -> None:
    angle = math.radians(25.0)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    box = np.array([[-0.6, -0.2], [0.6, -0.2], [0.6, 0.2], [-0.6, 0.2]]) @ turn.T
    assert math.degrees(long_axis_rad(box)) == pytest.approx(25.0, abs=0.1)


def test_what_is_seen_at_a_pixel_is_looked_at_through_it(station: Station) -> None:
    for sensor in station.sensors:
        pixels = seen_at(station, sensor, KINECT_COLOR, CORNERS)
        assert np.isfinite(pixels).all()
        assert looked_at(station, sensor, KINECT_COLOR, pixels) == pytest.approx(CORNERS, abs=1e-6)


def test_a_pixel_above_the_horizon_looks_at_no_belt(station: Station) -> None:
    place = looked_at(station, "kinect_1", KINECT_COLOR, np.array([[320.0, -20_000.0]]))
    assert np.isnan(place).all()


def test_the_mosaic_shows_each_place_as_one_sensor_sees_it(station: Station) -> None:
    x, y = np.meshgrid(np.linspace(-0.3, 0.3, 30), np.linspace(0.2, -0.2, 20))
    cameras = dict.fromkeys(station.sensors, KINECT_COLOR)
    mosaic = mosaic_of(station, cameras, np.stack([x, y], -1))
    shown = np.sum(list(mosaic.shares.values()), axis=0)
    assert shown.max() == 1
    assert shown.mean() > 0.9
    colours = {sensor: (40 * number + 20, 90, 200) for number, sensor in enumerate(cameras)}
    frames: dict[str, Frame | None] = {}
    for sensor, colour in colours.items():
        color = np.full((KINECT_COLOR.height, KINECT_COLOR.width, 3), colour, np.uint8)
        frames[sensor] = Frame(sensor, 0, 0.0, color, np.zeros(color.shape[:2], np.uint16), KINECT_COLOR)
    laid = mosaic.laid(frames)
    for sensor, share in mosaic.shares.items():
        assert {tuple(one) for one in laid[share][:, :3].tolist()} <= {colours[sensor]}
    frames["kinect_1"] = None
    assert not mosaic.laid(frames)[mosaic.shares["kinect_1"]].any()
