"""One biased device on the bench: what it sees, and what its depth is put right by."""

from __future__ import annotations

from functools import cache

import numpy as np

from fruitgui.calibration.depth.correct import correct_depth
from fruitgui.calibration.depth.measured import BareBelt, DepthFit, DepthReason, DepthRefusal, Measurements
from fruitgui.calibration.still import Still, average
from fruitgui.frame import F64
from fruitgui.sensors.depth_correction import DepthCorrection
from fruitgui.simulation.depth_bench import depth_bench
from fruitgui.simulation.kinect import DepthModel

RIG = 21
BIASED = DepthModel(scale_error=0.012, offset_m=-0.009, radial_error=0.008, fattening_px=1.2)
CORNER_R2 = (320**2 + 240**2) / 580**2


@cache
def still_of(seed: int, board_m: float = 0.0, ball_m: float = 0.0, raised_m: float = 0.0) -> Still:
    scene = depth_bench(seed, RIG, BIASED, board_height_m=board_m, ball_m=ball_m, raised_m=raised_m, captures=6)
    return average(list(scene.frames()))


@cache
def distance_m() -> float:
    plane = depth_bench(0, RIG, BIASED).rig().mounts["kinect_1"].surface.plane
    return -plane.offset_m / float(plane.normal[2])


def bare_belt(typed_m: float | None = None) -> BareBelt:
    return BareBelt(still_of(1), typed_m)


def fitted(measured: Measurements) -> DepthFit:
    made = correct_depth(measured)
    assert isinstance(made, DepthFit), made
    return made


def refused(measured: Measurements) -> DepthReason:
    made = correct_depth(measured)
    assert isinstance(made, DepthRefusal), made
    assert all(one.what and one.remedy for one in made.reasons)
    return made.reasons[0]


def errors_m(correction: DepthCorrection, z_m: float) -> F64:
    """Return how far corrected depths are off, from the middle of the picture to the height of its corner."""
    r2 = np.linspace(0.0, 0.4, 5)
    read = z_m * (1 + BIASED.scale_error + BIASED.radial_error * r2 / CORNER_R2) + BIASED.offset_m
    scales = correction.scale + correction.radial_2 * r2 + correction.radial_4 * r2**2
    return scales * read + correction.offset_m - z_m
