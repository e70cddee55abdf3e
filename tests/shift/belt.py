"""A belt with balls on it for ever, as two Kinects above it see it: cheap enough for hours, and the truth is known."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fruitgui.frame import F64, U8, U16, Bools, Intrinsics
from fruitgui.geometry.plane import Plane, Surface
from fruitgui.geometry.pose import Pose
from fruitgui.sensors.kinect.depth_table import ZeroPlane
from fruitgui.station.station import Station, StationSensor
from tests.emulated_usb.factory_made import registration_bytes

HEIGHT_M = 0.85
SPEED_M_S = 0.12
SPACING_S = 2.5
"""From one ball to the next."""

ENTRY_M = -0.9
"""Where a ball is at the time that is called its own; nobody sees so far."""

SENSORS_M = (-0.06, 0.06)
"""Where the sensors stand along the belt; the first is the reference."""

WHOLE_TO_M = 0.3
"""While a ball is so far from the middle along the belt, both sensors see it whole."""

COLORS = ((200, 60, 40), (60, 170, 50), (210, 180, 50))
_BELT, _NOISE_PICTURES = 70, 8
PLANE = ZeroPlane()
INFRARED = Intrinsics(640, 480, PLANE.focal_px, PLANE.focal_px, 319.5, 239.5)
COLOR = Intrinsics(640, 480, 525.0, 525.0, 319.5, 239.5)
APART_M = 0.024 * PLANE.focal_px / COLOR.fx
"""From the infrared camera to the colour camera."""

FACTORY = registration_bytes(COLOR.fx, (COLOR.cx, COLOR.cy), 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Ball:
    """One ball.

    Attributes:
        number: from 0. time_s: when it is at `ENTRY_M`. y_m: across the belt. radius_m, color: of it.
    """

    number: int
    time_s: float
    y_m: float
    radius_m: float
    color: tuple[int, int, int]

    def x_m(self, time_s: float) -> float:
        """Return where along the belt it is."""
        return ENTRY_M + SPEED_M_S * (time_s - self.time_s)


@lru_cache(maxsize=512)
def ball(number: int, seed: int) -> Ball:
    """Return one of the balls."""
    rng = np.random.default_rng([seed, 40, number])
    y_m, radius_m = float(rng.uniform(-0.12, 0.12)), float(rng.uniform(0.027, 0.04))
    return Ball(number, number * SPACING_S, y_m, radius_m, COLORS[int(rng.integers(len(COLORS)))])


class Belt:
    """What the Kinects see. A `Scene` of the player; time is seconds since the player began.

    Args:
        seed: of the balls.
        well: tells whether a Kinect is to give at a time what it sees; what others give, nobody is held to.

    Attributes:
        pictured: of each Kinect, how often it took a picture of a ball that both see whole, by the ball's number.
    """

    def __init__(self, seed: int, well: Callable[[int, float], bool] = lambda _kinect, _time_s: True) -> None:
        self._seed = seed
        self._well = well
        self.pictured: tuple[Counter[int], ...] = tuple(Counter() for _ in SENSORS_M)
        rng = np.random.default_rng([seed, 41])
        self._raw = [
            (raw_of(np.full((480, 640), HEIGHT_M)) + rng.normal(0.0, 0.7, (480, 640)).round()).astype(np.uint16)
            for _ in range(_NOISE_PICTURES)
        ]
        self._bayer = rng.integers(_BELT - 3, _BELT + 4, (480, 640)).astype(np.uint8)

    def __call__(self, kinect: int, time_s: float) -> tuple[U16, U8]:
        """Return raw depth and the colour camera's raw pixels."""
        raw, bayer = self._raw[round(time_s * 30.0) % _NOISE_PICTURES].copy(), self._bayer.copy()
        last, well = int(time_s / SPACING_S), self._well(kinect, time_s)
        for number in range(max(last - 8, 0), last + 1):
            one = ball(number, self._seed)
            self._paint(one, kinect, time_s, raw, bayer)
            self.pictured[kinect][number] += well and abs(one.x_m(time_s)) < WHOLE_TO_M
        return raw, bayer

    def _paint(self, one: Ball, kinect: int, time_s: float, raw: U16, bayer: U8) -> None:
        centre = np.array([one.x_m(time_s) - SENSORS_M[kinect], one.y_m, HEIGHT_M - one.radius_m])
        window, depth_m, hit = _sphere(INFRARED, centre + np.array([APART_M, 0.0, 0.0]), one.radius_m)
        if hit.any():
            raw[window][hit] = raw_of(depth_m[hit])
        window, _, hit = _sphere(COLOR, centre, one.radius_m)
        if hit.any():
            bayer[window][hit] = _mosaic(one.color)[window][hit]


def raw_of(depth_m: F64) -> U16:
    """Return the raw value that stands for a depth."""
    shift_cm = PLANE.emitter_cm * (1.0 - PLANE.reference_cm / (100.0 * depth_m))
    raw = 4.0 * (shift_cm / PLANE.pixel_cm + PLANE.const_shift_px + 0.375)
    return np.rint(raw).astype(np.uint16)


def _sphere(camera: Intrinsics, centre: F64, radius_m: float) -> tuple[tuple[slice, slice], F64, Bools]:
    """Return the window of the picture with a sphere, the depth of its front there, and where it is hit."""
    reach = 1.2 * radius_m / (centre[2] - radius_m)
    u, v = camera.fx * centre[0] / centre[2] + camera.cx, camera.fy * centre[1] / centre[2] + camera.cy
    columns = slice(*np.clip([int(u - reach * camera.fx), int(u + reach * camera.fx) + 2], 0, 640))
    rows = slice(*np.clip([int(v - reach * camera.fy), int(v + reach * camera.fy) + 2], 0, 480))
    rays = camera.rays()[rows, columns].astype(np.float64)
    x, y = rays[..., 0], rays[..., 1]
    along = x * centre[0] + y * centre[1] + centre[2]
    length2 = x * x + y * y + 1.0
    left = along**2 - length2 * (centre @ centre - radius_m**2)
    hit = left > 0.0
    return (rows, columns), (along - np.sqrt(np.maximum(left, 0.0))) / length2, hit


@lru_cache(maxsize=8)
def _mosaic(color: tuple[int, int, int]) -> U8:
    red, green, blue = color
    mosaic = np.full((480, 640), green, np.uint8)
    mosaic[0::2, 1::2], mosaic[1::2, 0::2] = red, blue
    return mosaic


def station(names: tuple[str, ...], serials: tuple[str, ...]) -> Station:
    """Return the station of the two sensors, in the reference sensor's frame; the belt runs along x."""
    surface = Surface(
        Plane(np.array([0.0, 0.0, -1.0]), HEIGHT_M),
        np.array([[x, y, HEIGHT_M] for x, y in ((-0.45, -0.2), (0.45, -0.2), (0.45, 0.2), (-0.45, 0.2))]),
    )
    sensors = {
        name: StationSensor(
            serial, Pose(np.eye(3), np.array([at_m - SENSORS_M[0], 0.0, 0.0]), np.zeros((6, 6))), surface
        )
        for name, serial, at_m in zip(names, serials, SENSORS_M, strict=True)
    }
    return Station(names[0], sensors, np.array([SPEED_M_S, 0.0, 0.0]))
