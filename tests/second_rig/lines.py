"""Moving lines: fruit that pass two opposed sensors, alone or touching, with foreign things among them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from tests.second_rig.bodies import F64
from tests.second_rig.camera import KINECT, Lens, Stand, aim
from tests.second_rig.kinect import Noise
from tests.second_rig.produce import FOREIGN, KINDS, Thing, grow
from tests.second_rig.scene import Actor, Drive, Eye, Scene, lay
from tests.second_rig.setting import Setting
from tests.second_rig.stills import furnish, scatter

LEAD_M = 0.95
"""How far before the middle the first thing starts and behind it the last one ends: out of every picture."""


@dataclass(frozen=True, slots=True)
class LinePlan:
    """What passes, and how.

    Attributes:
        touching: share of the fruit that touch another.
        light_lx: light of the run. rock_rad: rocking of every fruit.
        silent_s: span without captures of the second sensor, from the middle of the run.
        stop_s: how long the belt stands still halfway; the speed after it is 0.7 of that before.
        mingling: share of foreign things that touch what comes before them, be it fruit or not.
        clock_s: what the second sensor's clock shows more.
        rig: seed of the sensors' places and the belt (shared by training and running).
        grain: how strongly the belt's texture shows; None for the rig's own.
    """

    fruit: int = 60
    speed_m_s: float = 0.1
    touching: float = 0.0
    foreign: int = 0
    light_lx: float = 400.0
    rock_rad: float = 0.0
    silent_s: float = 0.0
    stop_s: float = 0.0
    clock_s: float = 0.0
    rig: int = 0
    grain: float | None = None
    lens: Lens = KINECT
    noises: tuple[Noise, Noise] = (Noise(), Noise())
    foreign_kinds: tuple[str, ...] = FOREIGN
    mingling: float = 0.0


def line(seed: int, plan: LinePlan) -> Scene:
    """Return a line of fruit, kinds in equal parts, in random order."""
    rng = np.random.default_rng([seed, 3])
    setting, stands = rig(plan.rig, plan.grain)
    kinds = [KINDS[n % len(KINDS)] for n in range(plan.fruit)]
    kinds += [plan.foreign_kinds[n % len(plan.foreign_kinds)] for n in range(plan.foreign)]
    things = [grow(str(kind), rng) for kind in rng.permutation(kinds)]
    half_m = setting.width_m / 2 - 0.02
    actors, tail_m = queue(things, half_m, plan.touching, plan.rock_rad, rng, plan.mingling)
    drive, seconds = _drive(plan, 2 * LEAD_M + tail_m)
    silent = ((seconds / 2 - plan.silent_s / 2, seconds / 2 + plan.silent_s / 2),) if plan.silent_s else ()
    eyes = (
        Eye("east", stands[0], plan.lens, plan.noises[0], 0.0, 0.2),
        Eye("west", stands[1], plan.lens, plan.noises[1], 0.1, 0.2, plan.clock_s, silent),
    )
    return Scene(seed, setting, eyes, actors, seconds, drive, plan.light_lx)


def at_rest(seed: int, plan: LinePlan, captures: int = 8) -> Scene:
    """Return the same rig's belt standing still with fruit scattered on it, to calibrate by."""
    rng = np.random.default_rng([seed, 6])
    setting, stands = rig(plan.rig, plan.grain)
    things = [grow(KINDS[n % len(KINDS)], rng) for n in range(14)]
    actors = scatter(things, np.zeros(2), np.array([0.32, setting.width_m / 2 - 0.06]), rng)
    eyes = tuple(
        Eye(name, stand, plan.lens, noise, first_s, 0.2)
        for name, stand, noise, first_s in zip(("east", "west"), stands, plan.noises, (0.0, 0.1), strict=True)
    )
    return Scene(seed, setting, eyes, actors, 0.2 * captures, light_lx=plan.light_lx)


def rig(seed: int, grain: float | None = None) -> tuple[Setting, tuple[Stand, Stand]]:
    """Return a belt and two opposed stands about 1.1 m from its middle."""
    rng = np.random.default_rng([seed, 4])
    setting = furnish(rng)
    setting = setting if grain is None else replace(setting, grain=grain)
    stands = []
    for side in (1.0, -1.0):
        angle = side * np.pi / 2 + rng.normal(0.0, 0.12)
        aside, height = rng.uniform(0.4, 0.65), rng.uniform(0.85, 1.1)
        centre = np.array([aside * np.cos(angle), aside * np.sin(angle), height])
        target = np.append(rng.normal(0.0, 0.03, 2), 0.02)
        stands.append(aim(centre, target, float(np.radians(rng.normal(0.0, 4.0)))))
    return setting, (stands[0], stands[1])


