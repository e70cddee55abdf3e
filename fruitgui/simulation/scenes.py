"""Ready scenes, each made from seeds: still ones for calibration, lines that run.

`rig_seed` decides the rig and its place (poses, each device's errors, belt,
rails); `seed` decides what lies on the belt, where, how it moves, light and
noise. Scenes with the same rig seed are the same station on other days.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.random import Generator

from fruitgui.simulation.body import Body
from fruitgui.simulation.device import Device
from fruitgui.simulation.fruit import KINDS, ball
from fruitgui.simulation.layouts import USUAL_HEIGHT_M
from fruitgui.simulation.light import make_light
from fruitgui.simulation.motion import SpeedProfile, constant
from fruitgui.simulation.packing import clusters, scatter, stream
from fruitgui.simulation.setting import USUAL, Conditions, Setting, make_setting
from fruitgui.simulation.simulation import Capture, Scene, Simulation, sight_along_belt
from fruitgui.simulation.stock import STRANGE, begun, made_restless, mixed, numbered, shoved

__all__ = [
    "USUAL",
    "Conditions",
    "bare_belt",
    "line_scene",
    "placement_scene",
    "sight_of",
    "sphere_scene",
    "still_scene",
]

PITCH_M = 0.11
"""Between the middles of neighbours in a row or grid of equal spheres."""


def still_scene(
    seed: int,
    layout: str = "opposed",
    fruit: int = 15,
    *,
    rig_seed: int | None = None,
    sensors: int = 0,
    captures: int = 5,
    with_rails: bool = True,
    kinds: Sequence[str] = KINDS,
    touching: float = 0.0,
    foreign: int = 0,
    moved_m: float = 0.0,
    height_m: tuple[float, float] = USUAL_HEIGHT_M,
    foreign_kinds: Sequence[str] = STRANGE,
    conditions: Conditions = USUAL,
) -> Simulation:
    """Return a scene at rest.

    Args:
        seed: of all chance but the rig's.
        layout: one of `layouts.LAYOUTS`.
        fruit: how many pieces; as many as fit are laid out.
        rig_seed: of the rig; `seed` where not given.
        sensors: how many, 0 for the layout's own number.
        captures: of each sensor.
        with_rails: rails beside the belt.
        kinds: drawn from.
        touching: share of fruit that touch another.
        foreign: how many foreign objects lie among them.
        moved_m: someone shoves two thirds of the things by about this much between the sensors' captures.
        height_m: range of the sensors' heights above the belt.
        foreign_kinds: foreign objects are drawn from these; may name fruit that nobody trains.
        conditions: light and sensors.
    """
    rng = np.random.default_rng([seed, 0])
    setting = make_setting(seed if rig_seed is None else rig_seed, layout, sensors, with_rails, conditions, height_m)
    groups = clusters(mixed(rng, fruit, kinds, foreign, foreign_kinds), touching, rng)
    bodies = numbered(scatter(groups, *_looked_at(setting), rng))
    if moved_m:
        bodies = shoved(bodies, moved_m, captures * len(setting.devices) * 0.05, rng)
    return _still(seed, rng, setting, bodies, captures, conditions)


def placement_scene(seed: int, *, captures: int = 5, conditions: Conditions = USUAL) -> Simulation:
    """Return a scene for calibrating, of a kind drawn by the seed.

    An opposed pair, a chain of three or a ring of four, 0.7–1.6 m high, rails
    beside the belt, 9–26 pieces of fruit (15–26 along a chain, which is longer).
    """
    rng = np.random.default_rng([seed, 5])
    layout = ("opposed", "chain", "ring")[seed % 3]
    fruit = int(rng.integers(15 if layout == "chain" else 9, 27))
    return still_scene(seed, layout, fruit, captures=captures, height_m=(0.7, 1.6), conditions=conditions)


def bare_belt(
    seed: int,
    layout: str = "opposed",
    *,
    captures: int = 5,
    height_m: tuple[float, float] = USUAL_HEIGHT_M,
    conditions: Conditions = USUAL,
) -> Simulation:
    """Return an empty belt at rest: nothing to register by. Arguments as of `still_scene`."""
    return still_scene(seed, layout, 0, captures=captures, height_m=height_m, conditions=conditions)


def sphere_scene(
    seed: int,
    pattern: str = "row",
    *,
    count: int = 7,
    captures: int = 5,
    conditions: Conditions = USUAL,
) -> Simulation:
    """Return equal spheres at equal distances, in a "row" of `count` or a "grid" of `count` by 4, at rest."""
    rng = np.random.default_rng([seed, 0])
    setting = make_setting(seed, "opposed", 0, True, conditions)
    sphere = ball(0.035, (0.93, 0.52, 0.10))
    rows = 1 if pattern == "row" else 4
    places = [(i - (count - 1) / 2, j - (rows - 1) / 2) for i in range(count) for j in range(rows)]
    bodies = [Body(n + 1, "orange", sphere, (x * PITCH_M, y * PITCH_M)) for n, (x, y) in enumerate(places)]
    return _still(seed, rng, setting, bodies, captures, conditions)


def line_scene(
    seed: int,
    fruit: int = 60,
    speed_m_s: float = 0.1,
    touching: float = 0.0,
    foreign: int = 0,
    *,
    rig_seed: int | None = None,
    layout: str = "opposed",
    sensors: int = 0,
    kinds: Sequence[str] = KINDS,
    speed: SpeedProfile | None = None,
    per_metre: float = 14.0,
    captures_hz: float = 10.0,
    restless: float = 0.35,
    foreign_kinds: Sequence[str] = STRANGE,
    silent: Sequence[tuple[int, float, float]] = (),
    conditions: Conditions = USUAL,
) -> Simulation:
    """Return a line that runs from before its first fruit comes into sight until its last has left.

    Args:
        seed: of all chance but the rig's.
        fruit: how many pieces.
        speed_m_s: of the belt, unless `speed` is given.
        touching: share of fruit that touch another.
        foreign: how many foreign objects come among them.
        rig_seed: of the rig; `seed` where not given.
        layout: one of `layouts.LAYOUTS`.
        sensors: how many, 0 for the layout's own number.
        kinds: drawn from.
        speed: the belt's speed over time.
        per_metre: pieces per metre of belt.
        captures_hz: of all sensors together; they take turns.
        restless: share of pieces that rock, roll a little or slide.
        foreign_kinds: foreign objects are drawn from these; may name fruit that nobody trains.
        silent: (number of the sensor from 0, from, to): spans in which a sensor gives nothing, seconds.
        conditions: light and sensors.
    """
    rng = np.random.default_rng([seed, 0])
    profile = speed or constant(speed_m_s)
    setting = make_setting(seed if rig_seed is None else rig_seed, layout, sensors, True, conditions)
    setting = replace(setting, devices=_silenced(setting.devices, silent))
    half_m = setting.surroundings.belt.width_m / 2
    bodies = [
        made_restless(body, rng) if rng.random() < restless else body
        for body in mixed(rng, fruit, kinds, foreign, foreign_kinds)
    ]
    laid = stream(clusters(bodies, touching, rng, half_m - 0.01), half_m, per_metre, rng)
    low_m, high_m = sight_of(setting)
    before_m = low_m - 0.25 - max(body.start_m[0] for body in laid)
    laid = numbered([body.at((body.start_m[0] + before_m, body.start_m[1])) for body in laid])
    laid = [begun(body, profile, low_m, high_m, rng) for body in laid]
    end_s = profile.time_at(high_m + 0.25 - min(body.start_m[0] for body in laid))
    turns = take_turns(setting.devices, end_s, captures_hz, rng)
    light = make_light(rng, conditions.lux)
    return Simulation(Scene(seed, setting.devices, setting.surroundings, light, tuple(laid), profile, turns))


def take_turns(devices: Sequence[Device], end_s: float, captures_hz: float, rng: Generator) -> tuple[Capture, ...]:
    """Return captures one after the other, one projector at a time, with the jitter of a real schedule."""
    captures = []
    for number in range(int(end_s * captures_hz)):
        device = devices[number % len(devices)]
        time_s = (number + 0.5 + rng.uniform(-0.05, 0.05)) / captures_hz
        lost = rng.random() < device.drop_share or any(start <= time_s < end for start, end in device.silent_s)
        if not lost:
            captures.append(Capture(float(time_s), device.sensor))
    return tuple(captures)


def _still(
    seed: int, rng: Generator, setting: Setting, bodies: Sequence[Body], captures: int, conditions: Conditions
) -> Simulation:
    turns = take_turns(setting.devices, captures * len(setting.devices) * 0.1, 10.0, rng)
    light = make_light(rng, conditions.lux)
    return Simulation(Scene(seed, setting.devices, setting.surroundings, light, tuple(bodies), constant(0.0), turns))


def _silenced(devices: Sequence[Device], silent: Sequence[tuple[int, float, float]]) -> tuple[Device, ...]:
    spans = [tuple((start, end) for which, start, end in silent if which == number) for number in range(len(devices))]
    return tuple(replace(device, silent_s=span) for device, span in zip(devices, spans, strict=True))


def sight_of(setting: Setting) -> tuple[float, float]:
    """Return the smallest and largest x of the world that any sensor sees of the belt."""
    still = Simulation(
        Scene(0, setting.devices, setting.surroundings, make_light(np.random.default_rng(0)), (), constant(0.0), ())
    )
    sights = [sight_along_belt(still.rig_mount(device.sensor), device) for device in setting.devices]
    return min(sight[0] for sight in sights), max(sight[1] for sight in sights)


def _looked_at(setting: Setting) -> tuple[np.ndarray, np.ndarray]:
    """Return the rectangle (low, high) of belt at which the sensors look."""
    along = []
    for device in setting.devices:
        place, axis = device.pose.translation_m, device.pose.rotation[:, 2]
        along.append(float((place - axis * place[2] / axis[2])[0]))
    half = setting.surroundings.belt.width_m / 2
    return np.array([min(along) - 0.42, -half]), np.array([max(along) + 0.42, half])
