from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fruitgui.frame import Frame
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.rig import Rig
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.simulation.scenes import still_scene
from fruitgui.station.rig_watch import EVERY_FRAMES, FRAMES_PER_LOOK, RigWatch


@pytest.fixture(scope="module")
def scene() -> tuple[Rig, list[Frame]]:
    simulation = still_scene(5, fruit=8, captures=FRAMES_PER_LOOK)
    frames = [frame for frame in simulation.frames() if frame.sensor == "kinect_1"]
    return simulation.rig(), frames


def watched(rig: Rig, frames: list[Frame]) -> list[str]:
    watch = RigWatch(rig)
    for frame in frames:
        watch.see_frame("kinect_1", frame)
        for _ in range(EVERY_FRAMES - 1):
            watch.see_frame("kinect_1", frame)
    return watch.warnings


def test_a_rig_that_stands_is_left_in_peace(scene: tuple[Rig, list[Frame]]) -> None:
    assert watched(*scene) == []


@pytest.mark.parametrize(("turn_deg", "lift_m"), [(0.8, 0.0), (0.0, 0.012)])
def test_a_bumped_sensor_is_named(scene: tuple[Rig, list[Frame]], turn_deg: float, lift_m: float) -> None:
    rig, frames = scene
    mount = rig.mounts["kinect_1"]
    plane = mount.surface.plane
    turned = rotation_from_vector(np.radians([turn_deg, 0.0, 0.0])) @ plane.normal
    moved = Surface(Plane(turned, plane.offset_m + lift_m), None)
    warnings = watched(Rig(rig.reference, {"kinect_1": replace(mount, surface=moved)}), frames)
    assert len(warnings) == 1
    assert warnings[0].startswith("calibration_stale: sensor kinect_1")


def test_a_short_recording_tells_it_too(scene: tuple[Rig, list[Frame]]) -> None:
    rig, frames = scene
    watch = RigWatch(rig)
    for number in range(EVERY_FRAMES):
        frame = frames[number % len(frames)]
        watch.see_frame("kinect_1", replace(frame, depth_mm=(frame.depth_mm * 1.25).astype(np.uint16)))
    assert len(watch.warnings) == 1
    assert "lies elsewhere" in watch.warnings[0]
