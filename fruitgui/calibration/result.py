"""What a calibration gives: accepted with its covariance and quality, or refused with reasons. There is no third."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.plane import Surface
from fruitgui.geometry.pose import Pose
from fruitgui.geometry.rig import Rig

Code = Literal["too_little_overlap", "too_little_structure", "ambiguous", "scene_moved", "disconnected"]

REMEDIES: Mapping[Code, str] = {
    "too_little_overlap": "Turn the sensors so that at least a third of what they see is common, with five or more "
    "pieces of fruit in it, and record again.",
    "too_little_structure": "Put ten or more pieces of fruit, spread over all of the belt that the sensors see, "
    "and record again.",
    "ambiguous": "Break the pattern: spread the fruit unevenly, of different kinds and sizes, or add one odd "
    "object, and record again.",
    "scene_moved": "Stop the belt, keep hands away, and record again.",
    "disconnected": "Add or turn a sensor so that its view links the groups, with fruit in the common part, "
    "and record again.",
}


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a calibration cannot be trusted, and what to do about it.

    Attributes:
        code: a stable word for programs.
        sensors: whom it concerns.
        what: one sentence for people.
        remedy: one sentence on what to do.
    """

    code: Code
    sensors: tuple[str, ...]
    what: str
    remedy: str


def reason(code: Code, sensors: tuple[str, ...], what: str) -> Reason:
    """Return a reason with the remedy that goes with its code."""
    return Reason(code, sensors, what, REMEDIES[code])


@dataclass(frozen=True, slots=True, eq=False)
class SensorQuality:
    """How well one sensor was placed.

    Attributes:
        word: `good` or `usable`; `unlinked` for a sensor that a refused calibration could not place.
        captures: frames averaged.
        surface_rms_m: spread of the averaged readings about the belt's plane.
        surface_tilt_std_rad, surface_height_std_m: how sure the plane is.
        position_std_m: standard deviation of the mapped belt, mean over the belt in view; 0 for the reference.
        angle_std_rad: of the pose.
        belt_gap_m: how far, rms over the common belt, its surface lies from the reference rig's; local, depth errors
            that a common plane cannot take up.
    """

    word: Literal["good", "usable", "unlinked"]
    captures: int
    surface_rms_m: float
    surface_tilt_std_rad: float
    surface_height_std_m: float
    position_std_m: float = 0.0
    angle_std_rad: float = 0.0
    belt_gap_m: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class PairQuality:
    """How well one pair of sensors agrees.

    Attributes:
        sensors: source and target.
        accepted: whether its registration was used.
        things: things on the belt that both saw and that met.
        overlap: share of the source's belt that the target sees too.
        residual_m: rms distance of matched surfaces.
        held_out_m: rms over things of how far each lies off when the others decide.
        scale: how much longer distances between things are in the target than in the source; 1 where devices agree.
        scale_std: its standard deviation; infinite where nothing tells.
        margin: how far the best fit leads the next different one (log evidence).
    """

    sensors: tuple[str, str]
    accepted: bool
    things: int
    overlap: float
    residual_m: float
    held_out_m: float
    scale: float
    scale_std: float
    margin: float


@dataclass(frozen=True, slots=True, eq=False)
class Calibration:
    """An accepted calibration.

    Attributes:
        rig: poses with covariances, surfaces and intrinsics, by sensor.
        sensors: quality by sensor.
        pairs: quality of every pair that was tried.
        warnings: what a person should look at.
        paper: poses as the source would have them: plain point-to-point ICP from the same first guess, composed
            along the same paths; empty unless asked for.
    """

    rig: Rig
    sensors: Mapping[str, SensorQuality]
    pairs: tuple[PairQuality, ...]
    warnings: tuple[str, ...]
    paper: Mapping[str, Pose]


@dataclass(frozen=True, slots=True, eq=False)
class Refusal:
    """A calibration that cannot be trusted.

    Attributes:
        reasons: at least one.
        sensors: quality by sensor, of those whose belt was found.
        pairs: quality of every pair that was tried.
        warnings: what a person should look at.
        surfaces: the belts that were found nevertheless, by sensor.
    """

    reasons: tuple[Reason, ...]
    sensors: Mapping[str, SensorQuality]
    pairs: tuple[PairQuality, ...]
    warnings: tuple[str, ...]
    surfaces: Mapping[str, Surface]


def mean_std_m(pose: Pose, mapped_m: F64) -> float:
    """Return the mean standard deviation (m) of points (N, 3), already mapped by a pose with covariance."""
    if pose.covariance is None or not len(mapped_m):
        return 0.0
    spreads = [J @ pose.covariance @ J.T for J in map(pose.point_jacobian, mapped_m)]
    return float(np.mean([max(float(np.trace(spread)), 0.0) ** 0.5 for spread in spreads]))
