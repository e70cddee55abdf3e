"""How the belt and the fruit on it move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64
from fruitgui.geometry.rotation import rotation_from_vector


@dataclass(frozen=True, slots=True)
class SpeedProfile:
    """The belt's speed over time, linear between knots, constant before the first and after the last.

    Attributes:
        times_s: of the knots, increasing, at least one.
        speeds_m_s: at the knots.
    """

    times_s: tuple[float, ...]
    speeds_m_s: tuple[float, ...]

    def speed_m_s(self, time_s: float) -> float:
        """Return the speed at a time."""
        return float(np.interp(time_s, self.times_s, self.speeds_m_s))

    def travel_m(self, time_s: float) -> float:
        """Return how far the belt has moved since time 0 (exact integral of the speed)."""
        return self._since_first(time_s) - self._since_first(0.0)

    def time_at(self, travel_m: float, latest_s: float = 3600.0) -> float:
        """Return the first time from 0 on at which the belt has moved `travel_m`, at most `latest_s`."""
        low, high = 0.0, latest_s
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.travel_m(middle) < travel_m else (low, middle)
        return high

    def _since_first(self, time_s: float) -> float:
        times, speeds = np.array(self.times_s), np.array(self.speeds_m_s)
        if time_s <= times[0]:
            return float((time_s - times[0]) * speeds[0])
        inside = np.append(times[times < time_s], time_s)
        values = np.interp(inside, times, speeds)
        return float(np.sum(np.diff(inside) * (values[1:] + values[:-1]) / 2))


def constant(speed_m_s: float) -> SpeedProfile:
    """Return a belt that runs at one speed."""
    return SpeedProfile((0.0,), (speed_m_s,))


def stop_and_start(speed_m_s: float, stop_s: float, rest_s: float, ramp_s: float = 0.4) -> SpeedProfile:
    """Return a belt that stops at `stop_s`, rests and starts again, each within `ramp_s`."""
    start_s = stop_s + ramp_s + rest_s
    return SpeedProfile(
        (0.0, stop_s, stop_s + ramp_s, start_s, start_s + ramp_s), (speed_m_s, speed_m_s, 0.0, 0.0, speed_m_s)
    )


def change(speed_m_s: float, then_m_s: float, at_s: float, ramp_s: float = 0.5) -> SpeedProfile:
    """Return a belt whose speed changes once."""
    return SpeedProfile((0.0, at_s, at_s + ramp_s), (speed_m_s, speed_m_s, then_m_s))


@dataclass(frozen=True, slots=True)
class Wobble:
    """A fruit's own motion on the belt, beside being carried.

    Attributes:
        axis_rad: heading of the horizontal axis about which it rocks and rolls.
        rock_rad, rock_hz, decay_s: amplitude, frequency and time of decay of rocking after `start_s`.
        roll_rad, roll_s: angle rolled, smoothly, within `roll_s` after `start_s`; it moves as it rolls.
        slide_m: (x, y) slid on the belt within `roll_s` after `start_s`.
        start_s: when it begins.
    """

    axis_rad: float = 0.0
    rock_rad: float = 0.0
    rock_hz: float = 1.5
    decay_s: float = 3.0
    roll_rad: float = 0.0
    roll_s: float = 1.0
    slide_m: tuple[float, float] = (0.0, 0.0)
    start_s: float = 0.0

    def turn_rad(self, time_s: float) -> float:
        """Return the angle turned about the axis at a time."""
        since = time_s - self.start_s
        if since <= 0:
            return 0.0
        rock = self.rock_rad * np.exp(-since / self.decay_s) * np.sin(2 * np.pi * self.rock_hz * since)
        return float(rock + self.roll_rad * smooth_step(since / self.roll_s))

    def moved_m(self, time_s: float, rolling_radius_m: float) -> F64:
        """Return how far (x, y) it has moved on the belt by rolling and sliding."""
        roll = self.turn_rad(time_s) * rolling_radius_m
        forward = np.array([np.sin(self.axis_rad), -np.cos(self.axis_rad)])
        slide = np.array(self.slide_m) * smooth_step((time_s - self.start_s) / self.roll_s)
        return np.asarray(forward * roll + slide)

    def rotation(self, time_s: float) -> F64:
        """Return the rotation (3, 3) from the resting orientation."""
        axis = np.array([np.cos(self.axis_rad), np.sin(self.axis_rad), 0.0])
        return rotation_from_vector(axis * self.turn_rad(time_s))


AT_REST = Wobble()
"""No motion of its own."""


def smooth_step(share: float) -> float:
    """Return 0 below 0, 1 above 1, and a smooth rise between (3s² − 2s³)."""
    inside = min(max(share, 0.0), 1.0)
    return inside * inside * (3 - 2 * inside)
