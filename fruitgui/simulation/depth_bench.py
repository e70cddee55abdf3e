"""One sensor over a belt with a board on a box, or a ball: what correcting its depth is measured with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fruitgui.simulation.body import Body
from fruitgui.simulation.device import raised
from fruitgui.simulation.fruit import ball
from fruitgui.simulation.kinect import DepthModel
from fruitgui.simulation.layouts import USUAL_HEIGHT_M
from fruitgui.simulation.light import make_light
from fruitgui.simulation.motion import constant
from fruitgui.simulation.setting import Conditions, make_setting
from fruitgui.simulation.simulation import Capture, Scene, Simulation
from fruitgui.simulation.surroundings import Block

BOARD_M = (0.40, 0.30)
"""A carton's lid."""

ORANGE, CARDBOARD = (0.93, 0.52, 0.10), (0.66, 0.52, 0.38)


def depth_bench(
    seed: int,
    rig_seed: int,
    model: DepthModel,
    *,
    board_height_m: float = 0.0,
    ball_m: float = 0.0,
    raised_m: float = 0.0,
    captures: int = 15,
    sensor_height_m: tuple[float, float] = USUAL_HEIGHT_M,
) -> Simulation:
    """Return a scene at rest of one sensor.

    Args:
        seed: of noise and light.
        rig_seed: of the sensor's place and of the belt.
        model: how its depth errs.
        board_height_m: of a board's upper side over the belt; 0 for none.
        ball_m: diameter of a ball on the belt; 0 for none.
        raised_m: the sensor was raised by so much from its place; 0 for not.
        captures: how many.
        sensor_height_m: range of the sensor's height above the belt.
    """
    conditions = Conditions(depth_model=model, fattening_px=model.fattening_px, noise_factor=1.0)
    setting = make_setting(rig_seed, "single", 0, True, conditions, sensor_height_m)
    surroundings, devices = setting.surroundings, setting.devices
    if raised_m > 0.0:
        devices = tuple(raised(device, raised_m, np.random.default_rng([seed, 12])) for device in devices)
    if board_height_m > 0.0:
        long_m, wide_m = BOARD_M[0] / 2, BOARD_M[1] / 2
        board = Block((-long_m, -wide_m, 0.0), (long_m, wide_m, board_height_m), CARDBOARD)
        surroundings = replace(surroundings, blocks=(*surroundings.blocks, board))
    bodies = (Body(1, "ball", ball(ball_m / 2, ORANGE), (0.0, 0.0), foreign=True),) if ball_m > 0.0 else ()
    turns = tuple(Capture((number + 0.5) / 10.0, devices[0].sensor) for number in range(captures))
    light = make_light(np.random.default_rng([seed, 0]), 500.0)
    return Simulation(Scene(seed, devices, surroundings, light, bodies, constant(0.0), turns))
