"""How fast scenes are rendered."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from fruitgui.simulation import scenes


@dataclass(frozen=True, slots=True)
class RenderSpeed:
    """What rendering costs.

    Attributes:
        frames: rendered.
        fruit_in_view: mean number of things in a frame's sight.
        frames_per_cpu_s: sensor frames per second of processor time.
        frame_ms: processor time of one frame, median.
    """

    frames: int
    fruit_in_view: float
    frames_per_cpu_s: float
    frame_ms: float


def render_speed(seed: int = 1, fruit: int = 20, frames: int = 20) -> RenderSpeed:
    """Render frames of a still scene with two opposed Kinects and `fruit` pieces in view; setting up is not counted."""
    sim = scenes.still_scene(seed, fruit=fruit, captures=(frames + 1) // 2 + 1)
    warm = len(sim.sensors)
    for number in range(warm):
        sim.frame(number)
    times_s, seen = [], []
    for number in range(warm, warm + frames):
        start_s = time.process_time()
        sim.frame(number)
        times_s.append(time.process_time() - start_s)
        seen.append(len(sim.in_sight(sim.captures[number])))
    return RenderSpeed(frames, float(np.mean(seen)), frames / sum(times_s), float(np.median(times_s)) * 1e3)
