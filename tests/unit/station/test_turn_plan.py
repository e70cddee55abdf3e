from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import Frame
from fruitgui.sensors.sensor import Projector, SensorInfo
from fruitgui.sensors.turns import Settling
from fruitgui.simulation.device import KINECT_COLOR
from fruitgui.simulation.scenes import bare_belt
from fruitgui.station.station import Station, StationSensor
from fruitgui.station.turn_plan import overlapping, rig_of, seen_length_m, turn_plan
from fruitgui.tracking.follow import FASTEST_M_S

SEEN_M = {f"kinect_{n}": 0.9 for n in range(1, 9)}


def kinects(names: Iterable[str], projector: Projector = Projector.SWITCHED) -> dict[str, SensorInfo]:
    return {name: SensorInfo(name, "", "", f"S-{name}", KINECT_COLOR, 30.0, projector) for name in names}


def test_before_calibration_every_sensor_is_alone() -> None:
    plan = turn_plan(kinects(["kinect_1", "kinect_2", "kinect_3"]), SEEN_M, None)
    assert plan.schedule.slots == (("kinect_1",), ("kinect_2",), ("kinect_3",))
    assert plan.takes_turns
    assert not plan.overlaps_known
    assert plan.rates_hz["kinect_2"] == pytest.approx(3 / 0.81)
    # One round of 0.81 s, in which all three views are taken, must fit into the 0.8 m on which a fruit is seen whole.
    assert plan.highest_speed_m_s == pytest.approx(0.8 / 0.81)


def test_a_device_that_settles_slowly_takes_longer_turns() -> None:
    infos = kinects(["kinect_1", "kinect_2"])
    plan = turn_plan(infos, SEEN_M, None, {"S-kinect_2": Settling(0.5, 3)})
    assert plan.schedule.cycle_s == pytest.approx(0.27 + 0.62)


def test_sensors_that_do_not_overlap_share_a_turn_once_calibration_tells() -> None:
    rig = bare_belt(4, "chain").rig()
    pairs = {frozenset(pair) for pair in overlapping(rig)}
    assert {frozenset(("kinect_1", "kinect_2")), frozenset(("kinect_2", "kinect_3"))} <= pairs
    plan = turn_plan(kinects(rig.mounts), SEEN_M, rig)
    assert plan.overlaps_known
    for slot in plan.schedule.slots:
        assert not any(set(pair) <= set(slot) for pair in pairs)


def test_groups_that_see_nothing_in_common_do_not_wait_for_each_other() -> None:
    rig = bare_belt(2, "disconnected").rig()
    plan = turn_plan(kinects(rig.mounts), SEEN_M, rig)
    assert plan.schedule.slots == (("kinect_1",), ("kinect_2",))
    assert plan.rates_hz["kinect_3"] == 30.0


def test_sensors_that_do_not_mind_each_other_are_not_slowed() -> None:
    rig = bare_belt(4, "opposed").rig()
    plan = turn_plan(kinects(rig.mounts, Projector.HARMLESS), SEEN_M, rig)
    assert not plan.takes_turns
    assert set(plan.rates_hz.values()) == {30.0}
    assert plan.highest_speed_m_s == FASTEST_M_S, "what three views would allow, no tracker follows"
    assert plan.clashes == ()


def test_a_projector_that_cannot_be_switched_is_named_with_whom_it_blinds() -> None:
    rig = bare_belt(4, "opposed").rig()
    infos = kinects(rig.mounts)
    infos |= kinects(["kinect_1"], Projector.FIXED)
    assert turn_plan(infos, SEEN_M, rig).clashes == (("kinect_1", "kinect_2"),)


def test_how_much_belt_is_seen_grows_with_the_distance() -> None:
    def frame(distance_mm: int) -> Frame:
        depth = np.full((KINECT_COLOR.height, KINECT_COLOR.width), distance_mm, np.uint16)
        return Frame("a", 0, 0.0, np.zeros((*depth.shape, 3), np.uint8), depth, KINECT_COLOR)

    near, far = (seen_length_m(KINECT_COLOR, frame(mm)) for mm in (800, 1600))
    assert far == pytest.approx(2 * near)
    assert near == pytest.approx(0.8 * 480 / 525)
    assert seen_length_m(KINECT_COLOR, None) > 0


def test_a_station_of_other_sensors_tells_nothing_of_these() -> None:
    rig = bare_belt(4, "opposed").rig()
    sensors = {name: StationSensor("", mount.pose, mount.surface) for name, mount in rig.mounts.items()}
    station = Station(rig.reference, sensors)
    cameras = {name: mount.intrinsics for name, mount in rig.mounts.items()}
    told = rig_of(station, cameras)
    assert told is not None
    assert set(told.mounts) == set(cameras)
    assert rig_of(station, {"kinect_1": KINECT_COLOR}) is None
    assert rig_of(None, cameras) is None


def test_who_overlaps_is_found_once_for_a_rig_and_anew_for_another() -> None:
    rig = bare_belt(4, "opposed").rig()
    sensors = {name: StationSensor("", mount.pose, mount.surface) for name, mount in rig.mounts.items()}
    cameras = {name: mount.intrinsics for name, mount in rig.mounts.items()}
    station, again = Station(rig.reference, sensors), Station(rig.reference, sensors)
    once = rig_of(station, cameras)
    assert once is not None
    assert rig_of(station, dict(cameras)) is once
    before = overlapping.cache_info().misses
    assert overlapping(once) == (("kinect_1", "kinect_2"),)
    assert overlapping(once) == (("kinect_1", "kinect_2"),)
    assert overlapping.cache_info().misses == before + 1
    other = rig_of(again, cameras)
    assert other is not once
    narrow = {**cameras, "kinect_1": replace(KINECT_COLOR, fx=2.0 * KINECT_COLOR.fx)}
    assert rig_of(station, narrow) is not once
