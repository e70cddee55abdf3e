"""How good a calibration is, in words and figures for people."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np

from fruitgui.calibration.pair import Registration
from fruitgui.calibration.relief import Relief
from fruitgui.calibration.result import SensorQuality, mean_std_m
from fruitgui.calibration.scale import Scale
from fruitgui.calibration.still import Still
from fruitgui.calibration.surface import Belt
from fruitgui.geometry.rig import Rig

GOOD_POSITION_STD_M = 0.001
GOOD_ANGLE_STD_RAD = float(np.radians(0.05))


def surface_quality(still: Still, belt: Belt, word: Literal["good", "usable", "unlinked"]) -> SensorQuality:
    """Return what is known of a sensor from its own belt alone."""
    tilt = float(np.sqrt(belt.covariance[0, 0] + belt.covariance[1, 1]))
    return SensorQuality(word, still.captures, belt.rms_m, tilt, float(np.sqrt(belt.covariance[2, 2])))


def placed_quality(sensor: str, rig: Rig, reliefs: Mapping[str, Relief]) -> SensorQuality:
    """Return how well a sensor of an accepted rig is placed."""
    relief = reliefs[sensor]
    pose = rig.mounts[sensor].pose
    belt_m = relief.frame.inverse().apply(relief.background_m[np.abs(relief.background_m[:, 2]) < 0.02][::10])
    position = mean_std_m(pose, pose.apply(belt_m))
    angle = 0.0 if pose.covariance is None else float(np.sqrt(max(np.trace(pose.covariance[:3, :3]), 0.0)))
    alone = surface_quality(relief.still, relief.belt, "good")
    good = position <= GOOD_POSITION_STD_M and angle <= GOOD_ANGLE_STD_RAD
    return SensorQuality(
        word="good" if good else "usable",
        captures=alone.captures,
        surface_rms_m=alone.surface_rms_m,
        surface_tilt_std_rad=alone.surface_tilt_std_rad,
        surface_height_std_m=alone.surface_height_std_m,
        position_std_m=position,
        angle_std_rad=angle,
        belt_gap_m=belt_gap_m(sensor, rig, reliefs),
    )


def belt_gap_m(sensor: str, rig: Rig, reliefs: Mapping[str, Relief], cell_m: float = 0.05) -> float | None:
    """Return the rms difference between this sensor's belt and the other sensors', patch by patch; None if alone."""
    mine = _belt_patches(sensor, rig, reliefs, cell_m)
    squares = []
    for other in reliefs:
        if other != sensor:
            theirs = _belt_patches(other, rig, reliefs, cell_m)
            squares += [(mine[cell] - theirs[cell]) ** 2 for cell in mine.keys() & theirs.keys()]
    return float(np.sqrt(np.mean(squares))) if squares else None


def _belt_patches(sensor: str, rig: Rig, reliefs: Mapping[str, Relief], cell_m: float) -> dict[tuple[int, int], float]:
    """Return the mean height over the reference's belt plane of each patch of belt that a sensor sees."""
    relief = reliefs[sensor]
    belt = relief.background_m[np.abs(relief.background_m[:, 2]) < 0.012]
    flat = rig.belt_frame().apply(rig.mounts[sensor].pose.apply(relief.frame.inverse().apply(belt)))
    if not len(flat):
        return {}
    cells, name = np.unique(np.floor(flat[:, :2] / cell_m).astype(int), axis=0, return_inverse=True)
    count = np.bincount(name.ravel())
    height = np.bincount(name.ravel(), flat[:, 2]) / count
    return {(int(u), int(v)): float(h) for (u, v), h, n in zip(cells, height, count, strict=True) if n >= 8}


def belt_warnings(
    reliefs: Mapping[str, Relief], used: Sequence[Registration], quality: Mapping[str, SensorQuality]
) -> tuple[str, ...]:
    """Return what a person should look at: unsure belts, devices whose depth scales differ, poses less sure."""
    texts = [text for relief in reliefs.values() for text in relief.belt.warnings]
    for pair in used:
        if Scale(pair.quality.scale, pair.quality.scale_std).doubtful:
            texts.append(_scales_differ(pair))
    for sensor, one in quality.items():
        if one.word == "usable":
            texts.append(
                f"{sensor} is placed to {1e3 * one.position_std_m:.1f} mm, {np.degrees(one.angle_std_rad):.2f}° only; "
                "more fruit in the common view would make it better."
            )
    return tuple(texts)


def _scales_differ(pair: Registration) -> str:
    ratio = pair.quality.scale
    longer, shorter = (pair.target, pair.source) if ratio > 1.0 else (pair.source, pair.target)
    return (
        f"Distances seen by {longer} are {100 * (max(ratio, 1 / ratio) - 1):.1f} % longer than by {shorter}: "
        "one of them has a depth scale error; correct it against something of known height."
    )
