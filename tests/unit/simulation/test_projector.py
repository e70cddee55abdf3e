"""Projectors of a simulated rig: how they settle, whom they disturb, and sensors that are switched."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from fruitgui.errors import WorldError
from fruitgui.frame import U16, Frame, Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.sensor import Projector, SensorTimeoutError
from fruitgui.simulation.ahead import SimulatedRig
from fruitgui.simulation.device import Device, depth_camera_of
from fruitgui.simulation.layouts import look_at
from fruitgui.simulation.projector import (
    SHORTEST_SHARE,
    Beams,
    ProjectorModel,
    crossed_by,
    projector_models,
    projector_pose,
    settling,
)
from fruitgui.simulation.setting import Setting
from fruitgui.simulation.show import Show
from fruitgui.simulation.supply import LineOptions
from fruitgui.simulation.switched import SwitchedStream, switched_sensors
from fruitgui.station.sources import PRESETS
from fruitgui.station.turn_plan import overlapping

APART = LineOptions(rig_seed=1, layout="disconnected", sensors=3, settling_s=0.3)
"""Two sensors that face each other, and one metres away."""

SLOW = ProjectorModel(0.4)
BELT_MM = 1000


@pytest.fixture(scope="module")
def place() -> Setting:
    return APART.setting()


@pytest.fixture
def beams(place: Setting) -> Beams:
    return Beams(place.devices, {device.sensor: SLOW for device in place.devices}, seed=5)


def belt(camera: Intrinsics) -> U16:
    return np.full((camera.height, camera.width), BELT_MM, np.uint16)


def holes(depth_mm: U16) -> float:
    return float((depth_mm == 0).mean())


def test_every_projector_has_a_time_of_its_own_that_the_rigs_seed_decides() -> None:
    names = [f"kinect_{one}" for one in range(1, 9)]
    first, again, other = (projector_models(seed, names, 0.4) for seed in (1, 1, 2))
    assert first == again
    assert first != other
    times_s = [model.settle_s for model in first.values()]
    assert len(set(times_s)) == len(names)
    assert SHORTEST_SHARE * 0.4 <= min(times_s) < max(times_s) <= 0.4


def test_light_settles_evenly_and_then_changes_nothing() -> None:
    depth = np.full((480, 640), BELT_MM, np.uint16)
    before = 1.0
    for since_s in (0.0, 0.1, 0.2, 0.3, 0.38):
        left = 1.0 - since_s / SLOW.settle_s
        seen = settling(depth, SLOW.unsettled(since_s), SLOW, np.random.default_rng(3))
        assert holes(seen) == pytest.approx(SLOW.first_holes * left, abs=0.01)
        assert holes(seen) < before
        off_mm = SLOW.first_scale * left * BELT_MM
        assert np.median(seen[seen > 0]) == pytest.approx(BELT_MM + off_mm, abs=0.5)
        before = holes(seen)
    assert SLOW.unsettled(SLOW.settle_s) == SLOW.unsettled(9.0) == 0.0


def test_in_the_dark_there_is_no_depth_and_in_steady_light_alone_it_is_as_it_was(place: Setting, beams: Beams) -> None:
    depth = belt(place.devices[0].color_camera)
    assert beams.lit("kinect_1", 0, depth, {"kinect_2": 9.0}) is None
    assert beams.lit("kinect_1", 0, depth, {"kinect_1": 9.0}) is depth
    assert beams.lit("kinect_1", 0, depth, {"kinect_1": 9.0, "kinect_3": 9.0}) is depth, "kinect_3 is far away"


def test_the_same_frame_is_lit_in_the_same_way_and_another_in_another(place: Setting, beams: Beams) -> None:
    depth, both = belt(place.devices[0].color_camera), {"kinect_1": 0.1, "kinect_2": 0.1}
    same = Beams(place.devices, beams.models, seed=5)
    first, again, later = (one.lit("kinect_1", n, depth, both) for one, n in ((beams, 4), (same, 4), (beams, 5)))
    assert first is not None
    assert np.array_equal(first, again)  # type: ignore[arg-type]
    assert not np.array_equal(first, later)  # type: ignore[arg-type]
    other = Beams(place.devices, beams.models, seed=6).lit("kinect_1", 4, depth, both)
    assert not np.array_equal(first, other)  # type: ignore[arg-type]
    assert (depth == BELT_MM).all(), "what was rendered is left as it is"


def test_another_pattern_disturbs_where_it_lies_and_nowhere_else(place: Setting, beams: Beams) -> None:
    depth, crossed = belt(place.devices[0].color_camera), beams.crossed("kinect_1", "kinect_2")
    assert 0.5 < crossed.mean() < 0.95
    seen = beams.lit("kinect_1", 0, depth, {"kinect_1": 9.0, "kinect_2": 9.0})
    assert seen is not None
    assert (seen[~crossed] == BELT_MM).all()
    assert holes(seen[crossed]) == pytest.approx(SLOW.disturbed_holes, abs=0.01)
    readings = seen[crossed & (seen > 0)].astype(float)
    assert readings.mean() == pytest.approx(BELT_MM, abs=0.1)
    assert readings.std() == pytest.approx(1e3 * SLOW.disturbed_noise, rel=0.05)


def test_those_are_crossed_whom_the_belt_says_to_overlap(place: Setting, beams: Beams) -> None:
    assert overlapping(Show(APART).place.rig()) == (("kinect_1", "kinect_2"),)
    names = [device.sensor for device in place.devices]
    crossed = {(one, other) for one in names for other in names if one != other and beams.crossed(one, other).any()}
    assert crossed == {("kinect_1", "kinect_2"), ("kinect_2", "kinect_1")}


def test_a_pixel_is_crossed_where_the_projector_reaches_the_place_that_it_sees() -> None:
    camera = Intrinsics(64, 48, 52.5, 52.5, 31.5, 23.5)
    one, other = (
        Device(name, look_at(np.array([x_m, 0.3, 1.0]), np.array([x_m, 0.0, 0.0])), camera, depth_camera_of(camera))
        for name, x_m in (("kinect_1", 0.0), ("kinect_2", 0.5))
    )
    crossed, projector = crossed_by(one, other), projector_pose(other)
    beside_m = other.pose.inverse().apply(projector.translation_m)
    assert beside_m == pytest.approx([0.05, 0.0, 0.0], abs=1e-9), "25 mm left of colour, then 75 mm to the right"
    middle_u, middle_v = camera.project(one.pose.inverse().apply(np.array([[0.5, 0.0, 0.0]]))).round().astype(int)[0]
    assert crossed[middle_v, middle_u]
    left_of_all = one.pose.inverse().apply(np.array([[-0.4, 0.0, 0.0]]))
    u, v = camera.project(left_of_all).round().astype(int)[0]
    assert not crossed[v, u]
    lit_m = [_ground(projector, ray) for ray in ((-0.55, 0.0), (0.55, 0.0))]
    columns = [camera.project(one.pose.inverse().apply(point))[0, 0] for point in lit_m]
    inside = min(columns) < np.arange(camera.width)
    assert np.array_equal(crossed[24], inside & (np.arange(camera.width) < max(columns)))


def _ground(pose: Pose, ray: tuple[float, float]) -> np.ndarray:
    """Return where a ray (x/z, y/z) of a frame meets the belt."""
    toward = pose.rotation @ np.array([*ray, 1.0])
    point: np.ndarray = pose.translation_m - toward * pose.translation_m[2] / toward[2]
    return point


def test_a_sensor_that_looks_up_is_crossed_by_nobody(place: Setting) -> None:
    device = place.devices[0]
    up = look_at(np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.1, 2.0]))
    above = Device("above", up, device.color_camera, device.depth_camera)
    assert not crossed_by(above, device).any()
    assert not crossed_by(device, above).any()


class Scripted:
    """A stream of frames of two sensors in turn, always due."""

    def __init__(self, sensors: Sequence[str], camera: Intrinsics) -> None:
        self._sensors = sensors
        self._camera = camera
        self.number = 0

    def begin(self) -> None:
        self.number = 0

    def draw(self, timeout_s: float) -> Frame | None:  # noqa: ARG002 - always due
        turn, which = divmod(self.number, len(self._sensors))
        self.number += 1
        color = np.zeros((self._camera.height, self._camera.width, 3), np.uint8)
        return Frame(self._sensors[which], turn, 0.1 * turn, color, belt(self._camera), self._camera)

    def end(self) -> None:
        pass


def test_frames_are_lit_by_who_shines_when_they_are_due(place: Setting, beams: Beams) -> None:
    now_s = [100.0]
    names = ("kinect_1", "kinect_2")
    stream = SwitchedStream(Scripted(names, place.devices[0].color_camera), beams, lambda: now_s[0])

    def drawn() -> list[float | None]:
        frames = [stream.draw(0.0) for _ in names]
        return [None if one is None else holes(one.depth_mm) for one in frames]

    assert drawn() == [None, None]
    stream.switch("kinect_1", True)
    now_s[0] += 0.5 * SLOW.settle_s
    stream.switch("kinect_1", True)  # it is on already: its light goes on settling
    first, second = drawn()
    assert first == pytest.approx(0.5 * SLOW.first_holes, abs=0.02)
    assert second is None
    now_s[0] += SLOW.settle_s
    assert drawn() == [0.0, None]
    stream.switch("kinect_2", True)
    now_s[0] += SLOW.settle_s
    share = beams.crossed("kinect_1", "kinect_2").mean()
    assert drawn()[0] == pytest.approx(share * SLOW.disturbed_holes, abs=0.01)
    stream.switch("kinect_2", False)
    assert drawn() == [0.0, None]
    stream.switch("kinect_1", False)
    stream.switch("kinect_1", True)
    assert drawn()[0] == pytest.approx(SLOW.first_holes, abs=0.02), "it begins anew"


def test_a_switched_sensor_starts_as_it_is_told_and_keeps_no_frame_of_before(place: Setting, beams: Beams) -> None:
    names = [device.sensor for device in place.devices[:2]]
    infos = Show(APART).infos()[:2]
    assert {info.projector for info in infos} == {Projector.SWITCHED}
    one, other = switched_sensors(Scripted(names, place.devices[0].color_camera), beams, infos)
    with pytest.raises(WorldError, match="not running"):
        one.read(0.0)
    for sensor in (one, other):
        sensor.open()
        sensor.projector(False)
        sensor.start()
    with pytest.raises(SensorTimeoutError):
        one.read(0.05)
    other.projector(True)
    one.projector(True)
    reads = [other.read(1.0) for _ in range(3)]  # those of the first wait for it meanwhile
    one.projector(False)
    one.projector(True)
    assert one.read(1.0).sequence >= reads[-1].sequence
    one.stop()
    one.start()
    assert one.read(1.0).sensor == names[0], "stopping and starting again does not change what was told"
    one.close()
    one.open()
    one.start()
    assert one.read(1.0).sensor == names[0], "untold it is on"
    for sensor in (one, other):
        sensor.close()


def test_only_a_rig_that_is_said_to_settle_has_projectors_that_are_switched() -> None:
    for name, options in PRESETS.items():
        light = {sensor.info.projector for sensor in SimulatedRig(options).sensors()}
        wanted = Projector.SWITCHED if name == "opposed_projectors" else Projector.HARMLESS
        assert light == {wanted}, name
