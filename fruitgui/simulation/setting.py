"""The rig and the place of a scene: sensors as a person put them, belt, rails and floor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from fruitgui.frame import Intrinsics
from fruitgui.geometry.pose import Pose
from fruitgui.simulation.device import KINECT_COLOR, Device, depth_camera_of
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.layouts import USUAL_HEIGHT_M, placements
from fruitgui.simulation.light import ColorModel
from fruitgui.simulation.surroundings import Surroundings, make_belt, rails


@dataclass(frozen=True, slots=True)
class Conditions:
    """Light and sensors of a scene; every effect of `depth_model` can be set there.

    Attributes:
        lux: light on the belt; None draws 100–1000.
        wear: how strongly the belt's texture shows, a share; None draws 0.02–0.10, 0 is a plain belt.
        depth_model: what all sensors share.
        fattening_px: of edges; None draws 0.3–1.6 px per sensor.
        noise_factor: of the disparity's random error; None draws 0.9–1.3 per sensor.
        scale_error: depth scale errors of sensors are drawn evenly from ± this.
        offset_m: depth offsets are drawn evenly from ± this.
        camera: the colour camera; its resolution is the frames'.
        clock_offset_s: clock offsets of all but the reference are drawn evenly from ± this.
        drop_share: share of frames lost.
        color_delay_s: delays of colour after depth are drawn evenly from ± this.
    """

    lux: float | None = None
    wear: float | None = None
    depth_model: DepthModel = DepthModel()  # noqa: RUF009 - frozen
    fattening_px: float | None = None
    noise_factor: float | None = None
    scale_error: float = 0.0
    offset_m: float = 0.0
    camera: Intrinsics = KINECT_COLOR
    clock_offset_s: float = 0.0
    drop_share: float = 0.0
    color_delay_s: float = 0.0


USUAL = Conditions()
"""Nominal Kinects without depth bias, under light drawn by the seed."""


@dataclass(frozen=True, slots=True, eq=False)
class Setting:
    """A rig in its place, the same for all scenes that share a rig seed."""

    devices: tuple[Device, ...]
    surroundings: Surroundings


def make_setting(
    rig_seed: int,
    layout: str,
    sensors: int,
    with_rails: bool,
    conditions: Conditions,
    height_m: tuple[float, float] = USUAL_HEIGHT_M,
) -> Setting:
    """Return the rig and place that a rig seed stands for; see `layouts.placements` for layout and sensors."""
    rng = np.random.default_rng([rig_seed, 10])
    poses = placements(layout, sensors, rng, height_m)
    surroundings = make_surroundings(rng, with_rails, conditions.wear)
    return Setting(make_devices(poses, conditions, rng), surroundings)


def make_surroundings(rng: Generator, with_rails: bool, wear: float | None = None) -> Surroundings:
    """Return a belt of random width and look, with or without rails, over a grey floor."""
    width_m = float(rng.uniform(0.50, 0.62))
    grey = float(rng.uniform(0.25, 0.6))
    beside = rails(width_m, rng) if with_rails else ()
    return Surroundings(make_belt(rng, width_m, wear=wear), beside, float(rng.uniform(0.5, 0.9)), (grey, grey, grey))


def make_devices(poses: Sequence[Pose], conditions: Conditions, rng: Generator) -> tuple[Device, ...]:
    """Return Kinects at poses into the world, named kinect_1, kinect_2, …; the first is the reference."""
    return tuple(_device(number, pose, conditions, rng) for number, pose in enumerate(poses))


def _device(number: int, pose: Pose, conditions: Conditions, rng: Generator) -> Device:
    offset_s = float(rng.uniform(-1, 1) * conditions.clock_offset_s)
    return Device(
        f"kinect_{number + 1}",
        pose,
        conditions.camera,
        depth_camera_of(conditions.camera),
        depth_model=_depth_model(conditions, rng),
        color_model=_color_model(rng),
        clock_offset_s=offset_s if number else 0.0,
        drop_share=conditions.drop_share,
        color_delay_s=float(rng.uniform(-1, 1) * conditions.color_delay_s),
        serial=f"SIM{rng.integers(10**8):08d}",
    )


def _depth_model(conditions: Conditions, rng: Generator) -> DepthModel:
    drawn_px, drawn_factor = float(rng.uniform(0.3, 1.6)), float(rng.uniform(0.9, 1.3))
    factor = drawn_factor if conditions.noise_factor is None else conditions.noise_factor
    model = conditions.depth_model
    return replace(
        model,
        sigma_px=model.sigma_px * factor,
        fattening_px=drawn_px if conditions.fattening_px is None else conditions.fattening_px,
        scale_error=model.scale_error + float(rng.uniform(-1, 1) * conditions.scale_error),
        offset_m=model.offset_m + float(rng.uniform(-1, 1) * conditions.offset_m),
    )


def _color_model(rng: Generator) -> ColorModel:
    red, green, blue = (1 + rng.normal(0, 0.02, 3)).tolist()
    return ColorModel(
        compliance=float(rng.uniform(0.05, 0.25)),
        vignetting=float(rng.uniform(0.05, 0.25)),
        balance=(red, green, blue),
        crosstalk=float(rng.uniform(0.02, 0.15)),
    )
