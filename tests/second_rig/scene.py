"""Who takes part: sensors, things on the belt, and how the belt moves."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from tests.second_rig.bodies import F64
from tests.second_rig.camera import KINECT, Lens, Stand
from tests.second_rig.kinect import Noise
from tests.second_rig.produce import Thing
from tests.second_rig.setting import Setting


@dataclass(frozen=True, slots=True, eq=False)
class Actor:
    """One thing on the belt.

    Attributes:
        number: its id in the truth.
        rotation: body → world. origin_m: place of the body's origin when the belt has moved by 0.
        rock_rad, rock_hz: small rocking about the line of the belt.
    """

    number: int
    thing: Thing
    rotation: F64
    origin_m: F64
    rock_rad: float = 0.0
    rock_hz: float = 0.7

    def turned(self, time_s: float) -> F64:
        """Return body → world at a time."""
        if not self.rock_rad:
            return self.rotation
        angle = self.rock_rad * np.sin(2.0 * np.pi * self.rock_hz * time_s + self.number)
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]) @ self.rotation


@dataclass(frozen=True, slots=True)
class Drive:
    """How far the belt has moved: speeds (m/s) that hold from their times (s) on, with ramps of `ramp_s`."""

    times_s: tuple[float, ...] = (0.0,)
    speeds_m_s: tuple[float, ...] = (0.0,)
    ramp_s: float = 0.3

    def travel_m(self, time_s: float) -> float:
        """Return the integral of the speed."""
        done = self.speeds_m_s[0] * (time_s - self.times_s[0])
        for since, before, after in zip(self.times_s[1:], self.speeds_m_s, self.speeds_m_s[1:], strict=False):
            late = max(time_s - since, 0.0)
            ramped = min(late, self.ramp_s)
            done += (after - before) * (ramped**2 / (2.0 * self.ramp_s) + late - ramped)
        return done


@dataclass(frozen=True, slots=True, eq=False)
class Eye:
    """One sensor: where it stands, what it sees through, how it errs, when it captures.

    Attributes:
        first_s, period_s: time of its first capture and between captures.
        clock_s: what its clock shows more than the true time.
        silent_s: spans of true time without captures.
        depth_in_own_camera: depth comes unregistered, from a camera 25 mm aside.
    """

    name: str
    stand: Stand
    lens: Lens = KINECT
    noise: Noise = field(default_factory=Noise)
    first_s: float = 0.0
    period_s: float = 0.2
    clock_s: float = 0.0
    silent_s: tuple[tuple[float, float], ...] = ()
    depth_in_own_camera: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """A whole story.

    Attributes:
        light_lx: light on the belt, 100–1000.
        shoves: (time_s, sensor, dx, dy, dz) jumps of a sensor's stand, for a rig that is bumped.
    """

    seed: int
    setting: Setting
    eyes: tuple[Eye, ...]
    actors: tuple[Actor, ...]
    seconds: float
    drive: Drive = Drive()
    light_lx: float = 400.0
    shoves: tuple[tuple[float, str, float, float, float], ...] = ()
    stirs: tuple[tuple[float, int, float, float], ...] = ()
    start_s: float = 1_700_000_000.0

    def captures(self) -> list[tuple[float, int, Eye]]:
        """Return (true time since the start, sequence, sensor) of every capture, in order of time."""
        found = []
        for eye in self.eyes:
            for n in range(int((self.seconds - eye.first_s) / eye.period_s) + 1):
                time = eye.first_s + n * eye.period_s
                if time < self.seconds and not any(a <= time < b for a, b in eye.silent_s):
                    found.append((time, n, eye))
        return sorted(found, key=lambda item: item[0])

    def stamp_s(self, eye: Eye, time_s: float) -> float:
        """Return the stamp that a sensor gives to a true time."""
        return self.start_s + time_s + eye.clock_s

    def stand_at(self, eye: Eye, time_s: float) -> Stand:
        """Return where a sensor stands at a time."""
        moved = np.array(eye.stand.centre_m)
        for since, name, *shift in self.shoves:
            if name == eye.name and time_s >= since:
                moved = moved + shift
        return Stand(eye.stand.rotation, moved)

    def origin_m(self, actor: Actor, time_s: float) -> F64:
        """Return the place of an actor's origin in the world."""
        place = actor.origin_m + np.array([self.drive.travel_m(time_s), 0.0, 0.0])
        for since, number, dx, dy in self.stirs:
            if number == actor.number and time_s >= since:
                place = place + np.array([dx, dy, 0.0])
        return np.asarray(place)

    def centre_m(self, actor: Actor, time_s: float) -> F64:
        """Return the place of an actor's centre of volume in the world."""
        return np.asarray(self.origin_m(actor, time_s) + actor.turned(time_s) @ actor.thing.truth.centre_m)


def lay(number: int, thing: Thing, x_m: float, y_m: float, rng: np.random.Generator, rock_rad: float = 0.0) -> Actor:
    """Set a thing down on the belt so that it touches it, its centre over x, y."""
    rotation = _resting(thing, rng)
    offset = rotation @ thing.truth.centre_m
    lowest = float((thing.body.surface_m @ rotation.T)[:, 2].min())
    return Actor(number, thing, rotation, np.array([x_m - offset[0], y_m - offset[1], -lowest]), rock_rad)


def _resting(thing: Thing, rng: np.random.Generator) -> F64:
    """Return a heading at random and the lean at which the centre lies lowest (long things), or a small lean."""
    if not thing.lies:
        flat = thing.kind in ("hand", "leaf", "box", "glove", "twig", "banana", "fingers", "sheet")
        return _spin(rng.uniform(0.0, 2.0 * np.pi)) @ _lean(0.0 if flat else rng.normal(0.0, 0.35))
    heading, own = _spin(rng.uniform(0.0, 2.0 * np.pi)), _spin(rng.uniform(0.0, 2.0 * np.pi))
    leans = np.pi / 2 + np.radians(np.arange(-24.0, 25.0, 2.0))
    turns = [_lean(float(angle)) @ own for angle in leans]
    centre, surface = thing.truth.centre_m, thing.body.surface_m
    heights = [float(turn[2] @ centre - (surface @ turn[2]).min()) for turn in turns]
    return heading @ turns[int(np.argmin(heights))]


def _spin(angle: float) -> F64:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def _lean(angle: float) -> F64:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
