"""Who the sensors of a scene are."""

from __future__ import annotations

import numpy as np

from fruitgui.sensors.sensor import ColorLock, SensorInfo
from fruitgui.simulation.simulation import Simulation


def sensor_info(sim: Simulation, sensor: str) -> SensorInfo:
    """Return who a sensor of a scene is."""
    device = sim.device(sensor)
    times_s = [capture.time_s for capture in sim.captures if capture.sensor == sensor]
    rate_hz = 1.0 / float(np.median(np.diff(times_s))) if len(times_s) > 1 else 0.0
    return SensorInfo(
        sensor,
        "fruitgui",
        "simulated Kinect v1",
        device.serial,
        device.color_camera,
        round(rate_hz, 1),
        color_lock=ColorLock.LOCKED,
    )
