"""What a projector does to depth: none in the dark, bad until its light settles, worse where another shines, too.

The Kinect v1 projects dots and knows them again. While its laser warms up dots are weak, so readings are missing, and
its wavelength drifts, so they are off; where two patterns lie on each other, windows match the wrong one or none
(Maimone & Fuchs 2012, "Reducing interference between multiple structured light depth sensors using motion").
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from fruitgui.frame import F32, U16, Bools
from fruitgui.geometry.pose import Pose
from fruitgui.simulation.device import Device

SPOT_PX = 4
"""Readings are lost in spots: a window that matches nothing is of several pixels."""

SHORTEST_SHARE = 0.5
"""The quickest light settles in this share of the time that the slowest takes."""


@dataclass(frozen=True, slots=True)
class ProjectorModel:
    """How one projector settles, and what another one's light does to its sensor.

    Attributes:
        settle_s: from switching on until depth is as it stays.
        first_holes: share of readings that is missing at first; falls to none evenly.
        first_scale: share by which depth is too large at first; falls to none evenly.
        disturbed_holes: share of readings that is missing where another pattern lies on its own.
        disturbed_noise: standard deviation of readings there, of depth squared, 1/m: twice what a Kinect's own is.
    """

    settle_s: float
    first_holes: float = 0.6
    first_scale: float = 0.006
    disturbed_holes: float = 0.25
    disturbed_noise: float = 2.8e-3

    def unsettled(self, since_s: float) -> float:
        """Return how much of the way the light has still to go, 1 to 0."""
        return min(max(1.0 - since_s / self.settle_s, 0.0), 1.0) if self.settle_s > 0.0 else 0.0


def projector_models(rig_seed: int, sensors: Sequence[str], settling_s: float) -> dict[str, ProjectorModel]:
    """Return the projectors of a rig: each its own, the slowest about as slow as is said.

    Args:
        rig_seed: decides how long each takes.
        sensors: in order.
        settling_s: that none takes longer than.
    """
    rng = np.random.default_rng([rig_seed, 12])
    return {sensor: ProjectorModel(settling_s * float(rng.uniform(SHORTEST_SHARE, 1.0))) for sensor in sensors}


def crossed_by(device: Device, other: Device) -> Bools:
    """Tell which pixels (H, W) of a sensor see a place of the belt's plane that another one's projector lights.

    A fruit on the belt may be lit where the belt below it is not; that is left out.
    """
    camera = device.color_camera
    rays = np.concatenate([camera.rays(), np.ones((camera.height, camera.width, 1))], axis=-1)
    downward = rays @ device.pose.rotation.T
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = -device.pose.translation_m[2] / downward[..., 2]
        belt_m = device.pose.translation_m + reach[..., None] * downward
        inside = _inside(projector_pose(other).inverse().apply(belt_m.reshape(-1, 3)), other)
    lit: Bools = inside.reshape(reach.shape) & (reach > 0.0)
    return lit


def projector_pose(device: Device) -> Pose:
    """Return the pose of a sensor's projector into the world: beside its infrared camera, and looking as that does."""
    beside = Pose(np.eye(3), np.array([device.depth_model.baseline_m, 0.0, 0.0]))
    return device.pose @ device.depth_to_color @ beside


def _inside(points_m: np.ndarray, device: Device) -> Bools:
    """Tell which points (N, 3) in a projector's frame its pattern reaches: as much as its infrared camera sees."""
    camera = device.depth_camera
    u, v = camera.project(points_m).T
    reached: Bools = (
        (points_m[:, 2] > 0.0) & (u >= -0.5) & (u < camera.width - 0.5) & (v >= -0.5) & (v < camera.height - 0.5)
    )
    return reached


class Beams:
    """The projectors of a rig: what each sensor's depth is while some of them shine.

    Args:
        devices: of the rig.
        models: by sensor.
        seed: of what is lost and how readings are off; with a frame's number it decides both.
    """

    def __init__(self, devices: Sequence[Device], models: Mapping[str, ProjectorModel], seed: int) -> None:
        self._devices = {device.sensor: device for device in devices}
        self._order = tuple(self._devices)
        self._seed = seed
        self._crossed: dict[tuple[str, str], Bools] = {}
        self.models = dict(models)

    def crossed(self, sensor: str, other: str) -> Bools:
        """Tell which pixels of a sensor another one's projector disturbs; see `crossed_by`."""
        pair = (sensor, other)
        if pair not in self._crossed:
            self._crossed[pair] = crossed_by(self._devices[sensor], self._devices[other])
        return self._crossed[pair]

    def lit(self, sensor: str, number: int, depth_mm: U16, on_for_s: Mapping[str, float]) -> U16 | None:
        """Return the depth that a sensor measures; None in the dark.

        Args:
            sensor: whose depth it is.
            number: of its frame.
            depth_mm: as measured in its own steady light alone; given back where nothing changes it.
            on_for_s: by sensor whose projector is on, for how long.
        """
        if sensor not in on_for_s:
            return None
        model = self.models[sensor]
        left = model.unsettled(on_for_s[sensor])
        disturbing = [self.crossed(sensor, other) for other in on_for_s if other != sensor]
        rng = np.random.default_rng([self._seed, 31, self._order.index(sensor), number])
        if left > 0.0:
            depth_mm = settling(depth_mm, left, model, rng)
        for crossed in disturbing:
            if crossed.any():
                depth_mm = disturbed(depth_mm, crossed, model, rng)
        return depth_mm


def settling(depth_mm: U16, left: float, model: ProjectorModel, rng: Generator) -> U16:
    """Return depth in light that has so much of its way still to go, 1 to 0."""
    grown: U16 = np.rint(depth_mm * np.float32(1.0 + model.first_scale * left)).astype(np.uint16)
    grown[spots(depth_mm.shape, model.first_holes * left, rng)] = 0
    return grown


def disturbed(depth_mm: U16, crossed: Bools, model: ProjectorModel, rng: Generator) -> U16:
    """Return depth where another pattern lies on some of its pixels."""
    z_m: F32 = depth_mm * np.float32(1e-3)
    off_mm = rng.standard_normal(depth_mm.shape, np.float32) * (np.float32(1e3 * model.disturbed_noise) * z_m * z_m)
    noisy = np.rint(np.maximum(depth_mm + off_mm, 0.0)).astype(np.uint16)
    noisy[spots(depth_mm.shape, model.disturbed_holes, rng)] = 0
    seen: U16 = np.where(crossed, noisy, depth_mm)
    return seen


def spots(shape: tuple[int, ...], share: float, rng: Generator) -> Bools:
    """Tell which pixels (H, W) are in one of the spots that so large a share of the picture is lost in."""
    height, width = shape
    coarse = rng.random((-(-height // SPOT_PX), -(-width // SPOT_PX)), np.float32) < share
    spread: Bools = np.repeat(np.repeat(coarse, SPOT_PX, axis=0), SPOT_PX, axis=1)[:height, :width]
    return spread
