"""A simulated rig that runs for ever: a line, a still scene for calibrating, or what else a person puts before it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum
from functools import cache

import numpy as np

from fruitgui.frame import Frame
from fruitgui.sensors.sensor import ColorLock, Projector, SensorInfo
from fruitgui.simulation.body import Body
from fruitgui.simulation.depth_bench import ORANGE
from fruitgui.simulation.device import Device, raised
from fruitgui.simulation.foreign import box_of
from fruitgui.simulation.fruit import ball
from fruitgui.simulation.light import make_light
from fruitgui.simulation.mesh import Mesh
from fruitgui.simulation.motion import SpeedProfile, constant
from fruitgui.simulation.scenes import sight_of, still_scene
from fruitgui.simulation.simulation import Capture, Scene, Simulation
from fruitgui.simulation.supply import BEFORE_SIGHT_M, LUX, LineOptions, has_left, supply

STILL_FRUIT, STILL_FRUIT_PER_SENSOR = 15, 8
_INSTANT_S = 1e-6

SHOWN_BOARD_M, SHOWN_BALL_M = (0.40, 0.30, 0.20), 0.20
"""A carton whose lid is level, and a ball: what a device's depth is measured with."""

SHOWN_RAISE_M = 0.30
"""So much higher sensors hang for the second height that depth is measured from."""

BOARD_NUMBER, BALL_NUMBER = -1_000_001, -1_000_002


class Showing(StrEnum):
    """What lies before the sensors; raised is a bare belt, seen from higher."""

    LINE = "line"
    PAUSED = "paused"
    STILL = "still"
    EMPTY = "empty"
    BOARD = "board"
    BALL = "ball"
    RAISED = "raised"


class Show:
    """Renders one capture after the other; the sensors take turns.

    Everything follows from the options and from what was shown at which capture: the same calls give the same frames.
    Stamps go on while the belt rests; the belt's own time, `belt_s`, does not.
    """

    def __init__(self, options: LineOptions) -> None:
        self._options = options
        self._setting = options.setting()
        self._sight_m = sight_of(self._setting)
        light = make_light(np.random.default_rng([options.rig_seed, 11]), LUX)
        devices, surroundings = self._setting.devices, self._setting.surroundings
        self._place = Simulation(Scene(options.seed, devices, surroundings, light, (), constant(0.0), ()))
        rng = np.random.default_rng([options.rig_seed, 12])
        higher = tuple(raised(device, SHOWN_RAISE_M, rng) for device in devices)
        self._higher = Simulation(replace(self._place.scene, devices=higher))
        self._supply = supply(options, self._setting)
        self._bodies: list[Body] = []
        self._more = True
        self._still: Sequence[Body] | None = None
        self._captures = 0
        self._last_s = 0.0
        self.showing = Showing.LINE
        self.belt_s = 0.0

    @property
    def place(self) -> Simulation:
        """The rig over an empty belt, with its truth."""
        return self._place

    @property
    def over(self) -> bool:
        """Whether all the fruit that were to come have come and gone; an endless line never is."""
        return self.showing is Showing.LINE and not self._more and not self._bodies

    def infos(self) -> list[SensorInfo]:
        """Return who the sensors are."""
        return [show_info(device, self._options) for device in self._setting.devices]

    def frame(self) -> Frame:
        """Return the next capture."""
        number, devices = self._captures, self._setting.devices
        self._captures += 1
        rng = np.random.default_rng([self._options.seed, 30, number])
        captures_hz = self._options.rate_hz * len(devices)
        time_s = (number + 0.5 + float(rng.uniform(-0.05, 0.05))) / captures_hz
        if self.showing is Showing.LINE:
            self.belt_s += time_s - self._last_s
        self._last_s = time_s
        device = devices[number % len(devices)]
        frame = self._scene(device, number).frame(0)
        return replace(frame, sequence=number // len(devices), time_s=time_s - device.clock_offset_s)

    def _scene(self, device: Device, number: int) -> Simulation:
        """Return a scene of one capture."""
        bodies, speed, at_s = self._before(self.showing)
        place = self._higher if self.showing is Showing.RAISED else self._place
        scene = place.scene
        seed = (scene.seed << 40) + number
        capture = Capture(at_s, device.sensor)
        return place.showing(replace(scene, seed=seed, bodies=tuple(bodies), speed=speed, captures=(capture,)))

    def _before(self, showing: Showing) -> tuple[Sequence[Body], SpeedProfile, float]:
        """Return what lies before the sensors, how the belt moves, and the time of the belt."""
        speed_m_s = self._options.speed_m_s
        if showing is Showing.LINE:
            return self._on_the_line(), constant(speed_m_s), self.belt_s
        if showing is Showing.PAUSED:
            stopped = (0.0, self.belt_s + _INSTANT_S, self.belt_s + 2 * _INSTANT_S)
            return (
                self._on_the_line(),
                SpeedProfile(stopped, (speed_m_s, speed_m_s, 0.0)),
                self.belt_s + 3 * _INSTANT_S,
            )
        return self._resting(showing), constant(0.0), 0.0

    def _resting(self, showing: Showing) -> Sequence[Body]:
        """Return what lies on a belt that rests."""
        if showing in (Showing.EMPTY, Showing.RAISED):
            return ()
        if showing is Showing.BOARD:
            return (Body(BOARD_NUMBER, "box", carton(), (0.0, 0.0), foreign=True),)
        if showing is Showing.BALL:
            return (Body(BALL_NUMBER, "ball", ball(SHOWN_BALL_M / 2, ORANGE), (0.0, 0.0), foreign=True),)
        return self._at_rest()

    def _on_the_line(self) -> list[Body]:
        """Return the bodies that are not yet past; more are supplied before they come into sight."""
        travel_m = self._options.speed_m_s * self.belt_s
        low_m, high_m = self._sight_m
        self._bodies = [body for body in self._bodies if not has_left(body, travel_m, high_m)]
        while self._more and all(body.start_m[0] + travel_m > low_m - BEFORE_SIGHT_M for body in self._bodies[-1:]):
            batch = next(self._supply, None)
            self._more = batch is not None
            self._bodies += batch or []
        return self._bodies

    def _at_rest(self) -> Sequence[Body]:
        """Return a still scene with good structure; its numbers are below zero, so that they are nobody else's."""
        if self._still is None:
            options, sensors = self._options, len(self._setting.devices)
            fruit = max(STILL_FRUIT, STILL_FRUIT_PER_SENSOR * sensors if options.layout == "chain" else 0)
            scene = still_scene(
                options.seed, options.layout, fruit, rig_seed=options.rig_seed, sensors=options.sensors
            ).scene
            self._still = [replace(body, fruit_id=-body.fruit_id) for body in scene.bodies]
        return self._still


@cache
def carton() -> Mesh:
    """Return the carton."""
    return box_of(np.array(SHOWN_BOARD_M), np.random.default_rng(0))


def show_info(device: Device, options: LineOptions) -> SensorInfo:
    """Return who a sensor of the show is."""
    camera = device.color_camera
    return SensorInfo(
        device.sensor,
        "fruitgui",
        "simulated Kinect v1",
        device.serial,
        camera,
        options.rate_hz,
        Projector.SWITCHED if options.settling_s > 0.0 else Projector.HARMLESS,
        color_lock=ColorLock.LOCKED,
    )
