"""Still scenes for calibrating: how sensors are placed, and what lies on the belt."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.second_rig.bodies import F64
from tests.second_rig.camera import KINECT, Lens, Stand, aim
from tests.second_rig.kinect import Noise
from tests.second_rig.produce import KINDS, Thing, grow, sphere
from tests.second_rig.scene import Actor, Eye, Scene, lay
from tests.second_rig.setting import Block, Setting, rails

LAYOUTS = ("opposed", "chain", "ring", "scattered")
ILL_POSED = {
    "bare": ("too_little_structure", "ambiguous"),
    "bare_rails": ("too_little_structure", "ambiguous"),
    "row": ("ambiguous",),
    "grid": ("ambiguous",),
    "disconnected": ("disconnected", "too_little_overlap"),
    "moved": ("scene_moved",),
    "stirred": ("scene_moved",),
}
"""Scenes that must not be accepted wrongly, with the codes that say so rightly."""


def still(seed: int, layout: str, *, captures: int = 8, lens: Lens = KINECT, noise: Noise | None = None,
          fruit: int | None = None, with_rails: bool | None = None) -> Scene:  # fmt: skip
    """Return a well-posed still scene: sensors of a layout round 9–26 fruit at random."""
    rng = np.random.default_rng([seed, 1])
    setting = furnish(rng, with_rails)
    stands, middle = place(layout, rng)
    count = int(rng.integers(9, 27)) if fruit is None else fruit
    half = np.array([0.32 if layout in ("opposed", "ring") else 0.62, setting.width_m / 2 - 0.06])
    things = [grow(KINDS[int(rng.integers(len(KINDS)))], rng) for _ in range(count)]
    actors = scatter(things, middle, half, rng)
    return _still(seed, setting, stands, actors, captures, lens, noise or Noise(), rng)


def ill_posed(seed: int, case: str) -> Scene:
    """Return a scene of `ILL_POSED`."""
    rng = np.random.default_rng([seed, 2])
    setting = furnish(rng, with_rails=case != "bare")
    stands, middle = place("opposed", rng)
    if case == "disconnected":
        stands = [stands[0], Stand(stands[1].rotation, stands[1].centre_m + np.array([4.0, 0.0, 0.0]))]
    actors = _SUBJECTS.get(case, _mixed)(setting, middle, rng)
    if case == "disconnected":
        second = scatter(
            [grow("lemon", rng) for _ in range(6)], middle + np.array([4.0, 0.0]), np.array([0.3, 0.15]), rng, 100
        )
        actors = (*actors, *second)
    scene = _still(seed, setting, stands, actors, 8, KINECT, Noise(), rng)
    half = scene.seconds / 2
    if case == "moved":
        return _with(scene, shoves=((half, scene.eyes[1].name, 0.03, 0.02, 0.0),))
    if case == "stirred":
        return _with(scene, stirs=tuple((half, a.number, *rng.normal(0.0, 0.03, 2)) for a in actors[::2]))
    return scene


def furnish(rng: np.random.Generator, with_rails: bool | None = None) -> Setting:
    """Return a belt with or without rails, its looks at random."""
    width = float(rng.uniform(0.42, 0.6))
    colours = [(200, 203, 205), (52, 84, 62), (40, 62, 104), (70, 70, 72), (176, 168, 150)]
    belt = colours[int(rng.integers(len(colours)))]
    blocks: tuple[Block, ...] = ()
    if with_rails if with_rails is not None else rng.random() < 0.7:
        steel = tuple(float(c) for c in rng.uniform(120, 200) * np.array([1.0, 1.0, 1.02]))
        blocks = rails(width, float(rng.uniform(0.015, 0.06)), float(rng.uniform(0.015, 0.04)),
                       float(rng.uniform(0.0, 0.02)), (steel[0], steel[1], steel[2]))  # fmt: skip
    lamp = (float(rng.uniform(-0.8, 0.8)), float(rng.uniform(-0.8, 0.8)), float(rng.uniform(1.8, 2.6)))
    return Setting(width_m=width, floor_m=-float(rng.uniform(0.5, 0.9)), belt_colour=belt, blocks=blocks,
                   grain=float(rng.uniform(0.01, 0.06)), lamp_m=lamp, seed=int(rng.integers(1 << 30)))  # fmt: skip


def place(layout: str, rng: np.random.Generator) -> tuple[list[Stand], F64]:
    """Return stands of a layout and the middle of what they look at (x, y)."""
    sides = {
        "opposed": [(90.0, 0.0), (-90.0, 0.0)],
        "chain": [(90.0, -0.5), (-90.0, 0.0), (90.0, 0.5)],
        "ring": [(45.0, 0.1), (135.0, -0.1), (225.0, -0.1), (315.0, 0.1)],
        "scattered": [(float(rng.uniform(0, 360)), along) for along in (-0.25, 0.0, 0.25)],
    }  # fmt: skip
    return [_stand(azimuth + rng.normal(0.0, 8.0), along, rng) for azimuth, along in sides[layout]], np.zeros(2)


def _stand(azimuth_deg: float, along_m: float, rng: np.random.Generator) -> Stand:
    height, aside = rng.uniform(0.7, 1.35), rng.uniform(0.25, 0.75)
    angle = np.radians(azimuth_deg)
    centre = np.array([along_m + aside * np.cos(angle), aside * np.sin(angle), height])
    target = np.array([along_m, 0.0, 0.0]) + np.append(rng.normal(0.0, 0.05, 2), 0.02)
    return aim(centre, target, float(np.radians(rng.normal(0.0, 6.0))))


def scatter(
    things: list[Thing], middle: F64, half_m: F64, rng: np.random.Generator, first: int = 0
) -> tuple[Actor, ...]:
    """Lay things at random inside a rectangle, none into another; what finds no room is left out."""
    actors: list[Actor] = []
    taken: list[tuple[F64, float]] = []
    for thing in things:
        radius = thing.body.radius_m
        for _ in range(200):
            spot = middle + rng.uniform(-half_m, half_m)
            if all(np.linalg.norm(spot - other) > radius + reach + 0.003 for other, reach in taken):
                actors.append(lay(first + len(actors), thing, float(spot[0]), float(spot[1]), rng))
                taken.append((spot, radius))
                break
    return tuple(actors)


def _still(seed: int, setting: Setting, stands: list[Stand], actors: tuple[Actor, ...], captures: int, lens: Lens,
           noise: Noise, rng: np.random.Generator) -> Scene:  # fmt: skip
    names = rng.permutation(["north", "south", "k_a", "k_b", "cam3", "left_2"])[: len(stands)]
    slot = 0.1
    eyes = tuple(Eye(str(name), stand, lens, noise, first_s=n * slot, period_s=slot * len(stands))
                 for n, (name, stand) in enumerate(zip(names, stands, strict=True)))  # fmt: skip
    seconds = captures * slot * len(stands)
    return Scene(seed, setting, eyes, actors, seconds, light_lx=float(np.exp(rng.uniform(np.log(100), np.log(1000)))))


def _mixed(setting: Setting, middle: F64, rng: np.random.Generator) -> tuple[Actor, ...]:
    things = [grow(KINDS[int(rng.integers(len(KINDS)))], rng) for _ in range(14)]
    return scatter(things, middle, np.array([0.32, setting.width_m / 2 - 0.06]), rng)


def _nothing(_setting: Setting, _middle: F64, _rng: np.random.Generator) -> tuple[Actor, ...]:
    return ()


def _balls(rows: int) -> Callable[[Setting, F64, np.random.Generator], tuple[Actor, ...]]:
    def lay_balls(_setting: Setting, middle: F64, rng: np.random.Generator) -> tuple[Actor, ...]:
        ball = sphere(0.035, (200.0, 120.0, 60.0))
        columns = 7 if rows == 1 else 4
        across = (np.arange(rows) - (rows - 1) / 2) * 0.11
        along = (np.arange(columns) - (columns - 1) / 2) * 0.11
        spots = [(x, y) for y in across for x in along]
        return tuple(lay(n, ball, middle[0] + x, middle[1] + y, rng) for n, (x, y) in enumerate(spots))

    return lay_balls


_SUBJECTS: dict[str, Callable[[Setting, F64, np.random.Generator], tuple[Actor, ...]]] = {
    "bare": _nothing,
    "bare_rails": _nothing,
    "row": _balls(1),
    "grid": _balls(3),
}


def _with(scene: Scene, **changes: object) -> Scene:
    from dataclasses import replace

    return replace(scene, **changes)  # type: ignore[arg-type]
