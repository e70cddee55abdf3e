"""A frozen sensor before which belt, box and ball can be laid, and that can be raised: its depth is measured so."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

from fruitgui.frame import Frame
from fruitgui.gui.shots.frozen import PERIOD_S, FrozenSensor, FrozenSource
from fruitgui.simulation.depth_bench import depth_bench
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.simulated import sensor_info
from fruitgui.station.depth_watch import Looked

SEED, RIG = 30, 21
CAPTURES = 6
BIASED = DepthModel(scale_error=0.012, offset_m=-0.009, radial_error=0.008, fattening_px=1.2)
BOX_M, BALL_M, RAISE_M = 0.20, 0.15, 0.30


@cache
def bench_frames(what: Looked) -> tuple[Frame, ...]:
    """Return what a biased sensor sees of a bare belt, a box, a ball, or the belt once it is raised."""
    scene = depth_bench(
        SEED + list(Looked).index(what), RIG, BIASED, board_height_m=BOX_M if what is Looked.BOARD else 0.0,
        ball_m=BALL_M if what is Looked.BALL else 0.0, raised_m=RAISE_M if what is Looked.RAISED else 0.0,
        captures=CAPTURES,
    )  # fmt: skip
    return tuple(scene.frames())


@cache
def bench_distance_m() -> float:
    """Return how far the belt is from the sensor, straight ahead."""
    plane = depth_bench(SEED, RIG, BIASED).rig().mounts["kinect_1"].surface.plane
    return -plane.offset_m / float(plane.normal[2])


@dataclass(frozen=True, slots=True)
class DepthBench:
    """One sensor as a source, and what lies before it."""

    source: FrozenSource

    def lay(self, what: Looked) -> None:
        """Lay something before the sensor, or nothing but the belt, from where it hangs or from higher."""
        self.source.sensors[0].frames = bench_frames(what)


def frozen_bench() -> DepthBench:
    """Return a bench with a bare belt."""
    info = replace(sensor_info(depth_bench(SEED, RIG, BIASED, captures=2), "kinect_1"), rate_hz=1.0 / PERIOD_S)
    return DepthBench(FrozenSource("bench", (FrozenSensor(info, bench_frames(Looked.BELT)),), "simulated"))
