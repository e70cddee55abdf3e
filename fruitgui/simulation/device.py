"""One simulated sensor: where it stands, its cameras, how it errs, and when it captures."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.random import Generator

from fruitgui.frame import Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rotation import rotation_from_vector
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.light import ColorModel

KINECT_COLOR = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
"""Nominal colour camera of a Kinect v1."""

DEPTH_FOCAL_RATIO = 580.0 / 525.0
"""The infrared camera's focal length over the colour camera's."""

COLOR_IN_DEPTH_M = 0.025
"""The colour camera stands this far to the right of the infrared camera."""

TURNED_RAD = float(np.radians(0.7))
"""A hand that raises a sensor turns it a little, about each axis."""


@dataclass(frozen=True, slots=True, eq=False)
class Device:
    """One sensor of a scene.

    Attributes:
        sensor: its id.
        pose: from its colour optical frame into the world.
        color_camera: intrinsics that its frames carry.
        depth_camera: intrinsics of its infrared camera.
        depth_to_color: pose from the infrared camera's frame into the colour camera's.
        depth_model, color_model: how it errs.
        clock_offset_s: to be added to its stamps to get true time.
        silent_s: (from, to) spans of true time in which it gives nothing.
        drop_share: share of its frames that are lost at random.
        color_delay_s: colour is exposed so much later than depth.
        serial: of the device.
    """

    sensor: str
    pose: Pose
    color_camera: Intrinsics = KINECT_COLOR
    depth_camera: Intrinsics = field(default_factory=lambda: depth_camera_of(KINECT_COLOR))
    depth_to_color: Pose = field(default_factory=lambda: Pose(np.eye(3), np.array([-COLOR_IN_DEPTH_M, 0.0, 0.0])))
    depth_model: DepthModel = DepthModel()  # noqa: RUF009 - frozen
    color_model: ColorModel = ColorModel()  # noqa: RUF009 - frozen
    clock_offset_s: float = 0.0
    silent_s: tuple[tuple[float, float], ...] = ()
    drop_share: float = 0.0
    color_delay_s: float = 0.0
    serial: str = ""


def depth_camera_of(color: Intrinsics) -> Intrinsics:
    """Return the infrared camera that goes with a colour camera: same picture size, narrower view."""
    focal = color.fx * DEPTH_FOCAL_RATIO
    return Intrinsics(color.width, color.height, focal, focal, (color.width - 1) / 2, (color.height - 1) / 2)


def raised(device: Device, by_m: float, rng: Generator) -> Device:
    """Return a sensor that a hand raised: its colour lens by so much straight up, and turned a little meanwhile."""
    turn = rotation_from_vector(rng.normal(0.0, TURNED_RAD, 3))
    pose = device.pose
    return replace(device, pose=Pose(turn @ pose.rotation, pose.translation_m + np.array([0.0, 0.0, by_m])))
