"""How fast scenes are rendered."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from fruitgui.simulation import scenes

SEEN_M = 1.5
"""About as much belt does a Kinect see from 1 m."""


@dataclass(frozen=True, slots=True)
class RenderSpeed:
    """What rendering costs.

    Attributes:
        frames: rendered.
        fruit_in_view: mean number of things that a frame shows.
        frames_per_cpu_s: sensor frames per second of processor time.
        frame_ms: processor time of one frame, median.
    """

    frames: int
    fruit_in_view: float
    frames_per_cpu_s: float
    frame_ms: float


def render_speed(seed: int = 1, fruit: int = 20, frames: int = 20) -> RenderSpeed:
    """Render frames of a line with two opposed Kinects and about `fruit` pieces in view; setting up is not counted."""
    sim = scenes.line_scene(seed, 3 * fruit, per_metre=fruit / SEEN_M)
    middle = len(sim.captures) // 2 - frames // 2
    warm = len(sim.sensors)
    for number in range(middle - warm, middle):
        sim.frame(number)
    times_s, seen = [], []
    for number in range(middle, middle + frames):
        start_s = time.process_time()
        sim.frame(number)
        times_s.append(time.process_time() - start_s)
        capture = sim.captures[number]
        who = sim.eye(capture.sensor).who(sim.in_sight(capture))
        seen.append(len(np.unique(who[who >= 0])))
    return RenderSpeed(frames, float(np.mean(seen)), frames / sum(times_s), float(np.median(times_s)) * 1e3)