def queue(things: list[Thing], half_m: float, touching: float, rock_rad: float,
          rng: np.random.Generator, mingling: float = 0.0) -> tuple[tuple[Actor, ...], float]:  # fmt: skip
    """Lay things one behind another in up to three lanes; return them and the length of the line."""
    actors: list[Actor] = []
    front = -LEAD_M
    for number, thing in enumerate(things):
        reach = thing.body.radius_m
        room = max(half_m - reach, 0.0)
        pair = bool(actors) and actors[-1].thing.kind in KINDS and thing.kind in KINDS
        mingles = mingling > 0.0 and bool(actors) and thing.kind not in KINDS and rng.random() < mingling
        if mingles or (pair and number % 2 and rng.random() < touching):
            actors.append(_nestle(number, thing, actors[-1], actors[:-1], room, rng, rock_rad))
            continue
        y = float(rng.uniform(-room, room))
        x = front + 0.03
        while _crowded(x, y, reach, actors[-12:], 0.012):
            x -= 0.004
        actors.append(lay(number, thing, x, y, rng, rock_rad))
        front = min(front, x + 0.05)
    tail = max(-LEAD_M - min(float(a.origin_m[0]) for a in actors), 0.0)
    return tuple(actors), tail


def _crowded(x: float, y: float, reach: float, others: list[Actor], gap_m: float) -> bool:
    return any(float(np.hypot(x - a.origin_m[0], y - a.origin_m[1])) < reach + a.thing.body.radius_m + gap_m
               for a in others)  # fmt: skip


def _nestle(number: int, thing: Thing, mate: Actor, others: list[Actor], room: float, rng: np.random.Generator,
            rock_rad: float) -> Actor:  # fmt: skip
    """Lay a thing so that it just touches `mate`, in a direction that is free."""
    fallback: Actor | None = None
    for _ in range(40):
        heading = rng.uniform(0.6 * np.pi, 1.4 * np.pi)
        way = np.array([np.cos(heading), np.sin(heading)])
        near, far = 0.0, thing.body.radius_m + mate.thing.body.radius_m + 0.02
        trial = lay(number, thing, float(mate.origin_m[0]), float(mate.origin_m[1]), rng, rock_rad)
        for _ in range(14):
            middle = (near + far) / 2
            moved = _shifted(trial, mate, way * middle)
            near, far = (middle, far) if overlap(moved, mate) else (near, middle)
        done = _shifted(trial, mate, way * (far + 0.0003))
        clear = not _crowded(*done.origin_m[:2], thing.body.radius_m, others[-12:], 0.004)
        if clear and abs(done.origin_m[1]) <= room:
            return done
        fallback = done if clear else fallback
    if fallback is not None:
        return fallback
    x = float(min(a.origin_m[0] for a in [*others, mate])) - 0.2
    return lay(number, thing, x, 0.0, rng, rock_rad)


def _shifted(actor: Actor, mate: Actor, by_m: F64) -> Actor:
    origin = np.array([mate.origin_m[0] + by_m[0], mate.origin_m[1] + by_m[1], actor.origin_m[2]])
    return Actor(actor.number, actor.thing, actor.rotation, origin, actor.rock_rad)


def overlap(first: Actor, second: Actor) -> bool:
    """Return whether two things run into one another."""
    points = first.thing.body.surface_m @ first.rotation.T + first.origin_m
    inside = (points - second.origin_m) @ second.rotation
    return bool((second.thing.body.value(inside) < 0.0).any())


def _drive(plan: LinePlan, way_m: float) -> tuple[Drive, float]:
    if not plan.stop_s:
        return Drive((0.0,), (plan.speed_m_s,)), way_m / plan.speed_m_s
    half = way_m / 2 / plan.speed_m_s
    times = (0.0, half, half + plan.stop_s)
    slower = 0.7 * plan.speed_m_s
    return Drive(times, (plan.speed_m_s, 0.0, slower)), half + plan.stop_s + way_m / 2 / slower + 0.5
